// SPDX-License-Identifier: MIT
#pragma once

#include "gltf.hpp"

#include <goffer/mesh/morph.hpp>

#include <map>
#include <string>
#include <vector>

/// How save_morphing() turns the document that save() would write into one that moves.

namespace goffer::mesh::gltf {

/// A document that grows: accessors are added behind those that it has, their bytes behind its buffer. Refers
/// to it.
struct Growing {
    Growing(Json& its_json, std::string& its_buffer) : json(its_json), buffer(its_buffer) {}

    Json& json;
    std::string& buffer;

    /// Returns the number of a new accessor of `count` elements, which is not for vertices.
    std::size_t add(const std::string& bytes, int component, const char* type, std::size_t count);

    /// Returns that of one for displacements, three floats each, with their bounds: sparse where that takes
    /// fewer bytes, and without any bytes where all are zero.
    std::size_t add_displacements(const std::vector<float>& values);

private:
    std::size_t add_view(const std::string& bytes, bool of_vertices);
};

/// How many nodes have each entry of a document's meshes. Refers to the document.
class MeshUsers {
public:
    explicit MeshUsers(Json& json);

    /// Gives `node` an entry of the meshes that no other node has, and returns its number.
    std::size_t claim(std::size_t node);

private:
    Json& json_;
    std::map<std::size_t, std::size_t> users_;  // of each mesh that has one
};

/// Returns the scene that is shown. It is made where the document has none, and so shows all nodes.
[[nodiscard]] Json& shown_scene(Json& json);

/// Takes out what moves the nodes of `blocks` in another way: animations and skins. A mesh that had a skin
/// moves to another node, where its joints placed it, in all scenes that showed it, and its blocks with it.
/// Returns a warning for each kind.
[[nodiscard]] std::vector<std::string> let_go_of_motion(Json& json, MeshUsers& users,
                                                        std::vector<Block>& blocks);

/// Adds the animation of `morphing`: its weights at `nodes`, whose meshes have all of its targets, and the
/// placement at a new parent of the whole scene.
void animate(Growing& document, const Morphing& morphing, const std::vector<std::size_t>& nodes);

}  // namespace goffer::mesh::gltf
