// SPDX-License-Identifier: MIT
#pragma once

#include "budget.hpp"
#include "share.hpp"

#include <goffer/io/named_files.hpp>
#include <goffer/mesh/mesh.hpp>

#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <nlohmann/json.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

/// What the parts of glTF's reader and writer share. The document is held as JSON in its own order, since all
/// of it has to be given back, and every access to it is checked here. TinyGLTF is not used: its model loses
/// the order, the exact numbers and unknown fields. TinyGLTF 2.7 also reads past the end of a GLB whose BIN
/// chunk is 8 bytes too long and of image views, overflows the stack on deeply nested extras, and refuses
/// buffers that are longer than their byteLength.

namespace goffer::mesh::gltf {

/// Types of an accessor's components: glTF 2.0, 3.6.2.2.
enum ComponentType : int {
    i8_type = 5120,
    u8_type = 5121,
    i16_type = 5122,
    u16_type = 5123,
    u32_type = 5125,
    float_type = 5126
};

using Json = nlohmann::ordered_json;

/// A value of a document and its path, so that each error can say where. The document must outlive it.
class Value {
public:
    explicit Value(const Json& json, std::string path = {}) : json_(&json), path_(std::move(path)) {}

    [[nodiscard]] bool has(const char* key) const;
    [[nodiscard]] Value operator[](const char* key) const;      ///< a member, which must be there
    [[nodiscard]] Value operator[](std::size_t element) const;  ///< of an array that must be long enough
    [[nodiscard]] std::size_t size() const;                     ///< of an array
    [[nodiscard]] double number() const;
    [[nodiscard]] std::uint64_t whole() const;  ///< a whole number from 0 to 2^53
    [[nodiscard]] const std::string& text() const;

    /// The elements of an array of exactly `count` numbers.
    [[nodiscard]] std::vector<double> numbers(std::size_t count) const;

    [[nodiscard]] std::uint64_t whole_or(const char* key, std::uint64_t otherwise) const;
    [[nodiscard]] std::string text_or(const char* key, const char* otherwise) const;
    [[nodiscard]] bool flag(const char* key) const;  ///< false where it is left out

    /// Throws Error "<path>: <what>".
    [[noreturn]] void fail(const std::string& what) const;
    /// Throws Error that says which type of JSON this is, and which was expected.
    [[noreturn]] void fail_type(const char* expected) const;

    [[nodiscard]] const Json& json() const { return *json_; }
    [[nodiscard]] const std::string& path() const { return path_; }

private:
    const Json* json_;
    std::string path_;
};

/// A file as read: the JSON and the bytes of its buffers. All buffer views are known to lie in their buffers.
struct Document : Source {
    explicit Document(io::NamedFiles named) : files(std::move(named)) {}
    Document(const Document&) = delete;
    Document& operator=(const Document&) = delete;

    Json json;
    std::vector<std::string> buffers;
    io::NamedFiles files;  ///< of the file
    Limits limits = {};    ///< that it was loaded with, for images in files of their own

    [[nodiscard]] Value root() const { return Value(json); }
    [[nodiscard]] std::size_t count(const char* list) const;

    /// `index` as an index into `list` ("meshes", ...), known to be in range.
    [[nodiscard]] std::size_t number(const char* list, const Value& index) const;

    /// The entry of `list` that `index` names. Its path also says where the index stands.
    [[nodiscard]] Value entry(const char* list, const Value& index) const;

