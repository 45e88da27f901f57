// SPDX-License-Identifier: MIT
#pragma once

#include <goffer/bend/pose.hpp>

#include <glm/mat4x3.hpp>

#include <cstddef>
#include <cstdint>

/// What an entity of this game has, each in a pool of its own.

namespace ecs {

/// Which creature it is, of which kind, and where its vertices lie in the vertex buffer.
struct Creature {
    std::uint32_t id = 0;  ///< never used twice
    std::uint32_t kind = 0;
    std::uint32_t first_vertex = 0;
};

struct Bend {
    goffer::bend::Pose now;
    goffer::bend::Pose drawn;  ///< when its vertices were last written: what motion vectors begin at
};

struct Place {
    glm::mat4x3 now{1};
    glm::mat4x3 drawn{1};
};

/// How much is done for it.
struct Detail {
    float wrinkle_weight = 1;
    std::uint8_t level = no_level;  ///< of the mesh that its vertices are of
    bool visible = false;
    bool moved = false;    ///< its vertices, and where they were before, were written in this frame
    bool touched = false;  ///< by the ball

    static constexpr std::uint8_t no_level = 255;
};

/// The components of one type, as an ECS keeps them: in pages of a power of two. (An array is one page.)
template <class T>
struct Pool {
    T* const* pages = nullptr;
    std::size_t page_size = 0;

    [[nodiscard]] T& operator[](std::size_t index) const noexcept {
        return pages[index / page_size][index % page_size];
    }
};

/// All components. Element i of each pool is of the same entity.
struct Pools {
    std::size_t count = 0;
    Pool<Creature> creatures;
    Pool<Bend> bends;
    Pool<Place> places;
    Pool<Detail> details;
};

/// An ECS, seen from the game.
class World {
public:
    World() = default;
    World(const World&) = delete;
    World& operator=(const World&) = delete;
    virtual ~World() = default;

    /// Good until the next entity comes or goes.
    [[nodiscard]] virtual Pools pools() = 0;
    virtual void add(const Creature& creature, const Place& place) = 0;
    /// Removes the entity at `index` of the pools; the last one takes its place.
    virtual void remove(std::size_t index) = 0;
};

}  // namespace ecs
