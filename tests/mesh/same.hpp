// SPDX-License-Identifier: MIT
#pragma once

#include <goffer/mesh/mesh.hpp>

#include <doctest/doctest.h>

namespace goffer::test {

/// All that a mesh holds of its own, but for what was warned of.
inline void check_same(const mesh::Mesh& a, const mesh::Mesh& b) {
    CHECK(a.positions == b.positions);
    CHECK(a.normals == b.normals);
    CHECK(a.tangents == b.tangents);
    CHECK(a.uvs == b.uvs);
    CHECK(a.colors == b.colors);
    CHECK(a.corners == b.corners);
    CHECK(a.faces == b.faces);
    CHECK(a.parts == b.parts);
    CHECK(a.materials == b.materials);
}

}  // namespace goffer::test
