// SPDX-License-Identifier: MIT
#include "support/models.hpp"
#include "support/worst.hpp"
#include "textures.hpp"
#include "wide_image.hpp"

#include <goffer/io/error.hpp>

#include <doctest/doctest.h>
#include <glm/trigonometric.hpp>
#include <nlohmann/json.hpp>

#include <array>
#include <fstream>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

using namespace goffer;
using namespace goffer::test;
using clip::TexturePlacement;
using clip::vertex_texture_layout;
using clip::VertexTexture;

namespace {

nlohmann::json json_of(const std::filesystem::path& file) {
    return nlohmann::json::parse(bytes_of(file));
}

glm::dvec3 vector_of(const nlohmann::json& list) {
    return {list[0].get<float>(), list[1].get<float>(), list[2].get<float>()};
}

/// Decodes a texture by what its JSON says alone.
class Decoder {
public:
    explicit Decoder(const std::filesystem::path& file)
        : json(json_of(file)),
          positions_(read_wide_image(file.parent_path() / json["positions"].get<std::string>())),
          normals_(read_wide_image(file.parent_path() / json["normals"].get<std::string>())) {
        for (const WideImage& image : {positions_, normals_}) {
            CHECK(image.width == json["width"].get<std::size_t>());
            CHECK(image.height == json["height"].get<std::size_t>());
        }
    }

    [[nodiscard]] glm::dvec3 position(std::size_t vertex, std::size_t frame) const {
        const glm::dvec3 low = vector_of(json["low"]), high = vector_of(json["high"]);
        return low + texel(positions_, vertex, frame) / 65535.0 * (high - low);
    }
    [[nodiscard]] glm::dvec3 normal(std::size_t vertex, std::size_t frame) const {
        return glm::normalize(texel(normals_, vertex, frame) / 65535.0 * 2.0 - 1.0);
    }

    const nlohmann::json json;

private:
    [[nodiscard]] glm::dvec3 texel(const WideImage& image, std::size_t vertex, std::size_t frame) const {
        const auto rows = json["rows_per_frame"].get<std::size_t>();
        return image.texel(vertex % image.width, frame * rows + vertex / image.width);
    }

    WideImage positions_, normals_;
};

/// The largest errors of all frames of a texture, against positions and normals in double.
struct Errors {
    double position = 0, distance = 0, normal = 0;
};

template <class Positions, class Normals>
Errors errors_of(const Decoder& decoder, std::size_t frames, Positions positions, Normals normals) {
    Errors worst;
    for (std::size_t frame = 0; frame < frames; ++frame) {
        const std::vector<glm::dvec3> p = positions(frame), n = normals(frame);
        for (std::size_t i = 0; i < p.size(); ++i) {
            const glm::dvec3 decoded = decoder.position(i, frame);
            test::take_worst(worst.position, farthest(decoded, p[i]));
            test::take_worst(worst.distance, glm::distance(decoded, p[i]));
            test::take_worst(worst.normal, angle_between(decoder.normal(i, frame), n[i]));
        }
    }
    return worst;
}

/// Whether a texture is as exact as it says, and no more exact than 16 bits are.
void check_errors(const Errors& errors, const VertexTexture& texture) {
    const double rounding = float_rounding(texture);
    CHECK(errors.position <= texture.half_step + rounding);
    CHECK(errors.position > 0.5 * texture.half_step);
    CHECK(errors.distance ==
          doctest::Approx(texture.position_error).epsilon(0.01 + rounding / texture.half_step));
    CHECK(errors.normal <= normal_half_step);
    CHECK(errors.normal == doctest::Approx(glm::degrees(texture.normal_error)).epsilon(0.02));
}

/// A texture of moving points, carried in the texture, within its stated error.
void check_points(std::size_t vertices, std::size_t frames, std::size_t width, std::size_t rows) {
    const Folder folder;
    const mesh::Mesh model = strip(vertices);
    MovingPoints points(vertices, frames, true);
    const VertexTexture texture =
        saved_texture(points, model, mesh::vertex_arrays(model), folder / "a.vat.json");
    CHECK(texture.layout.width == width);
    CHECK(texture.layout.rows_per_frame == rows);
    CHECK(texture.layout.height == rows * frames);
    const Decoder decoder(folder / "a.vat.json");
    check_errors(errors_of(
                     decoder, frames, [&](std::size_t frame) { return carried(points, frame); },
                     [&](std::size_t frame) { return carried_normals(points, frame); }),
                 texture);
}

std::string texture_error(clip::Frames& frames, std::size_t vertices, const std::string& name = "a.json") {
    const Folder folder;
    const mesh::Mesh model = strip(vertices);
    std::string message = message_of<io::Error>(
        [&] { saved_texture(frames, model, mesh::vertex_arrays(model), folder / name); });
    CHECK(folder.files() == 0);
    return message;
}

}  // namespace

