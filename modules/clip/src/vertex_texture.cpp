// SPDX-License-Identifier: MIT
#include "placed.hpp"
#include "texture_mesh.hpp"
#include "vertex_texture_text.hpp"
#include "wide_png.hpp"

#include <goffer/clip/frames.hpp>
#include <goffer/clip/vertex_texture.hpp>
#include <goffer/io/atomic_file.hpp>
#include <goffer/io/ending.hpp>
#include <goffer/mesh/mesh.hpp>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <glm/vector_relational.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace goffer::clip {
namespace {

namespace fs = std::filesystem;

constexpr float last_step = 65535;  // of a channel

/// The files of a texture: NAME.json and those beside it.
struct Names {
    fs::path json, positions, normals, mesh, glsl, hlsl;

    explicit Names(const fs::path& file) : json(file) {
        if (io::ending_of(file) != ".json") fail(file, "the ending is not .json; give a name that ends so");
        const auto beside = [&](const char* ending) {
            fs::path name = file;
            name.replace_extension();
            return name += ending;
        };
        positions = beside(".positions.png");
        normals = beside(".normals.png");
        mesh = beside(".mesh.glb");
        glsl = beside(".glsl");
        hlsl = beside(".hlsl");
    }

    [[nodiscard]] std::vector<fs::path> all() const { return {json, positions, normals, mesh, glsl, hlsl}; }
};

/// Numbers of a channel, and what a shader makes of them.
glm::vec3 steps_of(const glm::dvec3& share) {
    return {glm::round(glm::clamp(share, 0.0, 1.0) * static_cast<double>(last_step))};
}

/// Positions and normals of one frame at a time, in the space that is written.
class Reader {
public:
    Reader(Frames& frames, TexturePlacement placement, const fs::path& file)
        : frames_(frames), placement_(placement), file_(file), positions_(frames.vertices()) {}

    void read(std::size_t frame, bool with_normals) {
        normals_.resize(with_normals ? positions_.size() : 0);
        frames_.read(frame, positions_, normals_);
        if (placement_ == TexturePlacement::baked) place(frames_.placement(frame), positions_, normals_);
        check_finite(positions_, "vertex", frame, file_, use_smaller_numbers);
        check_finite(normals_, "normal", frame, file_, use_smaller_numbers);
    }
    [[nodiscard]] const std::vector<glm::vec3>& positions() const { return positions_; }
    [[nodiscard]] const std::vector<glm::vec3>& normals() const { return normals_; }

private:
    Frames& frames_;
    TexturePlacement placement_;
    const fs::path& file_;
    std::vector<glm::vec3> positions_, normals_;
};

void find_bounds(Reader& reader, std::size_t frames, VertexTexture& result, const fs::path& file) {
    result.low = glm::vec3(std::numeric_limits<float>::max());
    result.high = -result.low;
    for (std::size_t frame = 0; frame < frames; ++frame) {
        reader.read(frame, false);
        for (const glm::vec3& p : reader.positions()) {
            result.low = glm::min(result.low, p);
            result.high = glm::max(result.high, p);
        }
    }
    const glm::vec3 size = result.high - result.low;
    const float longest = std::max({size.x, size.y, size.z});
    if (!std::isfinite(longest)) fail(file, std::string("the clip is too large; ") + use_smaller_numbers);
    result.half_step = static_cast<double>(longest) / (2.0 * static_cast<double>(last_step));
}

/// Encodes frames, and measures what is lost.
class Encoder {
public:
    explicit Encoder(VertexTexture& result)
        : result_(result), size_(glm::dvec3(result.high) - glm::dvec3(result.low)) {}

    glm::vec3 position(const glm::vec3& p) {
        const glm::dvec3 from_low = glm::dvec3(p) - glm::dvec3(result_.low);
        const glm::vec3 steps =
            steps_of(glm::mix(from_low / size_, glm::dvec3(0.0), glm::equal(size_, glm::dvec3(0.0))));
        const glm::vec3 decoded = result_.low + steps / last_step * (result_.high - result_.low);
        result_.position_error =
            std::max(result_.position_error, glm::distance(glm::dvec3(decoded), glm::dvec3(p)));
        return steps;
    }

