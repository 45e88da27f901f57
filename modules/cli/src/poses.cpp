// SPDX-License-Identifier: MIT
#include "poses.hpp"

#include "arguments.hpp"
#include "crossing.hpp"
#include "model.hpp"

#include <goffer/bend/body_input.hpp>

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace goffer::cli {
namespace {

/// Where no word says how far.
constexpr const char* default_angle = "90";

[[noreturn]] void refuse_count(const std::string& option, std::size_t count, std::size_t regions) {
    throw UsageError(option + ": " + std::to_string(count) + " for " + counted(regions, "region") +
                     "; give one for each");
}

/// Of a list, where nobody says what each of its numbers is for.
[[noreturn]] void refuse_list(const std::string& option) {
    throw UsageError(option +
                     ": a list is for a body of several regions; add --regions, or --arcs for a model "
                     "that is bent at rest along a chain of them");
}

std::vector<fit::RegionOptions> read_regions(const std::string& text) {
    std::vector<fit::RegionOptions> regions;
    double sum = 0;
    for (const double share : read_numbers("--regions", text)) {
        regions.push_back({share, std::nullopt});
        sum += share;
    }
    const double rounding = 5.001e-4 * static_cast<double>(regions.size());  // of three digits each
    if (std::fabs(sum - 1) <= rounding)
        for (fit::RegionOptions& region : regions) region.share /= sum;
    try {
        fit::check(regions);
    } catch (const fit::Error& error) {
        throw UsageError("--regions " + text + ": " + error.what());
    }
    return regions;
}

std::vector<double> read_degrees(const std::string& option, const std::string& text, std::size_t count) {
    std::vector<double> degrees = read_angles(option, text);
    if (degrees.size() != count) refuse_count(option, degrees.size(), count);
    return degrees;
}

std::vector<double> read_directions(const std::string& text, std::size_t count) {
    std::vector<double> degrees = read_numbers("--directions", text);
    if (degrees.size() != count) refuse_count("--directions", degrees.size(), count);
    return degrees;
}

/// A target whose pose floats can hold, whatever the number: angles beyond every body's largest are as good
/// as far beyond, and directions come around.
Target target(double angle, double direction) {
    constexpr double beyond = 2 * bend::WorkingRange::max_angle, around = 36000;
    const double turned = std::fabs(direction) > around ? std::remainder(direction, 360) : direction;
    return {angle,
            direction,
            {static_cast<float>(std::clamp(radians(angle), -beyond, beyond)),
             static_cast<float>(radians(turned))}};
}

/// Angle and direction as the vector (alpha cos theta, alpha sin theta).
struct Curvature {
    double x, y;
};

Curvature curvature(double angle, double direction) {
    return {angle * std::cos(radians(direction)), angle * std::sin(radians(direction))};
}

/// How far `rest` can be moved along `unit` until the angle is `limit`.
double room_from(const Curvature& rest, const Curvature& unit, double limit) {
    const double along = rest.x * unit.x + rest.y * unit.y;
    const double missing = limit * limit - rest.x * rest.x - rest.y * rest.y;
    return std::sqrt(along * along + std::max(missing, 0.0)) - along;
}

/// `by` degrees in `direction` from the rest pose; infinite: until the angle is `limit`.
Target moved_from(const Curvature& rest, double by, double direction, double limit) {
    const Curvature unit = curvature(std::copysign(1.0, by), direction);
    const double reach = std::isfinite(by) ? std::fabs(by) : room_from(rest, unit, limit);
    const double x = rest.x + reach * unit.x, y = rest.y + reach * unit.y;
    return target(std::isfinite(by) ? std::hypot(x, y) : std::fabs(by), degrees(std::atan2(y, x)));
}

double largest(const bend::Body& body, std::size_t region) {
    return degrees(static_cast<double>(body.max_angle(region)));
}

/// How many degrees a region has left from its rest pose in `direction`; `by` < 0: the other way.
double room_on(const bend::Body& body, std::size_t region, double by, double direction) {
    const RestPose rest = rest_pose(body, region);
    return room_from(curvature(rest.angle, rest.direction), curvature(std::copysign(1.0, by), direction),
                     largest(body, region));
}

/// `toward`: which way the body is bent at rest.
Target target_from_rest(const bend::Body& body, std::size_t region, double by,
                        const std::optional<double>& direction, double toward) {
    const RestPose rest = rest_pose(body, region);
    if (rest.angle == 0) return target(by, direction.value_or(toward));
    if (!direction && rest.direction == toward) return target(rest.angle + by, rest.direction);
    return moved_from(curvature(rest.angle, rest.direction), by, direction.value_or(toward),
                      largest(body, region));
}

/// How much of `by` degrees each region of a body that is bent along a chain of arcs gets: by their lengths,
/// but no more than brings it to its largest angle; the others get the rest.
std::vector<double> shared_from_rest(const bend::Body& body, double by,
                                     const std::vector<std::optional<double>>& directions, double toward) {
    const std::span<const bend::RegionInput> regions = body.region_inputs();
    std::vector<double> shares(regions.size(), 0);
    std::vector<bool> full(regions.size(), false);
    double left = std::fabs(by);
    for (bool again = true; again;) {
        again = false;
        double length = 0;
        for (std::size_t i = 0; i < regions.size(); ++i) length += full[i] ? 0 : regions[i].length;
        if (!(length > 0)) break;
        for (std::size_t i = 0; i < regions.size() && !again; ++i) {
            if (full[i]) continue;
            const double room =
                room_on(body, i, by, directions[directions.size() == 1 ? 0 : i].value_or(toward));
            shares[i] = left * regions[i].length / length;
            if (shares[i] <= room) continue;
            shares[i] = room;
            left -= room;
            full[i] = again = true;
        }
    }
    // What nobody has room for is asked for all the same, and clamped.
    double given = 0;
    for (const double share : shares) given += share;
    for (double& share : shares)
        share = std::copysign(given > 0 ? share * std::max(std::fabs(by) / given, 1.0) : share, by);
    return shares;
}

/// Whether a region gets straighter than it is at rest. What `inspect` says of the rest pose is rounded, and
/// no straightening.
bool straightens(const RestPose& rest, const Target& target) {
    constexpr double clearly = 0.99, same_way = 0.7;  // cosine of 45 degrees
    constexpr double much = 0.5;                      // of the bend is gone, whatever the direction
    if (!(std::fabs(target.angle) < clearly * rest.angle)) return false;
    const double turn = std::cos(radians(target.direction - rest.direction));
    return std::fabs(target.angle) < much * rest.angle || std::copysign(1.0, target.angle) * turn > same_way;
}

/// Returns whether a region gets straighter than it is at rest.
bool report_rest_pose(Report& report, const PoseRequest& request, const std::vector<Target>& targets,
                      const bend::Body& body) {
    std::size_t straightened = 0;
    double rest = 0;
    for (std::size_t i = 0; i < targets.size(); ++i) {
        straightened += straightens(rest_pose(body, i), targets[i]) ? 1 : 0;
        rest += rest_pose(body, i).angle;
    }
    const bool from_rest = counts_from_rest(request, body);
    report.json["asked_from"] = from_rest ? "rest" : "straight";
    report.json["straightens"] = straightened > 0;
    if (rest == 0) return false;
    if (!request.along_path)
        report.line("angles",
                    "are absolute: 0 is straight, and " + rest_words(body) + " is the shape of the file");
    if (straightened == 0) return false;
    if (from_rest) return true;
    const std::string which = targets.size() == 1
                                  ? "the body"
                                  : std::to_string(straightened) + " of " + counted(targets.size(), "region");
    report.line(
        "note",
        "this straightens " + which + ", bent by " + rest_words(body) + " at rest" +
            (request.along_path ? "" : "; to bend it further from there, use --by D instead of --angle"));
    return true;
}

}  // namespace

void add_angle_words(CLI::App& command, PoseWords& words, const std::string& angle) {
    CLI::Option* const one =
        command.add_option("--angle", words.angle, angle + ". Several regions share it by their lengths")
            ->check(angle_word(true))
            ->type_name("FLOAT|max")
            ->default_str(default_angle);
    command.add_option("--regions", words.regions,
                       "Bend regions on their own: their shares of the length, as 0.3,0.4,0.3");
    command.add_option("--angles", words.angles, "Turn each region by an angle of its own, as 40,-60,20")
        ->excludes(one);
}

void add_pose_words(CLI::App& command, PoseWords& words) {
    add_angle_words(command, words,
                    "Turn the tip by this many degrees from straight, also where the body is bent at rest; "
                    "negative: the other way; max: as far as it can");
    command
        .add_option(
            "--by", words.by,
            "Turn the tip by this many degrees from the rest pose instead, in the plane of the rest arc "
            "or toward --direction")
        ->check(angle_word(true))
        ->type_name("FLOAT|max")
        ->excludes("--angle")
        ->excludes("--angles");
    CLI::Option* const toward =
        command
            .add_option("--direction", words.direction,
                        "Bend in this direction, degrees about the axis (default: that of the rest arc; "
                        "0 of a straight body)")
            ->check(angle_word(false));
    command
        .add_option("--directions", words.directions, "Bend each region in a direction of its own, as 0,0,90")
        ->excludes(toward);
}

std::vector<fit::RegionOptions> equal_regions(std::size_t count) {
    return std::vector<fit::RegionOptions>(count, {1.0 / static_cast<double>(count), std::nullopt});
}

PoseRequest::PoseRequest(const PoseWords& words, std::size_t arcs, std::vector<fit::RegionOptions> baked)
    : regions(words.regions ? read_regions(*words.regions)
              : arcs > 0    ? equal_regions(arcs)
                            : std::move(baked)),
      from_rest(words.by.has_value()),
      by_default(!words.by && !words.angle && !words.angles) {
    if (arcs > 0 && words.regions)
        throw UsageError("--regions: those of --arcs are its arcs; leave out one of them");
    for (const auto& [said, option] : {std::pair(words.angles.has_value(), "--angles"),
                                       std::pair(words.directions.has_value(), "--directions")}) {
        if (said && regions.empty()) refuse_list(option);
    }
    const std::size_t count = std::max<std::size_t>(regions.size(), 1);
    if (words.angles) angles = read_degrees("--angles", *words.angles, count);
    const double all = read_angles(from_rest ? "--by" : "--angle",
                                   words.by.value_or(words.angle.value_or(default_angle)))[0];
    if (!words.angles) shared = all;
    directions.assign(count, words.direction);
    if (words.directions) {
        const std::vector<double> each = read_directions(*words.directions, count);
        directions.assign(each.begin(), each.end());
    }
    for (std::size_t i = 0; i < count && !words.angles; ++i)
        angles.push_back(all * (regions.empty() ? 1 : regions[i].share));
}

void PoseRequest::share_out(const bend::Body& body) {
    for (std::size_t i = 0; shared && i < angles.size(); ++i) angles[i] = *shared * share_of(body, i);
}

RestPose rest_pose(const bend::Body& body, std::size_t region) {
    const bend::RegionInput& input = body.region_inputs()[region];
    return {degrees(input.rest_angle), input.rest_angle == 0 ? 0 : degrees(input.rest_direction)};
}

bend::Pose pose_from_rest(const bend::Body& body, std::size_t region, double by, double direction,
                          double share) {
    const RestPose rest = rest_pose(body, region);
    const Curvature from = curvature(rest.angle, rest.direction);
    const double room = room_on(body, region, by, direction);
    const double reach = std::copysign(share * std::min(std::fabs(by), room), by);
    bend::Pose pose = moved_from(from, reach, direction, largest(body, region)).pose;
    pose.angle = std::min(pose.angle, body.max_angle(region));  // beyond it by rounding alone
    return pose;
}

double share_of(const bend::Body& body, std::size_t region) {
    return body.region_inputs()[region].length / body.length();
}

double rest_direction(const bend::Body& body) {
    constexpr double cancels_out = 0.1;
    RestPose first{}, furthest{};
    bool same = true;
    double all = 0;
    Curvature sum{0, 0};
    for (std::size_t i = 0; i < body.region_count(); ++i) {
        const RestPose rest = rest_pose(body, i);
        if (rest.angle == 0) continue;
        if (all == 0) first = rest;
        same = same && rest.direction == first.direction;
        if (rest.angle > furthest.angle) furthest = rest;
        const Curvature own = curvature(rest.angle, rest.direction);
        sum = {sum.x + own.x, sum.y + own.y};
        all += rest.angle;
    }
    if (same) return first.direction;
    if (std::hypot(sum.x, sum.y) < cancels_out * all) return furthest.direction;
    return degrees(std::atan2(sum.y, sum.x));
}

bool bent_at_rest(const bend::Body& body) {
    return std::ranges::any_of(body.region_inputs(),
                               [](const bend::RegionInput& region) { return region.rest_angle != 0; });
}

bool is_chain(const bend::Body& body) {
    const std::span<const bend::RegionInput> regions = body.region_inputs();
    return std::ranges::any_of(regions, [&](const bend::RegionInput& region) {
        return !bend::share_rest_arc(region, regions[0], body.radius());
    });
}

std::string rest_words(const bend::Body& body) {
    double all = 0;
    bool same = true;
    const double toward = rest_direction(body);
    std::string list, angles;
    for (std::size_t i = 0; i < body.region_count(); ++i) {
        const RestPose rest = rest_pose(body, i);
        all += rest.angle;
        angles += (i == 0 ? "" : ",") + angle_text(rest.angle);
        same = same && (rest.angle == 0 || rest.direction == toward);
        list += (i == 0 ? "" : ", ") + angle_text(rest.angle) + " toward " + angle_text(rest.direction);
    }
    if (!same || is_chain(body)) return list + " degrees";
    const std::string whole = number(all) + " degrees toward " + angle_text(toward);
    return body.region_count() == 1 ? whole : whole + " (by region " + angles + ")";
}

std::vector<Target> targets_from_straight(const PoseRequest& request) {
    std::vector<Target> targets;
    for (std::size_t i = 0; i < request.angles.size(); ++i)
        targets.push_back(target(request.angles[i], request.directions[i].value_or(0)));
    return targets;
}

bool counts_from_rest(const PoseRequest& request, const bend::Body& body) {
    return request.from_rest || (request.by_default && bent_at_rest(body));
}

std::vector<Target> targets_on(const bend::Body& body, const PoseRequest& request) {
    std::vector<Target> targets;
    const double toward = rest_direction(body);
    const bool from_rest = counts_from_rest(request, body);
    std::vector<double> shares;
    if (from_rest && request.shared && std::isfinite(*request.shared) && is_chain(body))
        shares = shared_from_rest(body, *request.shared, request.directions, toward);
    for (std::size_t i = 0; i < body.region_count(); ++i) {
        const std::optional<double>& direction = request.directions[request.directions.size() == 1 ? 0 : i];
        const double angle = !shares.empty()  ? shares[i]
                             : request.shared ? *request.shared * share_of(body, i)
                                              : request.angles[i];
        if (request.by_default && from_rest) {
            targets.push_back(target_of(pose_from_rest(body, i, angle, direction.value_or(toward), 1)));
        } else {
            targets.push_back(from_rest ? target_from_rest(body, i, angle, direction, toward)
                                        : target(angle, direction.value_or(toward)));
        }
    }
    return targets;
}

Target target_of(const bend::Pose& pose) {
    return {degrees(static_cast<double>(pose.angle)), degrees(static_cast<double>(pose.direction)), pose};
}

std::vector<bend::Pose> poses_of(const std::vector<Target>& targets) {
    std::vector<bend::Pose> poses;
    poses.reserve(targets.size());
    for (const Target& target : targets) poses.push_back(target.pose);
    return poses;
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
    if (regions.empty()) refuse_list("--folds");
    if (folds.size() != regions.size()) refuse_count("--folds", folds.size(), regions.size());
    for (std::size_t i = 0; i < folds.size(); ++i) regions[i].folds = static_cast<int>(folds[i]);
    return std::nullopt;
}

std::string region_words(std::size_t region, std::size_t count) {
    return count == 1 ? "" : "region " + std::to_string(region + 1) + ": ";
}

double used_angle(const bend::Body& body, std::size_t region, const bend::Pose& pose) {
    return static_cast<double>(std::min(std::fabs(pose.angle), body.max_angle(region)));
}

bool beyond_full_turn(const bend::Body& body, std::span<const bend::Pose> poses) {
    constexpr double full_turn = 360.001;  // with some room for rounding
    Curvature all{0, 0};
    for (std::size_t r = 0; r < poses.size(); ++r) {
        const double angle = std::copysign(degrees(used_angle(body, r, poses[r])), poses[r].angle);
        const Curvature own = curvature(angle, degrees(static_cast<double>(poses[r].direction)));
        all = {all.x + own.x, all.y + own.y};
    }
    return std::hypot(all.x, all.y) > full_turn;
}

std::vector<double> right_angle_of(const bend::Body& body) {
    std::vector<double> angles;
    for (std::size_t r = 0; r < body.region_count(); ++r) {
        const double angle = share_of(body, r) * std::numbers::pi / 2;
        angles.push_back(std::min(static_cast<double>(body.max_angle(r)), angle));
    }
    return angles;
}

std::string capacity_words(int folds) {
    return folds >= fit::Stretch::max_folds ? "any number" : std::to_string(folds);
}

void warn_of_stretch(Report& report, double change, const std::string& when, const std::string& then) {
    constexpr double most = 0.01;
    if (change > most)
        report.warn("the area changes by " + percent(change) + when +
                    ": straightening stretches the inner side, which wrinkles cannot make up for" + then);
}

bool is_beyond(double asked, double limit) {
    constexpr double rounding = 1e-5;  // a limit is shown in six digits, and may be typed as shown
    return std::fabs(asked) > limit * (1 + rounding);
}

void warn_of_angle(Report& report, const std::string& which, double asked, double limit,
                   const std::string& then) {
    if (!is_beyond(asked, limit)) return;
    report.warn(which + "the angle of " + number(asked) + " degrees is beyond the largest, " + number(limit) +
                ", where the body would fold through itself; " + then);
}

bool report_poses(Report& report, const PoseRequest& request, const std::vector<Target>& targets,
                  const BoundModel& model) {
    const fit::Binding& binding = model.binding;
    const bend::Body& body = binding.body;
    nlohmann::ordered_json poses, regions;
    bool clamped = false;
    for (std::size_t i = 0; i < targets.size(); ++i) {
        const double limit = largest(body, i), asked = targets[i].angle;
        const bool all_the_way = std::isinf(asked);
        const bool beyond = std::fabs(targets[i].pose.angle) > body.max_angle(i);
        const double used = beyond ? std::copysign(limit, asked) : asked;
        const RestPose rest = rest_pose(body, i);
        const bool by_default = request.by_default && rest.angle > 0;
        clamped = clamped || (beyond && !all_the_way);
        poses.push_back({{"angle", used},
                         {"direction", targets[i].direction},
                         {"rest_angle", rest.angle},
                         {"rest_direction", rest.direction}});
        regions.push_back({{"length", binding.regions[i].length},
                           {"folds", binding.folds(i)},
                           {"folds_capacity", binding.folds_capacity(i)},
                           {"max_angle", limit},
                           {"clamped", beyond && !all_the_way}});
        const std::string which = region_words(i, targets.size());
        report.line(i == 0 ? "bend" : "", which + angle_text(used) + " degrees toward " +
                                              angle_text(targets[i].direction) + ", at most " +
                                              number(limit));
        if ((beyond || by_default) && rest.angle > 0 && !is_beyond(limit, rest.angle)) {
            report.warn(
                which +
                (all_the_way || by_default ? "" : "the angle of " + number(asked) + " degrees is clamped: ") +
                "the body is bent at rest by " + number(rest.angle) +
                " degrees, as far as it can be, and keeps that shape" +
                (model.baked ? "" : "; --rest straight fits it as if it were straight"));
        } else if (beyond && !all_the_way) {
            warn_of_angle(report, which, asked, limit, "clamped to it");
        }
    }
    const bool known = !model.baked || binding.folds_capacity() > 0;  // a body file need not say
    for (std::size_t i = 0; known && i < targets.size(); ++i) {
        report.line(i == 0 ? "folds" : "", region_words(i, targets.size()) +
                                               std::to_string(binding.folds(i)) + "; the mesh carries " +
                                               capacity_words(binding.folds_capacity(i)));
    }
    report.json["max_angle"] = regions[0]["max_angle"];
    report.json["folds_capacity"] = binding.folds_capacity();
    report.json["pose"] = poses[0];
    report.json["poses"] = poses;
    report.json["folds"] = binding.folds();
    report.json["regions"] = regions;
    report.json["clamped"] = clamped;
    const bool beyond = beyond_full_turn(body, poses_of(targets));
    report.json["beyond_full_turn"] = beyond;
    const bool through = runs_through_itself(body, poses_of(targets));
    report.json["runs_through_itself"] = through;
    if (beyond) {
        report.warn(std::string("this is ") + full_turn_words);
    } else if (through) {
        report.warn("parts of the body go through each other; bend it less, or another way with --direction");
    }
    return report_rest_pose(report, request, targets, body);
}

}  // namespace goffer::cli
