// SPDX-License-Identifier: MIT
#pragma once

#include <goffer/clip/frames.hpp>
#include <goffer/mesh/mesh.hpp>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

/// A clip as animated glTF.

namespace goffer::clip {

/// How closely a file has to follow the frames.
struct GltfOptions {
    /// What a vertex may be off at most, as a share of the mesh's largest extent at rest, or by
    /// the rounding of floats if that is more. As few targets are taken as that asks for. Finite and not
    /// below 0.
    double max_error = 4e-3;

    /// How many targets there may be at most, 1 or more: where `max_error` asks for more, the error may
    /// be larger. Unset: as many as it asks for.
    std::optional<std::size_t> targets = {};

    /// Bytes that finding the targets may take beside the mesh, its vertex arrays and one frame. What does
    /// not fit is read again: frames are read as often as needed. Building the file takes up to five times
    /// its size besides.
    std::uint64_t memory = std::uint64_t{1} << 30;
};

/// What keeps a file from following its frames as closely as GltfOptions::max_error asks.
enum class GltfLimit : std::uint8_t {
    none,      ///< nothing: it does
    targets,   ///< GltfOptions::targets: with more it would be nearer
    memory,    ///< GltfOptions::memory: more targets, or those of more frames, do not fit
    samples,   ///< targets are those of 1024 of the frames, and others have what these do not
    rounding,  ///< what is left is as small as the rounding of floats, which no target is made of
};

/// What was written, and how far it is from the frames. Distances are in model units and angles in radians;
/// they are those of the values in the file, over all vertices of all frames, before the placement.
struct GltfReport {
    std::size_t frames = 0;
    std::size_t targets = 0;            ///< shapes that frames are blends of
    bool exact = false;                 ///< the targets are the frames themselves: nothing is left out
    GltfLimit limit = GltfLimit::none;  ///< why max_error is not kept
    double size = 0;                    ///< the mesh's largest extent at rest
    double max_error = 0;               ///< largest distance of a vertex from where its frame has it
    double rms_error = 0;
    double max_angle = 0;  ///< largest angle between a normal and that of its frame; 0 without normals
    double rms_angle = 0;
    std::uint64_t bytes = 0;            ///< of the file
    std::vector<std::string> warnings;  ///< what of the mesh's source is left out, and that nothing moves

    [[nodiscard]] bool within() const noexcept { return limit == GltfLimit::none; }  ///< max_error is kept
};

/// Writes `mesh`, which is at rest, with `frames` as a glTF animation into a .glb or .gltf file, as
/// mesh::save_morphing() does; files.commit() puts it in its place. frames.vertices() is the number of
/// entries of mesh::vertex_arrays(mesh).
///
/// The targets are few shapes of which every frame is a blend: the principal components of how the vertices
/// move from their mean. One more takes the rest shape to where blending begins, so that all weights are from
/// 0 to 1, to which programs clamp them, and so that weights of 0 are the mesh at rest. Normals follow by the
/// same weights, as closely as these can. Tangents are left as they are at rest: normal maps are lit a little
/// wrong where the surface turns. There are never more targets than frames; where it takes as many, or no
/// fewer are near enough, they are the frames themselves. Of more than 1024 frames, or of fewer where
/// `memory` asks for it, evenly spaced ones decide the components; all frames are measured.
///
/// The placement becomes a node above the scene, with a key per frame unless it stays the same; one that
/// moves nothing is left out.
///
/// Throws mesh::Error if the ending or the options are not these, there are no vertices, entries do not fit,
/// a frame is not finite, or `memory` is too little for one target and two frames; and what save_morphing()
/// throws. Thread-safe for different `frames` and `files`.
[[nodiscard]] GltfReport save_gltf(const mesh::Mesh& mesh, Frames& frames, const GltfOptions& options,
                                   const std::filesystem::path& file, io::AtomicFiles& files);

}  // namespace goffer::clip
