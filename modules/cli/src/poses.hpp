// SPDX-License-Identifier: MIT
#pragma once

#include "report.hpp"

#include <goffer/bend/body.hpp>
#include <goffer/bend/pose.hpp>
#include <goffer/fit/bind.hpp>

#include <CLI/CLI.hpp>

#include <optional>
#include <string>
#include <vector>

/// How far and which way a body bends, region by region, from the words of the command line.

namespace goffer::cli {

/// Words on poses. Lists are numbers with commas between them, from base to tip.
struct PoseWords {
    double angle = 90;
    double direction = 0;
    std::optional<std::string> regions;
    std::optional<std::string> angles;
    std::optional<std::string> directions;
};

/// Adds --angle, --regions and --angles. `angle` says what --angle is; `words` must outlive `command`.
void add_angle_words(CLI::App& command, PoseWords& words, const std::string& angle);

/// Adds these, --direction and --directions.
void add_pose_words(CLI::App& command, PoseWords& words);

/// Such words, understood: one pose per region. Throws UsageError.
struct PoseRequest {
    std::vector<fit::RegionOptions> regions;  ///< none: the body is one region
    std::vector<double> angles;               ///< degrees, one per region
    std::vector<double> directions;           ///< degrees, one per region
    std::vector<bend::Pose> poses;            ///< the same, in radians

    explicit PoseRequest(const PoseWords& words);
};

/// "3", or a list of one number of folds per region: the one, or into `regions`. Nothing for no text. Throws
/// UsageError.
[[nodiscard]] std::optional<int> read_folds(const std::optional<std::string>& text,
                                            std::vector<fit::RegionOptions>& regions);

/// What begins a line about one of `count` regions: nothing where there is one alone.
[[nodiscard]] std::string region_words(std::size_t region, std::size_t count);

/// The angle of a pose that a run uses, radians, >= 0: clamped to the region's largest.
[[nodiscard]] double used_angle(const bend::Body& body, std::size_t region, const bend::Pose& pose);

/// Warns that an angle is beyond the largest, both in degrees. `which` begins the line; `then` ends it: what
/// is done.
void warn_of_angle(Report& report, const std::string& which, double asked, double limit,
                   const std::string& then);

/// Says what each region was bent by, and warns of those that were clamped.
void report_poses(Report& report, const PoseRequest& request, const fit::Binding& binding);

}  // namespace goffer::cli
