// SPDX-License-Identifier: MIT
#pragma once

#include <goffer/bend/fault.hpp>
#include <goffer/bend/region.hpp>

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

/// A body: a mesh bound to its base cylinder, which is a chain of one or more regions. goffer::fit::bind
/// makes one offline; all instances share it.

namespace goffer::bend {

/// One vertex at rest, in cylinder coordinates of its region. A region that is bent at rest is straightened
/// first. For g and w see modules/paper/README.md, "Wrinkle".
struct RestVertex {
    double beta = 0;  ///< direction about the axis, radians
    double z = 0;     ///< height along its region, 0..length, model units; may be off by length / 1000
    double rho = 0;   ///< distance from the axis, model units
    /// g w / rho, 1 / model units: a wrinkle of amplitude A takes the vertex to rho (1 + A wrinkle). Finite
    /// on the axis, where w / rho = 2 / (s r), with s the scale below.
    double wrinkle = 0;
    double slope = 0;  ///< d(g w) / dz, 1 / model units
    /// These three are of the body's shape at z: see modules/paper/README.md, "Shaped bodies".
    double scale = 1;        ///< s > 0: the radius there over the region's
    double scale_slope = 0;  ///< ds / dz, 1 / model units
    double drift = 0;  ///< D: integral of the radius there less the region's, from 0 to z, units squared;
    ///< at most length radius max_scale, either way
};

/// A rest normal's or tangent's components along (e_rho, e_beta, e_z) at its vertex. In a region that is bent
/// at rest, a normal is straightened by the transpose of the bend's Jacobian, a tangent by its inverse.
struct RestVector {
    double rho = 0;
    double beta = 0;
    double z = 0;
};

/// What a body is made from. Body::make copies what the spans refer to.
struct BodyInput {
    glm::dvec3 origin{0};  ///< center of the base end, model space
    glm::dmat3 axes{1};    ///< columns e1, e2, e3 of the body frame, orthonormal, right-handed
    double radius = 0;     ///< r > 0, model units
    std::span<const RegionInput> regions;  ///< from base to tip, 1..max_regions
    std::span<const RestVertex> vertices;  ///< at least one; all of a region's, then all of the next one's
    std::span<const RestVector> normals;   ///< one per vertex, of unit length
    std::span<const RestVector> tangents;  ///< none, or one per vertex, of unit length
    std::span<const float> tangent_signs;  ///< as many as tangents: w, the bitangent's sign
};

/// The range of numbers that Body::check accepts. Within it, no number on the way to the outputs leaves
/// float's range, in any pose and under any transform with numbers up to 1e6. (Positions and normals stand
/// transforms up to 1e18. Tangents do, too, unless wrinkles are as steep as is allowed here.) Lengths are in
/// model units.
///
/// The depth of a wrinkle is not computed but bounded, by the sum of the largest absolute values of a row's
/// terms. For tables that fit makes, the bound is up to five times the depth; in a region with a rest angle
/// or an onset, up to two hundred times.
struct WorkingRange {
    static constexpr double min_length = 1e-12;   ///< least length of a region; least radius
    static constexpr double max_length = 1e12;    ///< largest length of a region, radius, and rho of a vertex
    static constexpr double max_origin = 1e15;    ///< largest |origin| on each axis
    static constexpr double min_angle = 1e-12;    ///< least max_angle of a region and of its tables, radians
    static constexpr double max_angle = 1000;     ///< largest max_angle and |rest_direction|, radians
    static constexpr double max_rest = 1 - 1e-5;  ///< largest rest_angle, as a share of length / (2 radius)
    static constexpr double max_wrinkle = 1e18;   ///< largest |wrinkle| and |slope|, 1 / model units
    static constexpr double max_scale = 1e3;      ///< largest scale of a vertex, and of 1 / scale
    static constexpr double max_taper = 1e3;      ///< largest |scale_slope| times the length over the scale
    static constexpr double max_depth = 1e15;     ///< deepest wrinkle that a table may ask for
    static constexpr double max_growth = 1e6;  ///< largest factor that a wrinkle may stretch the surface by
    /// Largest distance of a vertex from the axis, with the deepest wrinkle added, as a multiple of the arc's
    /// radius length / max_angle. (From 1 on the body folds through itself.)
    static constexpr double max_radius_ratio = 1e4;
};

/// The part of a BodyInput that is at fault. From `length` to `factors`: a member of a region; from `beta` to
/// `drift`: a member of a vertex.
enum class BodyField : std::uint8_t {
    none,
    origin,
    axes,
    radius,
    regions,  ///< how many there are
    length,
    region_radius,
    max_scale,
    max_angle,
    rest_angle,
    rest_direction,
    onset,
    table,
    factors,
    vertex_count,  ///< of all regions together
    vertices,      ///< how many there are
    beta,
    z,
    rho,
    wrinkle,
    slope,
    scale,
    scale_slope,
    drift,
    normals,
    tangents,
    tangent_signs,
};

/// The first fault of a BodyInput. A plain value; a default-made one is none.
struct BodyFault {
    static constexpr std::size_t nowhere = Fault::nowhere;

