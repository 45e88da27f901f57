// SPDX-License-Identifier: MIT
#include "columns.hpp"
#include "profile.hpp"
#include "rest.hpp"
#include "row_scale.hpp"
#include "text.hpp"

#include <goffer/fit/refine.hpp>

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <unordered_map>
#include <utility>

namespace goffer::fit {
namespace {

constexpr double longest_edge = 1 + 5e-4;  // in rows: half the slack of folds_capacity

/// The corners of a triangle from bottom to top (by rows), and whether this order winds as the triangle does.
struct Upright {
    std::uint32_t low, middle, high;
    bool same_turn;
};

class Refiner {
public:
    /// `arc`: maps model space to the coordinates that heights are measured in, if edges are curved in these;
    /// null if heights change evenly along edges.
    Refiner(const Geometry& geometry, std::span<const double> heights, const RowScale& scale,
            const Straightening* arc)
        : triangles_(geometry.triangles),
          scale_(scale),
          arc_(arc),
          points_(geometry.positions.begin(), geometry.positions.end()),
          heights_(heights.begin(), heights.end()) {
        for (const double z : heights_) rows_.push_back(scale_.row(z));
    }

    Refinement run(const RefineOptions& options) && {
        const double all = check_growth(options.max_triangles);
        double next = 0;
        for (std::size_t t = 0; t < triangles_.size(); t += 3) {
            cut(t / 3);
            const auto done = static_cast<double>(out_.parents.size());
            if (!options.progress || done < next) continue;
            options.progress(std::min(done / all, 1.0));
            next = std::min(done + all / 200, all);
        }
        return std::move(out_);
    }

private:
    [[nodiscard]] double pieces(Edge edge) const {
        const double count = std::ceil(std::abs(rows_[edge.a] - rows_[edge.b]) / longest_edge);
        return count > 1 && leads_along(edge) ? count : 1;
    }

    [[nodiscard]] std::array<Edge, 3> edges(std::size_t triangle) const {
        const std::uint32_t* c = &triangles_[3 * triangle];
        return {{{c[0], c[1]}, {c[1], c[2]}, {c[2], c[0]}}};
    }

    double check_growth(std::size_t max_triangles) const;
    void cut(std::size_t triangle);
    void emit(std::size_t parent, const Upright& corners, std::array<std::uint32_t, 3> piece);
    [[nodiscard]] Upright upright(std::size_t triangle) const;
    void append_inner(std::vector<std::uint32_t>& chain, Edge upward);
    std::uint32_t first_between(Edge edge, std::uint32_t count);
    [[nodiscard]] bool leads_along(Edge edge) const;
    [[nodiscard]] double place(Edge edge, double height) const;
    [[nodiscard]] bool left_next(std::size_t i, std::size_t j) const;

