// SPDX-License-Identifier: MIT
#include "face_cutter.hpp"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace goffer::mesh {

/// Drops the coordinate along which the face's normal is longest. This is exact, and keeps what lies inside
/// of what. Returns false for a face without area, which has no plane.
bool FaceCutter::lay_flat(std::size_t first, std::size_t size) {
    const auto position = [&](std::size_t k) { return mesh_.positions[mesh_.corners[first + k]]; };
    const glm::dvec3 origin = position(0);
    glm::dvec3 normal(0);
    for (std::size_t k = 1; k + 1 < size; ++k)
        normal += glm::cross(glm::dvec3(position(k)) - origin, glm::dvec3(position(k + 1)) - origin);
    const glm::dvec3 size_of = glm::abs(normal);
    const int up = size_of.x >= size_of.y && size_of.x >= size_of.z ? 0 : size_of.y >= size_of.z ? 1 : 2;
    if (!(size_of[up] > 0)) return false;
    const int u = (up + (normal[up] > 0 ? 1 : 2)) % 3, v = (up + (normal[up] > 0 ? 2 : 1)) % 3;
    points_.clear();
    reach_ = 0;
    for (std::size_t k = 0; k < size; ++k) {
        const glm::dvec3 p = position(k);
        points_.emplace_back(p[u] - origin[u], p[v] - origin[v]);
        reach_ = std::max({reach_, std::fabs(p[u]), std::fabs(p[v])});
    }
    return true;
}

double FaceCutter::twice_area(Corner a, Corner b, Corner c) const {
    const glm::dvec2 ab = points_[b] - points_[a], ac = points_[c] - points_[a];
    return ab.x * ac.y - ab.y * ac.x;
}

/// How much of twice_area() may come from positions being floats.
double FaceCutter::rounding(Corner a, Corner b, Corner c) const {
    constexpr double unit = 4 * double{std::numeric_limits<float>::epsilon()};
    return unit * reach_ * (glm::distance(points_[a], points_[b]) + glm::distance(points_[b], points_[c]));
}

/// Whether a corner turns the other way, or back, as at the end of a slit, by more than rounding: faces that
/// were convex before they were rounded stay fans.
bool FaceCutter::concave() const {
    const auto size = static_cast<Corner>(points_.size());
    for (Corner b = 0; b < size; ++b) {
        const Corner a = (b + size - 1) % size, c = (b + 1) % size;
        const double area = twice_area(a, b, c), noise = rounding(a, b, c);
        const double onward = glm::dot(points_[b] - points_[a], points_[c] - points_[b]);
        if (area < -noise || (area <= noise && onward < -noise)) return true;
    }
    return false;
}

/// Whether `point` lies in the counterclockwise triangle a, b, c, its edges included unless `strictly`. A
/// corner of the triangle does not, nor one in its place: a face that goes around a hole comes by there
/// twice.
bool FaceCutter::holds(Corner a, Corner b, Corner c, Corner point, bool strictly) const {
    for (const Corner corner : {a, b, c})
        if (points_[corner] == points_[point]) return false;
    const double least =
        std::min({twice_area(a, b, point), twice_area(b, c, point), twice_area(c, a, point)});
    return strictly ? least > 0 : least >= 0;
}

/// Whether the triangle of a corner and its neighbors can be cut off: the corner is convex, and nothing else
/// of the face lies in it. If something does, then also a corner that is not convex, so that only these are
/// looked at, and most of them only at the triangle's box. `lenient` allows triangles without area and
/// corners on edges.
bool FaceCutter::is_ear(Corner corner, bool lenient) const {
    const Corner a = ring_.before[corner], c = ring_.after[corner];
    const double area = twice_area(a, corner, c);
    if (lenient ? area < -rounding(a, corner, c) : !(area > 0)) return false;
    const glm::dvec2 low = glm::min(glm::min(points_[a], points_[corner]), points_[c]);
    const glm::dvec2 high = glm::max(glm::max(points_[a], points_[corner]), points_[c]);
    return std::ranges::none_of(reflex_.corners, [&](Corner point) {
        const glm::dvec2 at = points_[point];
        if (at.x < low.x || at.x > high.x || at.y < low.y || at.y > high.y) return false;
        return holds(a, corner, c, point, lenient);
    });
}

