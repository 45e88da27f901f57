// SPDX-License-Identifier: MIT
#pragma once

#include <goffer/bend/body.hpp>
#include <goffer/bend/pose.hpp>
#include <goffer/mesh/mesh.hpp>
#include <goffer/view/picture.hpp>

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <filesystem>
#include <span>
#include <vector>

namespace goffer::cli {

/// What a picture of a bend needs. The caller owns all of it.
struct BentModel {
    const bend::Body& body;
    const mesh::Mesh& mesh;          ///< parts and materials
    const mesh::VertexArrays& rest;  ///< rest positions and triangles
    std::span<const glm::vec3> bent_positions;
    std::span<const glm::vec3> bent_normals;
    std::span<const glm::vec4> colors;  ///< empty: the materials' own; else linear RGBA, one per vertex
    bend::Pose pose;
};

/// One model per part of `mesh`, since each part has its material's color; parts without one are `plain`.
/// `vertices` has the positions and normals; its triangles are those of all faces, as mesh::triangles() cuts
/// them, in their order. The models refer to the same memory.
[[nodiscard]] std::vector<view::Model> part_models(const mesh::Mesh& mesh, const view::Model& vertices,
                                                   const glm::vec4& plain);

/// Renders the bent model, seen across the plane that it bends in and from above its squeezed side, so that
/// it lies from left to right and its wrinkles are in view; with `ghost` the rest shape too, translucent.
/// Writes a PNG, which `outputs` puts in its place.
void write_picture(const BentModel& model, bool ghost, const std::filesystem::path& file,
                   io::AtomicFiles& outputs);

}  // namespace goffer::cli
