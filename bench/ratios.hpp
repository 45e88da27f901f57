// SPDX-License-Identifier: MIT
#pragma once

#include <benchmark/benchmark.h>

#include <map>
#include <string>
#include <vector>

namespace goffer::bench {

/// Prints what Google Benchmark prints, and at the end how each case stands against the naive code and
/// against its floor, from the same run: medians over the repetitions.
class RatioReporter : public benchmark::ConsoleReporter {
public:
    RatioReporter() : ConsoleReporter(OO_None) {}
    void ReportRuns(const std::vector<Run>& runs) override;
    void Finalize() override;

private:
    struct Case {
        std::vector<double> times;     // ns per vertex, one per repetition
        std::vector<double> of_floor;  // as many, or none
    };

    [[nodiscard]] double naive_time(const std::string& name) const;  // 0 where there is none

    std::map<std::string, Case> cases_;
};

}  // namespace goffer::bench
