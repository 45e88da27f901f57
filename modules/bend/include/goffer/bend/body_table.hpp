// SPDX-License-Identifier: MIT
#pragma once

#include <goffer/bend/body.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

/// Bodies behind handles, for engines that load, reload and unload them while instances refer to them:
///
///     const bend::BodyHandle worm = bodies.add(std::move(file->levels[0].body));
///     bodies.replace(worm, std::move(reloaded->levels[0].body));  // between two frames
///     batch.body = bodies.find(worm);                             // null once it was removed
///
/// Optional: runs take a const Body*, wherever it comes from. "Between two frames" is while no run reads a
/// body.

namespace goffer::bend {

/// Names a body of one table. A plain value; a default-constructed one names none.
struct BodyHandle {
    std::uint32_t index = 0;
    std::uint32_t generation = 0;  ///< 0: none

    [[nodiscard]] bool operator==(const BodyHandle&) const noexcept = default;
};

/// Owns bodies. Move-only; one that was moved from is empty. Functions that are const are thread-safe, the
/// others are for one thread at a time, while no other reads. Handles of one table mean nothing in another.
class BodyTable {
public:
    BodyTable() = default;
    BodyTable(BodyTable&& other) noexcept;
    BodyTable& operator=(BodyTable&& other) noexcept;
    ~BodyTable();

    /// Takes a body, which must not be empty, and returns its handle. Bodies that are there keep their
    /// addresses. Allocates; may throw std::bad_alloc.
    [[nodiscard]] BodyHandle add(Body body);

    /// Puts `body`, which must not be empty, in the place of the one that `handle` names: the handle and the
    /// address stay, the revision goes up, and the old body is freed. Returns false, and leaves `body` as it
    /// is, if the handle names none. What was validated with the old body must be validated with the new one,
    /// which may have other vertices and regions.
    bool replace(BodyHandle handle, Body&& body);

    /// Frees the body, and makes `handle` and its copies name none, also when the place is used again.
    /// Returns false if the handle names none.
    bool remove(BodyHandle handle);

    /// The body, or null if the handle names none. The address is good until the body is removed.
    [[nodiscard]] const Body* find(BodyHandle handle) const noexcept;

    /// How many bodies have been in this place under this handle, counting from 1: what was made for the body
    /// (a vertex buffer, sockets) is out of date when this is another number. 0 if the handle names none.
    [[nodiscard]] std::uint32_t revision(BodyHandle handle) const noexcept;

    /// Number of bodies.
    [[nodiscard]] std::size_t size() const noexcept { return size_; }

private:
    struct Place {
        Body body;
        std::uint32_t generation = 1;
        std::uint32_t revision = 0;   // 0: free
        std::uint32_t next_free = 0;  // of free places
    };
    [[nodiscard]] const Place* place_of(BodyHandle handle) const noexcept;
    [[nodiscard]] Place* place_of(BodyHandle handle) noexcept;

    std::vector<Place*> places_;  // its own, which stay where they are; <memory> takes long to compile
    std::size_t size_ = 0;
    std::uint32_t first_free_ = none;
    static constexpr std::uint32_t none = ~std::uint32_t{0};
};

}  // namespace goffer::bend
