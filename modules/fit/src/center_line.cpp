// SPDX-License-Identifier: MIT
#include "center_line.hpp"

#include "disjoint_sets.hpp"
#include "stretches.hpp"

#include <goffer/fit/cylinder.hpp>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <queue>
#include <utility>

namespace goffer::fit {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

/// Places all over a surface, and which of them are near each other.
class PlaceGraph {
public:
    explicit PlaceGraph(std::vector<Vector3d> places) : places_(std::move(places)), links_(places_.size()) {
        link_near();
        link_sets();
    }

    /// How far each place is from the place `from`, along links.
    [[nodiscard]] std::vector<double> distances(std::size_t from) const {
        std::vector<double> distance(places_.size(), infinite);
        using Entry = std::pair<double, std::size_t>;
        std::priority_queue<Entry, std::vector<Entry>, std::greater<>> next;
        next.push({distance[from] = 0, from});
        while (!next.empty()) {
            const auto [far, at] = next.top();
            next.pop();
            if (far > distance[at]) continue;
            for (const std::size_t to : links_[at]) {
                const double there = far + (places_[to] - places_[at]).norm();
                if (there < distance[to]) next.push({distance[to] = there, to});
            }
        }
        return distance;
    }

    [[nodiscard]] const std::vector<Vector3d>& places() const { return places_; }

private:
    void link(std::size_t a, std::size_t b) {
        links_[a].push_back(b);
        links_[b].push_back(a);
    }

    /// Each with those that are nearest.
    void link_near() {
        constexpr std::size_t nearest = 8;
        std::vector<std::pair<double, std::size_t>> others;
        for (std::size_t i = 0; i < places_.size(); ++i) {
            others.clear();
            for (std::size_t j = 0; j < places_.size(); ++j)
                if (j != i) others.push_back({(places_[j] - places_[i]).squaredNorm(), j});
            const auto last = others.begin() + static_cast<std::ptrdiff_t>(std::min(nearest, others.size()));
            std::nth_element(others.begin(), last - 1, others.end());
            for (auto other = others.begin(); other != last; ++other) link(i, other->second);
        }
    }

    /// What is apart from the first place's part by the shortest gap to that, one part after the other.
    void link_sets() {
        DisjointSets sets(places_.size());
        for (std::size_t i = 0; i < links_.size(); ++i)
            for (const std::size_t j : links_[i])
                sets.join(static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(j));
        std::vector<std::vector<std::size_t>> parts(places_.size());
        for (std::size_t i = 0; i < places_.size(); ++i)
            parts[sets.set_of(static_cast<std::uint32_t>(i))].push_back(i);
        struct Gap {
            double squared = infinite;
            std::size_t from = 0;
        };
        std::vector<Gap> gaps(places_.size());  // from each place that is not linked to the nearest that is
        std::vector<bool> linked(places_.size(), false);
        std::size_t next = 0;
        for (;;) {
            for (const std::size_t i : parts[sets.set_of(static_cast<std::uint32_t>(next))]) {
                linked[i] = true;
                for (std::size_t j = 0; j < places_.size(); ++j) {
                    const double apart = linked[j] ? infinite : (places_[j] - places_[i]).squaredNorm();
                    if (apart < gaps[j].squared) gaps[j] = {apart, i};
                }
            }
            double least = infinite;
            for (std::size_t j = 0; j < places_.size(); ++j)
                if (!linked[j] && gaps[j].squared < least) least = gaps[next = j].squared;
            if (least == infinite) return;
            link(gaps[next].from, next);
        }
    }

    std::vector<Vector3d> places_;
    std::vector<std::vector<std::size_t>> links_;
};

/// The middles of small triangles of equal area, all over the surface.
std::vector<Vector3d> places_on(const Body& body, std::size_t count) {
    std::vector<std::uint32_t> triangles;
    const Body cloud = sampled_surface(body, count, triangles);
    std::vector<Vector3d> places;
    for (std::size_t t = 0; t < cloud.triangles.size(); t += 3)
        places.push_back((cloud.points[cloud.triangles[t]] + cloud.points[cloud.triangles[t + 1]] +
                          cloud.points[cloud.triangles[t + 2]]) /
                         3);
    return places;
}

std::size_t farthest(const std::vector<double>& distance) {
    return static_cast<std::size_t>(std::ranges::max_element(distance) - distance.begin());
}

/// The frame, carried without twist along an arc that bows off it by `curvature`.
Matrix3d carried(const Matrix3d& frame, const Eigen::Vector2d& curvature, double length) {
    const double size = curvature.norm();
    if (size == 0) return frame;
    const Vector3d bow = frame.leftCols<2>() * curvature / size;
    const Vector3d axis = frame.col(2);
    return Eigen::AngleAxisd(size * length, axis.cross(bow)) * frame;
}

/// The line at `distance` along an arc, with the carried frame.
Line along(const Line& line, const Eigen::Vector2d& curvature, double distance) {
    Line there = moved_along(line, distance);
    there.frame = carried(line.frame, curvature, distance);
    there.bow = there.frame.leftCols<2>() * curvature;
    return there;
}

}  // namespace

