// SPDX-License-Identifier: MIT
#include "bent_tube.hpp"

#include "rest.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

namespace goffer::fit {
namespace {

using Corners = std::array<std::uint32_t, 3>;

double area_of(const std::vector<glm::dvec3>& places, const Corners& t) {
    return glm::length(glm::cross(places[t[1]] - places[t[0]], places[t[2]] - places[t[0]])) / 2;
}

/// A body in model space: as it is, and turned about its center line by quarter turns.
class TurnedBody {
public:
    TurnedBody(const Body& body, const Cylinder& cylinder)
        : slack_(1e-9 * cylinder.length), straightening_(cylinder) {
        for (const Vector3d& point : body.points) {
            places_[0].push_back(from_eigen(body.middle + body.size * point));
            paper::Cylindrical at = straightening_.vertex(places_[0].back());
            heights_.push_back(at.z);
            for (std::size_t turn = 1; turn < places_.size(); ++turn) {
                at.beta += std::numbers::pi / 2;
                places_[turn].push_back(straightening_.bent(at));
            }
        }
    }

    /// Whether no edge leads across a gap between ends of arcs.
    [[nodiscard]] bool leads_along(const Corners& t) const {
        const auto leads = [&](std::uint32_t a, std::uint32_t b) {
            const glm::dvec3 middle = (places_[0][a] + places_[0][b]) / 2.0;
            return straightening_.leads_along(middle, heights_[a], heights_[b], slack_);
        };
        return leads(t[0], t[1]) && leads(t[1], t[2]) && leads(t[2], t[0]);
    }

    [[nodiscard]] double area(const Corners& t) const { return area_of(places_[0], t); }

    /// The mean of the areas that the triangle has all around the center line: that of quarter turns, since
    /// what it is stretched by is the cosine of the turn and its square.
    [[nodiscard]] double mean_area(const Corners& t) const {
        double sum = 0;
        for (const std::vector<glm::dvec3>& places : places_) sum += area_of(places, t);
        return sum / static_cast<double>(places_.size());
    }

private:
    double slack_;
    const Straightening straightening_;
    std::array<std::vector<glm::dvec3>, 4> places_;
    std::vector<double> heights_;
};

}  // namespace

bool is_bent_tube(const Body& body, const Cylinder& cylinder) {
    constexpr double most_across = 1e-3;                        // share of the area
    constexpr double most_inside = 0.035, most_outside = 0.07;  // likewise: modules/paper/README.md has why
    const TurnedBody turned(body, cylinder);
    double area = 0, mean = 0, across = 0;
    for (std::size_t i = 0; i + 2 < body.triangles.size(); i += 3) {
        const Corners t{body.triangles[i], body.triangles[i + 1], body.triangles[i + 2]};
        const double own = turned.area(t);
        if (turned.leads_along(t)) {
            area += own;
            mean += turned.mean_area(t);
        } else {
            across += own;
        }
    }
    return across <= most_across * area && area >= (1 - most_inside) * mean &&
           area <= (1 + most_outside) * mean;
}

}  // namespace goffer::fit
