// SPDX-License-Identifier: MIT
#pragma once

#include <goffer/mesh/mesh.hpp>

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

/// A mesh that moves, as glTF has it: shapes that are blended, and a node that carries all of it about.

namespace goffer::mesh {

/// A morph target: by how much positions and normals differ from the mesh's own where its weight is 1. One
/// value for each entry of vertex_arrays(mesh), in model space. The caller owns the memory. `normals` are
/// those of unit length that renderers make again after blending; empty, or ignored, where the mesh has none.
struct MorphTarget {
    std::span<const glm::vec3> positions;
    std::span<const glm::vec3> normals;
};

/// What happens at which time. Between the keys weights and translations are interpolated linearly, and
/// rotations along the shortest arc. The caller owns the memory.
struct Morphing {
    std::span<const MorphTarget> targets;          ///< may be empty
    std::span<const float> times;                  ///< of the keys: seconds, ascending, one or more
    std::span<const float> weights;                ///< one for each key and target: all of a key together
    std::span<const glm::vec3> translations = {};  ///< one for each key, or empty
    std::span<const glm::quat> rotations = {};     ///< likewise; of unit length
};

/// What save_morphing() wrote.
struct MorphingFile {
    std::uint64_t bytes = 0;
    bool animated = false;              ///< it has an animation: something moves between the keys
    std::vector<std::string> warnings;  ///< what of the source is left out, a line each
};

/// Writes `mesh` as save() does, as .glb or .gltf, with `morphing`: each of its nodes gets the targets that
/// move it, with `weights` as an animation, and all nodes of the scene get a common parent, which is
/// animated by translations and rotations, unless it leaves them where they are at all keys. What has the
/// same value at all keys is no animation, but the node's own; weights alone keep their first and last key
/// then, so that the clip keeps its length. Weights outside of 0..1 are written, but programs clamp them,
/// Blender 3.4 for one. Targets are floats, and sparse accessors where these are smaller. Tangents are not in
/// them: they stay as they are in the mesh.
///
/// Where the source is a glTF, what would move the mesh another way is left out, with a warning: animations,
/// skins, and the morph targets of what moves. Their bytes stay in the buffer. A node that is scaled to
/// nothing keeps its shape.
///
/// Throws Error as save() does, and if sizes do not fit together, or a value is not finite.
[[nodiscard]] MorphingFile save_morphing(const Mesh& mesh, const Morphing& morphing,
                                         const std::filesystem::path& file, io::AtomicFiles& files);

}  // namespace goffer::mesh
