// SPDX-License-Identifier: MIT
#include "support/bound_case.hpp"

#include <goffer/bend/crowd.hpp>
#include <goffer/bend/kernel_input.hpp>
#include <goffer/draw/offscreen.hpp>
#include <goffer/draw/renderer.hpp>

#include <doctest/doctest.h>
#include <epoxy/gl.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <functional>
#include <optional>
#include <string>
#include <vector>

/// What OpenGL draws, looked at pixel by pixel.

namespace goffer::test {
namespace {

constexpr int side = 240;

struct Pixel {
    std::uint8_t r, g, b, a;
    bool operator==(const Pixel&) const = default;
};

int difference(const Pixel& one, const Pixel& other) {
    return std::max({std::abs(one.r - other.r), std::abs(one.g - other.g), std::abs(one.b - other.b)});
}

std::vector<Pixel> drawn_pixels() {
    std::vector<Pixel> pixels(std::size_t{side} * side);
    glReadPixels(0, 0, side, side, GL_RGBA, GL_UNSIGNED_BYTE, pixels.data());
    return pixels;
}

/// Runs `check` in a context, unless there is none.
void in_context(bool embedded, const std::function<void(draw::Renderer&)>& check) {
    std::string why;
    using Api = draw::OffscreenContext::Api;
    const draw::OffscreenContext context(embedded ? Api::es30 : Api::core33, why);
    if (!context) {
        MESSAGE("skipped: ", why);
        return;
    }
    const draw::OffscreenTarget target(side, side);
    draw::Renderer renderer;
    check(renderer);
}

/// A crowd of one body on a line, in poses of its own.
struct Crowd {
    std::size_t instances;
    BoundCase bound;
    std::vector<bend::Pose> poses;
    std::vector<glm::mat4x3> transforms;
    std::vector<draw::Vertex> vertices;
    std::vector<bend::Coefficients> coefficients;
    bend::Batch batch;

    Crowd(Random& random, std::size_t regions, bool bent_at_rest, std::size_t count = 3)
        : instances(count), bound(random_case(random, regions, bent_at_rest)) {
        const bend::Body& body = bound.binding.body;
        for (std::size_t i = 0; i < instances; ++i) {
            for (const bend::Pose& pose : random_poses(random, body)) poses.push_back(pose);
            glm::mat4x3 transform(1);
            transform[3][0] =
                static_cast<float>(3.6 * static_cast<double>(i) / static_cast<double>(count) * body.length());
            transforms.push_back(transform);
        }
        vertices.resize(instances * body.vertex_count());
        coefficients.resize(instances * body.region_count());
        batch.body = &body;
        batch.count = instances;
        batch.poses = {.data = poses.data(),
                       .count = instances,
                       .stride = static_cast<std::uint32_t>(body.region_count() * sizeof(bend::Pose))};
        batch.transforms = strided(std::span(transforms));
        batch.positions = interleaved<3>(&vertices[0].position.x, vertices.size(), sizeof(draw::Vertex));
        batch.normals = interleaved<3>(&vertices[0].normal.x, vertices.size(), sizeof(draw::Vertex));
        batch.vertex_step = body.vertex_count();
        bend::run({.batches = {&batch, 1}});
        bend::set_up(batch, coefficients);
    }

    /// Its triangles, as vertices of the body.
    [[nodiscard]] std::vector<std::uint32_t> triangles_of_body() const {
        std::vector<std::uint32_t> triangles = bound.test_mesh.triangles;
        const std::vector<std::uint32_t> place = bound.binding.vertices_in_body();
        for (std::uint32_t& vertex : triangles) vertex = place[vertex];
        return triangles;
    }

    [[nodiscard]] draw::Mesh mesh() const {
        const std::vector<std::uint32_t> triangles = triangles_of_body();
        const auto count = static_cast<std::uint32_t>(triangles.size() / 3), half = count / 2;
        const std::array parts{draw::Part{0, half}, draw::Part{half, count - half, {0.1f, 0.3f, 0.6f}}};
        return {bound.binding.body, triangles, parts};
    }

    [[nodiscard]] draw::OrbitCamera camera() const {
        glm::vec3 low(1e30f), high(-1e30f);
        for (const draw::Vertex& vertex : vertices) {
            low = glm::min(low, vertex.position);
            high = glm::max(high, vertex.position);
        }
        draw::OrbitCamera camera({0.3f, 1, -0.5f}, {0, 0, 1});
        camera.look_at((low + high) / 2.0f, 0.5f * glm::distance(low, high), 1);
        return camera;
    }
};

std::vector<Pixel> picture(draw::Renderer& renderer, const draw::OrbitCamera& camera, draw::Mesh* mesh,
                           const draw::Look& look = {}) {
    renderer.begin(camera, {0, 0, side, side});
    if (mesh != nullptr) renderer.draw(*mesh, look);
    renderer.end();
    return drawn_pixels();
}

/// How many pixels differ by more than `most` of 255.
std::size_t different(const std::vector<Pixel>& one, const std::vector<Pixel>& other, int most) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < one.size(); ++i) count += difference(one[i], other[i]) > most ? 1 : 0;
    return count;
}

