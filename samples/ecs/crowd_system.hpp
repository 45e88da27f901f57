// SPDX-License-Identifier: MIT
#pragma once

#include "components.hpp"
#include "crowd_threads.hpp"

#include <goffer/bend/body_file.hpp>
#include <goffer/bend/bounds.hpp>
#include <goffer/bend/crowd.hpp>
#include <goffer/bend/sockets.hpp>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

/// The system that draws creatures: culls them, chooses their detail, deforms those that need it, and puts
/// hats on the near ones.

namespace ecs {

/// A vertex of 32 bytes, as a GPU gets it. goffer writes positions and normals, the game texture coordinates.
struct Vertex {
    glm::vec3 position{0};
    glm::vec3 normal{0};
    glm::vec2 uv{0};
};
static_assert(sizeof(Vertex) == 32);

/// Sees what is on the inner side of its planes.
struct Camera {
    struct Plane {
        glm::vec3 inward;
        float distance;  ///< of the origin, on the inner side
    };
    glm::vec3 position{0};
    std::span<const Plane> planes;

    [[nodiscard]] bool sees(const goffer::bend::Bounds& box) const;
};

struct Ball {
    glm::vec3 center{0};
    float radius = 0;
};

class CrowdSystem {
public:
    /// Room for `creatures` of up to `vertices` each, both at least 1. Deforms with `threads`, or with oneTBB
    /// where it is null. Throws std::length_error if there are too many vertices in all for 32 bits.
    CrowdSystem(std::size_t creatures, std::size_t vertices, CrowdThreads* threads);

    /// Takes a kind of creature. Throws std::runtime_error if its bodies have several regions, or more
    /// vertices than there is room for.
    [[nodiscard]] std::uint32_t add_kind(goffer::bend::BodyFile file);
    /// Puts a newer file in the place of a kind's, between two frames. Throws as add_kind().
    void replace_kind(std::uint32_t kind, goffer::bend::BodyFile file, const Pools& pools);
    /// No creature of this kind may be left.
    void remove_kind(std::uint32_t kind);

    /// First vertex of a free range of the vertex buffer, and giving it back.
    [[nodiscard]] std::uint32_t take_vertices();
    void give_back_vertices(std::uint32_t first);
    /// To be called when creatures have come or gone.
    void list_kinds(const Pools& pools);

    // A frame, in this order. Nothing allocates.
    void cull(const Pools& pools, const Camera& camera, std::uint32_t frame);
    goffer::bend::CrowdResult deform(const Pools& pools);
    void attach_hats(const Pools& pools);
    void touch(const Pools& pools, const Ball& ball);

    [[nodiscard]] std::span<const Vertex> vertices() const { return vertices_; }
    /// Where each vertex was when it was written before. A shader that makes motion vectors must assume that
    /// a creature did not move in this frame unless its Detail::moved is set: it was not deformed.
    [[nodiscard]] std::span<const glm::vec3> previous_positions() const { return previous_; }
    [[nodiscard]] std::span<const goffer::bend::SocketFrame> hats() const { return hats_; }
    [[nodiscard]] std::size_t seen() const { return seen_; }
    /// Vertices that the last deform() has written.
    [[nodiscard]] std::size_t deformed_vertices() const { return deformed_vertices_; }

private:
    struct Kind {
        goffer::bend::BodyFile file;
        std::optional<goffer::bend::Sockets> sockets;
        std::vector<std::uint32_t> all;               // indices into the pools
        std::vector<goffer::bend::Bounds> boxes;      // of these
        std::vector<std::vector<std::uint32_t>> due;  // of these, those to be deformed, by level
    };

    [[nodiscard]] std::unique_ptr<Kind> make_kind(goffer::bend::BodyFile file) const;
    void choose_detail(Kind& kind, std::uint32_t index, float distance, std::uint32_t frame,
                       const Pools& pools);
    [[nodiscard]] std::uint8_t level_of(const Kind& kind, float distance, std::uint8_t now) const;
    void write_uvs(const Kind& kind, const Creature& creature, std::size_t level);
    [[nodiscard]] goffer::bend::DeformJob job_of(const Pools& pools, std::uint32_t index) const;

    std::size_t creatures_;
    std::size_t room_;  // vertices of a creature
    CrowdThreads* threads_;
    std::vector<std::unique_ptr<Kind>> kinds_;  // null: removed
    std::vector<Vertex> vertices_;
    std::vector<glm::vec3> previous_;
    std::vector<std::uint32_t> free_;  // first vertices
    std::vector<goffer::bend::Batch> batches_;
    std::vector<std::uint32_t> near_;  // indices of creatures with hats and collisions
    std::vector<goffer::bend::SocketFrame> hats_;
    std::size_t seen_ = 0, deformed_vertices_ = 0;
};

}  // namespace ecs
