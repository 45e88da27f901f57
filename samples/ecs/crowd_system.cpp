// SPDX-License-Identifier: MIT
#include "crowd_system.hpp"

#include <goffer/bend/capsules.hpp>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cassert>
#include <limits>
#include <stdexcept>
#include <utility>

namespace ecs {

using namespace goffer;

namespace {

// Distances are in sizes of a creature's box: about how large it is on the screen.
constexpr float hats_until = 8;
constexpr float finest_until = 12;  // each coarser level until twice the distance
constexpr float level_margin =
    1.1f;  // what a creature at a limit has to pass it by, so that it does not flicker
constexpr float every_frame_until = 16;
constexpr float wrinkles_until = 24;
constexpr std::uint32_t far_interval = 4;  // frames from one turn of a far creature to its next one

float distance_to_segment(const glm::vec3& point, const glm::vec3& from, const glm::vec3& to) {
    const glm::vec3 along = to - from;
    const float squared = glm::dot(along, along);
    const float t = squared > 0 ? std::clamp(glm::dot(point - from, along) / squared, 0.0f, 1.0f) : 0.0f;
    return glm::distance(point, from + t * along);
}

}  // namespace

bool Camera::sees(const bend::Bounds& box) const {
    return std::ranges::all_of(planes, [&](const Plane& plane) {
        const glm::vec3 farthest = glm::mix(box.low, box.high, glm::greaterThan(plane.inward, glm::vec3(0)));
        return glm::dot(plane.inward, farthest) + plane.distance >= 0;
    });
}

CrowdSystem::CrowdSystem(std::size_t creatures, std::size_t vertices, CrowdThreads* threads)
    : creatures_(creatures), room_(vertices), threads_(threads), free_(creatures) {
    if (vertices == 0 || creatures == 0 || vertices > std::numeric_limits<std::uint32_t>::max() / creatures)
        throw std::length_error("too many vertices, or none");
    vertices_.resize(creatures * vertices);
    previous_.resize(creatures * vertices);
    for (std::size_t i = 0; i < creatures; ++i)
        free_[i] = static_cast<std::uint32_t>((creatures - 1 - i) * vertices);
    near_.reserve(creatures);
    hats_.reserve(creatures);
}

std::unique_ptr<CrowdSystem::Kind> CrowdSystem::make_kind(bend::BodyFile file) const {
    const std::size_t levels = std::min<std::size_t>(file.levels.size(), Detail::no_level);
    for (const bend::BodyFileLevel& level : file.levels) {
        if (level.body.region_count() != 1) throw std::runtime_error("this game is for bodies of one region");
        if (level.body.vertex_count() > room_) throw std::runtime_error("a body has too many vertices");
    }
    auto kind = std::make_unique<Kind>(Kind{std::move(file), std::nullopt, {}, {}, {}});
    const std::span<const bend::NamedSocket> sockets = kind->file.sockets;
    if (!sockets.empty()) kind->sockets = bend::Sockets::make(kind->file.levels[0].body, sockets.first(1));
    kind->all.reserve(creatures_);
    kind->boxes.resize(creatures_);
    kind->due.resize(levels);
    for (std::vector<std::uint32_t>& due : kind->due) due.reserve(creatures_);
    return kind;
}

std::uint32_t CrowdSystem::add_kind(bend::BodyFile file) {
    kinds_.push_back(make_kind(std::move(file)));
    batches_.reserve(kinds_.size() * bend::max_levels);
    return static_cast<std::uint32_t>(kinds_.size() - 1);
}

void CrowdSystem::replace_kind(std::uint32_t kind, bend::BodyFile file, const Pools& pools) {
    kinds_[kind] = make_kind(std::move(file));
    for (std::size_t i = 0; i < pools.count; ++i) {
        if (pools.creatures[i].kind == kind) pools.details[i].level = Detail::no_level;
    }
    list_kinds(pools);
}

void CrowdSystem::remove_kind(std::uint32_t kind) {
    kinds_[kind].reset();
}

std::uint32_t CrowdSystem::take_vertices() {
    if (free_.empty()) throw std::runtime_error("there is no room for another creature");
    const std::uint32_t first = free_.back();
    free_.pop_back();
    return first;
}

void CrowdSystem::give_back_vertices(std::uint32_t first) {
    free_.push_back(first);
}

void CrowdSystem::list_kinds(const Pools& pools) {
    for (const std::unique_ptr<Kind>& kind : kinds_) {
        if (kind) kind->all.clear();
    }
    for (std::size_t i = 0; i < pools.count; ++i)
        kinds_[pools.creatures[i].kind]->all.push_back(static_cast<std::uint32_t>(i));
}

void CrowdSystem::cull(const Pools& pools, const Camera& camera, std::uint32_t frame) {
    near_.clear();
    seen_ = 0;
    for (const std::unique_ptr<Kind>& kind : kinds_) {
        if (!kind) continue;
        for (std::vector<std::uint32_t>& due : kind->due) due.clear();
        if (kind->all.empty()) continue;
        bend::Batch batch{
            .body = &kind->file.levels[0].body, .count = kind->all.size(), .indices = kind->all};
        batch.poses = paged(pools.bends.pages, pools.bends.page_size, pools.count, &Bend::now);
        batch.transforms = paged(pools.places.pages, pools.places.page_size, pools.count, &Place::now);
        bend::bounds(batch, kind->boxes);  // from the poses alone: no vertex is touched
        for (std::size_t i = 0; i < kind->all.size(); ++i) {
            const std::uint32_t index = kind->all[i];
            const bend::Bounds& box = kind->boxes[i];
            pools.details[index].moved = pools.details[index].touched = false;
            if (!camera.sees(box)) {
                pools.details[index].visible = false;
                continue;
            }
            ++seen_;
            const float distance = glm::distance(camera.position, 0.5f * (box.low + box.high));
            choose_detail(*kind, index, distance / glm::distance(box.low, box.high), frame, pools);
        }
    }
}

void CrowdSystem::choose_detail(Kind& kind, std::uint32_t index, float distance, std::uint32_t frame,
                                const Pools& pools) {
    Detail& detail = pools.details[index];
    const std::uint8_t level = level_of(kind, distance, detail.level);
    const std::uint32_t interval = distance < every_frame_until ? 1 : far_interval;
    const bool stale = !detail.visible || detail.level != level;
    if (!detail.visible) {
        // Nobody has seen where it was.
        pools.bends[index].drawn = pools.bends[index].now;
        pools.places[index].drawn = pools.places[index].now;
    }
    detail.wrinkle_weight = std::clamp(2 - 2 * distance / wrinkles_until, 0.0f, 1.0f);
    detail.visible = true;
    if (detail.level != level) {
        detail.level = level;
        write_uvs(kind, pools.creatures[index], level);
    }
    if (stale || (frame + pools.creatures[index].id) % interval == 0) kind.due[level].push_back(index);
    if (distance < hats_until) near_.push_back(index);
}

std::uint8_t CrowdSystem::level_of(const Kind& kind, float distance, std::uint8_t now) const {
    const auto level_at = [&](float away) {
        std::size_t level = 0;
        for (float until = finest_until; away >= until && level + 1 < kind.due.size(); until *= 2) ++level;
        return static_cast<std::uint8_t>(level);
    };
    if (level_at(distance / level_margin) <= now && now <= level_at(distance * level_margin)) return now;
    return level_at(distance);
}

void CrowdSystem::write_uvs(const Kind& kind, const Creature& creature, std::size_t level) {
    const std::span<const glm::vec2> uvs = kind.file.levels[level].mesh.uvs;
    for (std::size_t i = 0; i < room_; ++i)
        vertices_[creature.first_vertex + i].uv = i < uvs.size() ? uvs[i] : glm::vec2(0);
}

bend::CrowdResult CrowdSystem::deform(const Pools& pools) {
    batches_.clear();
    for (const std::unique_ptr<Kind>& kind : kinds_) {
        for (std::size_t level = 0; kind && level < kind->due.size(); ++level) {
            const std::vector<std::uint32_t>& due = kind->due[level];
            if (due.empty()) continue;
            const std::size_t count = pools.count;
            const auto& [n, creatures, bends, places, details] = pools;
            bend::Batch batch{.body = &kind->file.levels[level].body, .count = due.size(), .indices = due};
            batch.poses = paged(bends.pages, bends.page_size, count, &Bend::now);
            batch.previous_poses = paged(bends.pages, bends.page_size, count, &Bend::drawn);
            batch.transforms = paged(places.pages, places.page_size, count, &Place::now);
            batch.previous_transforms = paged(places.pages, places.page_size, count, &Place::drawn);
            batch.wrinkle_weights = paged(details.pages, details.page_size, count, &Detail::wrinkle_weight);
            batch.vertex_offsets =
                paged(creatures.pages, creatures.page_size, count, &Creature::first_vertex);
            batch.positions = interleaved<3>(&vertices_[0].position.x, vertices_.size(), sizeof(Vertex));
            batch.normals = interleaved<3>(&vertices_[0].normal.x, vertices_.size(), sizeof(Vertex));
            batch.previous_positions = interleaved<3>(&previous_[0].x, previous_.size());
            batches_.push_back(batch);
        }
    }
    const bend::CrowdJob crowd{.batches = batches_};
    assert(bend::validate(crowd).none());
    const bend::CrowdResult result = threads_ != nullptr ? threads_->run(crowd) : bend::run_parallel(crowd);
    deformed_vertices_ = 0;
    for (const bend::Batch& batch : batches_) {
        deformed_vertices_ += batch.count * batch.body->vertex_count();
        for (const std::uint32_t index : batch.indices) {
            pools.bends[index].drawn = pools.bends[index].now;
            pools.places[index].drawn = pools.places[index].now;
            pools.details[index].moved = true;
        }
    }
    return result;
}

bend::DeformJob CrowdSystem::job_of(const Pools& pools, std::uint32_t index) const {
    bend::DeformJob job{.body = &kinds_[pools.creatures[index].kind]->file.levels[0].body};
    job.pose = pools.bends[index].now;
    job.transform = pools.places[index].now;
    job.wrinkle_weight = pools.details[index].wrinkle_weight;
    return job;
}

void CrowdSystem::attach_hats(const Pools& pools) {
    hats_.clear();
    for (const std::uint32_t index : near_) {
        const std::optional<bend::Sockets>& sockets = kinds_[pools.creatures[index].kind]->sockets;
        if (!sockets) continue;
        sockets->frames(job_of(pools, index), {&hats_.emplace_back(), 1});
    }
}

void CrowdSystem::touch(const Pools& pools, const Ball& ball) {
    std::array<bend::Capsule, 4> capsules;
    for (const std::uint32_t index : near_) {
        bend::capsules(job_of(pools, index), capsules.size(), capsules);
        pools.details[index].touched = std::ranges::any_of(capsules, [&](const bend::Capsule& capsule) {
            return distance_to_segment(ball.center, capsule.from, capsule.to) < ball.radius + capsule.radius;
        });
    }
}

}  // namespace ecs