/// Takes a corner into the list of those that are not convex, or out of it.
void FaceCutter::note_turn(Corner corner, bool convex) {
    std::size_t& place = reflex_.place[corner];
    if ((place == Reflex::none) == convex) return;
    if (convex) {
        const Corner last = reflex_.corners.back();
        reflex_.corners[place] = last;
        reflex_.place[last] = place;
        reflex_.corners.pop_back();
        reflex_.place[corner] = Reflex::none;
    } else {
        place = reflex_.corners.size();
        reflex_.corners.push_back(corner);
    }
}

void FaceCutter::find_ears(Corner start, bool lenient) {
    Corner corner = start;
    do {
        ears_[corner] = is_ear(corner, lenient);
        corner = ring_.after[corner];
    } while (corner != start);
}

void FaceCutter::clip(Corner corner, bool lenient) {
    const Corner a = ring_.before[corner], c = ring_.after[corner];
    triangles_.insert(triangles_.end(), {a, corner, c});
    ring_.after[a] = c;
    ring_.before[c] = a;
    --ring_.left;
    note_turn(corner, true);
    for (const Corner beside : {a, c})
        note_turn(beside, twice_area(ring_.before[beside], beside, ring_.after[beside]) > 0);
    for (const Corner beside : {a, c}) ears_[beside] = is_ear(beside, lenient);
}

/// Returns false where corners are left that are no ears: the face crosses itself.
bool FaceCutter::clip_ears() {
    const auto size = static_cast<Corner>(points_.size());
    ring_.before.resize(size);
    ring_.after.resize(size);
    for (Corner k = 0; k < size; ++k) {
        ring_.before[k] = (k + size - 1) % size;
        ring_.after[k] = (k + 1) % size;
    }
    ring_.left = size;
    reflex_.corners.clear();
    reflex_.place.assign(size, Reflex::none);
    for (Corner k = 0; k < size; ++k) note_turn(k, twice_area(ring_.before[k], k, ring_.after[k]) > 0);
    ears_.assign(size, false);
    triangles_.clear();
    Corner corner = 0;
    for (const bool lenient : {false, true}) {
        if (ring_.left > 3) find_ears(corner, lenient);
        for (std::size_t tried = 0; ring_.left > 3 && tried < ring_.left; ++tried) {
            const Corner next = ring_.after[corner];
            if (ears_[corner]) {
                clip(corner, lenient);
                tried = 0;
            }
            corner = next;
        }
    }
    if (ring_.left > 3) return false;
    triangles_.insert(triangles_.end(), {ring_.before[corner], corner, ring_.after[corner]});
    return true;
}

void FaceCutter::fan(std::size_t size) {
    triangles_.clear();
    for (Corner k = 1; k + 1 < size; ++k) triangles_.insert(triangles_.end(), {0, k, k + 1});
}

/// Area of all triangles, each counted as positive: no cut has less than the face.
double FaceCutter::covered() const {
    double sum = 0;
    for (std::size_t t = 0; t < triangles_.size(); t += 3)
        sum += std::fabs(twice_area(triangles_[t], triangles_[t + 1], triangles_[t + 2]));
    return sum;
}

std::span<const std::size_t> FaceCutter::placed(std::size_t first) {
    corners_.clear();
    for (const Corner corner : triangles_) corners_.push_back(first + corner);
    return corners_;
}

std::span<const std::size_t> FaceCutter::operator()(std::size_t first, std::size_t size) {
    const bool clipped = size > 3 && size <= max_corners && lay_flat(first, size) && concave() && clip_ears();
    if (!clipped) {
        fan(size);
        return placed(first);
    }
    const double ears = covered();
    std::swap(triangles_, clipped_);
    fan(size);
    if (ears < covered()) std::swap(triangles_, clipped_);
    return placed(first);
}

}  // namespace goffer::mesh