void append(std::vector<CenterPoint>& points, const Vector3d& place, double weight, double radius) {
    const double along = points.empty() ? 0 : points.back().along + (place - points.back().place).norm();
    points.push_back({place, along, weight, radius});
}

CenterPoints center_points(const Body& body) {
    constexpr std::size_t count = 2000;
    const PlaceGraph graph(places_on(body, count));
    const std::size_t base = farthest(graph.distances(0));
    const std::vector<double> from_base = graph.distances(base);
    const std::size_t tip = farthest(from_base);
    const std::vector<double> from_tip = graph.distances(tip);
    const double length = from_base[tip];
    const double radius = area_of(body) / (2 * std::numbers::pi * length);
    const double slices = std::floor(length / (center_step * radius));
    if (!(slices >= fewest_centers)) return {{}, radius};
    const auto bins = static_cast<std::size_t>(std::min(slices, most_centers));
    std::vector<CenterPoint> sums(bins, {Vector3d::Zero(), 0, 0, 0});
    for (std::size_t i = 0; i < graph.places().size(); ++i) {
        const double share = 0.5 + (from_base[i] - from_tip[i]) / (2 * length);
        const double bin = std::clamp(share * static_cast<double>(bins), 0.0, static_cast<double>(bins) - 1);
        CenterPoint& sum = sums[static_cast<std::size_t>(bin)];
        sum.place += graph.places()[i];
        sum.weight += 1;
    }
    std::vector<CenterPoint> points;
    for (std::size_t i = 0; i < bins; ++i) {
        constexpr double enough = 6, askew = 1.5;
        const CenterPoint& sum = sums[i];
        if (sum.weight < enough) continue;
        const double share = sum.weight / static_cast<double>(count);
        const double own = share * static_cast<double>(bins) * radius;
        // What is equally far from both ends lies askew near them.
        const double from_end = static_cast<double>(std::min(i, bins - 1 - i)) / static_cast<double>(bins);
        if (from_end * length < askew * own) continue;
        append(points, sum.place / sum.weight, share, own);
    }
    return {std::move(points), radius};
}

ArcChain::ArcChain(const Vector3d& point, const Matrix3d& frame, std::span<const ChainArc> arcs)
    : arcs_(arcs.begin(), arcs.end()) {
    Line line{point, frame};
    double start = 0;
    for (const ChainArc& arc : arcs_) {
        line.bow = line.frame.leftCols<2>() * arc.curvature;
        pieces_.push_back({start, line, Straightened(along(line, arc.curvature, arc.length / 2))});
        line = along(line, arc.curvature, arc.length);
        start += arc.length;
    }
}

Vector3d ArcChain::straightened(const Vector3d& place) const {
    Vector3d best = Vector3d::Zero();
    double least = infinite;
    for (std::size_t i = 0; i < pieces_.size(); ++i) {
        const double length = arcs_[i].length;
        const Vector3d at = pieces_[i].about_middle(place);
        const auto [z, far] =
            seen_from(at.z() + length / 2, at.head<2>().norm(), length, i == 0, i + 1 == pieces_.size());
        if (!(far < least)) continue;
        least = far;
        best = {at.x(), at.y(), pieces_[i].start + z};
    }
    return best;
}

std::size_t ArcChain::arc_at(double z) const {
    return stretch_at(std::span(pieces_), z);
}

Line ArcChain::line_at(double z) const {
    const std::size_t i = arc_at(z);
    return along(pieces_[i].line, arcs_[i].curvature, z - pieces_[i].start);
}

Vector3d ArcChain::bent(const Vector3d& at) const {
    const Line line = line_at(at.z());
    return line.point + line.frame.leftCols<2>() * at.head<2>();
}

namespace {

/// What is to be found of a chain: its numbers as one vector, of the changes from where it was.
class Unknowns {
public:
    explicit Unknowns(const ArcChain& from) : start_(from.line_at(0)), arcs_(from.arcs()) {}

