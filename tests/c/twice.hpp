// SPDX-License-Identifier: MIT
#pragma once

#include "support/bodies.hpp"

#include <goffer/bend/pose.hpp>
#include <goffer/fit/bake.hpp>
#include <goffer/fit/bind.hpp>

#include <doctest/doctest.h>
#include <goffer.h>

#include <cstring>
#include <string>
#include <vector>

/// What tests of the C interface share.

namespace goffer::test {

inline goffer_mesh mesh_of(const TestMesh& mesh) {
    return {&mesh.positions[0].x,
            &mesh.normals[0].x,
            &mesh.tangents[0].x,
            mesh.positions.size(),
            mesh.triangles.data(),
            mesh.triangles.size() / 3,
            nullptr};
}

/// A mesh bound twice: from C, and from C++.
struct Twice {
    TestMesh mesh;
    fit::Binding binding;
    goffer_body* body;
    std::vector<goffer_pose> poses;

    explicit Twice(Random& random, std::size_t regions) : mesh(random_mesh(random, 12, 2, 24, 65)) {
        const fit::Geometry geometry = mesh.geometry();
        fit::BindOptions options;
        std::vector<double> shares(regions, 1.0 / static_cast<double>(regions));
        for (const double share : shares) options.regions.push_back({share, {}});
        binding = fit::bind(geometry, fit::fit_cylinder(geometry), options);
        goffer_bind_options wanted = goffer_bind_defaults();
        wanted.shares = shares.data();
        wanted.region_count = regions;
        const goffer_mesh from = mesh_of(mesh);
        goffer_error error;
        body = goffer_body_bind(&from, &wanted, &error);
        INFO(error.text);
        REQUIRE(body != nullptr);
        for (std::size_t r = 0; r < regions; ++r)
            poses.push_back(
                {static_cast<float>(uniform(random, -2, 2)), static_cast<float>(uniform(random, -4, 4))});
    }
    Twice(const Twice&) = delete;
    Twice& operator=(const Twice&) = delete;
    ~Twice() { goffer_body_free(body); }

    [[nodiscard]] std::vector<bend::Pose> cpp_poses() const {
        std::vector<bend::Pose> result;
        for (const goffer_pose& pose : poses) result.push_back({pose.angle, pose.direction});
        return result;
    }
};

/// A body file of one level.
inline std::vector<std::byte> baked_bytes(const Twice& twice) {
    const fit::BakeLevel level{&twice.binding, {twice.mesh.triangles, {}, {}, {}}};
    return fit::bake({{&level, 1}});
}

inline goffer_stream stream(std::vector<float>& memory, std::size_t floats) {
    goffer_stream result = {};
    for (std::size_t c = 0; c < floats; ++c) result.component[c] = memory.data() + c;
    result.stride = floats * sizeof(float);
    result.count = memory.size() / floats;
    return result;
}

template <class T>
inline bool same_bits(const std::vector<T>& a, const std::vector<T>& b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0;
}

inline std::string error_of_job(const goffer_job& job) {
    goffer_error error;
    CHECK(goffer_job_validate(&job, &error) == 0);
    return error.text;
}

}  // namespace goffer::test