    /// The bytes of a buffer view.
    [[nodiscard]] std::string_view view(const Value& buffer_view) const;
};

/// Takes a .glb or .gltf apart and reads its buffers. Throws Error without the file's name.
[[nodiscard]] std::shared_ptr<const Document> open_document(const std::filesystem::path& file,
                                                            std::string_view bytes,
                                                            const LoadOptions& options, Budget& budget,
                                                            const Share& share);

/// Returns the files that the elements of `lists` ("buffers", "images") of a .glb or .gltf lie in, but for
/// those that `files` does not find. Throws Error without the file's name where it is no document.
[[nodiscard]] std::vector<std::filesystem::path> named_files(std::string_view bytes,
                                                             std::span<const char* const> lists,
                                                             const io::NamedFiles& files, Budget& budget);

/// A warning of an extension that a document requires and goffer does not know; empty if there is none.
[[nodiscard]] std::string unknown_extensions(const Document& document);

/// Refuses a document whose meshes are compressed. Where they are also there in plain, for readers that do
/// not know the compression, takes the compressed copies out.
void use_plain_data(Json& json);

/// Calls `visit` for each element of owner[key], where that is an array or object.
template <class Owner, class Visit>
void each(Owner& owner, const char* key, Visit&& visit) {
    if (!owner.is_object() || !owner.contains(key) || !owner[key].is_structured()) return;
    for (auto& element : owner[key]) visit(element);
}

/// Says which images are not where their URIs lead, or may not be read; broken ones are not looked at.
[[nodiscard]] std::vector<std::string> missing_images(const Document& document);

/// The document's materials: their names and base colors, still without textures. Throws Error.
[[nodiscard]] std::vector<Material> materials_of(const Document& document);

/// Gives the materials of `mesh`, which are those of the document, their base-color textures. Returns, as a
/// warning or none, which are broken and left out; of missing images missing_images() tells.
[[nodiscard]] std::vector<std::string> read_textures(const std::shared_ptr<const Document>& document,
                                                     Mesh& mesh);

/// Says, as a warning or none, which fields that nothing here reads are of the wrong type, or, of animations,
/// cameras and skeletons, hold an index of something that is not there.
[[nodiscard]] std::vector<std::string> wrong_types(const Document& document);

/// Return the bytes of a file with this document and its one buffer.
[[nodiscard]] std::string glb_file(Json json, const std::string& buffer);
[[nodiscard]] std::string gltf_file(Json json, const std::string& buffer);

/// URIs. Data URIs may be in base64 or percent-encoded; data_of returns null for a malformed one.
[[nodiscard]] bool is_data_uri(std::string_view uri);
[[nodiscard]] bool has_scheme(std::string_view uri);
[[nodiscard]] std::optional<std::string> data_of(std::string_view data_uri);
[[nodiscard]] std::string data_uri(std::string_view mime_type, std::string_view bytes);
[[nodiscard]] std::filesystem::path path_of(std::string_view uri);
[[nodiscard]] std::string uri_of(const std::filesystem::path& relative);

/// Elements without bytes behind them are zeros. A count in a file must not make us allocate without end: a
/// scene, and one accessor, may have this many.
inline constexpr std::uint64_t max_unbacked = 1u << 20;

/// Returns the components of an accessor, `components` for each element, in the order of elements; normalized
/// integers become numbers in -1..1. `index` is the reference to the accessor. Nothing is allocated before it
/// is known that there are bytes for that size.
[[nodiscard]] std::vector<float> read_floats(const Document& document, const Value& index,
                                             std::size_t components);

/// The elements of an accessor of unsigned integers.
[[nodiscard]] std::vector<std::uint32_t> read_indices(const Document& document, const Value& index);

/// The bytes of an array of floats or integers, as glTF wants them: little-endian.
template <class T>
[[nodiscard]] std::string bytes_of(const std::vector<T>& values) {
    return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)};
}

/// Sets the fields `min` and `max` of an accessor of positions.
void set_bounds(Json& accessor, const std::vector<float>& values, std::size_t components);

/// Where a node, or a skin, stands in the scene: maps its positions, normals and tangents to world space, and
/// back. Normals and tangents get unit length, unless the placement is the identity, which changes no bit.
class Placement {
public:
    Placement() : Placement(glm::dmat4(1.0)) {}
    explicit Placement(const glm::dmat4& matrix);

    [[nodiscard]] const glm::dmat4& matrix() const { return matrix_; }
    [[nodiscard]] bool mirrored() const { return mirrored_; }  ///< the winding of triangles changes
    [[nodiscard]] bool singular() const { return singular_; }  ///< there is no way back

    [[nodiscard]] glm::vec3 point(const glm::vec3& local) const;
    [[nodiscard]] glm::vec3 normal(const glm::vec3& local) const;
    [[nodiscard]] glm::vec4 tangent(const glm::vec4& local) const;

