// SPDX-License-Identifier: MIT
#pragma once

#include "mask.hpp"

#include <goffer/fit/cylinder.hpp>
#include <goffer/fit/geometry.hpp>
#include <goffer/paper/closed_form.hpp>

#include <functional>
#include <vector>

namespace goffer::fit {

/// How much of its wrinkle each part of a body can bear. A base cylinder knows one radius at each height; a
/// mesh may have a thin stem there, a leg beside the axis, or hairs. A wrinkle moves what lies beside
/// the axis as a whole, so that a thin part would go to and fro by more than it is thick. Parts are what the
/// cross-sections of the mesh fall into. A function of the place alone, so that all meshes of a rig agree. A
/// plain value.
class Parts {
public:
    /// Neither is needed afterward.
    Parts(const Geometry& geometry, const Cylinder& cylinder);

    /// Sets weights with which every part bears its wrinkle. `depth`: of the wrinkle of the inner line at a
    /// height, in the pose that parts are to bear; model units.
    void weigh(const std::function<double(double)>& depth);

    /// Returns the weight of the wrinkle at a place, straightened: -1..1, and how it changes along z.
    [[nodiscard]] MaskValue at(const paper::Cylindrical& place) const;

    /// Whether every part bears all of its wrinkle.
    [[nodiscard]] bool sound() const { return sound_; }

private:
    /// A part in a cross-section.
    struct Part {
        double x, y;    // its center
        double radius;  // mean distance of its outline from there
        double moved;   // by how much of the depth of a wrinkle its center moves
        double weight;
    };

    /// Weights of the parts of a slice, each times how near it is, and how near all are together.
    struct Near {
        double weight = 0, all = 0;
    };

    [[nodiscard]] Near near(const std::vector<Part>& slice, double x, double y) const;

    std::vector<std::vector<Part>> slices_;
    double step_ = 0;   // from one to the next; the first is half of it above the base
    double reach_ = 0;  // how far along z a weight is spread
    bool sound_ = true;
};

}  // namespace goffer::fit