TEST_CASE("vertex texture: frames are rows, as many as they need, within what graphics cards take") {
    const auto check = [](std::size_t vertices, std::size_t frames, std::size_t width, std::size_t rows) {
        const auto layout = vertex_texture_layout(vertices, frames);
        REQUIRE(layout);
        CHECK(layout->width == width);
        CHECK(layout->rows_per_frame == rows);
        CHECK(layout->height == rows * frames);
        CHECK(layout->width * rows >= vertices);
        CHECK(layout->width * (rows - 1) < vertices);
    };
    check(1, 1, 1, 1);
    check(2048, 100, 2048, 1);
    check(2049, 100, 1025, 2);
    check(10'000, 96, 2000, 5);
    check(10'000, 16384, 10'000, 1);  // wider than is handy, for the sake of the frames
    check(16384, 16384, 16384, 1);
    check(100'000, 1000, 6250, 16);
    check(std::size_t{1} << 24, 16, 16384, 1024);
    check(16385, 8192, 8193, 2);
    check(32768, 8192, 16384, 2);
    CHECK(!vertex_texture_layout(16385, 8193));  // frames share no rows: there is room for 8192 only
    CHECK(!vertex_texture_layout(32769, 8192));
    CHECK(!vertex_texture_layout(std::size_t{1} << 24, 17));
    CHECK(!vertex_texture_layout(1, 16385));
    CHECK(!vertex_texture_layout(16385, 16384));
    CHECK(!vertex_texture_layout((std::size_t{1} << 24) + 1, 1));
    CHECK(!vertex_texture_layout(std::numeric_limits<std::size_t>::max(), 1));
    CHECK(!vertex_texture_layout(1, std::numeric_limits<std::size_t>::max()));
    CHECK(!vertex_texture_layout(0, 2));
    CHECK(!vertex_texture_layout(2, 0));
    CHECK(!vertex_texture_layout(0, 0));
}

TEST_CASE("vertex texture: moving points are within half a step of 16 bits") {
    check_points(700, 12, 700, 1);
    check_points(5000, 7, 1667, 3);
}

TEST_CASE("vertex texture: a model that bends is within half a step of 16 bits") {
    const Folder folder;
    BendingModel bending(model("wine_bottle.glb"), 13);
    const VertexTexture texture =
        saved_texture(bending, bending.model, bending.arrays, folder / "bottle.json");
    const Decoder decoder(folder / "bottle.json");
    check_errors(errors_of(
                     decoder, bending.count(), [&](std::size_t frame) { return carried(bending, frame); },
                     [&](std::size_t frame) { return carried_normals(bending, frame); }),
                 texture);
    const glm::vec3 size = texture.high - texture.low;
    MESSAGE(texture.layout.width, " x ", texture.layout.height, ", bounds ",
            std::max({size.x, size.y, size.z}), ", half a step ", texture.half_step, ", off by ",
            texture.position_error, " and ", glm::degrees(texture.normal_error), " degrees");
}

TEST_CASE("vertex texture: placements that are listed are not in the texels") {
    const Folder folder;
    const mesh::Mesh model = strip(300);
    MovingPoints points(300, 9, true), still(300, 9, false);
    const VertexTexture listed =
        saved_texture(points, model, mesh::vertex_arrays(model), folder / "a.json", TexturePlacement::listed);
    saved_texture(still, model, mesh::vertex_arrays(model), folder / "b.json");
    CHECK(bytes_of(folder / "a.positions.png") == bytes_of(folder / "b.positions.png"));
    CHECK(bytes_of(folder / "a.normals.png") == bytes_of(folder / "b.normals.png"));
    const nlohmann::json json = json_of(folder / "a.json"), baked = json_of(folder / "b.json");
    CHECK(json["placement"] == "listed");
    CHECK(baked["placement"] == "baked");
    CHECK(!baked.contains("placements"));
    REQUIRE(json["placements"].size() == 9);
    for (std::size_t frame = 0; frame < 9; ++frame) {
        const glm::mat4x3 matrix = points.placement(frame);
        for (std::size_t i = 0; i < 12; ++i)
            CHECK(json["placements"][frame][i].get<float>() ==
                  matrix[static_cast<glm::length_t>(i / 3)][static_cast<glm::length_t>(i % 3)]);
    }
    CHECK(listed.files.size() == 6);
}

TEST_CASE("vertex texture: the JSON says what a player needs") {
    const Folder folder;
    const mesh::Mesh model = strip(300);
    MovingPoints points(300, 9, true);
    const VertexTexture texture =
        saved_texture(points, model, mesh::vertex_arrays(model), folder / "worm.vat.json");
    const nlohmann::json json = json_of(folder / "worm.vat.json");
    CHECK(json["format"] == "goffer vertex-animation texture");
    CHECK(json["version"] == 1);
    CHECK(json["positions"] == "worm.vat.positions.png");
    CHECK(json["normals"] == "worm.vat.normals.png");
    CHECK(json["mesh"] == "worm.vat.mesh.glb");
    CHECK(json["shader"] == "worm.vat.glsl");
    CHECK(json["shader_hlsl"] == "worm.vat.hlsl");
    CHECK(json["vertices"] == 300);
    CHECK(json["frames"] == 9);
    CHECK(json["frames_per_second"] == 24);
    CHECK(json["half_step"] == texture.half_step);
    CHECK(json["position_error"] == texture.position_error);
    CHECK(json["normal_error_degrees"] == glm::degrees(texture.normal_error));
    CHECK(glm::vec3(vector_of(json["low"])) == texture.low);
    CHECK(glm::vec3(vector_of(json["high"])) == texture.high);
    for (const auto& file : texture.files) CHECK(std::filesystem::is_regular_file(file));
    CHECK(folder.files() == texture.files.size());
    for (const std::string language : {"glsl", "hlsl"}) {
        const std::string source = GOFFER_SOURCE_DIR "/modules/clip/include/goffer/clip/vertex_texture.";
        CHECK(bytes_of(folder / ("worm.vat." + language)) == bytes_of(source + language));
    }
}

TEST_CASE("vertex texture: an image that is cut off is no image") {
    const Folder folder;
    const mesh::Mesh model = strip(900);
    MovingPoints points(900, 9, true);
    const VertexTexture texture = saved_texture(points, model, mesh::vertex_arrays(model), folder / "a.json");
    const std::string bytes = bytes_of(texture.files[1]);
    for (const std::size_t size : {std::size_t{0}, std::size_t{20}, bytes.size() / 2}) {
        const auto cut = folder.write("cut.png", bytes.substr(0, size));
        CHECK(message_of<std::runtime_error>([&] { (void)read_wide_image(cut); }) == "cut off");
    }
    CHECK(read_wide_image(folder.write("cut.png", bytes)).height == 9);
}

TEST_CASE("vertex texture: a clip that is flat, or stands still, has no step where it has no size") {
    class Flat : public MovingPoints {
    public:
        Flat() : MovingPoints(5, 3, false) {}
        void read(std::size_t frame, std::span<glm::vec3> positions, std::span<glm::vec3> normals) override {
            MovingPoints::read(frame, positions, normals);
            for (glm::vec3& p : positions) p.y = 0.1f, p.z = -7;
        }
    } flat;
    const Folder folder;
    const mesh::Mesh model = strip(5);
    saved_texture(flat, model, mesh::vertex_arrays(model), folder / "a.json");
    const Decoder decoder(folder / "a.json");
    for (std::size_t i = 0; i < 5; ++i) {
        CHECK(decoder.position(i, 1).y == static_cast<double>(0.1f));
        CHECK(decoder.position(i, 1).z == -7);
    }
}

TEST_CASE("vertex texture: what no texture can hold is refused, and nothing is left") {
    class Far : public MovingPoints {
    public:
        Far(float x, float first) : MovingPoints(9, 3, false), x_(x), first_(first) {}
        void read(std::size_t frame, std::span<glm::vec3> positions, std::span<glm::vec3> normals) override {
            MovingPoints::read(frame, positions, normals);
            positions[0].x = first_;
            positions[4].x = x_;
        }

    private:
        float x_, first_;
    };
    MovingPoints points(9, 3, false), long_clip(9, 16385, false);
    CHECK(tells(texture_error(points, 9, "a.png"), "not .json"));
    CHECK(tells(texture_error(points, 8), "the clip has 9 vertices, and its mesh 8"));
    CHECK(tells(texture_error(long_clip, 9),
                "16385 frames of 9 vertices do not fit 16384 rows of 16384 "
                "texels: each of these frames takes 1 row, so that 16384 fit"));
    MovingPoints wide(16385, 8193, false), none(0, 3, false), still(9, 0, false),
        countless((std::size_t{1} << 24) + 1, 1, false);
    CHECK(tells(texture_error(wide, 16385), "takes 2 rows, so that 8192 fit; give it fewer"));
    CHECK(tells(texture_error(none, 0), "3 frames of 0 vertices make no texture; give it 1 or more of both"));
    CHECK(tells(texture_error(still, 9), "0 frames of 9 vertices make no texture"));
    CHECK(tells(texture_error(countless, 9), "16777217 vertices are more than the 16777216 that a float"));
    Far lost(std::numeric_limits<float>::quiet_NaN(), 0), far(3e38f, -3e38f);
    CHECK(tells(texture_error(lost, 9), "frame 0, vertex 4 (counted from 0) is not finite"));
    CHECK(tells(texture_error(far, 9), "too large"));
    MovingPoints many(3000, 40, false);
    const FullDisk full(4096);
    CHECK(tells(texture_error(many, 3000), "cannot be written"));
}
