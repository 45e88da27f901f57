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

/// Whether two matrices place vertices alike, as far as floats of the size `reach` tell.
bool alike(const glm::dmat4& a, const glm::dmat4& b, double reach) {
    constexpr double close = 1e-4;
    const glm::dmat4 off = a - b;
    return largest(off, 0, 3) <= close * largest(a, 0, 3) && largest(off, 3, 4) <= close * reach;
}

bool finite(const glm::dmat4& m) {
    for (int c = 0; c < 4; ++c)
        for (int r = 0; r < 4; ++r)
            if (!std::isfinite(m[c][r])) return false;
    return true;
}

}  // namespace

SkinPlace place_of_skin(const Document& document, const Value& skin,
                        const std::map<std::size_t, glm::dmat4>& worlds) {
    const Value joints = skin["joints"];
    std::vector<float> inverse;
    if (skin.has("inverseBindMatrices")) {
        inverse = read_floats(document, skin["inverseBindMatrices"], 16);
        inverse.resize(16 * joints.size());
    }
    SkinPlace first;
    double reach = 1e-30;  // of coordinates that cancel in the products
    for (std::size_t i = 0; i < joints.size(); ++i) {
        const auto world = worlds.find(document.number("nodes", joints[i]));
        glm::dmat4 place = world != worlds.end() ? world->second : glm::dmat4(1.0);
        if (!inverse.empty()) {
            glm::dmat4 bind(glm::make_mat4(&inverse[16 * i]));
            for (int c = 0; c < 4; ++c) bind[c][3] = c == 3 ? 1.0 : 0.0;
            reach = std::max(reach, largest(place, 3, 4));
            place = place * bind;
        }
        if (!finite(place)) return {};
        if (i == 0) first.matrix = place;
        reach = std::max(reach, largest(place, 3, 4));
        first.as_bound = first.as_bound && alike(first.matrix, place, reach);
    }
    const glm::dmat4 identity(1.0);
    if (alike(identity, first.matrix, reach)) first.matrix = identity;
    return first;
}

}  // namespace goffer::mesh::gltf
