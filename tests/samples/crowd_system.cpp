// SPDX-License-Identifier: MIT
#include <goffer/bend/body_file.hpp>
#include <goffer/bend/body_input.hpp>

#include <crowd_system.hpp>
#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include <array>
#include <stdexcept>
#include <vector>

/// What the game of samples/ecs does for two creatures, step by step.

namespace goffer::test {
namespace {

/// A worm of 2 levels along z, of length 4. A level has four vertices; the fine one has texture coordinates.
bend::BodyFile worm(bool with_uvs = true) {
    const std::vector<bend::RestVertex> vertices{
        {.z = 0, .rho = 1}, {.z = 1, .rho = 1}, {.z = 3, .rho = 1}, {.z = 4}};
    const std::vector<bend::RestVector> normals(4, {.rho = 1});
    const bend::RegionInput whole{.length = 4, .max_angle = 2, .vertex_count = vertices.size()};
    bend::BodyInput input;
    input.radius = 1;
    input.regions = {&whole, 1};
    input.vertices = vertices;
    input.normals = normals;
    const bend::Body fine = bend::Body::make(input).value(), coarse = bend::Body::make(input).value();
    const std::vector<std::uint32_t> triangles{0, 1, 2, 1, 2, 3};
    const std::vector<glm::vec2> uvs{{1, 2}, {3, 4}, {5, 6}, {7, 8}};
    std::array<bend::LevelInput, 2> levels{bend::LevelInput{&fine}, bend::LevelInput{&coarse}};
    levels[0].mesh.triangles = triangles;
    if (with_uvs) levels[0].mesh.uvs = uvs;
    return bend::load_copy(bend::save({levels, {}, {}, {}})).value();
}

/// A few creatures in plain arrays, before a camera that sees all with x >= 0.
class Scene {
public:
    explicit Scene(std::size_t count) : creatures_(count), bends_(count), places_(count), details_(count) {
        kind = crowd.add_kind(worm());
        for (std::size_t i = 0; i < count; ++i) {
            creatures_[i] = {static_cast<std::uint32_t>(i), kind, crowd.take_vertices()};
            places_[i].now[3] = {10, 0, 5 * i};
        }
        crowd.list_kinds(pools());
    }

    [[nodiscard]] ecs::Pools pools() {
        pages_ = {creatures_.data(), bends_.data(), places_.data(), details_.data()};
        return {creatures_.size(),
                {&pages_.creatures, 64},
                {&pages_.bends, 64},
                {&pages_.places, 64},
                {&pages_.details, 64}};
    }
    bend::CrowdResult draw() {
        const std::array<ecs::Camera::Plane, 1> planes{ecs::Camera::Plane{{1, 0, 0}, 0}};
        crowd.cull(pools(), {{0, 0, 0}, planes}, frame_++);
        return crowd.deform(pools());
    }
    /// How far the first vertex of creature `i` has gone, for motion vectors.
    [[nodiscard]] float motion(std::size_t i) const {
        if (!details_[i].moved) return 0;
        const std::uint32_t vertex = creatures_[i].first_vertex;
        return glm::distance(crowd.vertices()[vertex].position, crowd.previous_positions()[vertex]);
    }
    [[nodiscard]] glm::vec3& place(std::size_t i) { return places_[i].now[3]; }
    [[nodiscard]] const ecs::Detail& detail(std::size_t i) const { return details_[i]; }
    [[nodiscard]] const ecs::Vertex& vertex(std::size_t i) const {
        return crowd.vertices()[creatures_[i].first_vertex];
    }

