// SPDX-License-Identifier: MIT
#pragma once

#include <benchmark/benchmark.h>

#include <map>
#include <string>
#include <vector>

namespace goffer::bench {

/// Prints what Google Benchmark prints, and at the end how each deform case stands against the naive code and
/// against the fill of the same bytes, from the same run: the ratio of medians over the repetitions.
class RatioReporter : public benchmark::ConsoleReporter {
public:
    void ReportRuns(const std::vector<Run>& runs) override;
    void Finalize() override;

private:
    [[nodiscard]] double median(const std::string& name) const;  // ns per vertex, or 0 where it was not run

    std::map<std::string, std::vector<double>> times_;  // ns per vertex by case
};

}  // namespace goffer::bench