    [[nodiscard]] Eigen::Index count() const { return 5 + 3 * static_cast<Eigen::Index>(arcs_.size()) - 1; }

    /// The first five move and tilt the base. Then curvatures, then places of joints.
    [[nodiscard]] ArcChain moved(const Eigen::VectorXd& by, double shortest) const {
        const Vector3d tilt(by[3], by[4], 0);
        Matrix3d frame = start_.frame;
        if (tilt.norm() > 0)
            frame = frame * Eigen::AngleAxisd(tilt.norm(), tilt.normalized()).toRotationMatrix();
        std::vector<ChainArc> arcs = arcs_;
        for (std::size_t i = 0; i < arcs.size(); ++i) {
            const auto at = static_cast<Eigen::Index>(i);
            arcs[i].curvature += by.segment<2>(5 + 2 * at);
            if (i + 1 == arcs.size()) continue;
            const double shift = by[5 + 2 * static_cast<Eigen::Index>(arcs.size()) + at];
            arcs[i].length += shift;
            arcs[i + 1].length -= shift;
        }
        for (ChainArc& arc : arcs) arc.length = std::max(arc.length, shortest);
        return {start_.point + start_.frame * by.head<3>(), frame, arcs};
    }

private:
    Line start_;
    std::vector<ChainArc> arcs_;
};

/// How far the chain at each point's height is from the point, and how much too far each arc is bent, in
/// radii. Along the chain it does not count in full: lengths from point to point are not quite those of the
/// chain.
Eigen::VectorXd residuals(const ArcChain& chain, std::span<const CenterPoint> points, double radius) {
    constexpr double most_bent = 0.8, stiffness = 3, along = 0.3;
    const auto count = static_cast<Eigen::Index>(points.size());
    const std::vector<ChainArc>& arcs = chain.arcs();
    Eigen::VectorXd all = Eigen::VectorXd::Zero(3 * count + static_cast<Eigen::Index>(arcs.size()));
    for (Eigen::Index i = 0; i < count; ++i) {
        const CenterPoint& point = points[static_cast<std::size_t>(i)];
        const Line line = chain.line_at(point.along);
        Vector3d off = line.frame.transpose() * (point.place - line.point);
        off.z() *= along;
        all.segment<3>(3 * i) = std::sqrt(point.weight) / point.radius * off;
        const std::size_t arc = chain.arc_at(point.along);
        double& excess = all[3 * count + static_cast<Eigen::Index>(arc)];
        excess = std::max(
            excess, stiffness * (std::max(point.radius, radius) * arcs[arc].curvature.norm() - most_bent));
    }
    return all;
}

/// Bends of the line from point to point, at each inner point, in the frame that is carried along it.
struct Bends {
    Matrix3d frame;                       // at the first point
    std::vector<Eigen::Vector2d> turned;  // by how much up to and with each point; none at the first
};

Bends bends_of(std::span<const CenterPoint> points) {
    const auto toward = [&](std::size_t i) -> Vector3d {
        return (points[i + 1].place - points[i].place).normalized();
    };
    Matrix3d frame = line_through(points[0].place, toward(0)).frame;
    Bends bends{frame, std::vector<Eigen::Vector2d>(points.size(), Eigen::Vector2d::Zero())};
    for (std::size_t i = 1; i < points.size(); ++i) {
        bends.turned[i] = bends.turned[i - 1];
        if (i + 1 == points.size()) break;
        const Vector3d before = frame.col(2), after = toward(i);
        const Vector3d axis = before.cross(after);
        const double angle = std::atan2(axis.norm(), before.dot(after));
        if (!(axis.norm() > 0)) continue;
        const Vector3d bow = axis.normalized().cross(before);
        bends.turned[i] += angle * frame.leftCols<2>().transpose() * bow;
        frame = Eigen::AngleAxisd(angle, axis.normalized()) * frame;
    }
    return bends;
}

/// Cuts the points into `count` stretches, so that the line bends as evenly as it can within each (dynamic
/// programming). Returns the first point of each, and the last point. None is shorter than `shortest`, if
/// they have room.
std::vector<std::size_t> cut_evenly(std::span<const CenterPoint> points, const Bends& bends,
                                    std::size_t count, double shortest) {
    const std::size_t last = points.size() - 1;
    // The squares about the straight line from (along, turned) at one point to that at another.
    const auto cost = [&](std::size_t from, std::size_t to) {
        const double length = points[to].along - points[from].along;
        if (length < shortest) return infinite;
        double sum = 0;
        for (std::size_t i = from + 1; i < to; ++i) {
            const double share = (points[i].along - points[from].along) / length;
            sum +=
                (bends.turned[i] - (1 - share) * bends.turned[from] - share * bends.turned[to]).squaredNorm();
        }
        return sum;
    };
    std::vector<std::vector<double>> costs(last + 1, std::vector<double>(last + 1, infinite));
    for (std::size_t from = 0; from < last; ++from)
        for (std::size_t to = from + 1; to <= last; ++to) costs[from][to] = cost(from, to);
    std::vector<double> least = costs[0];
    std::vector<std::vector<std::size_t>> before(count, std::vector<std::size_t>(last + 1, 0));
    for (std::size_t n = 1; n < count; ++n) {
        std::vector<double> next(last + 1, infinite);
        for (std::size_t to = 1; to <= last; ++to) {
            for (std::size_t middle = 1; middle < to; ++middle) {
                const double sum = least[middle] + costs[middle][to];
                if (sum < next[to]) next[to] = sum, before[n][to] = middle;
            }
        }
        least = std::move(next);
    }
    if (!(least[last] < infinite)) return {};
    std::vector<std::size_t> cuts{last};
    for (std::size_t n = count; n-- > 1;) cuts.push_back(before[n][cuts.back()]);
    cuts.push_back(0);
    std::ranges::reverse(cuts);
    return cuts;
}

/// Moves the chain to the points, without another arc, by damped least squares (Levenberg, Marquardt).
ArcChain settled_on(const ArcChain& start, std::span<const CenterPoint> points, const ChainLimits& limits) {
    constexpr int max_steps = 12;
    constexpr double settled = 1e-4, step_size = 1e-6;
    ArcChain chain = start;
    double damping = 1e-3;
    Eigen::VectorXd off = residuals(chain, points, limits.radius);
    for (int step = 0; step < max_steps; ++step) {
        const Unknowns unknowns(chain);
        Eigen::MatrixXd jacobian(off.size(), unknowns.count());
        for (Eigen::Index i = 0; i < unknowns.count(); ++i) {
            Eigen::VectorXd by = Eigen::VectorXd::Zero(unknowns.count());
            by[i] = step_size;
            jacobian.col(i) =
                (residuals(unknowns.moved(by, limits.shortest), points, limits.radius) - off) / step_size;
        }
        const Eigen::MatrixXd normal = jacobian.transpose() * jacobian;
        const Eigen::VectorXd right = jacobian.transpose() * off;
        bool better = false;
        double gain = 0;
        for (int attempt = 0; attempt < 5 && !better; ++attempt, damping *= better ? 1 : 8) {
            Eigen::MatrixXd damped = normal;
            damped.diagonal() += damping * (normal.diagonal().array() + 1e-9).matrix();
            const ArcChain moved = unknowns.moved(-damped.ldlt().solve(right), limits.shortest);
            const Eigen::VectorXd there = residuals(moved, points, limits.radius);
            if (!(there.squaredNorm() < off.squaredNorm())) continue;
            gain = 1 - there.norm() / off.norm();
            chain = moved;
            off = there;
            better = true;
        }
        if (!better || gain < settled) break;
        damping = std::max(damping / 8, 1e-9);
    }
    return chain;
}

}  // namespace

