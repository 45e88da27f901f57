// SPDX-License-Identifier: MIT
#include "ratios.hpp"

#include <goffer/measure/timer.hpp>

#include <cstdio>

namespace goffer::bench {
namespace {

void add(const benchmark::BenchmarkReporter::Run& run, const char* counter, std::vector<double>& to) {
    const auto found = run.counters.find(counter);
    if (found != run.counters.end()) to.push_back(found->second.value);
}

// The naive case that belongs to deform/<streams>/...: layouts of the same streams share one.
std::string naive_name(const std::string& name) {
    const std::size_t slash = name.find('/') + 1;
    const std::string streams = name.substr(slash, name.find('/', slash) - slash);
    return "naive/" + streams.substr(streams.find('-') + 1);
}

void print_ratio(double value) {
    value > 0 ? std::printf(" %12.3f", value) : std::printf(" %12s", "");
}

}  // namespace

void RatioReporter::ReportRuns(const std::vector<Run>& runs) {
    ConsoleReporter::ReportRuns(runs);
    for (const Run& run : runs) {
        if (run.run_type != Run::RT_Iteration) continue;
        if (run.counters.find("ns_per_vertex") == run.counters.end()) continue;  // as of one that was refused
        Case& seen = cases_[run.run_name.function_name];
        add(run, "ns_per_vertex", seen.times);
        add(run, "of_floor", seen.of_floor);
    }
}

double RatioReporter::naive_time(const std::string& name) const {
    const auto found = cases_.find(naive_name(name));
    return found == cases_.end() ? 0 : measure::median(found->second.times);
}

void RatioReporter::Finalize() {
    std::printf("\n%-60s %12s %12s %12s\n", "medians of this run", "ns/vertex", "naive / it", "of floor");
    for (const auto& [name, seen] : cases_) {
        const double time = measure::median(seen.times);
        std::printf("%-60s", name.c_str());
        print_ratio(time);
        print_ratio(naive_time(name) / time);
        print_ratio(measure::median(seen.of_floor));
        std::printf("\n");
    }
}

}  // namespace goffer::bench
