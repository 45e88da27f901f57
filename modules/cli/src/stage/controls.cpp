// SPDX-License-Identifier: MIT
#include "stage/controls.hpp"

#include "deformed.hpp"

#include <goffer/io/text.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <span>
#include <string_view>
#include <utility>

namespace goffer::cli {
namespace {

/// "0.25,0.25,0.25,0.25"; empty for one region. The last makes up for the rounding of the others.
std::string equal_shares(int regions) {
    std::string text;
    double left = 1;
    for (int r = 1; r < regions; ++r) {
        const std::string share = number(1.0 / regions);
        left -= io::to_double(share).value();
        text += share + ",";
    }
    return regions > 1 ? text + number(left) : text;
}

/// `count` regions that bend alike, together as far and that way as these do; angles add up as vectors.
std::vector<Bend> shared_out(const std::vector<Bend>& regions, int count) {
    double x = 0, y = 0;
    for (const Bend& bend : regions) {
        const double angle = static_cast<double>(bend.angle),
                     theta = radians(static_cast<double>(bend.direction));
        x += angle * std::cos(theta);
        y += angle * std::sin(theta);
    }
    const Bend each{static_cast<float>(std::hypot(x, y) / count),
                    static_cast<float>(degrees(std::atan2(y, x)))};
    return std::vector<Bend>(static_cast<std::size_t>(count), each);
}

/// `value` of each region, with commas between them.
template <class Value>
std::string list(const std::vector<Bend>& regions, const Value& value) {
    std::string text;
    for (const Bend& bend : regions)
        text += (text.empty() ? "" : ",") + number(static_cast<double>(value(bend)));
    return text;
}

float angle_of(const Bend& bend) {
    return bend.angle;
}

float direction_of(const Bend& bend) {
    return bend.direction;
}

/// As one word of a shell.
std::string quoted(const std::string& word) {
    const auto plain = [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
               std::string_view("._-/+,=").find(c) != std::string_view::npos;
    };
    if (!word.empty() && std::ranges::all_of(word, plain)) return word;
    std::string text = "'";
    for (const char c : word) text += c == '\'' ? "'\\''" : std::string(1, c);
    return text + "'";
}

}  // namespace

void Controls::set_words(const BindWords& words) {
    profile = words.profile;
    amplitude = words.amplitude;
    shape = words.shape;
    refine = words.refine.empty() ? "on" : words.refine;
    const Controls usual;
    roundness = words.roundness ? static_cast<float>(*words.roundness) : usual.roundness;
    fold_length = words.fold_length ? static_cast<float>(*words.fold_length) : usual.fold_length;
    onset = words.onset ? static_cast<float>(*words.onset) : usual.onset;
    folds = usual.folds;
    folds_list.clear();
    if (!words.folds) return;
    const std::vector<double> numbers = read_numbers("--folds", *words.folds);
    if (numbers.size() > 1) {
        folds_list = *words.folds;
    } else {
        folds = static_cast<int>(numbers[0]);
    }
}

void Controls::set_poses(const Loaded& loaded) {
    const bend::Body& body = loaded.models[0].binding.body;
    regions.clear();
    for (std::size_t r = 0; r < loaded.targets.size(); ++r) {
        const float limit = body.max_angle(r),
                    angle = std::clamp(loaded.targets[r].pose.angle, -limit, limit);
        regions.push_back({static_cast<float>(degrees(static_cast<double>(angle))),
                           static_cast<float>(std::remainder(loaded.targets[r].direction, 360.0))});
    }
}

void Controls::take(const Loaded& loaded) {
    const bend::Body& body = loaded.models[0].binding.body;
    if (loaded.wish.new_pose || body.region_count() != regions.size()) set_poses(loaded);
    if (!loaded.words.folds || loaded.words.folds->find(',') == std::string::npos) folds_list.clear();
    for (std::size_t r = 0; r < regions.size(); ++r) turn(r, {}, body.max_angle(r));
}

void Controls::turn(std::size_t region, const Bend& by, float limit) {
    Bend& bend = regions[region];
    const auto farthest = static_cast<float>(degrees(static_cast<double>(limit)));
    bend.angle = std::clamp(bend.angle + by.angle, -farthest, farthest);
    bend.direction = std::remainder(bend.direction + by.direction, 360.0f);
}

Wish wish_of(const Controls& controls, Wish wish) {
    BindWords& words = wish.bind;
    words.paper = false;
    words.profile = controls.profile;
    words.amplitude = controls.amplitude;
    words.shape = controls.shape;
    words.refine = controls.refine;
    words.roundness.reset();
    words.folds.reset();
    words.fold_length.reset();
    words.onset.reset();
    if (!controls.folds_list.empty()) {
        words.folds = controls.folds_list;
    } else if (controls.folds >= 0) {
        words.folds = std::to_string(controls.folds);
    }
    if (controls.fold_length > 0 && !words.folds)
        words.fold_length = static_cast<double>(controls.fold_length);
    if (controls.roundness != Controls().roundness && words.profile == "even")
        words.roundness = static_cast<double>(controls.roundness);
    if (controls.onset >= 0) words.onset = static_cast<double>(controls.onset);
    const bool same = controls.region_count == static_cast<int>(controls.regions.size());
    const std::vector<Bend> regions =
        same ? controls.regions : shared_out(controls.regions, controls.region_count);
    std::optional<std::string> shares = same ? wish.pose.regions : equal_shares(controls.region_count);
    wish.pose = {};
    wish.keep_rest = false;
    wish.new_pose = !same;
    if (shares && !shares->empty()) wish.pose.regions = std::move(shares);
    const bool others = words.fit.arcs > 0 || controls.region_count == 1;
    if (!same && others && words.fit.rest == "auto") {  // arcs that were or would be found give way
        words.fit.arcs = 0;
        words.fit.rest = "arc";
    }
    if (regions.size() > 1) {
        wish.pose.angles = list(regions, angle_of);
        wish.pose.directions = list(regions, direction_of);
    } else {
        wish.pose.angle = list(regions, angle_of);
        wish.pose.direction = static_cast<double>(regions[0].direction);
    }
    return wish;
}

Wish wish_to_open(std::vector<std::filesystem::path> files, const Controls& controls, Wish wish) {
    Wish other = wish_of(controls, std::move(wish));
    other.files = std::move(files);
    other.pose = {};
    other.keep_rest = true;
    other.new_pose = true;
    other.bind.level = 0;
    other.bind.fit = {};
    other.bind.wrinkle_range.reset();
    other.bind.wrinkle_mask.reset();
    if (other.bind.folds && other.bind.folds->find(',') != std::string::npos) other.bind.folds.reset();
    other.bind.choices.clear();  // were of the files of the command line
    return other;
}

std::vector<bend::Pose> poses_of(const Controls& controls) {
    std::vector<bend::Pose> poses;
    for (const Bend& bend : controls.regions)
        poses.push_back({static_cast<float>(radians(static_cast<double>(bend.angle))),
                         static_cast<float>(radians(static_cast<double>(bend.direction)))});
    return poses;
}

Bend bend_of(const bend::Pose& pose) {
    return {static_cast<float>(degrees(static_cast<double>(pose.angle))),
            static_cast<float>(degrees(static_cast<double>(pose.direction)))};
}

std::vector<bend::Pose> swung(std::vector<bend::Pose> poses, std::size_t frame) {
    const double swing =
        0.5 - 0.5 * std::cos(2 * std::numbers::pi * static_cast<double>(frame) / frames_per_swing);
    for (bend::Pose& pose : poses) pose.angle *= static_cast<float>(swing);
    return poses;
}

std::string command_of(const Controls& controls, const Wish& wish, const BoundModel& model) {
    if (wish.files.empty()) throw InputError("the base model has no file to bend; open a model");
    const Wish now = wish_of(controls, wish);
    const BindWords usual;
    const bool crowd = controls.instances > 0;
    std::string text = crowd ? "goffer view" : "goffer bend";
    const auto add_file = [&](const std::filesystem::path& name) {
        text += " " + quoted((name.string().starts_with('-') ? "./" : "") + name.string());
    };
    std::ranges::for_each(std::span(now.files).first(crowd ? now.files.size() : 1), add_file);
    const auto add = [&](const std::string& option, const std::string& value) {
        text += " --";
        text += option;
        text += " ";
        text += value;
    };
    const auto add_unless = [&](const std::string& option, const std::string& value,
                                const std::string& except) {
        if (value != except) add(option, value);
    };
    if (crowd) add("crowd", std::to_string(controls.instances));
    const bool several = controls.regions.size() > 1;
    if (now.bind.fit.arcs > 0) {
        add("arcs", std::to_string(now.bind.fit.arcs));
    } else if (several && !model.baked) {
        add("regions", now.pose.regions.value_or(""));
    }
    add(several ? "angles" : "angle", list(controls.regions, angle_of));
    add(several ? "directions" : "direction", list(controls.regions, direction_of));
    if (now.bind.level > 0) add("level", std::to_string(now.bind.level));
    if (!model.baked) {
        const BindWords& words = now.bind;
        add_unless("profile", words.profile, usual.profile);
        if (words.folds) add("folds", *words.folds);
        if (words.fold_length) add("fold-length", number(*words.fold_length));
        add_unless("amplitude", words.amplitude, usual.amplitude);
        add_unless("shape", words.shape, usual.shape);
        add_unless("joints", words.joints, usual.joints);
        if (words.roundness) add("roundness", number(*words.roundness));
        if (words.onset) add("onset", number(*words.onset));
        if (words.wrinkle_range) add("wrinkle-range", *words.wrinkle_range);
        if (words.wrinkle_mask) add("wrinkle-mask", *words.wrinkle_mask);
        add_unless("axis", words.fit.axis, usual.fit.axis);
        add_unless("rest", words.fit.rest, usual.fit.rest);
        add_unless("refine", words.refine, "auto");
        if (words.load.allow_outside) text += " --allow-outside";
    }
    if (crowd) return text;
    return text + " -o " + quoted(model.file.stem().string() + "-bent" + ending_of(model));
}

}  // namespace goffer::cli
