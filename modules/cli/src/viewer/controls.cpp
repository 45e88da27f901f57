// SPDX-License-Identifier: MIT
#include "viewer/controls.hpp"

#include <algorithm>
#include <cmath>

namespace goffer::cli {
namespace {

/// "0.25,0.25,0.25,0.25"; empty for one region.
std::string equal_shares(std::size_t regions) {
    std::string text;
    for (std::size_t r = 0; regions > 1 && r < regions; ++r)
        text += (r > 0 ? "," : "") + number(1 / static_cast<double>(regions));
    return text;
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

void Controls::set(const BindWords& said) {
    const BindWords words = BindRequest(said).words;
    profile = words.profile;
    amplitude = words.amplitude;
    shape = words.shape;
    refine = words.refine.empty() ? "on" : words.refine;
    roundness = static_cast<float>(words.roundness);
    if (words.fold_length) fold_length = static_cast<float>(*words.fold_length);
    if (words.onset) onset = static_cast<float>(*words.onset);
    if (words.folds && words.folds->find(',') == std::string::npos) folds = std::atoi(words.folds->c_str());
}

void Controls::set(const std::vector<Target>& targets) {
    regions.clear();
    for (const Target& target : targets)
        regions.push_back({static_cast<float>(degrees(static_cast<double>(target.pose.angle))),
                           static_cast<float>(target.direction)});
}

Wish wish_of(const Controls& controls, Wish wish) {
    BindWords& words = wish.bind;
    words.paper = false;
    words.profile = controls.profile;
    words.amplitude = controls.amplitude;
    words.shape = controls.shape;
    words.refine = controls.refine;
    words.roundness = static_cast<double>(controls.roundness);
    words.folds.reset();
    words.fold_length.reset();
    words.onset.reset();
    if (controls.folds > 0) words.folds = std::to_string(controls.folds);
    if (controls.fold_length > 0) words.fold_length = static_cast<double>(controls.fold_length);
    if (controls.onset >= 0) words.onset = static_cast<double>(controls.onset);
    const std::size_t regions = controls.regions.size();
    const std::string shares = wish.pose.regions.value_or("");
    const auto said = static_cast<std::size_t>(std::ranges::count(shares, ',')) + 1;
    if (said != regions) wish.pose.regions = equal_shares(regions);
    if (regions == 1) wish.pose.regions.reset();
    wish.keep_rest = false;
    wish.pose.by.reset();
    wish.pose.directions.reset();
    wish.pose.angles.reset();
    if (regions > 1) {
        wish.pose.angles = list(controls.regions, angle_of);
    } else {
        wish.pose.angle = list(controls.regions, angle_of);
    }
    return wish;
}

std::vector<bend::Pose> poses_of(const Controls& controls) {
    std::vector<bend::Pose> poses;
    for (const Bend& bend : controls.regions)
        poses.push_back({static_cast<float>(radians(static_cast<double>(bend.angle))),
                         static_cast<float>(radians(static_cast<double>(bend.direction)))});
    return poses;
}

std::string command_of(const Controls& controls, const Wish& wish, const BoundModel& model) {
    const Wish now = wish_of(controls, wish);
    const BindWords usual;
    std::string text = "goffer bend " + quoted(model.file.string());
    const auto add = [&](const std::string& option, const std::string& value) {
        text += " --" + option + " " + value;
    };
    const auto add_unless = [&](const std::string& option, const std::string& value,
                                const std::string& except) {
        if (value != except) add(option, value);
    };
    const bool several = controls.regions.size() > 1;
    if (several && !model.baked) add("regions", *now.pose.regions);
    add(several ? "angles" : "angle", list(controls.regions, angle_of));
    add(several ? "directions" : "direction", list(controls.regions, direction_of));
    if (!model.baked) {
        const BindWords& words = now.bind;
        add_unless("profile", words.profile, usual.profile);
        if (words.folds) add("folds", *words.folds);
        if (words.fold_length) add("fold-length", number(*words.fold_length));
        add_unless("amplitude", words.amplitude, usual.amplitude);
        add_unless("shape", words.shape, usual.shape);
        add_unless("roundness", number(words.roundness), number(usual.roundness));
        if (words.onset) add("onset", number(*words.onset));
        if (words.wrinkle_range) add("wrinkle-range", *words.wrinkle_range);
        add_unless("axis", words.axis, usual.axis);
        add_unless("rest", words.rest, usual.rest);
        add_unless("refine", words.refine, "auto");
    }
    return text + " -o " + quoted(model.file.stem().string() + "-bent.glb");
}

}  // namespace goffer::cli