std::optional<ArcChain> fit_arcs(std::span<const CenterPoint> points, const ChainLimits& limits,
                                 std::size_t count) {
    const Bends bends = bends_of(points);
    const std::vector<std::size_t> cuts = cut_evenly(points, bends, count, limits.shortest);
    if (cuts.empty()) return std::nullopt;
    std::vector<ChainArc> arcs;
    for (std::size_t i = 0; i < count; ++i) {
        const double length = points[cuts[i + 1]].along - points[cuts[i]].along;
        arcs.push_back({length, (bends.turned[cuts[i + 1]] - bends.turned[cuts[i]]) / length});
    }
    return settled_on({points[0].place, bends.frame, arcs}, points, limits);
}

std::optional<ArcChain> fit_fewest_arcs(std::span<const CenterPoint> points, const ChainLimits& limits) {
    double weight = 0;
    for (const CenterPoint& point : points) weight += point.weight;
    std::optional<ArcChain> best;
    for (std::size_t count = 2; count <= max_arcs; ++count) {
        std::optional<ArcChain> chain = fit_arcs(points, limits, count);
        if (!chain) break;
        best = std::move(chain);
        const double off = residuals(*best, points, limits.radius).squaredNorm();
        if (std::sqrt(off / weight) < limits.tolerance) break;
    }
    return best;
}

}  // namespace goffer::fit
