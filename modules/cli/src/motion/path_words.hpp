// SPDX-License-Identifier: MIT
#pragma once

#include "command_line.hpp"
#include "motion/path.hpp"
#include "poses.hpp"
#include "report.hpp"

#include <filesystem>
#include <vector>

/// Words on the path that a body is bent along.

namespace goffer::cli {

struct BoundModel;

struct PathOptions {
    std::filesystem::path file;  ///< empty: none
    double start = 0;
    std::string scale = "1";
};

/// What a file of a path holds, for --help.
inline constexpr const char* path_help =
    "A path is a file of three numbers a line, or JSON: [[x,y,z], ..] or an object with \"points\" or\n"
    "\"bezier\": [[p,p,p,p], ..], and \"closed\": true where it goes back to its beginning. A curve runs\n"
    "through points, unless \"curve\" is \"straight\". It has the units of the model; --path-scale F\n"
    "multiplies it. Regions follow it, each as one arc: eight of equal length, unless --regions says others.";

/// Adds --path and --path-scale. Both structures of words must outlive `command`.
void add_path_words(CLI::App& command, PathOptions& words);

/// Refuses (UsageError) other words of a path where there is none.
void check_path_words(const PathOptions& words, const CLI::App& command);

/// The regions of a body that follows a path where nobody says.
[[nodiscard]] std::vector<fit::RegionOptions> regions_for_path();

/// How a body lies on its path.
struct Laid {
    std::vector<Target> targets;  ///< one per region
    bend::PathFit fit;
    double length = 0;  ///< of the path, scaled
    double body_length = 0;
    double scale = 1;
    double beyond = 0;  ///< how much of the body lies beyond the path's end, straight on
};

/// Lays `body` on the path of `words`. Throws InputError.
[[nodiscard]] Laid lay(const bend::Body& body, const PathOptions& words);

/// Says how closely the body lies on it.
void report_path(Report& report, const Laid& laid, const PathOptions& words);

/// The factor that --path-scale says. Throws UsageError.
[[nodiscard]] double read_path_scale(const std::string& text);

}  // namespace goffer::cli