    std::span<const std::uint32_t> triangles_;
    const RowScale& scale_;
    const Straightening* arc_;
    std::vector<glm::dvec3> points_;  // the three below: of the mesh's vertices, then of the new ones
    std::vector<double> heights_, rows_;
    std::unordered_map<std::uint64_t, std::uint32_t> first_between_;
    std::vector<std::uint32_t> left_, right_;  // the two sides of a triangle, inner vertices, upward
    Refinement out_;
};

/// Returns how many triangles there will be.
double Refiner::check_growth(std::size_t max_triangles) const {
    double triangles = 0, vertices = static_cast<double>(heights_.size());
    for (std::size_t t = 0; t < triangles_.size() / 3; ++t) {
        for (const Edge& edge : edges(t)) {
            triangles += pieces(edge);
            vertices += pieces(edge) - 1;
        }
        triangles -= 2;
    }
    const double indices = std::numeric_limits<std::uint32_t>::max();
    if (triangles <= static_cast<double>(max_triangles) && vertices < indices) return triangles;
    throw SizeError("refined, the mesh would have " + text(triangles) + " triangles, more than the " +
                    std::to_string(max_triangles) + " allowed; ask for fewer folds");
}

Upright Refiner::upright(std::size_t triangle) const {
    const std::uint32_t* c = &triangles_[3 * triangle];
    std::array<std::size_t, 3> order{0, 1, 2};
    std::ranges::stable_sort(order, {}, [&](std::size_t i) { return rows_[c[i]]; });
    return {c[order[0]], c[order[1]], c[order[2]], (order[0] + 1) % 3 == order[1]};
}

void Refiner::emit(std::size_t parent, const Upright& corners, std::array<std::uint32_t, 3> piece) {
    if (!corners.same_turn) std::swap(piece[1], piece[2]);
    out_.triangles.insert(out_.triangles.end(), piece.begin(), piece.end());
    out_.parents.push_back(static_cast<std::uint32_t>(parent));
}

/// The first of the `count` new vertices on an edge; the others follow it upward. On a seam both sides have
/// the same heights, so both name the edge in this direction and get the same sums.
std::uint32_t Refiner::first_between(Edge edge, std::uint32_t count) {
    const auto next = static_cast<std::uint32_t>(points_.size());
    const std::uint64_t key = (std::uint64_t{edge.a} << 32) | edge.b;
    const auto [entry, is_new] = first_between_.try_emplace(key, next);
    if (!is_new) return entry->second;
    for (std::uint32_t i = 1; i <= count; ++i) {
        const double share = i / (count + 1.0);
        const double row = rows_[edge.a] + share * (rows_[edge.b] - rows_[edge.a]);
        const double height = scale_.height(row);
        const double t = place(edge, height);
        out_.vertices.push_back({edge.a, edge.b, t});
        points_.push_back(points_[edge.a] + t * (points_[edge.b] - points_[edge.a]));
        heights_.push_back(height);
        rows_.push_back(row);
    }
    return entry->second;
}

/// An edge across a gap is not cut: what is between its ends is of no height of the body.
bool Refiner::leads_along(Edge edge) const {
    return arc_ == nullptr || arc_->leads_along((points_[edge.a] + points_[edge.b]) / 2.0, heights_[edge.a],
                                                heights_[edge.b], 0);
}

/// Where an edge, from a up to b, reaches a height, as a share of the edge. About an arc's center a straight
/// edge turns one way, but not evenly: solved by false position (the Illinois variant), which keeps a
/// bracket.
double Refiner::place(Edge edge, double height) const {
    constexpr int max_steps = 60;
    double low = 0, high = 1;
    double below = heights_[edge.a] - height, above = heights_[edge.b] - height;
    const double close = 1e-12 * (above - below);
    double t = below / (below - above);
    for (int step = 0, side = 0; arc_ != nullptr && step < max_steps; ++step) {
        const double off = arc_->height(points_[edge.a] + t * (points_[edge.b] - points_[edge.a])) - height;
        if (!(std::fabs(off) > close)) break;
        const int now = off < 0 ? -1 : 1;
        if (now < 0) {
            low = t, below = off;
            if (side == now) above /= 2;
        } else {
            high = t, above = off;
            if (side == now) below /= 2;
        }
        side = now;
        t = low + (high - low) * (below / (below - above));
    }
    return t;
}

void Refiner::append_inner(std::vector<std::uint32_t>& chain, Edge upward) {
    const auto count = static_cast<std::uint32_t>(pieces(upward)) - 1;
    if (count == 0) return;
    const std::uint32_t first = first_between(upward, count);
    for (std::uint32_t i = 0; i < count; ++i) chain.push_back(first + i);
}

/// Whether the next piece takes a step up the left side. The side that lags may always step, the other one if
/// the new cross edge stays within a row. If both may, the shorter cross edge decides.
bool Refiner::left_next(std::size_t i, std::size_t j) const {
    if (j + 1 == right_.size()) return true;
    if (i + 1 == left_.size()) return false;
    const auto reach = [&](std::uint32_t a, std::uint32_t b) { return std::abs(rows_[a] - rows_[b]); };
    const std::uint32_t left = left_[i], right = right_[j], left_up = left_[i + 1], right_up = right_[j + 1];
    const bool left_lags = rows_[left] <= rows_[right];
    if (!left_lags && reach(left_up, right) > longest_edge) return false;
    if (left_lags && reach(left, right_up) > longest_edge) return true;
    const double by_left = glm::distance(points_[left_up], points_[right]);
    const double by_right = glm::distance(points_[left], points_[right_up]);
    return by_left == by_right ? left_lags : by_left < by_right;
}

/// One side of an upright triangle is the edge from low to high, the other side is the other two edges.
/// Pieces fill the space between from the bottom up, like a zipper: each has an edge of one side and a vertex
/// of the other side that is within a row of both its ends. Where only the side from low to high leads across
/// a gap, and is not cut, the pieces meet at its ends.
void Refiner::cut(std::size_t triangle) {
    const Upright corners = upright(triangle);
    left_.clear();
    right_.clear();
    append_inner(left_, {corners.low, corners.high});
    append_inner(right_, {corners.low, corners.middle});
    const std::size_t middle = right_.size();
    right_.push_back(corners.middle);
    append_inner(right_, {corners.middle, corners.high});
    if (left_.empty() && right_.size() == 1) {
        const std::uint32_t* c = &triangles_[3 * triangle];
        out_.triangles.insert(out_.triangles.end(), c, c + 3);
        out_.parents.push_back(static_cast<std::uint32_t>(triangle));
        return;
    }
    if (left_.empty()) {
        std::uint32_t last = corners.low;
        for (std::size_t j = 0; j < middle; ++j) {
            emit(triangle, corners, {last, right_[j], corners.high});
            last = right_[j];
        }
        for (std::size_t j = middle; j + 1 < right_.size(); ++j)
            emit(triangle, corners, {last, right_[j], right_[j + 1]});
        emit(triangle, corners, {last, right_.back(), corners.high});
        return;
    }
    emit(triangle, corners, {corners.low, right_[0], left_[0]});
    for (std::size_t i = 0, j = 0; i + j + 2 < left_.size() + right_.size();) {
        const bool left = left_next(i, j);
        emit(triangle, corners, {left_[i], right_[j], left ? left_[i + 1] : right_[j + 1]});
        ++(left ? i : j);
    }
    emit(triangle, corners, {left_.back(), right_.back(), corners.high});
}

void check_stretches(std::span<const Stretch> stretches) {
    if (stretches.empty()) throw Error("stretches: there are none; give one or more");
    for (std::size_t i = 0; i < stretches.size(); ++i) {
        const std::string which = stretches.size() > 1 ? " of stretch " + std::to_string(i) : "";
        const auto [length, folds] = stretches[i];
        if (!(length > 0) || !std::isfinite(length))
            throw Error("length" + which + " is " + text(length) + "; give a finite length above 0");
        if (!(folds >= 0 && folds <= Stretch::max_folds))
            throw Error("folds" + which + ": " + text(folds) + "; give 0 to " +
                        std::to_string(Stretch::max_folds));
    }
}

void check_heights(std::span<const double> heights, std::size_t vertices) {
    if (heights.size() != vertices)
        throw Error("heights: " + std::to_string(heights.size()) + " for " + std::to_string(vertices) +
                    " vertices; give one per vertex");
    const auto bad = std::ranges::find_if_not(heights, [](double z) { return std::isfinite(z); });
    if (bad != heights.end())
        throw Error("height of vertex " + std::to_string(bad - heights.begin()) +
                    " is NaN or infinite; give z in model units");
}

/// Adds stretches that a region of Profile::even needs: folds are as long as the body is thick.
void add_even(std::vector<Stretch>& stretches, const Cylinder& cylinder, const BindOptions& options,
              double start, double length, std::optional<int> asked) {
    const bool round = cylinder.radii.empty() || has_one_radius(cylinder, options);
    const WrinkleRange range = options.wrinkle_range;
    const std::size_t pieces = round && range.whole() ? 1 : 64;
    const double step = length / static_cast<double>(pieces);
    const std::vector<double> radii = round ? std::vector<double>(pieces, cylinder.radius)
                                            : radii_at(cylinder, start + step / 2, length - step, pieces);
    std::vector<double> folds;
    double sum = 0;
    for (const double radius : radii) {
        folds.push_back(step / fold_length_at(cylinder, options.profile, options.fold_length, radius));
        sum += folds.back();
    }
    // A body has a whole number of them.
    const double whole = asked ? *asked : std::clamp<double>(std::round(sum), 1, max_folds(Profile::even));
    for (std::size_t i = 0; i < pieces; ++i) {
        const double low = (start + static_cast<double>(i) * step) / cylinder.length;
        const double high = low + step / cylinder.length;
        const bool smooth = high < range.first || low > range.last;
        stretches.push_back({step, smooth ? 0 : folds[i] * whole / sum / 2});
    }
}

/// `arc` is that of Refiner's constructor.
Refinement with_rows(const Geometry& geometry, std::span<const double> heights, const RowScale& scale,
                     const Straightening* arc, const RefineOptions& options) {
    check_heights(heights, geometry.positions.size());
    return Refiner(geometry, heights, scale, arc).run(options);
}

/// The same options for the first (0) or the second (1) half of the work.
RefineOptions half_of(const RefineOptions& options, int half) {
    RefineOptions own = options;
    if (options.progress)
        own.progress = [&options, half](double share) { options.progress((half + share) / 2); };
    return own;
}

RowScale scale_of(std::span<const Stretch> stretches) {
    check_stretches(stretches);
    return RowScale(stretches);
}

}  // namespace

std::vector<Stretch> stretches_of(const Cylinder& cylinder, const BindOptions& options) {
    std::vector<Stretch> stretches;
    double start = 0;
    for (const RegionOptions& region : regions_of(with_regions_of(cylinder, options))) {
        const Cylinder own = stretch_of(cylinder, region.share * cylinder.length);
        if (options.profile.kind == Profile::Kind::even) {
            add_even(stretches, cylinder, options, start, own.length, region.folds);
        } else {
            const int sensible = sensible_folds(own, BindOptions::max_folds, options.fold_length);
            stretches.push_back({own.length, static_cast<double>(region.folds.value_or(sensible))});
        }
        start += own.length;
    }
    return stretches;
}

int fold_count(std::span<const Stretch> stretches, Profile profile) {
    const double halves = profile.kind == Profile::Kind::even ? 2 : 1;
    double folds = 0;
    for (const Stretch& stretch : stretches) folds += halves * stretch.folds;
    return static_cast<int>(std::round(folds));
}

std::vector<int> suitable_folds(const Cylinder& cylinder, const BindOptions& options) {
    BindOptions unsaid = options;
    unsaid.folds.reset();
    for (RegionOptions& region : unsaid.regions) region.folds.reset();
    const std::vector<Stretch> stretches = stretches_of(cylinder, unsaid);
    const std::size_t regions = regions_of(with_regions_of(cylinder, unsaid)).size(),
                      of_region = stretches.size() / regions;
    std::vector<int> folds;
    folds.reserve(regions);
    for (std::size_t r = 0; r < regions; ++r)
        folds.push_back(fold_count(std::span(stretches).subspan(r * of_region, of_region), unsaid.profile));
    return folds;
}

Refinement refine(const Geometry& geometry, std::span<const double> heights,
                  std::span<const Stretch> stretches, const RefineOptions& options) {
    check(geometry);
    return with_rows(geometry, heights, scale_of(stretches), nullptr, options);
}

Refinement refine(const Geometry& geometry, const Cylinder& cylinder, std::span<const Stretch> stretches,
                  const RefineOptions& options) {
    check(geometry);
    check(cylinder);
    const RowScale scale = scale_of(stretches);
    const Straightening arc(cylinder);
    Refinement rows = with_rows(geometry, heights(geometry.positions, cylinder), scale,
                                cylinder.bent() ? &arc : nullptr, half_of(options, 0));
    return with_columns(geometry, cylinder, scale, std::move(rows), half_of(options, 1));
}

Refinement refine(const Geometry& geometry, const Cylinder& cylinder, int folds,
                  const RefineOptions& options) {
    const Stretch whole{cylinder.length, static_cast<double>(folds)};
    return refine(geometry, cylinder, {&whole, 1}, options);
}

std::vector<glm::vec3> refined_positions(std::span<const glm::vec3> positions, const Refinement& refinement) {
    std::vector<glm::vec3> all(positions.begin(), positions.end());
    all.reserve(positions.size() + refinement.vertices.size());
    for (const auto& [a, b, t] : refinement.vertices) {
        const glm::dvec3 from = all[a], to = all[b];
        all.emplace_back(from + t * (to - from));
    }
    return all;
}

}  // namespace goffer::fit
