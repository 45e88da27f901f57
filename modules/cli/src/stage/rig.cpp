// SPDX-License-Identifier: MIT
#include "stage/rig.hpp"

#include <goffer/bend/job.hpp>
#include <goffer/fit/bind.hpp>
#include <goffer/paper/base.hpp>
#include <goffer/paper/shape.hpp>

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace goffer::cli {
namespace {

constexpr std::uint32_t columns = 32, rows_of_region = 96, ring_step = 4, column_step = 4;
constexpr glm::vec3 line_color{0.05f, 0.12f, 0.30f};

}  // namespace

std::optional<Rig> Rig::make(const BoundModel& model) {
    if (model.baked) return std::nullopt;
    const fit::Cylinder& cylinder = model.cylinder;
    Rig rig;
    std::vector<double> heights;
    double start = 0;
    for (const fit::RegionBinding& region : model.binding.regions) {
        for (std::uint32_t i = 0; i < rows_of_region; ++i)
            heights.push_back(start + region.length * i / rows_of_region);
        start += region.length;
    }
    heights.push_back(cylinder.length);
    rig.rows_ = heights.size();
    const auto rows = static_cast<std::uint32_t>(rig.rows_);
    const std::vector<std::uint32_t> triangles =
        paper::base_mesh(cylinder.length, cylinder.radius, columns, rows).triangles;
    std::optional<paper::Spline> radius;
    if (!cylinder.radii.empty()) radius.emplace(cylinder.length, cylinder.radii);
    std::vector<fit::BasePoint> points;
    for (const double z : heights) {
        for (std::uint32_t c = 0; c < columns; ++c)
            points.push_back(
                {2 * std::numbers::pi * c / columns, z, radius ? (*radius)(z) : cylinder.radius});
    }
    const std::vector<glm::dvec3> places = fit::places_on_base(cylinder, points);
    const std::vector<glm::vec3> positions(places.begin(), places.end());
    try {
        fit::Binding binding = fit::bind_level({positions, triangles}, model.binding);
        rig.place_ = binding.vertices_in_body();
        rig.body_ = std::move(binding.body);
    } catch (const fit::Error&) {
        return std::nullopt;  // outside bend::WorkingRange
    }
    rig.bent_.resize(positions.size());
    return rig;
}

const glm::vec3& Rig::at(std::size_t row, std::size_t column) const {
    return bent_[place_[row * columns + column % columns]];
}

void Rig::set(std::span<const bend::Pose> poses) {
    bend::DeformJob job;
    job.body = &body_;
    job.poses = poses;
    job.positions = interleaved<3>(&bent_.front().x, bent_.size());
    bend::run(job);
}

std::vector<draw::Mark> Rig::lines() const {
    std::vector<draw::Mark> lines;
    const auto line = [&](const glm::vec3& from, const glm::vec3& to) {
        lines.push_back({from, line_color});
        lines.push_back({to, line_color});
    };
    for (std::size_t row = 0; row < rows_; row += ring_step) {
        for (std::size_t c = 0; c < columns; ++c) line(at(row, c), at(row, c + 1));
    }
    for (std::size_t c = 0; c < columns; c += column_step) {
        for (std::size_t row = 0; row + 1 < rows_; ++row) line(at(row, c), at(row + 1, c));
    }
    return lines;
}

}  // namespace goffer::cli
