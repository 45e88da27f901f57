// SPDX-License-Identifier: MIT
#pragma once

#include "mask.hpp"

#include <goffer/fit/cylinder.hpp>
#include <goffer/fit/geometry.hpp>
#include <goffer/paper/closed_form.hpp>

#include <array>
#include <cstddef>
#include <functional>
#include <limits>
#include <span>
#include <vector>

namespace goffer::fit {

/// Where a part lies in a cross-section, and how thick it is there. Lengths are in radii of the base.
struct Disc {
    double x = 0, y = 0;  ///< its center
    double radius = 0;    ///< mean distance of its outline from there
    double reach = 0;     ///< greatest distance
    double size = 0;      ///< geometric mean of the radius and of half its thickness: plates are thin
    double beside = 0;    ///< 0: the axis runs through it; 1: beside it
};

/// Points of an outline, in radii of the base.
struct OutlinePoints {
    static constexpr std::size_t count = 8;  ///< one may be there more than once
    std::array<float, count> x, y;
};

/// How much of its wrinkle each part of a body can bear. A base cylinder knows one radius at each height; a
/// mesh may have a thin stem there, a leg beside the axis, or hairs. A wrinkle moves what lies beside
/// the axis as a whole, so that a thin part would go to and fro by more than it is thick. Parts are what the
/// cross-sections of the mesh fall into. Weights pass into each other over a length that grows with the
/// wrinkle's depth, so that surfaces that lie one behind the other never pass through each other. A function
/// of the place alone, so that all meshes of a rig agree. A plain value.
class Parts {
public:
    /// Neither is needed afterward.
    Parts(const Geometry& geometry, const Cylinder& cylinder);

    /// How deep the wrinkle of the inner line is at a height; model units.
    using Depth = std::function<double(double)>;

    /// Sets weights with which every part bears its wrinkle. `depth`: in the pose that parts are to bear;
    /// `deepest`: in any.
    /// `ease`: how many times as much as usual each part bears.
    void weigh(const Depth& depth, const Depth& deepest, double ease = 1);

    /// Returns how far from the axis the mesh reaches between two heights; model units. At least as far as it
    /// does.
    [[nodiscard]] double outermost(double low, double high) const;

    /// Returns the weight of the wrinkle at a place, straightened: -1..1, and how it changes along z.
    [[nodiscard]] MaskValue at(const paper::Cylindrical& place) const;

    /// Whether every part bears all of its wrinkle.
    [[nodiscard]] bool sound() const { return sound_; }

private:
    /// A part in a cross-section. Lengths are in radii of the base.
    struct Part {
        Disc disc;
        double moved;                        // by how much of the depth of a wrinkle its center moves
        double share;                        // how much it counts beside others as near
        std::vector<OutlinePoints> outline;  // all along it
        double distance = std::numeric_limits<double>::infinity();  // of the outline from thicker parts
        double weight = 1;
        double priority = 1;  // of its weight before those of others
    };

    struct Slice {
        std::vector<Part> parts;
        double blend = 0;   // over which weights pass into each other
        bool sound = true;  // whether each part bears all of its wrinkle
    };

    /// Weights of the parts of a slice, each times how near it is, and how near all are together.
    struct Near {
        double weight = 0, all = 0;
    };

    static void measure_distances(Slice& slice);
    [[nodiscard]] static double distance(std::span<const Part> parts, double x, double y);
    [[nodiscard]] static Near near(const Slice& slice, double x, double y);

    std::vector<Slice> slices_;
    double radius_ = 1;  // of the base
    double step_ = 0;    // from one slice to the next; the first is half of it above the base
    double reach_ = 0;   // how far along z a weight is spread
    bool sound_ = true;
};

}  // namespace goffer::fit
