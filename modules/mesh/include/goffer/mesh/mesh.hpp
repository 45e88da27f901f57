// SPDX-License-Identifier: MIT
#pragma once

#include <goffer/mesh/material.hpp>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

/// A mesh as files carry it: vertices in file order, attributes with or without indices of their own,
/// polygons, materials. Nothing is merged, split or reordered on the way in. All functions are thread-safe.

namespace goffer::io {
class AtomicFiles;
}

namespace goffer::mesh {

/// Thrown for a file that cannot be read, and for a mesh that does not fit together or cannot be written.
/// what() is one line: what is wrong, where, and how to mend it.
class Error : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

/// An attribute: one value per vertex, or values with an index for each corner of a face, as in OBJ.
template <class T>
struct Attribute {
    std::vector<T> values;
    /// Empty: one value per vertex. Else one index into `values` per face corner, `none` where it has no
    /// value.
    std::vector<std::uint32_t> corners;

    static constexpr std::uint32_t none = 0xffffffffu;
    [[nodiscard]] bool empty() const { return values.empty(); }
    [[nodiscard]] bool per_vertex() const { return corners.empty(); }
    bool operator==(const Attribute&) const = default;
};

/// A run of faces that belong together: a glTF primitive, an OBJ group with one material, an STL solid.
struct Part {
    std::string name;
    std::int32_t material = -1;  ///< index into Mesh::materials, or -1 for none
    std::uint32_t first_face = 0;
    std::uint32_t face_count = 0;
    bool operator==(const Part&) const = default;
};

/// What a writer needs of the file that a mesh came from, to give back all that bending does not change.
/// Opaque to callers.
class Source {
public:
    virtual ~Source() = default;
};

/// A mesh. A plain value: copies are deep but for `source`, which is shared and immutable.
struct Mesh {
    std::vector<glm::vec3> positions;       ///< model space (glTF: world space of the scene), file order
    Attribute<glm::vec3> normals;           ///< as in the file; none are made
    Attribute<glm::vec4> tangents;          ///< w: sign of the bitangent
    std::vector<Attribute<glm::vec2>> uvs;  ///< sets 0, 1, ...; v points up, as in OBJ (glTF's is flipped)
    std::vector<glm::vec4> colors;          ///< empty, or RGBA per vertex; white is 1
    bool linear_colors = false;             ///< as glTF's are, else encoded as sRGB, as those of other files
    std::vector<std::uint32_t> corners;     ///< the faces' vertex indices, face after face
    std::vector<std::uint32_t> faces;       ///< how many corners each face has, 3 or more
    std::vector<Part> parts;                ///< empty, or covering all faces, in order
    std::vector<Material> materials;
    std::vector<std::string> warnings;     ///< what load() tolerated: a missing material file, a skin, ...
    std::shared_ptr<const Source> source;  ///< null for a mesh made in memory
};

/// What a mesh may cost at most: a small file can stand for a very large mesh. What would be above is refused
/// before it is allocated. 2^32 - 1 vertices or more are refused whatever this says.
struct Limits {
    std::uint64_t memory = std::uint64_t{2} << 30;  ///< bytes for a mesh and its file, as estimated
    std::uint64_t vertices = 50'000'000;
    std::uint64_t triangles = 50'000'000;  ///< a face of n corners being n - 2
};

/// What load() may do.
struct LoadOptions {
    /// Whether the other files that a glTF or an OBJ names (buffers, images, material files) may lie outside
    /// the folder that it is in. A file from somebody else could name any file of the machine, whose bytes
    /// would then be read, and be in what save() writes.
    bool allow_outside = false;
    Limits limits = {};
    /// Called with the share that is done, 0 to 1, ascending, a few hundred times at most, from the calling
    /// thread; it must not throw. Empty: nobody is told.
    std::function<void(double)> progress = {};
};

/// Reads an OBJ, PLY, STL, glTF or GLB file. The format is told by the content or, failing that, by the
/// ending of the name. Other files that an OBJ or a glTF names are read too, if they lie in its folder or
/// below it once links are followed, or anywhere with LoadOptions::allow_outside; images are looked for, and
/// read by Image::bytes() alone. Faces of fewer than 3 corners, and materials and textures that are missing,
/// broken or outside, are left out with a warning.
///
/// Throws Error if the file cannot be read or is not of these formats, has a buffer outside its folder, is
/// beyond the limits, a position or normal is not finite, an index is out of range, there is no vertex or no
/// face, or a glTF is compressed and has no plain copy of its data.
[[nodiscard]] Mesh load(const std::filesystem::path& file, const LoadOptions& options = {});

/// Returns the buffers that a glTF or GLB file names, which need not exist, without those outside its folder
/// unless options.allow_outside, since load() refuses them; none for other formats and for a glTF that is
/// broken. Throws Error if the file cannot be read or is beyond the limits. Thread-safe.
[[nodiscard]] std::vector<std::filesystem::path> named_buffers(const std::filesystem::path& file,
                                                               const LoadOptions& options = {});

/// The same, and the images of a glTF, the material files of an OBJ and the textures that these name: what an
/// output must not replace.
[[nodiscard]] std::vector<std::filesystem::path> named_files(const std::filesystem::path& file,
                                                             const LoadOptions& options = {});

/// Writes `mesh` in the format of the file name's ending (.obj, .ply, .stl, .glb or .gltf, in any case).
///
/// A mesh that differs from the file that it came from in positions, normals and tangents only is given back
/// as that file with these replaced, if the format is the same (.glb and .gltf are one). Any other mesh is
/// written anew, with what the format can carry, and colors as it has them, linear or sRGB; an OBJ then gets
/// its materials in a file of the same name with the ending .mtl, or, where that is there and was not written
/// by save(), with a number behind the name. Files are written beside their place and renamed: on failure an
/// existing file stays as it was.
///
/// Throws Error if the ending is unknown, the mesh does not fit together (see load), or a value cannot be
/// written into its glTF node; and io::Error if a file cannot be written.
void save(const Mesh& mesh, const std::filesystem::path& file);

/// Writes `mesh` likewise, but leaves it to files.commit() to put it, and its materials, in their places.
void save(const Mesh& mesh, const std::filesystem::path& file, io::AtomicFiles& files);

/// Whether save() knows the ending of `file`: to refuse an output before any work is done.
[[nodiscard]] bool can_save(const std::filesystem::path& file);

/// A mesh as a deformer wants it: arrays with one position, one normal and one tangent per entry, and
/// triangles that index these. Entry i of the first Mesh::positions.size() is vertex i of the mesh. A vertex
/// that occurs with several normals or tangents, as in OBJ, has further entries after all of these, in the
/// order in which the faces' corners first ask for them. A normal or tangent that the mesh lacks for a vertex
/// is zero.
struct VertexArrays {
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> normals;        ///< empty if the mesh has none
    std::vector<glm::vec4> tangents;       ///< empty if the mesh has none
    std::vector<glm::vec2> uvs;            ///< empty, or of set `uv_set`: see vertex_arrays_with_uvs()
    std::size_t uv_set = 0;                ///< which of Mesh::uvs they are of
    std::vector<std::uint32_t> triangles;  ///< 3 entries each; polygons are cut as triangles() does
    std::vector<std::uint32_t> vertex;     ///< for each entry, which vertex of the mesh it is
};

/// Makes the arrays of `mesh`, which must fit together as a loaded one does.
[[nodiscard]] VertexArrays vertex_arrays(const Mesh& mesh);

/// Makes the arrays of `mesh` as an engine draws them: each entry also has one texture coordinate, of set
/// `set`, so that a vertex on a seam has an entry for each of its coordinates. The order is that of
/// vertex_arrays(): entry i is vertex i of the mesh with what its first corner has, and further entries are
/// after all of these, in the order of use. Equal coordinates under several indices are one. As everywhere
/// in a Mesh, v points up; a coordinate that the mesh lacks for a corner is 0, 0. Where the mesh does not
/// have the set, these are the arrays of vertex_arrays(). with_vertex_arrays() takes either kind back.
[[nodiscard]] VertexArrays vertex_arrays_with_uvs(const Mesh& mesh, std::size_t set = 0);

/// Returns the number of triangles, a face of n corners being n - 2.
[[nodiscard]] std::size_t triangle_count(const Mesh& mesh);

/// Returns the vertices of the triangles, 3 each: face after face, wound as the faces are. A convex face is a
/// fan around its first corner. A concave one is cut along diagonals that lie in it, so that its triangles
/// have its area, in a time that grows with the square of its corners. It is a fan too if it crosses itself,
/// has no area, or has more than 4096 corners.
[[nodiscard]] std::vector<std::uint32_t> triangles(const Mesh& mesh);

/// Triangles [first, first + count) of triangles(mesh).
struct TriangleRange {
    std::uint32_t first = 0;
    std::uint32_t count = 0;
};

/// Returns which triangles each part of `mesh` has.
[[nodiscard]] std::vector<TriangleRange> triangles_of_parts(const Mesh& mesh);

/// Returns where in their images the corners of triangles(mesh) are, each in the texture of its part's
/// material: of its set, and transformed. 0, 0 where there is no texture, or the corner has no coordinate in
/// it; empty where no part's texture has a set that the mesh has. Values may be infinite or NaN if the file
/// has such.
///
/// They are of corners rather than of vertices since a vertex on a seam has several. What bends a mesh then
/// needs no vertices for the sake of its texture: split ones would change what a fit finds, and what save()
/// writes.
[[nodiscard]] std::vector<glm::vec2> texture_uvs(const Mesh& mesh);

/// Returns `mesh` with the positions, normals and tangents of `bent`, whose entries are those of
/// vertex_arrays(mesh), or of vertex_arrays_with_uvs(mesh, bent.uv_set) if it has uvs, in the same order. Its
/// texture coordinates are not looked at: bending does not change them. Where a vertex has several entries,
/// the first one's position counts, and its normal and tangent where the mesh has these per vertex. Streams
/// that the mesh does not have are ignored. Values of attributes with indices keep their places; one that
/// several entries share and that is no longer the same for all is split, its copies after the others. Keeps
/// `source`, so that save() gives the file back. Throws Error if `bent` has too few entries.
[[nodiscard]] Mesh with_vertex_arrays(const Mesh& mesh, const VertexArrays& bent);

}  // namespace goffer::mesh