    ecs::CrowdSystem crowd{3, 4, nullptr};
    std::uint32_t kind = 0;

private:
    struct Pages {
        ecs::Creature* creatures = nullptr;
        ecs::Bend* bends = nullptr;
        ecs::Place* places = nullptr;
        ecs::Detail* details = nullptr;
    };
    std::vector<ecs::Creature> creatures_;
    std::vector<ecs::Bend> bends_;
    std::vector<ecs::Place> places_;
    std::vector<ecs::Detail> details_;
    Pages pages_;
    std::uint32_t frame_ = 0;
};

}  // namespace

TEST_CASE("crowd system: motion is that of the last frame, and none of what was not seen") {
    Scene scene(2);
    CHECK(scene.draw().deformed == 2);
    CHECK(scene.motion(0) == 0);  // it has only come
    scene.place(0).x += 1;
    scene.draw();
    CHECK(scene.motion(0) == 1);
    CHECK(scene.motion(1) == 0);
    scene.place(0).x = -50;  // out of view, ..
    CHECK(scene.draw().deformed == 1);
    CHECK(!scene.detail(0).moved);
    scene.place(0) = {20, 7, 0};  // .. and back, elsewhere
    CHECK(scene.draw().deformed == 2);
    CHECK(scene.motion(0) == 0);
    CHECK(scene.vertex(0).position.y == 7);
}

TEST_CASE("crowd system: far creatures take turns, and their levels do not flicker") {
    Scene scene(1);
    scene.place(0).x = 1000;
    std::size_t deformed = scene.draw().deformed;
    CHECK(deformed == 1);  // it has only come
    CHECK(scene.detail(0).level == 1);
    CHECK(scene.detail(0).wrinkle_weight == 0);
    for (int frame = 0; frame < 8; ++frame) deformed += scene.draw().deformed;
    CHECK(deformed == 3);

    // The limit between both levels, from either side.
    float near = 0, far = 1000;
    while (far - near > 0.01f) {
        Scene fresh(1);
        fresh.place(0).x = 0.5f * (near + far);
        fresh.draw();
        (fresh.detail(0).level == 0 ? near : far) = fresh.place(0).x;
    }
    scene.place(0).x = 0.97f * near;
    scene.draw();
    CHECK(scene.detail(0).level == 1);
    scene.place(0).x = 0.8f * near;
    scene.draw();
    CHECK(scene.detail(0).level == 0);
    scene.place(0).x = 1.03f * near;
    scene.draw();
    CHECK(scene.detail(0).level == 0);
}

TEST_CASE("crowd system: texture coordinates are those of the level, or none") {
    Scene scene(1);
    scene.draw();
    CHECK(scene.vertex(0).uv == glm::vec2(1, 2));
    scene.crowd.replace_kind(scene.kind, worm(false), scene.pools());
    scene.draw();
    CHECK(scene.vertex(0).uv == glm::vec2(0, 0));
}

TEST_CASE("crowd system: who is out of the ball's reach is not touched") {
    Scene scene(1);
    scene.draw();
    scene.crowd.touch(scene.pools(), {{10, 0, 2}, 1});
    CHECK(scene.detail(0).touched);
    scene.draw();
    scene.crowd.touch(scene.pools(), {{10, 0, 200}, 1});
    CHECK(!scene.detail(0).touched);
    scene.draw();
    scene.crowd.touch(scene.pools(), {{10, 0, 2}, 1});
    scene.place(0).x = 1000;
    scene.draw();
    scene.crowd.touch(scene.pools(), {{10, 0, 2}, 1});
    CHECK(!scene.detail(0).touched);
}

TEST_CASE("crowd system: no creature, and no room") {
    Scene nobody(0);
    CHECK(nobody.draw().deformed == 0);
    CHECK_THROWS_AS(ecs::CrowdSystem(100'000, 50'000, nullptr), std::length_error);
    CHECK_THROWS_AS(ecs::CrowdSystem(0, 1, nullptr), std::length_error);
    Scene full(3);
    CHECK_THROWS_AS((void)full.crowd.take_vertices(), std::runtime_error);
    ecs::CrowdSystem small(1, 3, nullptr);
    CHECK_THROWS_AS((void)small.add_kind(worm()), std::runtime_error);
}

}  // namespace goffer::test
