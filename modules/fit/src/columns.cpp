// SPDX-License-Identifier: MIT
#include "columns.hpp"

#include "rest.hpp"

#include <goffer/paper/shape.hpp>
#include <goffer/paper/wrinkle.hpp>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <tuple>
#include <unordered_map>
#include <utility>
#include <vector>

namespace goffer::fit {
namespace {

/// How far a wrinkle may be off in the middle of an edge, in its depth: 1 - cos(17 degrees), which an edge of
/// the skin has that spans 34 degrees. A prism of 11 sides is left as it is, one of 10 is not.
constexpr double most_off = 0.0437;

/// How often a side of a triangle is cut in half, its pieces included. Where one side of a triangle lies in a
/// stretch without folds and two lean on it, new sides might be too wide without end.
constexpr int most_halvings = 6;

/// A piece of a triangle. halvings[i]: how often the side from corners[i] on may still be cut. Both pieces at
/// a side agree on it.
struct Piece {
    std::array<std::uint32_t, 3> corners;
    std::array<int, 3> halvings;
};

/// Where a vertex lies across and along the straightened body.
struct Spot {
    glm::dvec2 across;
    double z;
};

class ColumnCutter {
public:
    ColumnCutter(const Geometry& geometry, const Cylinder& cylinder, const RowScale& scale,
                 const Refinement& rows)
        : straightening_(cylinder),
          scale_(scale),
          radius_(cylinder.length,
                  cylinder.radii.empty() ? std::vector<double>(2, cylinder.radius) : cylinder.radii),
          positions_(refined_positions(geometry.positions, rows)),
          rows_(rows) {
        spots_.reserve(positions_.size());
        for (const glm::vec3& position : positions_) add_spot(position);
    }

    /// Returns nothing if there would be more triangles than allowed, or more vertices than 32 bits number.
    std::optional<Refinement> run(const RefineOptions& options) &&;

private:
    void add_spot(const glm::vec3& position);
    [[nodiscard]] double off(Edge edge) const;
    [[nodiscard]] Edge named_alike(Edge edge) const;
    [[nodiscard]] glm::vec3 half_way(Edge edge) const;
    [[nodiscard]] double need(Edge edge) const;
    std::uint32_t middle(Edge edge);
    bool cut(const Piece& whole, std::uint32_t parent, std::size_t max_triangles);
    bool cut_worst(const Piece& piece);