    [[nodiscard]] glm::vec3 point_back(const glm::vec3& placed) const;
    [[nodiscard]] glm::vec3 normal_back(const glm::vec3& placed) const;
    [[nodiscard]] glm::vec4 tangent_back(const glm::vec4& placed) const;

    /// What is added to a position, brought back.
    [[nodiscard]] glm::vec3 shift_back(const glm::vec3& placed) const;

    /// What is added to a normal that is of unit length when placed, and `local` in the node's space.
    [[nodiscard]] glm::vec3 turn_back(const glm::vec3& placed, const glm::vec3& local) const;

private:
    glm::dmat4 matrix_;
    glm::dmat4 inverse_{1.0};
    /// Cofactors of the matrix over its largest entry: the inverse transpose up to a factor.
    glm::dmat3 cofactors_{1.0};
    bool identity_ = false, mirrored_ = false, singular_ = false;
};

/// The attributes that bending changes, and how many components each has.
enum Stream : std::size_t { position, normal, tangent, stream_count };
inline constexpr std::array<const char*, stream_count> stream_name{"POSITION", "NORMAL", "TANGENT"};
inline constexpr std::array<std::size_t, stream_count> stream_width{3, 3, 4};

/// A run of the mesh's vertices: one set of accessors under one node.
struct Block {
    std::size_t node = 0, mesh = 0;
    std::vector<std::size_t> primitives;  ///< of the mesh, which share the accessors
    std::size_t count = 0;                ///< vertices
    /// Where its values start in positions, normals.values and tangents.values; `absent` where it has none.
    std::array<std::size_t, stream_count> first{absent, absent, absent};
    Placement placement;

    static constexpr std::size_t absent = ~std::size_t{0};
};

/// A document's scene as a mesh, without its source. The blocks, in vertex order, say where its vertices come
/// from.
struct Scene {
    Mesh mesh;
    std::vector<Block> blocks;
};

/// The matrix with the last row of an affine one, whatever a file has there.
[[nodiscard]] glm::dmat4 affine(glm::dmat4 matrix);

/// A node of the scene, and the matrix from its space to the scene's.
struct PlacedNode {
    std::size_t node;
    glm::dmat4 world;
};

/// All nodes of the scene, parents before children, children in their order. Throws Error if it is no forest.
[[nodiscard]] std::vector<PlacedNode> nodes_of_scene(const Document& document);

/// Where its joints place a skinned mesh.
struct SkinPlace {
    glm::dmat4 matrix{1.0};  ///< from the mesh's space to the scene's: the first joint's
    bool as_bound = true;    ///< all joints place it so: they stand as they did when it was bound
};

/// Returns where the joints of `skin` that are in the scene place its meshes: the identity, exactly, where
/// that is meant, and where there is none. `worlds`: the matrices of the scene's nodes. Throws Error if a
/// joint is no node, or its inverse bind matrices are fewer or of another type.
[[nodiscard]] SkinPlace place_of_skin(const Document& document, const Value& skin,
                                      const std::map<std::size_t, glm::dmat4>& worlds);

/// Reads the scene of a document. The writer relies on getting the same scene for the same document.
/// Throws OverLimit; without a budget there is no limit, for documents that have been read before.
[[nodiscard]] Scene read_scene(const Document& document, Budget& budget, const Share& share = {});
[[nodiscard]] Scene read_scene(const Document& document, const Share& share = {});

/// A document to be written.
struct Output {
    Json json;
    std::string buffer;
};

/// Returns the document that `mesh` came from, with the streams of `mesh` in it; null if the mesh has no such
/// document, or differs from it in more than these streams. `embed`: takes images in, for a GLB.
[[nodiscard]] std::optional<Output> rewritten(const Mesh& mesh, const std::filesystem::path& file,
                                              bool embed);

/// Turns an output into a document again, which names the files that `origin` does.
[[nodiscard]] std::shared_ptr<const Document> document_of(Output output, const Document& origin);

/// Returns a new document for a mesh that came from no glTF.
[[nodiscard]] Output made(const Mesh& mesh);

}  // namespace goffer::mesh::gltf
