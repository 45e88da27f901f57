// SPDX-License-Identifier: MIT
#include "motion/path_words.hpp"

#include "arguments.hpp"
#include "model.hpp"
#include "motion/document.hpp"

#include <goffer/io/error.hpp>

#include <CLI/CLI.hpp>

#include <algorithm>

namespace goffer::cli {
namespace {

constexpr double largest_scale = 1e9;  // that --path-scale takes

nlohmann::ordered_json rows_of(const glm::mat4x3& transform) {
    nlohmann::ordered_json rows;
    for (int r = 0; r < 3; ++r)
        rows.push_back({transform[0][r], transform[1][r], transform[2][r], transform[3][r]});
    return rows;
}

}  // namespace

void add_path_words(CLI::App& command, PathOptions& words) {
    command.add_option("--path", words.file, "Bend along the path in this file, and lie on it (see below)");
    command.add_option("--path-scale", words.scale,
                       "Multiply the path by this; fit: until it is as long as the body [1]");
}

void check_path_words(const PathOptions& words, const CLI::App& command) {
    for (const char* const option : {"--path-start", "--path-scale"}) {
        const CLI::Option* const known = command.get_option_no_throw(option);
        if (known && known->count() > 0 && words.file.empty())
            throw UsageError(std::string(option) + ": belongs to a path; add --path FILE");
    }
}

std::vector<fit::RegionOptions> regions_for_path() {
    return equal_regions(8);
}

double read_path_scale(const std::string& text) {
    const std::vector<double> numbers = read_numbers("--path-scale", text);
    constexpr double least_scale = 1e-9;
    if (numbers.size() != 1 || !(numbers[0] >= least_scale && numbers[0] <= largest_scale))
        throw UsageError("--path-scale: '" + text + "' is not a number within 1e-09..1e+09");
    return numbers[0];
}

Laid lay(const bend::Body& body, const PathOptions& words) {
    const std::string where = io::escaped(words.file.string());
    const nlohmann::json document = read_path_file(words.file);
    Laid laid;
    laid.scale = words.scale == "fit" ? body.length() / Path(read_path(document, 1, where), where).length()
                                      : read_path_scale(words.scale);
    const Path path(read_path(document, laid.scale, where), where);
    laid.length = path.length();
    laid.body_length = body.length();
    if (!path.closed() && words.start > path.length())
        throw InputError("--path-start: " + number(words.start) + " is beyond the end of a path of " +
                         number(path.length()) + "; give less");
    std::vector<bend::Pose> poses(body.region_count());
    laid.fit = path.lay(body, words.start, poses);
    if (!path.closed()) laid.beyond = std::max(words.start + body.length() - path.length(), 0.0);
    for (const bend::Pose& pose : poses) laid.targets.push_back(target_of(pose));
    return laid;
}

void report_path(Report& report, const Laid& laid, const PathOptions& words) {
    const auto error = static_cast<double>(laid.fit.error);
    constexpr double rounding = 1e-6;  // of floats, in lengths of the body
    report.json["path"] = {{"file", words.file.string()},
                           {"length", laid.length},
                           {"scale", laid.scale},
                           {"start", words.start},
                           {"error", error},
                           {"clamped", laid.fit.clamped},
                           {"transform", rows_of(laid.fit.transform)}};
    report.line("path", words.file.string() + ", " + number(laid.length) + " long, starting at " +
                            number(words.start) + ": the center line is within " +
                            number(error < rounding * laid.body_length ? 0 : error) + " of it");
    constexpr double much_longer = 8;
    if (const double ratio = laid.length / laid.body_length; ratio > much_longer)
        report.line("", "the path is " + number(ratio) +
                            " times as long as the body, which follows only a part of it; --path-scale fit "
                            "makes them equally long");
    constexpr double noticeable = 1e-3;
    if (laid.beyond > noticeable * laid.length) {
        const double enough = laid.scale * (laid.length + laid.beyond) / laid.length;
        report.warn("the path is " + number(laid.beyond) +
                    " shorter than the body, which goes straight on beyond its end; " +
                    (enough <= largest_scale ? "--path-scale " + number(enough) + " makes it long enough"
                                             : "give a longer one"));
    }
    if (laid.fit.clamped)
        report.warn("the path bends more sharply than the body can; regions are bent as far as they can");
}

}  // namespace goffer::cli
