// SPDX-License-Identifier: MIT
#include "budget.hpp"

#include <goffer/io/error.hpp>

#include <algorithm>
#include <string>

namespace goffer::mesh {
namespace {

[[noreturn]] void refuse(const char* things, std::uint64_t limit, const char* name) {
    throw OverLimit("has more than " + std::to_string(limit) + " " + things +
                    "; use a smaller mesh, or allow more (Limits::" + name + ")");
}

/// Sums that would not fit into 64 bits are above every limit.
std::uint64_t product(std::uint64_t count, std::uint64_t each) {
    const std::uint64_t most = std::numeric_limits<std::uint64_t>::max();
    return each != 0 && count > most / each ? most : count * each;
}

bool exceeds(std::uint64_t used, std::uint64_t more, std::uint64_t limit) {
    return used > limit || more > limit - used;
}

}  // namespace

Budget::Budget(const Limits& limits) : limits_(limits) {
    limits_.vertices = std::min(limits_.vertices, most);
    limits_.triangles = std::min(limits_.triangles, most);
}

void Budget::check(std::uint64_t vertices, std::uint64_t triangles, std::uint64_t bytes) const {
    if (exceeds(vertices_, vertices, limits_.vertices)) refuse("vertices", limits_.vertices, "vertices");
    if (exceeds(triangles_, triangles, limits_.triangles))
        refuse("triangles", limits_.triangles, "triangles");
    if (exceeds(bytes_, bytes, limits_.memory))
        throw OverLimit("takes more than the " + io::size_text(limits_.memory) +
                        " of memory that are allowed; use a smaller mesh, or allow more: --max-memory of the "
                        "command, Limits::memory in a program");
}

void Budget::take(std::uint64_t bytes) {
    check(0, 0, bytes);
    bytes_ += bytes;
}

void Budget::take_vertices(std::uint64_t count, std::uint64_t bytes_each) {
    check(count, 0, product(count, bytes_each));
    vertices_ += count;
    bytes_ += product(count, bytes_each);
}

void Budget::take_faces(std::uint64_t faces, std::uint64_t corners, std::uint64_t bytes_per_corner) {
    const std::uint64_t triangles = corners - std::min(corners, 2 * faces);
    const std::uint64_t bytes = product(corners, bytes_per_corner) + product(faces, sizeof(std::uint32_t));
    check(0, std::max(triangles, faces), bytes);
    triangles_ += triangles;
    bytes_ += bytes;
}

}  // namespace goffer::mesh
