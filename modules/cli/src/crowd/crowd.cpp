// SPDX-License-Identifier: MIT
#include "crowd/crowd.hpp"

#include "arguments.hpp"
#include "memory.hpp"
#include "poses.hpp"

#include <goffer/bend/bounds.hpp>
#include <goffer/measure/fill.hpp>

#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <new>
#include <numbers>

namespace goffer::cli {
namespace {

constexpr double turn = 2 * std::numbers::pi;
constexpr double frames_per_turn = 600;
constexpr double lag_per_length = 0.25;  // of the tip's swing behind the base's, in turns

/// Evenly spread over 0..1 for any run of `index`, and without a pattern on a grid.
double scattered(std::size_t index, double ratio) {
    double whole = 0;
    return std::modf(static_cast<double>(index) * ratio, &whole);
}

/// A square grid, on which neighbors in a column are of different models too.
std::size_t columns_for(std::size_t instances, std::size_t models) {
    const auto columns = static_cast<std::size_t>(std::ceil(std::sqrt(static_cast<double>(instances))));
    return models > 1 && columns % models == 0 ? columns + 1 : columns;
}

std::size_t instances_of(std::size_t model, std::size_t models, std::size_t instances) {
    return (instances + models - 1 - model) / models;
}

/// Returns a group for each model, each of about as many instances.
std::vector<measure::CrowdGroup> groups_of(std::span<const BoundModel> models, std::size_t instances) {
    std::vector<measure::CrowdGroup> groups;
    for (std::size_t i = 0; i < models.size(); ++i) {
        const bend::Body& body = models[i].binding.body;
        groups.push_back({&body, instances_of(i, models.size(), instances), body.vertex_count()});
    }
    return groups;
}

[[noreturn]] void refuse(const CrowdPlan& plan, std::uint64_t bytes, const std::string& reason) {
    throw InputError(plan.option + ": a crowd of " + std::to_string(plan.instances) + " takes " +
                     number(static_cast<double>(bytes) / 1e9) + " GB of memory" + reason +
                     "; use fewer or coarser models");
}

/// Looks first: a system that hands out more than it has ends the program later, without a word.
Columns memory_for(std::span<const BoundModel> models, const CrowdPlan& plan) {
    const std::size_t vertices = measure::vertex_count(groups_of(models, plan.instances));
    const std::uint64_t bytes =
        std::uint64_t{vertices} * plan.layout.footprint() * sizeof(float) +
        std::uint64_t{plan.instances} * (sizeof(glm::mat4x3) + plan.poses.size() * sizeof(bend::Pose));
    constexpr std::uint64_t most = std::numeric_limits<std::ptrdiff_t>::max();
    if (bytes > most) refuse(plan, bytes, ", more than a program can have");
    if (const auto free = free_memory(); free && bytes > *free) {
        refuse(plan, bytes, ", and " + number(static_cast<double>(*free) / 1e9) + " GB are free");
    }
    try {
        return {1, plan.layout.memory_floats(vertices)};
    } catch (const std::bad_alloc&) {
        refuse(plan, bytes, ", which cannot be had");
    }
}

/// From model space to a place in the world: base end on the ground, axis up, a length of 1, turned by `yaw`
/// (in turns).
glm::mat4x3 transform_to(const bend::Body& body, double x, double y, double yaw) {
    const double c = std::cos(turn * yaw), s = std::sin(turn * yaw);
    const glm::dmat3 turned(c, s, 0, -s, c, 0, 0, 0, 1);
    const glm::dmat3 linear = turned * glm::transpose(body.axes()) * (1 / body.length());
    const glm::dvec3 place = glm::dvec3(x, y, 0) - linear * body.origin();
    return {glm::vec3(linear[0]), glm::vec3(linear[1]), glm::vec3(linear[2]), glm::vec3(place)};
}

/// How far a body at rest reaches from the axis that it stands on, in lengths of it.
double reach_at_rest(const bend::Body& body) {
    const bend::Bounds box = bend::bounds(body, body.rest_poses(), transform_to(body, 0, 0, 0));
    return static_cast<double>(std::max({-box.low.x, -box.low.y, box.high.x, box.high.y}));
}

/// Keeps neighbors from touching: they bend much the same way, except from the rest pose, where each bends
/// its own way. In lengths of a body.
double spacing_for(std::span<const BoundModel> models, bool from_rest) {
    double thickest = 0, farthest = 0;
    for (const BoundModel& model : models) {
        thickest = std::max(thickest, model.cylinder.radius / model.cylinder.length);
        farthest = std::max(farthest, reach_at_rest(model.binding.body));
    }
    const double spacing = 0.25 + 2.7 * thickest;
    return from_rest ? std::max(spacing, 2 * farthest) : spacing;
}

}  // namespace

Crowd::Crowd(std::span<const BoundModel> models, const CrowdPlan& plan)
    : columns_(columns_for(plan.instances, models.size())),
      spacing_(spacing_for(models, plan.from_rest)),
      farthest_(plan.poses),
      from_rest_(plan.from_rest),
      memory_(memory_for(models, plan)),
      scene_(groups_of(models, plan.instances), plan.layout, memory_[0]) {
    members_.reserve(plan.instances);
    transforms_.reserve(plan.instances);
    for (std::size_t m = 0; m < models.size(); ++m) {
        const std::size_t begin = members_.size();
        for (std::size_t place = m; place < plan.instances; place += models.size()) add(models[m], m, place);
        scene_.batches()[m].transforms = strided(std::span(transforms_).subspan(begin));
    }
    job_ = scene_.job(plan.isa, plan.stores);
    set_poses(0);
    if (const bend::Fault fault = bend::validate(job_); !fault.none())
        throw InputError("cannot deform: " + std::string(bend::describe(fault)));
}

void Crowd::add(const BoundModel& model, std::size_t index, std::size_t place) {
    const auto [column, row] = spot_of(place);
    const double x = spacing_ * static_cast<double>(column);
    const double y = spacing_ * static_cast<double>(row);
    const double yaw = scattered(place, 0.754877666);  // with the next: the plastic number's
    const double own = scattered(place, 0.569840291);
    members_.push_back({.model = index,
                        .place = place,
                        .phase = 0.11 * x + 0.17 * y + 0.12 * own,
                        .direction = 0.05 * x - 0.04 * y + 0.10 * own - yaw});
    transforms_.push_back(transform_to(model.binding.body, x, y, yaw));
}

void Crowd::set_farthest(std::span<const bend::Pose> poses) noexcept {
    std::ranges::copy(poses.first(std::min(poses.size(), farthest_.size())), farthest_.begin());
}

void Crowd::set_poses(std::size_t frame) noexcept {
    const auto time = static_cast<double>(frame);
    scene_.set_poses([&](std::size_t index, std::span<bend::Pose> poses) {
        const Member& member = members_[index];
        const bend::Body& body = *job_.batches[member.model].body;
        const double direction = turn * (time / frames_per_turn + member.direction);
        double start = 0;
        for (std::size_t r = 0; r < poses.size(); ++r) {
            const double phase =
                time / frames_per_swing + member.phase - lag_per_length * start / body.length();
            const double swing = 0.5 - 0.5 * std::cos(turn * phase);
            const float limit = body.max_angle(r);
            const auto angle = static_cast<double>(std::clamp(farthest_[r].angle, -limit, limit));
            poses[r] = from_rest_
                           ? pose_from_rest(body, r, degrees(static_cast<double>(farthest_[r].angle)),
                                            degrees(direction), swing)
                           : bend::Pose{static_cast<float>(angle * swing), static_cast<float>(direction)};
            start += static_cast<double>(body.regions()[r].length);
        }
    });
}

void Crowd::fill(float seed, int threads) {
    measure::fill(memory_[0].first(scene_.bytes() / sizeof(float)), seed, true, threads);
}

Spot Crowd::spot(std::size_t index) const noexcept {
    return spot_of(members_[index].place);
}

Spot Crowd::spot_of(std::size_t place) const noexcept {
    return {place % columns_, place / columns_};
}

}  // namespace goffer::cli
