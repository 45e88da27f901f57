// SPDX-License-Identifier: MIT
#include "poses.hpp"

#include "arguments.hpp"

#include <algorithm>
#include <cmath>

namespace goffer::cli {
namespace {

constexpr double max_degrees = 36000;

[[noreturn]] void refuse_count(const std::string& option, std::size_t count, std::size_t regions) {
    throw UsageError(option + ": " + std::to_string(count) + " for " + counted(regions, "region") +
                     "; give one for each");
}

std::vector<fit::RegionOptions> read_regions(const std::string& text) {
    std::vector<fit::RegionOptions> regions;
    for (const double share : read_numbers("--regions", text)) regions.push_back({share, std::nullopt});
    try {
        fit::check(regions);
    } catch (const fit::Error& error) {
        throw UsageError("--" + std::string(error.what()));
    }
    return regions;
}

std::vector<double> read_degrees(const std::string& option, const std::string& text, std::size_t count) {
    std::vector<double> degrees = read_numbers(option, text);
    if (degrees.size() != count) refuse_count(option, degrees.size(), count);
    for (const double value : degrees) {
        if (std::fabs(value) > max_degrees) {
            throw UsageError(option + ": " + number(value) + " is not an angle in degrees within " +
                             number(-max_degrees) + ".." + number(max_degrees));
        }
    }
    return degrees;
}

CLI::Validator angle_in_degrees() {
    return number_within(-max_degrees, max_degrees, "an angle in degrees");
}

}  // namespace

void add_angle_words(CLI::App& command, PoseWords& words, const std::string& angle) {
    CLI::Option* const one =
        command.add_option("--angle", words.angle, angle + ". Several regions share it by their lengths")
            ->check(angle_in_degrees())
            ->capture_default_str();
    CLI::Option* const regions = command.add_option(
        "--regions", words.regions, "Bend regions on their own: their shares of the length, as 0.3,0.4,0.3");
    command.add_option("--angles", words.angles, "Turn each region by an angle of its own, as 40,-60,20")
        ->needs(regions)
        ->excludes(one);
}

void add_pose_words(CLI::App& command, PoseWords& words) {
    add_angle_words(command, words,
                    "Turn the tip by this many degrees from straight; negative: the other way");
    CLI::Option* const toward =
        command.add_option("--direction", words.direction, "Bend in this direction, degrees about the axis")
            ->check(angle_in_degrees())
            ->capture_default_str();
    command
        .add_option("--directions", words.directions, "Bend each region in a direction of its own, as 0,0,90")
        ->needs("--regions")
        ->excludes(toward);
}

PoseRequest::PoseRequest(const PoseWords& words) {
    if (words.regions) regions = read_regions(*words.regions);
    const std::size_t count = std::max<std::size_t>(regions.size(), 1);
    if (words.angles) angles = read_degrees("--angles", *words.angles, count);
    if (words.directions) directions = read_degrees("--directions", *words.directions, count);
    for (std::size_t i = 0; i < count; ++i) {
        if (!words.angles) angles.push_back(words.angle * (regions.empty() ? 1 : regions[i].share));
        if (!words.directions) directions.push_back(words.direction);
        poses.push_back({static_cast<float>(radians(angles[i])), static_cast<float>(radians(directions[i]))});
    }
}

std::optional<int> read_folds(const std::optional<std::string>& text,
                              std::vector<fit::RegionOptions>& regions) {
    if (!text) return std::nullopt;
    const std::vector<double> folds = read_numbers("--folds", *text);
    for (const double value : folds) {
        if (!(value >= 0 && value <= fit::BindOptions::max_folds) || value != std::floor(value)) {
            throw UsageError("--folds: " + number(value) + " is not a whole number within 0.." +
                             std::to_string(fit::BindOptions::max_folds));
        }
    }
    if (folds.size() == 1) return static_cast<int>(folds[0]);
    if (folds.size() != regions.size())
        refuse_count("--folds", folds.size(), std::max<std::size_t>(regions.size(), 1));
    for (std::size_t i = 0; i < folds.size(); ++i) regions[i].folds = static_cast<int>(folds[i]);
    return std::nullopt;
}

std::string region_words(std::size_t region, std::size_t count) {
    return count == 1 ? "" : "region " + std::to_string(region + 1) + ": ";
}

double used_angle(const bend::Body& body, std::size_t region, const bend::Pose& pose) {
    return static_cast<double>(std::min(std::fabs(pose.angle), body.max_angle(region)));
}

void warn_of_angle(Report& report, const std::string& which, double asked, double limit,
                   const std::string& then) {
    report.warn(which + "the angle of " + number(asked) + " degrees is beyond the largest, " + number(limit) +
                ", where the body would fold through itself; " + then);
}

void report_poses(Report& report, const PoseRequest& request, const fit::Binding& binding) {
    const bend::Body& body = binding.body;
    nlohmann::ordered_json poses, regions;
    bool clamped = false;
    for (std::size_t i = 0; i < request.poses.size(); ++i) {
        const double limit = degrees(static_cast<double>(body.max_angle(i)));
        const double asked = request.angles[i];
        const bool beyond = std::fabs(request.poses[i].angle) > body.max_angle(i);
        const double used = beyond ? std::copysign(limit, asked) : asked;
        clamped = clamped || beyond;
        poses.push_back({{"angle", used}, {"direction", request.directions[i]}});
        regions.push_back({{"length", binding.regions[i].length},
                           {"folds", binding.folds(i)},
                           {"folds_capacity", binding.folds_capacity(i)},
                           {"max_angle", limit},
                           {"clamped", beyond}});
        const std::string which = region_words(i, request.poses.size());
        report.line(i == 0 ? "bend" : "", which + number(used) + " degrees toward " +
                                              number(request.directions[i]) + ", at most " + number(limit));
        report.line(i == 0 ? "folds" : "", which + std::to_string(binding.folds(i)) + " of " +
                                               std::to_string(binding.folds_capacity(i)) +
                                               " that the mesh carries");
        if (beyond) warn_of_angle(report, which, asked, limit, "clamped to it");
    }
    report.json["max_angle"] = regions[0]["max_angle"];
    report.json["folds_capacity"] = binding.folds_capacity();
    report.json["pose"] = poses[0];
    report.json["poses"] = poses;
    report.json["folds"] = binding.folds();
    report.json["regions"] = regions;
    report.json["clamped"] = clamped;
}

}  // namespace goffer::cli
