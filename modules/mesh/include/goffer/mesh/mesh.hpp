// SPDX-License-Identifier: MIT
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

/// A mesh as files carry it: vertices in file order, attributes with or without indices of their own,
/// polygons, materials. Nothing is merged, split or reordered on the way in.

namespace goffer::mesh {

/// A file that cannot be read, or a mesh that cannot be written. what() is one line: what is wrong, where,
/// how to mend it.
class Error : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

/// An attribute: one value per vertex (`corners` empty) or values with an index of their own per face corner
/// (OBJ).
template <class T>
struct Attribute {
    std::vector<T> values;
    std::vector<std::uint32_t>
        corners;  ///< empty, or one index into `values` per face corner (`none` where absent)

    static constexpr std::uint32_t none = 0xffffffffu;
    [[nodiscard]] bool empty() const { return values.empty(); }
    [[nodiscard]] bool per_vertex() const { return corners.empty(); }
    bool operator==(const Attribute&) const = default;
};

struct Material {
    std::string name;
    glm::vec4 base_color{0.8f, 0.8f, 0.8f, 1.0f};  ///< linear RGBA
    bool operator==(const Material&) const = default;
};

/// A run of faces that belong together: a glTF primitive, an OBJ group with one material.
struct Part {
    std::string name;
    std::int32_t material = -1;  ///< index into materials, or -1
    std::uint32_t first_face = 0;
    std::uint32_t face_count = 0;
    bool operator==(const Part&) const = default;
};

/// What a format's writer needs of the file a mesh came from, to give back all that bending does not touch.
class Source {
public:
    virtual ~Source() = default;
};

/// A mesh. A plain value: copies are deep but for `source`, which is shared and immutable.
struct Mesh {
    std::vector<glm::vec3> positions;       ///< model space (glTF: world space of the scene), file order
    Attribute<glm::vec3> normals;           ///< as in the file; never made up
    Attribute<glm::vec4> tangents;          ///< w: sign of the bitangent
    std::vector<Attribute<glm::vec2>> uvs;  ///< sets 0, 1, ..; v points up, as in OBJ (glTF's is turned)
    std::vector<glm::vec4> colors;          ///< empty, or RGBA per vertex, 0..1, values as in the file
    std::vector<std::uint32_t> corners;     ///< the faces' vertex indices, face after face
    std::vector<std::uint32_t> faces;       ///< corners per face (3 or more)
    std::vector<Part> parts;                ///< cover all faces, in order
    std::vector<Material> materials;
    std::vector<std::string> warnings;     ///< what was tolerated: a missing material file, a skin, ...
    std::shared_ptr<const Source> source;  ///< null for meshes made in memory
};

/// Reads OBJ, PLY, STL, glTF or GLB, told by content first and by the file name's ending second.
/// Throws Error on anything that is not a readable mesh with finite positions and indices in range.
[[nodiscard]] Mesh load(const std::filesystem::path& file);

/// Writes `mesh` in the format of the file name's ending (.obj .ply .stl .glb .gltf). Into the format it came
/// from, everything that `mesh` does not change is kept (`source`); into another, whatever that can carry.
/// Written beside and renamed: on failure an existing file is left as it was. An OBJ that was none before
/// gets its materials in a file beside it, of the same name with the ending .mtl. Throws Error for an unknown
/// ending or a mesh that does not fit together, and io::Error where a file cannot be written.
void save(const Mesh& mesh, const std::filesystem::path& file);

/// The endings `save` knows, for error messages and for refusing an output before any work is done.
[[nodiscard]] bool can_save(const std::filesystem::path& file);

/// A mesh as a deformer wants it: every record is one position with one normal and one tangent, and triangles
/// index records. Record i < positions.size() of the mesh is vertex i; vertices that occur with several
/// normals or tangents (OBJ) have further records behind those. A vertex that has no normal or tangent in the
/// file has a zero one.
struct VertexArrays {
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> normals;        ///< empty where the mesh has none
    std::vector<glm::vec4> tangents;       ///< empty where the mesh has none
    std::vector<std::uint32_t> triangles;  ///< 3 records each; polygons are cut up into fans
    std::vector<std::uint32_t> vertex;     ///< of each record
};

/// The records of `mesh`. Pure; may be called from any thread.
[[nodiscard]] VertexArrays vertex_arrays(const Mesh& mesh);

/// The number of triangles once polygons are cut up into fans.
[[nodiscard]] std::size_t triangle_count(const Mesh& mesh);

/// The vertices of these triangles, 3 each: face after face, each cut up into a fan. Pure; may be called from
/// any thread.
[[nodiscard]] std::vector<std::uint32_t> triangles(const Mesh& mesh);

/// `mesh` with the positions, normals and tangents of `bent`, which holds as many records as
/// `vertex_arrays(mesh)` in the same order. Streams that the mesh does not have are ignored. Keeps `source`.
/// Attribute values keep their places; one that several vertices share and that is no longer the same for all
/// is split, its copies behind the others. Throws Error where `bent` holds too few records.
[[nodiscard]] Mesh with_vertex_arrays(const Mesh& mesh, const VertexArrays& bent);

}  // namespace goffer::mesh
