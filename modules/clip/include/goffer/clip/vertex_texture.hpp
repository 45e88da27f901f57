// SPDX-License-Identifier: MIT
#pragma once

#include <glm/vec3.hpp>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string_view>
#include <vector>

/// Vertex-animation textures: a clip as two images, which a vertex shader plays by looking its vertex up.
/// Nothing is left to do for the processor, and nothing is bent: what an engine wants for the crowd far away.
///
/// The texel of vertex v in frame f is column v % width of row f * rows_per_frame + v / width, counted from
/// the image's first row, which is its uppermost. modules/clip/README.md, "Vertex-animation textures", says
/// what is in the files, and vertex_texture.glsl and .hlsl play them.

namespace goffer::io {
class AtomicFiles;
}
namespace goffer::mesh {
struct Mesh;
struct VertexArrays;
}  // namespace goffer::mesh

namespace goffer::clip {

class Frames;

/// Where in its images a clip is. Texels are RGB of 16 bits each.
struct VertexTextureLayout {
    std::size_t width = 0, height = 0;  ///< at most `largest_side`
    std::size_t rows_per_frame = 0;     ///< 1, unless a frame has more vertices than the images have columns

    static constexpr std::size_t largest_side = 16384;  ///< what graphics cards take
    static constexpr std::size_t handy_width = 2048;    ///< what the smallest take: not exceeded without need
    /// Floats hold every whole number up to it, and so the number of each vertex.
    static constexpr std::size_t most_vertices = std::size_t{1} << 24;
};

/// Returns the layout of `frames` frames of `vertices` vertices; nothing where either is 0, there are more
/// than `most_vertices`, or the images would need more than `largest_side` rows. Frames share no rows: each
/// takes vertices / `largest_side` of them, rounded up, or more. Thread-safe.
[[nodiscard]] std::optional<VertexTextureLayout> vertex_texture_layout(std::size_t vertices,
                                                                       std::size_t frames) noexcept;

/// Where Frames::placement() goes.
enum class TexturePlacement : std::uint8_t {
    baked,   ///< into positions and normals, which are in the scene's space
    listed,  ///< into the JSON, a matrix for each frame; positions and normals are in model space
};

/// What was written.
struct VertexTexture {
    VertexTextureLayout layout;
    glm::vec3 low{0}, high{0};  ///< bounds of all positions of the clip: texels 0 and 65535
    /// What rounding to 16 bits can add to a position's error on one axis: the longest side of the bounds /
    /// 131070.
    double half_step = 0;
    double position_error = 0;  ///< measured: the largest distance of a decoded position, model units
    double normal_error = 0;    ///< measured: the largest angle of a decoded normal, radians
    std::vector<std::filesystem::path> files;  ///< all of them, `file` first
};

/// Returns the files that save_vertex_texture() writes for `file`, in the order of VertexTexture::files: to
/// refuse an output that would replace an input, before any work is done. Touches none of them. Throws
/// io::Error if the name of `file` does not end in .json.
[[nodiscard]] std::vector<std::filesystem::path> vertex_texture_files(const std::filesystem::path& file);

/// Writes `frames` as a vertex-animation texture. `file` is the JSON that describes it, NAME.json; beside it
/// are NAME.positions.png, NAME.normals.png, NAME.mesh.glb, NAME.glsl and NAME.hlsl: the two images, the mesh
/// at rest, and the texts of vertex_texture.glsl and .hlsl. Files that are there are replaced. The JSON has
/// U+FFFD in the place of bytes of their names that are not UTF-8.
///
/// `arrays` are those of `model` that the frames are of: by vertex_arrays(), or by vertex_arrays_with_uvs()
/// to keep texture coordinates. The GLB has its entries in their order, once each, their coordinates as
/// TEXCOORD_0, and their numbers as the first component of TEXCOORD_1.
///
/// Frames are read twice, for the bounds and for the texels; one is in memory at a time. Files are `files`'
/// to put in their places. Throws io::Error if a file cannot be written, its name does not end in .json,
/// frames do not fit the arrays, vertex_texture_layout() has nothing for them, or a position or a normal is
/// not finite; and mesh::Error, before any frame is read, if mesh::save() refuses the mesh at rest.
VertexTexture save_vertex_texture(Frames& frames, const mesh::Mesh& model, const mesh::VertexArrays& arrays,
                                  const std::filesystem::path& file, io::AtomicFiles& files,
                                  TexturePlacement placement = TexturePlacement::baked);

/// The text of goffer/clip/vertex_texture.glsl. Static storage; a 0 follows it. Thread-safe.
[[nodiscard]] std::string_view vertex_texture_glsl() noexcept;

/// The text of goffer/clip/vertex_texture.hlsl, likewise.
[[nodiscard]] std::string_view vertex_texture_hlsl() noexcept;

}  // namespace goffer::clip
