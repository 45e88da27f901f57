// SPDX-License-Identifier: MIT
#pragma once

#include <goffer/bend/region.hpp>
#include <goffer/bend/rest_vertex.hpp>

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include <span>

/// What Body::make makes a body from, and the numbers that it takes. fit::bind fills it in; so may a pipeline
/// of one's own.

namespace goffer::bend {

/// What a body is made from. Body::make copies what the spans refer to.
struct BodyInput {
    glm::dvec3 origin{0};  ///< center of the base end, model space
    glm::dmat3 axes{1};    ///< e1, e2, e3 of the body frame, orthonormal to 1e-6, right-handed
    double radius = 0;     ///< r > 0, model units
    std::span<const RegionInput> regions;  ///< from base to tip, 1..max_regions
    /// At least one; all of a region's, then all of the next one's. See RegionInput::blend.
    std::span<const RestVertex> vertices;
    std::span<const RestVector> normals;   ///< one per vertex, of unit length: squares within 1e-3 of 1
    std::span<const RestVector> tangents;  ///< none, or one per vertex, likewise
    std::span<const float> tangent_signs;  ///< as many as tangents: w, the bitangent's sign
};

/// The range of numbers that Body::check accepts. Within it, no number on the way to the outputs leaves
/// float's range, in any pose and under any transform with numbers up to 1e6. (Positions and normals stand
/// transforms up to 1e18. Tangents do, too, unless wrinkles are as steep as is allowed here.) Lengths are in
/// model units.
///
/// The depth of a wrinkle is not computed but bounded, by the sum of the largest absolute values of a row's
/// terms. For tables that fit makes, the bound is up to five times the depth; in a region with a rest angle
/// or an onset, up to two hundred times. Terms are bounded, too: what kernels make of them stays below 1e36.
struct WorkingRange {
    static constexpr double min_length = 1e-12;   ///< least length of a region; least radius
    static constexpr double max_length = 1e12;    ///< largest length of a region, radius, and rho of a vertex
    static constexpr double max_origin = 1e15;    ///< largest |origin| on each axis
    static constexpr double min_angle = 1e-12;    ///< least max_angle of a region and of its tables, radians
    static constexpr double max_angle = 1000;     ///< largest max_angle, |rest_direction| and |beta|, radians
    static constexpr double max_rest = 1 - 1e-5;  ///< largest rest_angle over length / (2 radius max_scale)
    /// The same where wrinkles pass between regions that are bent along different arcs at rest.
    static constexpr double max_joint_rest = 0.98;
    static constexpr double max_wrinkle = 1e18;    ///< largest |wrinkle| and |slope|, 1 / model units
    static constexpr double max_scale = 1e3;       ///< largest scale of a vertex, and of 1 / scale
    static constexpr double max_taper = 1e3;       ///< largest |scale_slope| times the length over the scale
    static constexpr double max_blend_gain = 1e3;  ///< largest blend_gain, and 1 / blend_gain
    static constexpr double max_depth = 1e15;      ///< deepest wrinkle that a table may ask for
    static constexpr double max_growth = 1e6;  ///< largest factor that a wrinkle may stretch the surface by
    /// Largest distance of a vertex from the axis, with the deepest wrinkle added, as a multiple of the arc's
    /// radius length / max_angle. (From 1 on the body folds through itself.)
    static constexpr double max_radius_ratio = 1e4;
};

}  // namespace goffer::bend
