// SPDX-License-Identifier: MIT
#include "places.hpp"

#include <array>
#include <bit>
#include <unordered_map>

namespace goffer::fit {
namespace {

using Place = std::array<std::uint32_t, 3>;

struct PlaceHash {
    std::size_t operator()(const Place& p) const {
        std::uint64_t h = 0;
        for (const std::uint32_t bits : p) h = (h ^ bits) * 0x9e3779b97f4a7c15u;
        return h ^ (h >> 32);
    }
};

}  // namespace

std::vector<std::uint32_t> places(std::span<const glm::vec3> positions) {
    std::unordered_map<Place, std::uint32_t, PlaceHash> seen;
    seen.reserve(positions.size());
    std::vector<std::uint32_t> place;
    place.reserve(positions.size());
    for (const glm::vec3& p : positions) {
        const glm::vec3 q = p + 0.0f;  // -0 and 0 are one place
        const Place key{std::bit_cast<std::uint32_t>(q.x), std::bit_cast<std::uint32_t>(q.y),
                        std::bit_cast<std::uint32_t>(q.z)};
        place.push_back(seen.try_emplace(key, static_cast<std::uint32_t>(seen.size())).first->second);
    }
    return place;
}

}  // namespace goffer::fit
