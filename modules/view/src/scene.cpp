// SPDX-License-Identifier: MIT
#include "scene.hpp"

#include "texture.hpp"

#include <glm/geometric.hpp>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace goffer::view {
namespace {

constexpr float clearance = 2e-5f;  // between a surface and the rays that leave it; the scene is 2 long

/// What Embree reports, in words.
std::string words_of(RTCError error) {
    if (error == RTC_ERROR_OUT_OF_MEMORY)
        return "there is not enough memory; free some, or use a smaller mesh";
    return "Embree error " + std::to_string(error);
}

bool finite(const glm::vec3& p) {
    return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
}

void check_sizes(const Model& model, const std::string& name) {
    const auto vertices = std::to_string(model.positions.size());
    if (model.triangles.size() % 3 != 0)
        throw Error(name + ": " + std::to_string(model.triangles.size()) +
                    " indices are not a multiple of 3; give three per triangle");
    if (!model.normals.empty() && model.normals.size() != model.positions.size())
        throw Error(name + ": " + std::to_string(model.normals.size()) + " normals for " + vertices +
                    " vertices; give one each or none");
    if (!model.colors.empty() && model.colors.size() != model.positions.size())
        throw Error(name + ": " + std::to_string(model.colors.size()) + " colors for " + vertices +
                    " vertices; give one each or none");
    if (model.texture.image && model.uvs.size() != model.triangles.size())
        throw Error(name + ": " + std::to_string(model.uvs.size()) + " texture coordinates for " +
                    std::to_string(model.triangles.size()) + " corners; give one each");
}

void check(const Model& model, std::size_t index) {
    const std::string name = "model " + std::to_string(index);
    check_sizes(model, name);
    for (const std::uint32_t vertex : model.triangles) {
        if (vertex >= model.positions.size())
            throw Error(name + ": a triangle uses vertex " + std::to_string(vertex) + ", but there are " +
                        std::to_string(model.positions.size()) + "; correct the index or add the vertex");
        if (!finite(model.positions[vertex]))
            throw Error(name + ": vertex " + std::to_string(vertex) + " is not finite; correct or remove it");
    }
}

struct Bounds {
    glm::dvec3 low{std::numeric_limits<double>::infinity()};
    glm::dvec3 high{-std::numeric_limits<double>::infinity()};
};

Bounds bounds(std::span<const Model> models) {
    Bounds b;
    for (const Model& model : models)
        for (const std::uint32_t vertex : model.triangles) {
            b.low = glm::min(b.low, glm::dvec3(model.positions[vertex]));
            b.high = glm::max(b.high, glm::dvec3(model.positions[vertex]));
        }
    return b;
}

bool translucent(const Model& model) {
    const auto below_one = [&](const glm::vec4& color) { return color.a * model.color.a < 1; };
    return model.color.a < 1 || std::ranges::any_of(model.colors, below_one);
}

RTCRay to_embree(const Ray& ray) {
    RTCRay r{};
    r.org_x = ray.origin.x, r.org_y = ray.origin.y, r.org_z = ray.origin.z;
    r.dir_x = ray.direction.x, r.dir_y = ray.direction.y, r.dir_z = ray.direction.z;
    r.tfar = ray.length;
    r.mask = ~0u;
    return r;
}

EmbreeScene empty_scene(RTCDevice device) {
    EmbreeScene scene(rtcNewScene(device));
    rtcSetSceneFlags(scene.get(), RTC_SCENE_FLAG_ROBUST);
    return scene;
}

template <class T>
T* new_buffer(RTCGeometry geometry, RTCBufferType type, RTCFormat format, std::size_t count) {
    void* memory = rtcSetNewGeometryBuffer(geometry, type, 0, format, sizeof(T), count);
    if (memory == nullptr)
        throw Error("there is not enough memory for a mesh of " + std::to_string(count) +
                    " vertices or triangles; give a smaller one");
    return static_cast<T*>(memory);
}

// Which of two surfaces in the same place is hit depends on the order in the tree, and Embree does not
// promise the same tree for every number of threads. So one thread builds it, which is fast enough.
void commit(RTCScene scene) {
    tbb::task_arena(1).execute([scene] { rtcJoinCommitScene(scene); });
}

glm::vec3 unit_or(const glm::vec3& v, const glm::vec3& otherwise) {
    const float length = glm::length(v);
    return length > 0 && std::isfinite(length) ? v / length : otherwise;
}

/// Where a ray meets the plane of a triangle, as the weights of its edges. Not finite where it does not.
glm::vec2 on_plane(const Ray& ray, const glm::vec3& direction, const glm::vec3& corner,
                   const glm::vec3& edge1, const glm::vec3& edge2) {
    const glm::vec3 normal = glm::cross(edge1, edge2), to_eye = ray.origin - corner;
    const glm::vec3 place = to_eye - glm::dot(normal, to_eye) / glm::dot(normal, direction) * direction;
    return glm::vec2(glm::dot(normal, glm::cross(place, edge2)), glm::dot(normal, glm::cross(edge1, place))) /
           glm::dot(normal, normal);
}

/// What the pixel that the ray belongs to covers: as far as its neighbors' rays are apart on the same plane.
Footprint footprint(const Model& model, const Hit& hit, const Ray& ray, const glm::vec3& corner,
                    const glm::vec3& edge1, const glm::vec3& edge2) {
    const auto uvs = model.uvs.subspan(std::size_t{3} * hit.triangle, 3);
    const glm::vec2 along1 = uvs[1] - uvs[0], along2 = uvs[2] - uvs[0];
    const glm::vec2 here(hit.u, hit.v);
    const auto change = [&](const glm::vec3& step) {
        const glm::vec2 there = on_plane(ray, ray.direction + step, corner, edge1, edge2) - here;
        return there.x * along1 + there.y * along2;
    };
    return {uvs[0] + here.x * along1 + here.y * along2, change(ray.right), change(ray.up)};
}

}  // namespace

