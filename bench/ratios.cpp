// SPDX-License-Identifier: MIT
#include "ratios.hpp"

#include <algorithm>
#include <cstdio>

namespace goffer::bench {
namespace {

constexpr const char* counter = "ns_per_vertex";

// deform/<streams>/...: the naive case and the fill that belong to it.
std::string streams_of(const std::string& name) {
    const std::size_t first = name.find('/') + 1;
    return name.substr(first, name.find('/', first) - first);
}

}  // namespace

void RatioReporter::ReportRuns(const std::vector<Run>& runs) {
    ConsoleReporter::ReportRuns(runs);
    for (const Run& run : runs) {
        const auto found = run.counters.find(counter);
        if (run.run_type == Run::RT_Iteration && !run.error_occurred && found != run.counters.end()) {
            times_[run.run_name.function_name].push_back(found->second.value);
        }
    }
}

double RatioReporter::median(const std::string& name) const {
    const auto found = times_.find(name);
    if (found == times_.end()) return 0;
    std::vector<double> sorted = found->second;
    std::sort(sorted.begin(), sorted.end());
    return sorted[sorted.size() / 2];
}

void RatioReporter::Finalize() {
    std::printf("\n%-48s %12s %12s %12s\n", "medians of this run", "ns/vertex", "naive / it", "fill / it");
    for (const auto& [name, values] : times_) {
        const double time = median(name);
        const double naive = median("naive/" + streams_of(name));
        const double fill = median("floor/fill/" + streams_of(name));
        std::printf("%-48s %12.3f %12.2f %12.3f\n", name.c_str(), time, naive / time, fill / time);
    }
}

}  // namespace goffer::bench
