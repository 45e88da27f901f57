// SPDX-License-Identifier: MIT
#include "gltf.hpp"

#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <cmath>

namespace goffer::mesh::gltf {
namespace {

double largest(const glm::dmat4& m, int first, int last) {
    double most = 0;
    for (int c = first; c < last; ++c)
        for (int r = 0; r < 3; ++r) most = std::max(most, std::abs(m[c][r]));
    return most;
}

/// Whether two matrices place vertices alike. Exporters invert the matrices of joints in float, and what they
/// are multiplied with cancels: `reach` is how large coordinates are on the way.
bool alike(const glm::dmat4& a, const glm::dmat4& b, double reach) {
    constexpr double close = 1e-5;
    const glm::dmat4 off = a - b;
    return largest(off, 0, 3) <= close * largest(a, 0, 3) && largest(off, 3, 4) <= close * reach;
}

bool finite(const glm::dmat4& m) {
    for (int c = 0; c < 4; ++c)
        for (int r = 0; r < 4; ++r)
            if (!std::isfinite(m[c][r])) return false;
    return true;
}

/// The inverse bind matrices of a skin's joints, 16 numbers each; none where all are the identity.
std::vector<float> inverse_binds(const Document& document, const Value& skin) {
    if (!skin.has("inverseBindMatrices")) return {};
    const Value reference = skin["inverseBindMatrices"];
    std::vector<float> inverse = read_floats(document, reference, 16);
    if (inverse.size() / 16 < skin["joints"].size())
        reference.fail("has " + std::to_string(inverse.size() / 16) + " elements for " +
                       std::to_string(skin["joints"].size()) + " joints; export the file again");
    if (!std::ranges::all_of(inverse, [](float value) { return std::isfinite(value); }))
        reference.fail("has a number that is not finite; export the file again");
    return inverse;
}

}  // namespace

SkinPlace place_of_skin(const Document& document, const Value& skin,
                        const std::map<std::size_t, glm::dmat4>& worlds) {
    const Value joints = skin["joints"];
    const std::vector<float> inverse = inverse_binds(document, skin);
    std::optional<glm::dmat4> first;
    bool as_bound = true;
    double reach = 1e-30;
    for (std::size_t i = 0; i < joints.size(); ++i) {
        const auto world = worlds.find(document.number("nodes", joints[i]));
        if (world == worlds.end()) continue;
        glm::dmat4 place = world->second;
        if (!inverse.empty()) {
            reach = std::max(reach, largest(place, 3, 4));
            place = place * affine(glm::dmat4(glm::make_mat4(&inverse[16 * i])));
        }
        if (!finite(place)) {
            as_bound = false;
            continue;
        }
        reach = std::max(reach, largest(place, 3, 4));
        if (!first) first = place;
        as_bound = as_bound && alike(*first, place, reach);
    }
    const glm::dmat4 identity(1.0);
    if (!first || alike(identity, *first, reach)) return {identity, as_bound};
    return {*first, as_bound};
}

}  // namespace goffer::mesh::gltf