Scene::Scene(std::span<const Model> models, std::span<const glm::vec3> also) {
    for (std::size_t i = 0; i < models.size(); ++i) check(models[i], i);
    auto [low, high] = bounds(models);
    if (!(low.x <= high.x))
        throw Error("nothing to see: the models have no triangles; give one that has some");
    for (const glm::vec3& point : also) {
        if (!finite(point)) throw Error("a point that is to be seen too is not finite; leave it out");
        low = glm::min(low, glm::dvec3(point));
        high = glm::max(high, glm::dvec3(point));
    }
    const glm::dvec3 size = high - low;
    const double extent = std::max({size.x, size.y, size.z});
    if (!(extent > 0))
        throw Error("nothing to see: all vertices are in one point; give a mesh with an extent");

    device_.reset(rtcNewDevice(nullptr));
    if (!device_) throw Error("the renderer does not start: " + words_of(rtcGetDeviceError(nullptr)));
    solids_ = empty_scene(device_.get());
    for (const Model& model : models) bodies_.push_back({model, nullptr});
    for (std::size_t i = 0; i < models.size(); ++i) {
        if (translucent(models[i])) ghosts_.push_back(empty_scene(device_.get()));
        const RTCScene scene = translucent(models[i]) ? ghosts_.back().get() : solids_.get();
        bodies_[i].points = add(scene, i, 0.5 * (low + high), 2 / extent);
    }
    for (const glm::vec3& point : also)
        points_.emplace_back((glm::dvec3(point) - 0.5 * (low + high)) * (2 / extent));
    commit(solids_.get());
    for (const EmbreeScene& ghost : ghosts_) commit(ghost.get());
    if (const RTCError error = rtcGetDeviceError(device_.get()); error != RTC_ERROR_NONE)
        throw Error("the models cannot be prepared for rendering: " + words_of(error));
}