    const Straightening straightening_;
    const RowScale& scale_;
    const paper::Spline radius_;
    std::vector<glm::vec3> positions_;  // this and the next: of the mesh's vertices, then of the new ones
    std::vector<Spot> spots_;
    std::unordered_map<std::uint64_t, std::uint32_t> middles_;
    std::vector<Piece> open_;  // pieces of a triangle that may have to be cut
    const Refinement& rows_;
    Refinement out_;
};

void ColumnCutter::add_spot(const glm::vec3& position) {
    const paper::Cylindrical at = straightening_.vertex(position);
    spots_.push_back({at.rho * glm::dvec2(std::cos(at.beta), std::sin(at.beta)), at.z});
}

/// The ends of an edge, in the order that both sides of a seam name them in.
Edge ColumnCutter::named_alike(Edge edge) const {
    const glm::vec3 &a = positions_[edge.a], &b = positions_[edge.b];
    return std::tie(b.x, b.y, b.z) < std::tie(a.x, a.y, a.z) ? Edge{edge.b, edge.a} : edge;
}

/// What the wrinkle lacks in the middle of an edge, in its depth there: its ends are moved away from the axis
/// in two directions, and the middle by the mean of both. Next to nothing near the axis, where it fades.
double ColumnCutter::off(Edge edge) const {
    const auto& [a, z_a] = spots_[edge.a];
    const auto& [b, z_b] = spots_[edge.b];
    const double rho_a = glm::length(a), rho_b = glm::length(b);
    const double product = rho_a * rho_b;
    if (!(product > 0)) return 0;
    const double cosine = std::clamp(glm::dot(a, b) / product, -1.0, 1.0);
    const double lost = 1 - std::sqrt((1 + cosine) / 2);
    if (!(lost > most_off) || !scale_.has_folds(std::min(z_a, z_b), std::max(z_a, z_b))) return 0;
    const double nearest = std::min({rho_a, rho_b, glm::length(a + b) / 2});
    return lost * paper::depth_weight(nearest, radius_((z_a + z_b) / 2));
}

glm::vec3 ColumnCutter::half_way(Edge edge) const {
    const glm::dvec3 from = positions_[edge.a], to = positions_[edge.b];
    return glm::vec3(from + 0.5 * (to - from));
}

/// Whether to cut an edge, and if so how badly: what is off in its middle, or 0. One whose ends are next to
/// each other in float is left as it is, and so is one across the gap between the ends of a bent body.
double ColumnCutter::need(Edge edge) const {
    const double its = off(edge);
    if (!(its > most_off)) return 0;
    const glm::vec3 half = half_way(edge);
    if (half == positions_[edge.a] || half == positions_[edge.b]) return 0;
    const double slack = 5e-4 * radius_.length();  // edges around the body have ends of one height
    return straightening_.leads_along(half, spots_[edge.a].z, spots_[edge.b].z, slack) ? its : 0;
}

/// The vertex in the middle of an edge.
std::uint32_t ColumnCutter::middle(Edge edge) {
    const auto next = static_cast<std::uint32_t>(positions_.size());
    const auto [entry, is_new] = middles_.try_emplace((std::uint64_t{edge.a} << 32) | edge.b, next);
    if (!is_new) return entry->second;
    out_.vertices.push_back({edge.a, edge.b, 0.5});
    positions_.push_back(half_way(edge));
    add_spot(positions_.back());
    return next;
}

/// Cuts the side in half that needs it most, and puts both pieces on the stack. Returns whether one did.
bool ColumnCutter::cut_worst(const Piece& piece) {
    const auto& [corners, halvings] = piece;
    std::size_t i = 0;
    double most = 0;
    for (std::size_t side = 0; side < 3; ++side) {
        if (halvings[side] == 0) continue;
        const double its = need(named_alike({corners[side], corners[(side + 1) % 3]}));
        if (its > most) i = side, most = its;
    }
    if (!(most > 0)) return false;
    const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
    const std::uint32_t half = middle(named_alike({corners[i], corners[j]}));
    const int left = halvings[i] - 1;
    open_.push_back({{half, corners[j], corners[k]}, {left, halvings[j], left}});
    open_.push_back({{corners[i], half, corners[k]}, {left, left, halvings[k]}});
    return true;
}

/// Returns false if the pieces become too many.
bool ColumnCutter::cut(const Piece& whole, std::uint32_t parent, std::size_t max_triangles) {
    open_.push_back(whole);
    while (!open_.empty()) {
        const Piece piece = open_.back();
        open_.pop_back();
        if (positions_.size() >= std::numeric_limits<std::uint32_t>::max()) return false;
        if (cut_worst(piece)) continue;
        if (out_.parents.size() >= max_triangles) return false;
        out_.triangles.insert(out_.triangles.end(), piece.corners.begin(), piece.corners.end());
        out_.parents.push_back(parent);
    }
    return true;
}

std::optional<Refinement> ColumnCutter::run(const RefineOptions& options) && {
    out_.vertices = rows_.vertices;
    const std::size_t count = rows_.parents.size(), step = count / 100 + 1;
    for (std::size_t t = 0; t < count; ++t) {
        const std::uint32_t* corners = &rows_.triangles[3 * t];
        const Piece whole{{corners[0], corners[1], corners[2]},
                          {most_halvings, most_halvings, most_halvings}};
        if (!cut(whole, rows_.parents[t], options.max_triangles)) return std::nullopt;
        if (options.progress && t % step == 0)
            options.progress(static_cast<double>(t) / static_cast<double>(count));
    }
    return std::move(out_);
}

}  // namespace

Refinement with_columns(const Geometry& geometry, const Cylinder& cylinder, const RowScale& scale,
                        Refinement rows, const RefineOptions& options) {
    std::optional<Refinement> all = ColumnCutter(geometry, cylinder, scale, rows).run(options);
    return all ? std::move(*all) : std::move(rows);
}

}  // namespace goffer::fit
