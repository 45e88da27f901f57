// SPDX-License-Identifier: MIT
#include "crowd/render.hpp"

#include "packed_vertices.hpp"
#include "picture.hpp"

#include <goffer/bend/bounds.hpp>
#include <goffer/view/picture.hpp>

#include <glm/packing.hpp>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <vector>

namespace goffer::cli {
namespace {

constexpr std::size_t max_instances = 400;
constexpr std::size_t max_triangles = 4'000'000;

/// Not quite the same for any two neighbors.
glm::vec4 tinted(const glm::vec4& color, std::size_t index) {
    const float turn = 2.4f * static_cast<float>(index % 1000);
    const glm::vec3 tint(1 + 0.12f * std::sin(turn), 1 + 0.12f * std::sin(1.31f * turn + 1),
                         1 + 0.12f * std::sin(0.77f * turn + 2));
    return {glm::vec3(color) * tint, 1};
}

/// Vertices read back from wherever a job has put them.
struct Vertices {
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> normals;
};

std::vector<glm::vec3> read(const Stream3& stream) {
    std::vector<glm::vec3> values(stream.count);
    for (std::size_t i = 0; i < values.size(); ++i) {
        for (int c = 0; c < 3; ++c) {
            std::memcpy(&values[i][c],
                        reinterpret_cast<const std::byte*>(stream.component[c]) + i * stream.stride,
                        sizeof(float));
        }
    }
    return values;
}

Vertices read_packed(const bend::DeformJob& job) {
    const auto [low, high] = bend::bounds(job);
    Vertices vertices{std::vector<glm::vec3>(job.packed.count), std::vector<glm::vec3>(job.packed.count)};
    unpack_vertices(reinterpret_cast<const std::byte*>(job.packed.first), job.packed.stride, low, high,
                    vertices.positions, vertices.normals);
    return vertices;
}

/// Makes the normals of an instance, for a crowd that has not asked for them.
std::vector<glm::vec3> make_normals(bend::DeformJob job) {
    std::vector<glm::vec3> normals(job.body->vertex_count());
    job.positions = {};
    job.normals = interleaved<3>(&normals.front().x, normals.size());
    bend::run(job);
    return normals;
}

Vertices vertices_of(const bend::DeformJob& job) {
    if (!job.packed.empty()) return read_packed(job);
    return {read(job.positions), job.normals.empty() ? make_normals(job) : read(job.normals)};
}

/// The instances to be shown, as indices.
std::vector<std::size_t> choose(const Crowd& crowd, std::span<const BoundModel> models) {
    const std::size_t count = crowd.instances();
    std::size_t triangles = 0;
    for (std::size_t i = 0; i < count; ++i) triangles += models[crowd.model(i)].rest.triangles.size() / 3;
    const std::size_t fit = max_triangles / (triangles / count + 1);
    const std::size_t most = std::clamp<std::size_t>(fit, 1, max_instances);
    const auto width = static_cast<std::size_t>(std::ceil(std::sqrt(static_cast<double>(most))));
    const std::size_t left = (crowd.columns() - std::min(width, crowd.columns())) / 2;
    std::vector<std::size_t> chosen;
    for (std::size_t i = 0; i < count; ++i) {
        const auto [column, row] = crowd.spot(i);
        const bool in_front =
            left <= column && column < left + width && row < std::max<std::size_t>(most / width, 1);
        if (count <= most || in_front) chosen.push_back(i);
    }
    return chosen;
}

}  // namespace

std::size_t write_crowd_picture(const Crowd& crowd, std::span<const BoundModel> models,
                                std::span<const Textures> textures, const view::Settings& settings,
                                const std::filesystem::path& file, io::AtomicFiles& outputs) {
    const std::vector<std::size_t> chosen = choose(crowd, models);
    const std::vector<PictureTextures> pictured(textures.begin(), textures.end());
    std::vector<std::vector<glm::vec4>> colors;
    for (std::size_t i = 0; i < models.size(); ++i)
        colors.push_back(vertex_colors(models[i].mesh, models[i].rest, plain_color(i)));
    std::vector<Vertices> vertices;
    std::vector<view::Model> parts;
    vertices.reserve(chosen.size());
    for (const std::size_t i : chosen) {
        const BoundModel& model = models[crowd.model(i)];
        Vertices& own = vertices.emplace_back(vertices_of(crowd.scene().instance(i)));
        put_in_model_order(own.positions, model.binding);
        put_in_model_order(own.normals, model.binding);
        const glm::vec4 plain = plain_color(crowd.model(i));
        const view::Model all{.positions = own.positions,
                              .triangles = model.rest.triangles,
                              .normals = own.normals,
                              .colors = colors[crowd.model(i)]};
        for (view::Model& part : part_models(model.mesh, all, pictured[crowd.model(i)], plain)) {
            part.color = tinted(part.color, i);
            parts.push_back(part);
        }
    }
    view::Camera camera;
    camera.toward = {0.12f, 1.0f, -0.85f};
    view::save_png(view::render(parts, camera, settings), file, outputs);
    return chosen.size();
}

}  // namespace goffer::cli
