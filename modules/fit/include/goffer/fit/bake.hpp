// SPDX-License-Identifier: MIT
#pragma once

#include <goffer/bend/body_file.hpp>
#include <goffer/fit/bind.hpp>

#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

/// Makes a body file of meshes that were bound: the last step of a pipeline. bend::load() takes it.

namespace goffer::fit {

/// A level of detail: what bind() returned, or bind_level().
struct BakeLevel {
    const Binding* binding = nullptr;
    /// What is drawn of it, in the order of the geometry that was bound: triangles refer to its vertices,
    /// texture coordinates and `source` have one entry for each. bake() puts them into the body's order,
    /// which is what `source` says if it is not given and the orders differ.
    bend::DrawMesh mesh = {};
};

/// What a file is made from. Nothing of it is needed once it is made.
struct BakeInput {
    /// From fine to coarse, 1 to bend::max_levels; all but the first bound by bind_level() to the first one.
    std::span<const BakeLevel> levels;
    std::span<const bend::DrawMaterial> materials = {};
    std::span<const bend::NamedSocket> sockets = {};  ///< as socket_at() and socket_near() make them
    std::string_view notes = {};                      ///< for people and tools
};

/// Returns the bytes of a body file. The same input gives the same bytes. Throws Error, which says what is
/// wrong and where, if a level has no binding or not the rig of the first one, an entry is missing or out of
/// range, or a number is not finite. Thread-safe.
[[nodiscard]] std::vector<std::byte> bake(const BakeInput& input);

}  // namespace goffer::fit