const glm::vec3* Scene::add(RTCScene scene, std::size_t index, const glm::dvec3& center, double scale) {
    const Model& model = bodies_[index].model;
    if (model.triangles.empty()) return nullptr;
    const RTCGeometry geometry = rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_TRIANGLE);
    rtcAttachGeometryByID(scene, geometry, static_cast<unsigned>(index));
    rtcReleaseGeometry(geometry);  // the scene keeps it

    auto* points =
        new_buffer<glm::vec3>(geometry, RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT3, model.positions.size());
    std::ranges::transform(model.positions, points,
                           [&](const glm::vec3& p) { return glm::vec3((glm::dvec3(p) - center) * scale); });
    auto* indices =
        new_buffer<glm::uvec3>(geometry, RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT3, model.triangles.size() / 3);
    std::ranges::copy(model.triangles, &indices->x);
    rtcCommitGeometry(geometry);

    for (const std::uint32_t vertex : model.triangles) points_.push_back(points[vertex]);
    return points;
}

std::optional<Hit> Scene::nearest(RTCScene scene, const Ray& ray) {
    RTCRayHit query{};
    query.ray = to_embree(ray);
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    embree_intersect(scene, query);
    if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
    return Hit{query.hit.geomID, query.hit.primID, query.hit.u, query.hit.v, query.ray.tfar};
}

bool Scene::occluded(const Ray& ray) const {
    RTCRay query = to_embree(ray);
    embree_occluded(solids_.get(), query);
    return query.tfar < 0;
}

void Scene::ghosts(const Ray& ray, std::vector<Hit>& hits) const {
    hits.clear();
    for (const EmbreeScene& ghost : ghosts_)
        if (const auto hit = nearest(ghost.get(), ray)) hits.push_back(*hit);
    std::ranges::stable_sort(hits, std::ranges::greater{}, &Hit::distance);
}

Surface Scene::surface(const Hit& hit, const Ray& ray) const {
    const auto& [model, points] = bodies_[hit.model];
    const auto corners = model.triangles.subspan(std::size_t{3} * hit.triangle, 3);
    const float weights[3] = {1 - hit.u - hit.v, hit.u, hit.v};
    Surface s{glm::vec3(0), glm::vec3(0), glm::vec3(0), glm::vec3(0), model.color};

    for (int i = 0; i < 3; ++i) s.position += weights[i] * points[corners[i]];
    const glm::vec3 edge1 = points[corners[1]] - points[corners[0]];
    const glm::vec3 edge2 = points[corners[2]] - points[corners[0]];
    s.face = unit_or(glm::cross(edge1, edge2), -ray.direction);
    if (glm::dot(s.face, ray.direction) > 0) s.face = -s.face;

    if (!model.colors.empty()) {
        glm::vec4 color(0);
        for (int i = 0; i < 3; ++i) color += weights[i] * model.colors[corners[i]];
        s.color *= color;
    }
    if (model.texture.image) {
        const Footprint over = footprint(model, hit, ray, points[corners[0]], edge1, edge2);
        s.color *= glm::vec4(texture_color(model.texture, over), 1);
        s.uv = over.uv;
        s.uv_step = std::max(glm::length(over.across), glm::length(over.up));
    }
    s.normal = s.face;
    s.outside = s.position;
    if (!model.normals.empty()) {
        glm::vec3 mean(0);
        for (int i = 0; i < 3; ++i) mean += weights[i] * model.normals[corners[i]];
        s.normal = unit_or(mean, s.face);
        const float side = glm::dot(s.normal, s.face) < 0 ? -1.0f : 1.0f;
        s.normal *= side;
        // Shadow rays start on the curved surface that the normals stand for (Hanika 2021). Otherwise coarse
        // triangles would show where light grazes them.
        for (int i = 0; i < 3; ++i) {
            const glm::vec3 n = side * unit_or(model.normals[corners[i]], side * s.face);
            s.outside += weights[i] * std::max(0.0f, -glm::dot(s.position - points[corners[i]], n)) * n;
        }
    }
    s.outside += clearance * s.face;
    return s;
}

}  // namespace goffer::view