/// Both ways to deform show one picture: the last bits of vertices move edges by less than a pixel.
void same_picture(draw::Renderer& renderer) {
    Random random(21);
    for (std::size_t trial = 0; trial < 6; ++trial) {
        CAPTURE(trial);
        // The coefficients of the last are more than a row of a texture holds.
        const Crowd crowd(random, 1 + trial % 3, trial % 2 == 1, trial == 5 ? 80 : 3);
        const draw::OrbitCamera camera = crowd.camera();
        draw::Mesh mesh = crowd.mesh();
        const std::vector<Pixel> backdrop = picture(renderer, camera, nullptr);
        mesh.set_vertices(crowd.vertices);
        const std::vector<Pixel> by_processor = picture(renderer, camera, &mesh, {.tinted = true});
        mesh.set_coefficients(crowd.coefficients);
        const std::vector<Pixel> by_shader = picture(renderer, camera, &mesh, {.tinted = true});
        const std::size_t shown = different(by_processor, backdrop, 8);
        CHECK(shown > 500);
        CHECK(different(by_processor, by_shader, 3) <= shown / 200);
        const auto last = [](const std::vector<Pixel>& pixels, const std::vector<Pixel>& empty) {
            std::size_t column = 0;
            for (std::size_t i = 0; i < pixels.size(); ++i) {
                if (difference(pixels[i], empty[i]) > 8) column = std::max(column, i % side);
            }
            return column;
        };
        CHECK(last(by_shader, backdrop) == last(by_processor, backdrop));
    }
}

}  // namespace

TEST_CASE("pictures: OpenGL 3.3 draws the same, whoever deforms") {
    in_context(false, same_picture);
}

TEST_CASE("pictures: OpenGL ES 3.0 draws the same, whoever deforms") {
    in_context(true, same_picture);
}

TEST_CASE("pictures: edges, colors, tints and opacity show, and go again") {
    in_context(false, [](draw::Renderer& renderer) {
        Random random(22);
        const Crowd crowd(random, 1, false);
        const draw::OrbitCamera camera = crowd.camera();
        draw::Mesh mesh = crowd.mesh();
        mesh.set_vertices(crowd.vertices);
        const std::vector<Pixel> backdrop = picture(renderer, camera, nullptr);
        const std::vector<Pixel> plain = picture(renderer, camera, &mesh);
        const std::size_t shown = different(plain, backdrop, 8);
        const auto differs = [&](const draw::Look& look) {
            return different(picture(renderer, camera, &mesh, look), plain, 8);
        };
        CHECK(differs({.wireframe = true}) > shown / 10);
        CHECK(differs({.tinted = true}) > shown / 10);
        CHECK(differs({.opacity = 0.2f}) > shown / 2);
        const std::vector<glm::vec3> blue(crowd.bound.binding.body.vertex_count(), {0, 0, 1});
        mesh.set_colors(blue);
        const std::vector<Pixel> colored = picture(renderer, camera, &mesh);
        std::size_t bluish = 0;
        for (std::size_t i = 0; i < colored.size(); ++i) bluish += colored[i].b > colored[i].r + 60 ? 1 : 0;
        CHECK(bluish > shown / 2);
        mesh.set_colors({});
        CHECK(picture(renderer, camera, &mesh) == plain);
    });
}

