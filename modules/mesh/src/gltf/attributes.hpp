// SPDX-License-Identifier: MIT
#pragma once

#include "gltf.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

/// What the primitives of a document have for each vertex, before any of it is read.

namespace goffer::mesh::gltf {

/// Accessors of one vertex set: the streams, COLOR_0, TEXCOORD_0..; Block::absent where left out.
using AccessorSet = std::vector<std::size_t>;

/// The accessors that a primitive's attributes name. Throws Error.
[[nodiscard]] AccessorSet accessors_of(const Value& attributes);

/// How many sets of texture coordinates there are: TEXCOORD_0, TEXCOORD_1 and so on, without a gap.
[[nodiscard]] inline std::size_t uv_sets_of(const AccessorSet& set) {
    return set.size() - stream_count - 1;
}

/// The attribute's name.
[[nodiscard]] std::string uv_name(std::size_t set);

/// Whether an attribute of that name is for skins: joints, or their weights.
[[nodiscard]] inline bool is_of_skin(std::string_view name) {
    return name.starts_with("JOINTS_") || name.starts_with("WEIGHTS_");
}

/// How many values and indices there are to read for a primitive, or for the meshes of nodes; 0 where reading
/// will refuse something.
[[nodiscard]] std::uint64_t work_of(const Document& document, const Value& primitive);
[[nodiscard]] std::uint64_t work_of(const Document& document, std::span<const PlacedNode> nodes);

}  // namespace goffer::mesh::gltf
