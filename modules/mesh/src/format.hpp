// SPDX-License-Identifier: MIT
#pragma once

#include "share.hpp"

#include <goffer/mesh/mesh.hpp>

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

/// What each format provides for load() and save(). Readers take the bytes of a file, and its path for
/// messages and for the files that it names; they throw Error that begins with the path, or OverLimit.
/// Writers return the whole file as bytes, so that one place writes beside and renames; glTF's throw Error
/// likewise. `share` hears how far readers are; its owner says when all is done. Thread-safe.

namespace goffer::mesh {

class Budget;

/// What a corner has in place of an index where an attribute has no value for it.
inline constexpr std::uint32_t none = Attribute<glm::vec3>::none;

[[nodiscard]] Mesh read_obj(const std::filesystem::path& file, std::string_view bytes,
                            const LoadOptions& options, Budget& budget, const Share& share);
[[nodiscard]] Mesh read_ply(const std::filesystem::path& file, std::string_view bytes, Budget& budget,
                            const Share& share);
[[nodiscard]] Mesh read_stl(const std::filesystem::path& file, std::string_view bytes, Budget& budget,
                            const Share& share);
[[nodiscard]] Mesh read_gltf(const std::filesystem::path& file, std::string_view bytes,
                             const LoadOptions& options, Budget& budget,
                             const Share& share);  // .gltf and .glb

/// The files that the elements of `lists` ("buffers", "images") of a .gltf or .glb lie in; none where it is
/// broken, of which read_gltf() says more.
[[nodiscard]] std::vector<std::filesystem::path> gltf_files(const std::filesystem::path& file,
                                                            std::string_view bytes,
                                                            std::span<const char* const> lists,
                                                            const LoadOptions& options, Budget& budget);

/// The material files that an OBJ names, and the textures that these name.
[[nodiscard]] std::vector<std::filesystem::path> obj_files(const std::filesystem::path& file,
                                                           std::string_view bytes, const LoadOptions& options,
                                                           Budget& budget);

/// Whether the bytes are certainly STL; those of a broken STL file may not be.
[[nodiscard]] bool is_stl(std::string_view bytes);

/// `file` is where the bytes will go: references to material files are kept valid from there.
[[nodiscard]] std::string write_obj(const Mesh& mesh, const std::filesystem::path& file);
/// The file that a new OBJ names for its materials: of its own name, with a number behind it where somebody
/// else has a file there.
[[nodiscard]] std::filesystem::path mtl_beside(const std::filesystem::path& obj);
/// The materials of a mesh that is written anew; empty if it has none, or if it keeps the mtllib lines of the
/// OBJ that it came from.
[[nodiscard]] std::string write_mtl(const Mesh& mesh);
[[nodiscard]] std::string write_ply(const Mesh& mesh);
[[nodiscard]] std::string write_stl(const Mesh& mesh);
/// `file` is where the bytes will go: references to outside files are kept valid from there.
[[nodiscard]] std::string write_glb(const Mesh& mesh, const std::filesystem::path& file);
/// Its buffer is a data URI.
[[nodiscard]] std::string write_gltf(const Mesh& mesh, const std::filesystem::path& file);

/// Returns all bytes of a regular file, which come out of `budget`. Throws Error if it is missing, no regular
/// file, empty or unreadable.
[[nodiscard]] std::string read_bytes(const std::filesystem::path& file, Budget& budget,
                                     const Share& share = {});

/// An image in a file of its own, which is read by Image::bytes() if it is no larger than limits.memory.
[[nodiscard]] std::shared_ptr<const Image> image_in(const std::filesystem::path& file, const Limits& limits);

/// Throws Error that begins with `file`, unless sizes, indices, parts and materials fit together and all
/// positions and normals are finite.
void check(const Mesh& mesh, const std::filesystem::path& file);

/// Whether `mesh` differs from `read` only in the values of positions, normals and tangents, some of which
/// may have been split. A writer can then give back the file that `read` came from with these values
/// replaced.
[[nodiscard]] bool only_bent(const Mesh& mesh, const Mesh& read);

/// Returns the index into `attribute` for face corner `corner`, whose vertex is `vertex`; `none` if it has no
/// value.
template <class T>
[[nodiscard]] std::uint32_t value_at(const Attribute<T>& attribute, std::size_t corner,
                                     std::uint32_t vertex) {
    if (attribute.empty()) return Attribute<T>::none;
    return attribute.per_vertex() ? vertex : attribute.corners[corner];
}

}  // namespace goffer::mesh
