// SPDX-License-Identifier: MIT
#pragma once

#include <goffer/bend/job.hpp>
#include <goffer/clip/frames.hpp>
#include <goffer/fit/bind.hpp>
#include <goffer/mesh/mesh.hpp>

#include <glm/geometric.hpp>
#include <glm/mat4x3.hpp>
#include <glm/vec4.hpp>

#include <cmath>
#include <cstddef>
#include <filesystem>
#include <span>
#include <vector>

/// Clips to be written to files.

namespace goffer::test {

/// A rotation about an axis that is none of the coordinates', and a shift.
inline glm::mat4x3 turned_and_shifted(float angle, const glm::vec3& shift) {
    const glm::vec3 axis = glm::normalize(glm::vec3(1, 2, -3));
    const auto turn = [&](const glm::vec3& v) {
        return v * std::cos(angle) + glm::cross(axis, v) * std::sin(angle) +
               axis * glm::dot(axis, v) * (1 - std::cos(angle));
    };
    return {turn({1, 0, 0}), turn({0, 1, 0}), turn({0, 0, 1}), shift};
}

/// Points that all move differently, in x, y and z over different lengths, and are carried about.
class MovingPoints : public clip::Frames {
public:
    MovingPoints(std::size_t vertices, std::size_t count, bool carried)
        : vertices_(vertices), count_(count), carried_(carried) {}

    [[nodiscard]] std::size_t count() const noexcept override { return count_; }
    [[nodiscard]] double rate() const noexcept override { return 24; }
    [[nodiscard]] std::size_t vertices() const noexcept override { return vertices_; }

    void read(std::size_t frame, std::span<glm::vec3> positions, std::span<glm::vec3> normals) override {
        const auto f = static_cast<float>(frame);
        for (std::size_t i = 0; i < vertices_; ++i) {
            const auto v = static_cast<float>(i);
            positions[i] = {3 * std::sin(0.7f * v + 0.3f * f), -5 + std::cos(1.1f * v - 0.2f * f),
                            40 + 0.01f * v + 0.5f * f};
            if (!normals.empty())
                normals[i] = glm::normalize(glm::vec3(std::sin(v + 0.1f * f), std::cos(1.7f * v - 0.1f * f),
                                                      std::sin(2.3f * v + 0.2f * f)));
        }
    }

    [[nodiscard]] glm::mat4x3 placement(std::size_t frame) const override {
        const auto f = static_cast<float>(frame);
        return carried_ ? turned_and_shifted(0.1f * f, {2 * f, -f, 7}) : glm::mat4x3(1.0f);
    }

private:
    std::size_t vertices_, count_;
    bool carried_;
};

/// A model that bends this way and that, and is carried about.
class BendingModel : public clip::Frames {
public:
    BendingModel(const std::filesystem::path& file, std::size_t count)
        : model(mesh::load(file)), arrays(mesh::vertex_arrays_with_uvs(model)), count_(count) {
        const fit::Geometry geometry{arrays.positions, arrays.triangles, arrays.normals};
        binding_ = fit::bind(geometry, fit::fit_cylinder(geometry));
    }

    [[nodiscard]] std::size_t count() const noexcept override { return count_; }
    [[nodiscard]] double rate() const noexcept override { return 25; }
    [[nodiscard]] std::size_t vertices() const noexcept override { return arrays.positions.size(); }

    void read(std::size_t frame, std::span<glm::vec3> positions, std::span<glm::vec3> normals) override {
        const float turn = 6.2831853f * static_cast<float>(frame) / static_cast<float>(count_);
        bend::DeformJob job{.body = &binding_.body,
                            .pose = {.angle = 0.9f * std::sin(turn), .direction = 0.5f + 0.2f * turn}};
        job.positions = interleaved<3>(&positions[0].x, positions.size());
        if (!normals.empty()) job.normals = interleaved<3>(&normals[0].x, normals.size());
        bend::run(job);
    }

    [[nodiscard]] glm::mat4x3 placement(std::size_t frame) const override {
        const auto f = static_cast<float>(frame);
        const auto length = static_cast<float>(binding_.body.length());
        return turned_and_shifted(0.05f * f, length * glm::vec3(0.02f * f, -0.1f, 0.01f * f));
    }

    const mesh::Mesh model;
    const mesh::VertexArrays arrays;

private:
    std::size_t count_;
    fit::Binding binding_;
};

/// A frame's positions where the placement carries them, in double.
inline std::vector<glm::dvec3> carried(clip::Frames& frames, std::size_t frame) {
    std::vector<glm::vec3> positions(frames.vertices());
    frames.read(frame, positions, {});
    const glm::dmat4x3 placement(frames.placement(frame));
    std::vector<glm::dvec3> result;
    result.reserve(positions.size());
    for (const glm::vec3& p : positions) result.push_back(placement * glm::dvec4(p, 1.0));
    return result;
}

/// A frame's normals, turned likewise.
inline std::vector<glm::dvec3> carried_normals(clip::Frames& frames, std::size_t frame) {
    std::vector<glm::vec3> positions(frames.vertices()), normals(frames.vertices());
    frames.read(frame, positions, normals);
    const glm::dmat4x3 placement(frames.placement(frame));
    std::vector<glm::dvec3> result;
    result.reserve(normals.size());
    for (const glm::vec3& n : normals) result.push_back(placement * glm::dvec4(n, 0.0));
    return result;
}

}  // namespace goffer::test