namespace {

/// A mesh with a texture in which every triangle has a color of its own: all edges are seams. It must look
/// like one whose triangles are parts in these colors, whoever deforms.
void same_with_seams(draw::Renderer& renderer) {
    Random random(25);
    const std::array<glm::vec3, 4> colors{glm::vec3{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 0}};
    std::vector<std::uint8_t> rgba;  // two above, two below
    for (const glm::vec3& color : colors)
        for (const float value : {color.r, color.g, color.b, 1.0f})
            rgba.push_back(static_cast<std::uint8_t>(255 * value));
    const std::array textures{draw::Texture{2, 2, rgba, draw::Wrap::clamp, draw::Wrap::clamp, true}};
    for (std::size_t trial = 0; trial < 3; ++trial) {
        CAPTURE(trial);
        const Crowd crowd(random, 1 + trial, trial == 1);
        const std::vector<std::uint32_t> triangles = crowd.triangles_of_body();
        std::vector<draw::Part> by_color;
        std::vector<glm::vec2> uvs;
        for (std::uint32_t t = 0; t < triangles.size() / 3; ++t) {
            const std::size_t which = (t * 2654435761u >> 7) % 4;
            by_color.push_back({t, 1, 0.7f * colors[which]});
            uvs.insert(uvs.end(), 3, {which % 2 == 0 ? 0.25f : 0.75f, which < 2 ? 0.75f : 0.25f});
        }
        const auto count = static_cast<std::uint32_t>(triangles.size() / 3);
        const std::array whole{draw::Part{0, count, glm::vec3(0.7f), 0}};
        draw::Mesh textured(crowd.bound.binding.body, triangles, whole, {textures, uvs});
        draw::Mesh plain(crowd.bound.binding.body, triangles, by_color);
        plain.set_vertices(crowd.vertices);
        const draw::OrbitCamera camera = crowd.camera();
        const std::vector<Pixel> backdrop = picture(renderer, camera, nullptr);
        const std::vector<Pixel> wanted = picture(renderer, camera, &plain, {.tinted = true});
        const std::size_t shown = different(wanted, backdrop, 8);
        CHECK(shown > 500);
        textured.set_vertices(crowd.vertices);
        CHECK(different(picture(renderer, camera, &textured, {.tinted = true}), wanted, 3) <= shown / 500);
        textured.set_coefficients(crowd.coefficients);
        CHECK(different(picture(renderer, camera, &textured, {.tinted = true}), wanted, 8) <= shown / 50);
        // Vertices' colors are multiplied by it, and stand alone where it is not wanted.
        const std::vector<glm::vec3> red(crowd.bound.binding.body.vertex_count(), {1, 0, 0});
        textured.set_colors(red);
        const std::vector<Pixel> both = picture(renderer, camera, &textured);
        const auto reddish = [](const std::vector<Pixel>& pixels) {
            return static_cast<std::size_t>(std::ranges::count_if(
                pixels, [](const Pixel& p) { return p.r > p.g + 60 && p.r > p.b + 60; }));
        };
        CHECK(reddish(both) > shown / 5);
        CHECK(reddish(both) < shown * 4 / 5);
        CHECK(reddish(picture(renderer, camera, &textured, {.textured = false})) > shown * 4 / 5);
        CHECK(different(picture(renderer, camera, &textured, {.wireframe = true}), both, 8) > shown / 10);
    }
}

}  // namespace

TEST_CASE("pictures: OpenGL 3.3 draws textures, and seams where they are") {
    in_context(false, same_with_seams);
}

TEST_CASE("pictures: OpenGL ES 3.0 draws textures, and seams where they are") {
    in_context(true, same_with_seams);
}

TEST_CASE("pictures: lines are hidden behind what is in front, points are not") {
    in_context(false, [](draw::Renderer& renderer) {
        Random random(23);
        const Crowd crowd(random, 1, false);
        const draw::OrbitCamera camera = crowd.camera();
        draw::Mesh mesh = crowd.mesh();
        mesh.set_vertices(crowd.vertices);
        const glm::vec3 middle = crowd.vertices[0].position;
        const glm::vec3 behind = camera.eye() + 3.0f * (middle - camera.eye());
        const glm::vec3 near = camera.eye() + 0.1f * (middle - camera.eye());
        const glm::vec3 across = 0.001f * camera.right();
        const auto greens = [&](const std::function<void()>& marks) {
            renderer.begin(camera, {0, 0, side, side});
            renderer.draw(mesh);
            marks();
            renderer.end();
            return std::ranges::count_if(drawn_pixels(),
                                         [](const Pixel& pixel) { return pixel.g > 200 && pixel.r < 60; });
        };
        const auto line_at = [&](const glm::vec3& from) {
            const std::array line{
                draw::Mark{from, {0, 1, 0}},
                draw::Mark{from + 100.0f * across * glm::distance(from, camera.eye()), {0, 1, 0}}};
            return greens([&] { renderer.draw_lines(line); });
        };
        CHECK(line_at(near) > 3);
        CHECK(line_at(behind) < line_at(near));
        const std::array point{draw::Mark{behind, {0, 1, 0}}};
        const auto dot = greens([&] { renderer.draw_points(point, 12); });
        CHECK(dot > 30);
        CHECK(dot < 150);
    });
}

TEST_CASE("pictures: a mesh without instances, and no marks, are nothing to draw") {
    in_context(false, [](draw::Renderer& renderer) {
        Random random(24);
        const Crowd crowd(random, 2, false);
        draw::Mesh mesh = crowd.mesh();
        const draw::OrbitCamera camera = crowd.camera();
        const std::vector<Pixel> backdrop = picture(renderer, camera, nullptr);
        CHECK(picture(renderer, camera, &mesh) == backdrop);
        renderer.begin(camera, {0, 0, side, side});
        renderer.draw_lines({});
        renderer.draw_points({}, 5);
        renderer.end();
        CHECK(drawn_pixels() == backdrop);
    });
}

}  // namespace goffer::test
