// SPDX-License-Identifier: MIT
#include "reduction.hpp"

#include <goffer/clip/gltf.hpp>
#include <goffer/mesh/morph.hpp>

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat3x3.hpp>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace goffer::clip {

namespace {

void check(const GltfOptions& options, const Frames& frames, const Rest& rest) {
    if (!(options.max_error >= 0.0 && std::isfinite(options.max_error)))
        throw mesh::Error("max_error is not a share of a size; give a number of 0 or more");
    if (options.targets && *options.targets == 0)
        throw mesh::Error("without targets nothing moves; allow 1 or more");
    if (rest.entries() == 0) throw mesh::Error("the mesh has no vertices; give it 1 or more");
    if (frames.vertices() != rest.entries())
        throw mesh::Error("the frames have " + std::to_string(frames.vertices()) + " vertices and the mesh " +
                          std::to_string(rest.entries()) + " entries; make them of the same mesh");
}

/// The keys of the placement and their times.
struct Keys {
    std::vector<float> times;
    std::vector<glm::vec3> translations;
    std::vector<glm::quat> rotations;
};

/// A quaternion and its negative are the same rotation: each key has the one that is nearer to the key
/// before, since not all programs look for the shorter way.
Keys keys_of(const Frames& frames) {
    Keys keys;
    glm::dquat before(1.0, 0.0, 0.0, 0.0);
    for (std::size_t f = 0; f < frames.count(); ++f) {
        const glm::mat4x3 placement = frames.placement(f);
        glm::dquat rotation = glm::normalize(glm::quat_cast(glm::dmat3(placement)));
        if (glm::dot(rotation, before) < 0.0) rotation = -rotation;
        before = rotation;
        keys.times.push_back(static_cast<float>(static_cast<double>(f) / frames.rate()));
        keys.translations.push_back(placement[3]);
        keys.rotations.emplace_back(rotation);
    }
    return keys;
}

}  // namespace

GltfReport save_gltf(const mesh::Mesh& mesh, Frames& frames, const GltfOptions& options,
                     const std::filesystem::path& file, io::AtomicFiles& files) {
    const Rest rest = rest_of(mesh);
    check(options, frames, rest);
    const double allowed = std::max(options.max_error * rest.size, rest.rounding());
    Moves moves(rest, frames);
    Blend blend = reduce(moves, {allowed, options.targets, options.memory});
    prune(blend, allowed);
    const BlendError error = measure(moves, blend);
    // What is left out beyond the components' own error is what rounding takes.
    GltfLimit limit = GltfLimit::none;
    if (!(error.max <= allowed)) limit = blend.limit == GltfLimit::none ? GltfLimit::rounding : blend.limit;
    std::vector<mesh::MorphTarget> targets;
    targets.reserve(blend.targets.count());
    for (std::size_t k = 0; k < blend.targets.count(); ++k)
        targets.push_back(
            {std::as_const(blend.targets).positions(k), std::as_const(blend.targets).normals(k)});
    const Keys keys = keys_of(frames);
    mesh::MorphingFile written = mesh::save_morphing(
        mesh, {targets, keys.times, blend.weights, keys.translations, keys.rotations}, file, files);
    if (!written.animated) written.warnings.emplace_back("nothing moves: the file has no animation");
    return {frames.count(),
            targets.size(),
            blend.exact,
            limit,
            rest.size,
            error.max,
            error.rms,
            error.max_angle,
            error.rms_angle,
            written.bytes,
            std::move(written.warnings)};
}

}  // namespace goffer::clip
