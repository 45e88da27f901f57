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
/// what is in the files, and vertex_texture.glsl plays them.

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
    static constexpr std::size_t most_vertices = std::size_t{1} << 24;  ///< a float counts so many
};

/// Returns the layout of `frames` frames of `vertices` vertices, both 1 or more; nothing where they do not
/// fit into `largest_side` squared, or are more than `most_vertices`.
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
    /// What rounding to 16 bits can add to a position's error: the longest side of the bounds / 131070.
    double half_step = 0;
    double position_error = 0;  ///< measured: the largest distance of a decoded position, model units
    double normal_error = 0;    ///< measured: the largest angle of a decoded normal, degrees
    std::vector<std::filesystem::path> files;  ///< all of them, `file` first
};

/// Writes `frames` as a vertex-animation texture. `file` is the JSON that describes it, NAME.json; beside it
/// are NAME.positions.png, NAME.normals.png, NAME.glb and NAME.glsl: the two images, the mesh at rest, and
/// the text of vertex_texture.glsl. `arrays` are those of `model` that the frames are of: by vertex_arrays(),
/// or by vertex_arrays_with_uvs() to keep texture coordinates. The GLB has its entries in their order, once
/// each, their coordinates as TEXCOORD_0, and their numbers as the first component of TEXCOORD_1.
///
/// Frames are read twice, for the bounds and for the texels; one is in memory at a time. Files are `files`'
/// to put in their places. Throws io::Error if a file cannot be written, its name does not end in .json,
/// frames do not fit the arrays or the layout, or a position is not finite.
VertexTexture save_vertex_texture(Frames& frames, const mesh::Mesh& model, const mesh::VertexArrays& arrays,
                                  const std::filesystem::path& file, io::AtomicFiles& files,
                                  TexturePlacement placement = TexturePlacement::baked);

/// The text of goffer/clip/vertex_texture.glsl. Static storage; a 0 follows it. Thread-safe.
[[nodiscard]] std::string_view vertex_texture_glsl() noexcept;

}  // namespace goffer::clip