    BodyField field = BodyField::none;
    Reason reason = Reason::none;
    /// Which region, vertex, normal, tangent or tangent sign. `nowhere`: the body, or all of them.
    std::size_t index = nowhere;

    [[nodiscard]] bool none() const noexcept { return reason == Reason::none; }
    [[nodiscard]] bool operator==(const BodyFault&) const noexcept = default;
};

/// Says in one line what is wrong, where, and what was wanted, as in "regions[2].max_angle: not finite; ...".
/// Says "no fault" of none. Does not allocate. Thread-safe.
[[nodiscard]] FaultText describe(const BodyFault& fault) noexcept;

struct BodyData;

/// An immutable body. Move-only; jobs and threads share it by reference. All functions are thread-safe, and
/// do not allocate unless they say so.
///
/// Vertices keep the order that they were given in: vertex i of the body is vertex i of every output stream.
/// A body that was default-made or moved from is empty: it has no vertices and no regions, and validate()
/// refuses it.
class Body {
public:
    Body() noexcept;
    /// For goffer's own sources.
    explicit Body(std::unique_ptr<const BodyData> data) noexcept;
    Body(Body&& other) noexcept;
    Body& operator=(Body&& other) noexcept;
    ~Body();

    /// Finds the first thing in `input` that is missing, not finite, contradictory or outside WorkingRange.
    /// No fault: make() can make a body from it.
    [[nodiscard]] static BodyFault check(const BodyInput& input) noexcept;

    /// Makes a body, or returns nothing where check(input) finds a fault. Allocates; may throw
    /// std::bad_alloc.
    [[nodiscard]] static std::optional<Body> make(const BodyInput& input);

    [[nodiscard]] bool empty() const noexcept { return data_ == nullptr; }
    [[nodiscard]] std::size_t vertex_count() const noexcept;
    [[nodiscard]] bool has_tangents() const noexcept;
    /// From base to tip; at least one, unless the body is empty.
    [[nodiscard]] std::span<const Region> regions() const noexcept;
    /// What the regions were made from, unrounded. Together with origin(), axes() and radius() this is all of
    /// a BodyInput but its vertices. A body made from it deforms a vertex with the same rest coordinates to
    /// the same bits.
    [[nodiscard]] std::span<const RegionInput> region_inputs() const noexcept;
    [[nodiscard]] std::size_t region_count() const noexcept { return regions().size(); }
    /// Length of all regions together, model units.
    [[nodiscard]] double length() const noexcept;
    /// Radius of the base cylinder, model units.
    [[nodiscard]] double radius() const noexcept;
    /// Region::max_angle of region `region` < region_count().
    [[nodiscard]] float max_angle(std::size_t region = 0) const noexcept;
    /// Region::rest of region `region` < region_count().
    [[nodiscard]] Pose rest_pose(std::size_t region = 0) const noexcept;
    /// rest_pose() of each region: the poses that give the rest shape back. Allocates.
    [[nodiscard]] std::vector<Pose> rest_poses() const;
    /// Center of the base end, model space. An empty body has origin and axes of a default-made BodyInput.
    [[nodiscard]] glm::dvec3 origin() const noexcept;
    /// Columns e1, e2, e3 of the body frame, in model space.
    [[nodiscard]] glm::dmat3 axes() const noexcept;
    /// Bytes of memory that the body takes, itself included. Columns that lie in a body file do not count.
    [[nodiscard]] std::size_t bytes() const noexcept;
    /// For goffer's own sources; null if the body is empty.
    [[nodiscard]] const BodyData* data() const noexcept { return data_.get(); }

private:
    std::unique_ptr<const BodyData> data_;
};

}  // namespace goffer::bend