    glm::vec3 normal(const glm::vec3& n) {
        const glm::vec3 steps = steps_of(glm::dvec3(n) * 0.5 + 0.5);
        const glm::dvec3 decoded = glm::normalize(glm::dvec3(steps / last_step * 2.0f - 1.0f));
        const glm::dvec3 exact = glm::normalize(glm::dvec3(n));
        // atan2 rather than acos, which knows no small angles. A normal that is none has no error.
        const double angle = std::atan2(glm::length(glm::cross(decoded, exact)), glm::dot(decoded, exact));
        result_.normal_error = std::max(result_.normal_error, angle);
        return steps;
    }

private:
    VertexTexture& result_;
    glm::dvec3 size_;
};

/// Appends a frame to an image: row after row, and zeros behind its last vertex.
template <class Encode>
void write_frame(WidePng& image, const VertexTextureLayout& layout, const std::vector<glm::vec3>& values,
                 std::vector<std::uint16_t>& row, Encode encode) {
    for (std::size_t first = 0; first < layout.rows_per_frame * layout.width; first += layout.width) {
        std::ranges::fill(row, std::uint16_t{0});
        const std::size_t end = std::min(values.size(), first + layout.width);
        for (std::size_t i = first; i < end; ++i) {
            const glm::vec3 steps = encode(values[i]);
            for (std::size_t axis = 0; axis < 3; ++axis)
                row[3 * (i - first) + axis] =
                    static_cast<std::uint16_t>(steps[static_cast<glm::length_t>(axis)]);
        }
        image.write_row(row);
    }
}

void write_images(Reader& reader, std::size_t frames, const Names& names, io::AtomicFiles& files,
                  VertexTexture& result) {
    const VertexTextureLayout& layout = result.layout;
    WidePng positions(layout.width, layout.height, files.add(names.positions), names.positions);
    WidePng normals(layout.width, layout.height, files.add(names.normals), names.normals);
    std::vector<std::uint16_t> row(3 * layout.width);
    Encoder encoder(result);
    for (std::size_t frame = 0; frame < frames; ++frame) {
        reader.read(frame, true);
        write_frame(positions, layout, reader.positions(), row,
                    [&](const glm::vec3& p) { return encoder.position(p); });
        write_frame(normals, layout, reader.normals(), row,
                    [&](const glm::vec3& n) { return encoder.normal(n); });
    }
    positions.finish();
    normals.finish();
}

nlohmann::ordered_json list(const glm::vec3& v) {
    return {v.x, v.y, v.z};
}

/// The columns of each frame's matrix, one behind the other.
nlohmann::ordered_json placements_of(const Frames& frames) {
    nlohmann::ordered_json all = nlohmann::ordered_json::array();
    for (std::size_t frame = 0; frame < frames.count(); ++frame) {
        const glm::mat4x3 matrix = frames.placement(frame);
        nlohmann::ordered_json one = nlohmann::ordered_json::array();
        for (glm::length_t column = 0; column < 4; ++column)
            for (glm::length_t axis = 0; axis < 3; ++axis) one.push_back(matrix[column][axis]);
        all.push_back(std::move(one));
    }
    return all;
}

nlohmann::ordered_json description(const Frames& frames, const Names& names, const VertexTexture& texture,
                                   TexturePlacement placement) {
    nlohmann::ordered_json json;
    json["format"] = "goffer vertex-animation texture";
    json["version"] = 1;
    json["positions"] = names.positions.filename().string();
    json["normals"] = names.normals.filename().string();
    json["mesh"] = names.mesh.filename().string();
    json["shader"] = names.glsl.filename().string();
    json["shader_hlsl"] = names.hlsl.filename().string();
    json["vertices"] = frames.vertices();
    json["frames"] = frames.count();
    json["frames_per_second"] = frames.rate();
    json["width"] = texture.layout.width;
    json["height"] = texture.layout.height;
    json["rows_per_frame"] = texture.layout.rows_per_frame;
    json["low"] = list(texture.low);
    json["high"] = list(texture.high);
    json["placement"] = placement == TexturePlacement::baked ? "baked" : "listed";
    if (placement == TexturePlacement::listed) json["placements"] = placements_of(frames);
    json["half_step"] = texture.half_step;
    json["position_error"] = texture.position_error;
    json["normal_error_degrees"] = glm::degrees(texture.normal_error);
    return json;
}

std::size_t divided(std::size_t a, std::size_t b) noexcept {
    return (a + b - 1) / b;
}

/// How many rows a frame takes at least.
std::size_t fewest_rows(std::size_t vertices) noexcept {
    return divided(vertices, VertexTextureLayout::largest_side);
}

/// Says why there is no layout.
[[noreturn]] void refuse(const fs::path& file, std::size_t vertices, std::size_t frames) {
    const std::string clip = std::to_string(frames) + " frames of " + std::to_string(vertices) + " vertices";
    if (vertices == 0 || frames == 0) fail(file, clip + " make no texture; give it 1 or more of both");
    if (vertices > VertexTextureLayout::most_vertices)
        fail(file, std::to_string(vertices) + " vertices are more than the " +
                       std::to_string(VertexTextureLayout::most_vertices) +
                       " that a float can number; use a smaller mesh");
    const std::size_t rows = fewest_rows(vertices), most_rows = VertexTextureLayout::largest_side;
    const std::string side = std::to_string(most_rows);
    fail(file, clip + " do not fit " + side + " rows of " + side + " texels: each of these frames takes " +
                   std::to_string(rows) + (rows == 1 ? " row" : " rows") + ", so that " +
                   std::to_string(most_rows / rows) + " fit; give it fewer frames or vertices");
}

}  // namespace

