// SPDX-License-Identifier: MIT
#pragma once

#include <goffer/mesh/mesh.hpp>

namespace goffer::clip {

/// The mesh that a vertex-animation texture moves: `model` as `arrays` of it are, entry by entry, with the
/// entries' numbers as the u of a second set of texture coordinates. Has the model's parts, colors and
/// materials, as far as mesh::save() writes materials of a mesh that is made anew.
[[nodiscard]] mesh::Mesh texture_mesh(const mesh::Mesh& model, const mesh::VertexArrays& arrays);

}  // namespace goffer::clip
