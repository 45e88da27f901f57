// SPDX-License-Identifier: MIT
#include "stage/stage.hpp"

#include "deformed.hpp"
#include "local_area.hpp"
#include "looks.hpp"
#include "poses.hpp"

#include <goffer/bend/bounds.hpp>
#include <goffer/measure/timer.hpp>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

namespace goffer::cli {
namespace {

constexpr glm::vec3 normal_color{0.02f, 0.10f, 0.55f};

draw::Texture drawn(const ShownTexture& texture) {
    const view::Image& image = *texture.image;
    return {image.width,
            image.height,
            image.rgba,
            wrap_as<draw::Wrap>(texture.wrap_u),
            wrap_as<draw::Wrap>(texture.wrap_v),
            texture.nearest};
}

/// Parts in the colors and with the textures that pictures have, and these textures, each once.
struct Parts {
    std::vector<draw::Part> parts;
    std::vector<draw::Texture> textures;
};

/// `colored`: the vertices have colors.
Parts parts_of(const BoundModel& model, const Textures& textures, bool colored, std::size_t index) {
    Parts out;
    std::vector<ShownTexture> known;
    for (const PartLook& look : looks_of(model.mesh, textures, colored, plain_color(index))) {
        draw::Part& part = out.parts.emplace_back();
        part.first = look.triangles.first;
        part.count = look.triangles.count;
        part.color = glm::vec3(look.color);
        if (look.material == PartLook::none) continue;
        const ShownTexture& texture = textures.of_material[look.material];
        const auto found = std::ranges::find(known, texture);
        part.texture = static_cast<std::size_t>(found - known.begin());
        if (found != known.end()) continue;
        known.push_back(texture);
        out.textures.push_back(drawn(texture));
    }
    return out;
}

/// Colors in the model's order, put into the body's.
std::vector<glm::vec3> in_body_order(const std::vector<glm::vec4>& colors, const fit::Binding& binding) {
    std::vector<glm::vec3> sorted(colors.begin(), colors.end());
    for (std::size_t i = 0; i < std::min(binding.order.size(), sorted.size()); ++i)
        sorted[i] = glm::vec3(colors[binding.order[i]]);
    return sorted;
}

std::vector<glm::vec3> own_colors(const BoundModel& model) {
    return in_body_order(vertex_colors(model.mesh, model.rest, plain_color(0)), model.binding);
}

draw::Mesh drawn_mesh(const BoundModel& model, const Textures& textures, std::size_t index) {
    const std::vector<std::uint32_t> places = model.binding.vertices_in_body();
    std::vector<std::uint32_t> triangles = model.rest.triangles;
    for (std::uint32_t& vertex : triangles) vertex = places[vertex];
    const std::vector<glm::vec4> colors = vertex_colors(model.mesh, model.rest, plain_color(index));
    const Parts parts = parts_of(model, textures, !colors.empty(), index);
    const draw::Skin skin{parts.textures,
                          parts.textures.empty() ? std::span<const glm::vec2>() : textures.uvs};
    draw::Mesh mesh(model.binding.body, triangles, parts.parts, skin);
    mesh.set_colors(in_body_order(colors, model.binding));
    return mesh;
}

std::vector<draw::Vertex> rest_vertices(const BoundModel& model) {
    std::vector<draw::Vertex> vertices(model.binding.body.vertex_count());
    bend::DeformJob job;
    const std::vector<bend::Pose> poses = model.binding.body.rest_poses();
    job.body = &model.binding.body;
    job.poses = poses;
    job.positions = interleaved<3>(&vertices.front().position.x, vertices.size(), sizeof(draw::Vertex));
    job.normals = interleaved<3>(&vertices.front().normal.x, vertices.size(), sizeof(draw::Vertex));
    bend::run(job);
    return vertices;
}

bend::Bounds empty_bounds() {
    constexpr float most = std::numeric_limits<float>::max();
    return {glm::vec3(most), glm::vec3(-most)};
}

bend::Bounds united(const bend::Bounds& one, const bend::Bounds& other) {
    return {glm::min(one.low, other.low), glm::max(one.high, other.high)};
}

/// Milliseconds of `work`, by the clock on the wall.
template <class Work>
double timed(const Work& work) {
    return 1e-6 * measure::nanoseconds_of(measure::wall_clock, work);
}

}  // namespace

Stage::Stage(std::unique_ptr<Loaded> loaded) : loaded_(std::move(loaded)), frames_(model()) {
    const BoundModel& first = model();
    for (std::size_t i = 0; i < loaded_->models.size(); ++i)
        meshes_.push_back(drawn_mesh(loaded_->models[i], loaded_->textures[i], i));
    loaded_->textures.clear();  // they are where they are drawn from
    poses_ = first.binding.body.rest_poses();
    vertices_.resize(first.binding.body.vertex_count());
    batch_.body = &first.binding.body;
    batch_.count = 1;
    batch_.poses = {.data = poses_.data(),
                    .count = 1,
                    .stride = static_cast<std::uint32_t>(poses_.size() * sizeof(bend::Pose))};
    batch_.positions = interleaved<3>(&vertices_.front().position.x, vertices_.size(), sizeof(draw::Vertex));
    batch_.normals = interleaved<3>(&vertices_.front().normal.x, vertices_.size(), sizeof(draw::Vertex));
    batch_.vertex_step = vertices_.size();
}

void Stage::set_instances(std::size_t instances) {
    crowd_.reset();
    if (instances == 0) return;
    CrowdPlan plan;
    plan.instances = std::max(instances, loaded_->models.size());
    plan.option = "--crowd";
    plan.poses = poses_of(loaded_->targets);
    plan.layout = measure::stream_layout("interleaved-positions+normals");
    crowd_ = std::make_unique<Crowd>(loaded_->models, plan);
}

std::size_t Stage::vertices() const {
    return crowd_ ? crowd_->scene().vertices() : vertices_.size();
}

std::span<const bend::Batch> Stage::batches() const {
    return crowd_ ? crowd_->job().batches : std::span<const bend::Batch>(&batch_, 1);
}

void Stage::pose(std::span<const bend::Pose> poses, std::size_t frame) {
    std::ranges::copy(poses, poses_.begin());
    if (crowd_) {
        crowd_->set_farthest(poses_);
        crowd_->set_poses(frame);
    }
    if (!crowd_) frames_.set(poses_);
}

FrameTimes Stage::deform(Deformer how, const Show& show) {
    FrameTimes times;
    const bool overlay = !crowd_ && (show.normals || show.area);
    if (how == Deformer::processor || overlay)
        times.deform =
            timed([&] { bend::run_parallel(crowd_ ? crowd_->job() : bend::CrowdJob{.batches = batches()}); });
    for (std::size_t i = 0; i < batches().size(); ++i) {
        const bend::Batch& batch = batches()[i];
        if (how == Deformer::processor) {
            times.upload += timed([&] { upload_vertices(i); });
            continue;
        }
        coefficients_.resize(batch.count * batch.body->region_count());
        times.set_up += timed([&] { bend::set_up(batch, coefficients_); });
        times.upload += timed([&] { meshes_[i].set_coefficients(coefficients_); });
    }
    normals_.clear();
    if (!crowd_ && show.normals) mark_normals();
    if (!crowd_ && show.area) {
        std::vector<glm::vec3> positions;
        positions.reserve(vertices_.size());
        for (const draw::Vertex& vertex : vertices_) positions.push_back(vertex.position);
        put_in_model_order(positions, model().binding);
        meshes_[0].set_colors(in_body_order(area_colors(model(), positions), model().binding));
    } else if (area_shown_) {
        meshes_[0].set_colors(own_colors(model()));
    }
    area_shown_ = show.area && !crowd_;
    return times;
}

void Stage::upload_vertices(std::size_t group) {
    const bend::Batch& batch = batches()[group];
    // Records of positions and normals, one behind the other: what draw::Vertex is.
    const auto* const first = reinterpret_cast<const draw::Vertex*>(batch.positions.component[0]);
    meshes_[group].set_vertices({first, batch.count * batch.vertex_step});
}

void Stage::mark_normals() {
    const auto length = static_cast<float>(0.08 * model().cylinder.radius);
    normals_.reserve(2 * vertices_.size());
    for (const draw::Vertex& vertex : vertices_) {
        normals_.push_back({vertex.position, normal_color});
        normals_.push_back({vertex.position + length * vertex.normal, normal_color});
    }
}

void Stage::mark_axes(const glm::mat4x3& frame, float size) {
    constexpr std::array<glm::vec3, 3> colors{glm::vec3{0.6f, 0, 0}, {0, 0.35f, 0}, {0, 0.05f, 0.7f}};
    for (int axis = 0; axis < 3; ++axis) {
        const glm::vec3& color = colors[static_cast<std::size_t>(axis)];
        frame_marks_.push_back({frame[3], color});
        frame_marks_.push_back({frame[3] + size * frame[axis], color});
    }
}

void Stage::draw_base(draw::Renderer& renderer) {
    if (!rig_sought_) rig_ = Rig::make(model());
    rig_sought_ = true;
    if (!rig_) return;
    rig_->set(poses_);
    renderer.draw_lines(rig_->lines());
}

void Stage::draw(draw::Renderer& renderer, const Show& show) {
    draw::Look look{.wireframe = show.wireframe, .tinted = crowd_ != nullptr, .textured = !area_shown_};
    for (std::size_t i = 0; i < batches().size(); ++i) {
        renderer.draw(meshes_[i], look);
        look.first_instance += batches()[i].count;
    }
    if (crowd_) return;
    renderer.draw_lines(normals_);
    if (show.base) draw_base(renderer);
    if (show.frames) {
        const auto radius = static_cast<float>(model().cylinder.radius);
        frame_marks_.clear();
        for (const glm::mat4x3& frame : frames_.regions()) mark_axes(frame, 1.6f * radius);
        for (const glm::mat4x3& frame : frames_.sockets()) mark_axes(frame, 0.8f * radius);
        renderer.draw_lines(frame_marks_);
    }
    if (!show.rest) return;
    if (!rest_) {
        rest_.emplace(drawn_mesh(model(), {}, 0));
        rest_->set_vertices(rest_vertices(model()));
    }
    renderer.draw(*rest_, {.opacity = 0.25f});
}

std::span<const glm::mat4x3> Stage::frames() const {
    return crowd_ ? std::span<const glm::mat4x3>() : frames_.regions();
}

void Stage::show_all(draw::OrbitCamera& camera, float aspect) const {
    bend::Bounds all = empty_bounds();
    std::vector<bend::Bounds> boxes;
    for (const bend::Batch& batch : batches()) {
        boxes.resize(batch.count);
        bend::bounds(batch, boxes);
        for (const bend::Bounds& box : boxes) all = united(all, box);
    }
    glm::vec3 toward(0.12f, 1.0f, -0.85f), up(0, 0, 1);
    if (!crowd_) {
        const Sight sight = sight_of(model().binding.body, poses_of(loaded_->targets), {});
        toward = sight.toward;
        up = sight.up;
        for (const glm::vec3& position : model().rest.positions) all = united(all, {position, position});
    }
    camera = draw::OrbitCamera(toward, up);
    camera.look_at((all.low + all.high) / 2.0f, 0.47f * glm::distance(all.low, all.high), aspect);
}

}  // namespace goffer::cli
