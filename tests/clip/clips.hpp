// SPDX-License-Identifier: MIT
#pragma once

#include <goffer/bend/job.hpp>
#include <goffer/bend/path.hpp>
#include <goffer/clip/frames.hpp>
#include <goffer/engine/strided_view.hpp>
#include <goffer/fit/bind.hpp>
#include <goffer/mesh/mesh.hpp>

#include <cmath>
#include <functional>
#include <utility>
#include <vector>

/// Moving meshes for the tests.

namespace goffer::test {

/// A mesh whose vertices a function moves.
class MadeFrames : public clip::Frames {
public:
    /// Returns where a position or a normal of the rest is in a frame.
    using Move = std::function<glm::vec3(std::size_t frame, const glm::vec3& position, bool is_normal,
                                         const glm::vec3& value)>;
    using Place = std::function<glm::mat4x3(std::size_t frame)>;

    MadeFrames(const mesh::Mesh& mesh, std::size_t count, Move move, Place place = {})
        : rest_(mesh::vertex_arrays(mesh)), count_(count), move_(std::move(move)), place_(std::move(place)) {}

    [[nodiscard]] std::size_t count() const noexcept override { return count_; }
    [[nodiscard]] double rate() const noexcept override { return 30; }
    [[nodiscard]] std::size_t vertices() const noexcept override { return rest_.positions.size(); }
    void read(std::size_t frame, std::span<glm::vec3> positions, std::span<glm::vec3> normals) override {
        ++reads;
        for (std::size_t i = 0; i < positions.size(); ++i)
            positions[i] = move_(frame, rest_.positions[i], false, rest_.positions[i]);
        for (std::size_t i = 0; i < normals.size(); ++i)
            normals[i] = move_(frame, rest_.positions[i], true, rest_.normals[i]);
    }
    [[nodiscard]] glm::mat4x3 placement(std::size_t frame) const override {
        return place_ ? place_(frame) : glm::mat4x3(1.0f);
    }

    std::size_t reads = 0;

private:
    mesh::VertexArrays rest_;
    std::size_t count_;
    Move move_;
    Place place_;
};

/// A mesh with regions that walks along an S: it bends as its path does, and is carried along it.
class WalkingFrames : public clip::Frames {
public:
    WalkingFrames(const mesh::Mesh& mesh, std::size_t count, std::size_t regions)
        : rest_(mesh::vertex_arrays(mesh)), count_(count) {
        const fit::Geometry geometry{rest_.positions, rest_.triangles, rest_.normals};
        fit::BindOptions options;
        options.regions.assign(regions, {.share = 1.0 / static_cast<double>(regions)});
        binding_ = fit::bind(geometry, fit::fit_cylinder(geometry), options);
    }

    [[nodiscard]] std::size_t count() const noexcept override { return count_; }
    [[nodiscard]] double rate() const noexcept override { return 30; }
    [[nodiscard]] std::size_t vertices() const noexcept override { return rest_.positions.size(); }

    void read(std::size_t frame, std::span<glm::vec3> positions, std::span<glm::vec3> normals) override {
        std::vector<bend::Pose> poses(binding_.body.region_count());
        (void)along(frame, poses);
        std::vector<glm::vec3> p(positions.size()), n(normals.size());
        bend::DeformJob job{.body = &binding_.body, .poses = poses};
        job.positions = interleaved<3>(&p[0].x, p.size());
        if (!n.empty()) job.normals = interleaved<3>(&n[0].x, n.size());
        bend::run(job);
        for (std::size_t i = 0; i < p.size(); ++i) {
            const std::size_t to = binding_.order.empty() ? i : binding_.order[i];
            positions[to] = p[i];
            if (!n.empty()) normals[to] = n[i];
        }
    }

    [[nodiscard]] glm::mat4x3 placement(std::size_t frame) const override {
        std::vector<bend::Pose> poses(binding_.body.region_count());
        return along(frame, poses).transform;
    }

private:
    [[nodiscard]] bend::PathFit along(std::size_t frame, std::span<bend::Pose> poses) const {
        const auto length = static_cast<float>(binding_.body.length());
        const float begin =
            2 * static_cast<float>(frame) / static_cast<float>(std::max<std::size_t>(count_ - 1, 1));
        std::vector<glm::vec3> points;
        for (int i = 0; i <= 60; ++i) {
            const float t = begin + 1.2f * static_cast<float>(i) / 60;
            points.emplace_back(length * 0.5f * std::sin(2.1f * t), 0.0f, length * t);
        }
        return bend::poses_along(binding_.body, points, poses);
    }

    mesh::VertexArrays rest_;
    std::size_t count_;
    fit::Binding binding_;
};

}  // namespace goffer::test