std::optional<VertexTextureLayout> vertex_texture_layout(std::size_t vertices, std::size_t frames) noexcept {
    constexpr std::size_t side = VertexTextureLayout::largest_side;
    if (vertices == 0 || vertices > VertexTextureLayout::most_vertices) return std::nullopt;
    if (frames == 0 || frames > side / fewest_rows(vertices)) return std::nullopt;
    const std::size_t wanted = divided(vertices, VertexTextureLayout::handy_width);
    const std::size_t rows = std::min(wanted, side / frames);
    const std::size_t width = divided(vertices, rows);
    return VertexTextureLayout{width, divided(vertices, width) * frames, divided(vertices, width)};
}

std::vector<fs::path> vertex_texture_files(const fs::path& file) {
    return Names(file).all();
}

VertexTexture save_vertex_texture(Frames& frames, const mesh::Mesh& model, const mesh::VertexArrays& arrays,
                                  const fs::path& file, io::AtomicFiles& files, TexturePlacement placement) {
    const Names names(file);
    const auto layout = vertex_texture_layout(frames.vertices(), frames.count());
    if (!layout) refuse(file, frames.vertices(), frames.count());
    if (frames.vertices() != arrays.positions.size())
        fail(file, "the clip has " + std::to_string(frames.vertices()) + " vertices, and its mesh " +
                       std::to_string(arrays.positions.size()) + "; give the arrays that it was made from");
    VertexTexture result;
    result.layout = *layout;
    result.files = names.all();
    // These two first, to be refused before the work.
    io::AtomicFile& json = files.add(file);
    mesh::save(texture_mesh(model, arrays), names.mesh, files);
    Reader reader(frames, placement, file);
    find_bounds(reader, frames.count(), result, file);
    write_images(reader, frames.count(), names, files, result);
    files.add(names.glsl).write(vertex_texture_glsl());
    files.add(names.hlsl).write(vertex_texture_hlsl());
    // A file name need not be UTF-8; what is not is replaced.
    json.write(description(frames, names, result, placement)
                   .dump(2, ' ', false, nlohmann::json::error_handler_t::replace) +
               "\n");
    return result;
}

std::string_view vertex_texture_glsl() noexcept {
    return {glsl_text, sizeof glsl_text - 1};
}

std::string_view vertex_texture_hlsl() noexcept {
    return {hlsl_text, sizeof hlsl_text - 1};
}

}  // namespace goffer::clip
