// SPDX-License-Identifier: MIT
#include "support/bodies.hpp"

#include <goffer/bend/body_table.hpp>

#include <doctest/doctest.h>

#include <cstddef>
#include <utility>
#include <vector>

/// Handles name the body that they were given for, or none.

namespace goffer::test {
namespace {

bend::Body body_of_vertices(Random& random, std::size_t vertices) {
    const LooseVertices loose(random, vertices, 0.1);
    bend::RegionInput region;
    region.length = 1;
    region.max_angle = 3;
    region.vertex_count = vertices;
    return loose.body({&region, 1});
}

}  // namespace

TEST_CASE("body table: a handle names its body until that is removed") {
    Random random(81);
    bend::BodyTable table;
    CHECK(table.find({}) == nullptr);
    CHECK(table.find({7, 1}) == nullptr);
    const bend::BodyHandle worm = table.add(body_of_vertices(random, 3)),
                           fish = table.add(body_of_vertices(random, 4));
    const bend::Body* const address = table.find(worm);
    REQUIRE(address != nullptr);
    CHECK(address->vertex_count() == 3);
    CHECK(table.find(fish)->vertex_count() == 4);
    CHECK(table.revision(worm) == 1);

    bend::Body reloaded = body_of_vertices(random, 5);
    CHECK(table.replace(worm, std::move(reloaded)));
    CHECK(table.find(worm) == address);
    CHECK(address->vertex_count() == 5);
    CHECK(table.revision(worm) == 2);
    CHECK(table.revision(fish) == 1);

    CHECK(table.remove(worm));
    CHECK(table.find(worm) == nullptr);
    CHECK(table.revision(worm) == 0);
    CHECK(!table.remove(worm));
    bend::Body left = body_of_vertices(random, 6);
    CHECK(!table.replace(worm, std::move(left)));
    CHECK(left.vertex_count() == 6);
    CHECK(table.size() == 1);

    const bend::BodyHandle next = table.add(std::move(left));
    CHECK(next.index == worm.index);
    CHECK(next != worm);
    CHECK(table.find(worm) == nullptr);
    CHECK(table.find(next)->vertex_count() == 6);
    CHECK(table.find(fish)->vertex_count() == 4);

    CHECK(table.remove(next));
    bend::BodyTable moved = std::move(table);
    CHECK(moved.find(fish)->vertex_count() == 4);
    CHECK(table.size() == 0);
    CHECK(table.find(fish) == nullptr);
    const bend::BodyHandle again = table.add(body_of_vertices(random, 7));
    CHECK(table.find(again)->vertex_count() == 7);
    table = std::move(moved);
    CHECK(table.find(fish)->vertex_count() == 4);
}

TEST_CASE("body table: like a map of numbers that are never used twice, whatever comes and goes") {
    Random random(82);
    bend::BodyTable table;
    std::vector<std::pair<bend::BodyHandle, std::size_t>> alive;  // with its number of vertices
    std::vector<bend::BodyHandle> gone;
    for (int step = 0; step < 600; ++step) {
        const std::size_t vertices = 1 + random() % 9, kind = random() % 4;
        if (alive.empty() || kind <= 1) {
            alive.emplace_back(table.add(body_of_vertices(random, vertices)), vertices);
        } else {
            const std::size_t which = random() % alive.size();
            const bend::BodyHandle handle = alive[which].first;
            if (kind == 2) {
                CHECK(table.replace(handle, body_of_vertices(random, vertices)));
                alive[which].second = vertices;
            } else {
                CHECK(table.remove(handle));
                gone.push_back(handle);
                alive.erase(alive.begin() + static_cast<std::ptrdiff_t>(which));
            }
        }
        CHECK(table.size() == alive.size());
        bool right = true;
        for (const auto& [handle, count] : alive)
            right = right && table.find(handle) != nullptr && table.find(handle)->vertex_count() == count;
        for (const bend::BodyHandle handle : gone) right = right && table.find(handle) == nullptr;
        CHECK(right);
    }
    CHECK(gone.size() > 50);
}

}  // namespace goffer::test
