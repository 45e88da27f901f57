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

/// A body: a mesh bound to its base cylinder, which is a chain of one or more regions. Made once, offline
/// (goffer::fit::bind), shared by all its instances.

namespace goffer::bend {

/// One vertex at rest, in cylinder coordinates of its region: where the region is bent at rest, those of the
/// point that it would be at if straightened.
struct RestVertex {
    double beta = 0;  ///< direction about the axis, radians
    double z = 0;     ///< height along its region, 0..the region's length, model units
    double rho = 0;   ///< distance from the axis, model units
    double wrinkle =
        0;  ///< g w / rho: rho' = rho (1 + amplitude * wrinkle); finite on the axis, where w / rho = 2 / r
    double slope = 0;  ///< d(g w) / dz, 1 / model units
};

/// A rest normal's or tangent's components along (e_rho, e_beta, e_z) at its vertex, straightened as that is:
/// a normal by the transpose of the rest bend's Jacobian, a tangent by its inverse.
struct RestVector {
    double rho = 0;
    double beta = 0;
    double z = 0;
};

/// What a body is made from. The spans are the caller's and are copied.
struct BodyInput {
    glm::dvec3 origin{0};  ///< center of the base end, model space
    glm::dmat3 axes{1};    ///< columns e1, e2, e3 of the body frame, orthonormal, right-handed
    double radius = 0;     ///< r > 0, model units
    std::span<const RegionInput> regions;  ///< from base to tip, 1..max_regions
    std::span<const RestVertex> vertices;  ///< at least one; those of a region after those of the one before
    std::span<const RestVector> normals;   ///< one per vertex, of unit length
    std::span<const RestVector> tangents;  ///< none, or one per vertex, of unit length
    std::span<const float> tangent_signs;  ///< as many as tangents: w, the bitangent's sign
};

/// The working range: what Body::check accepts, so that in every pose, under a transform with numbers up to
/// 1e6, no number on the way to the outputs leaves float's range. (Positions and normals bear transforms up
/// to 1e18; tangents do where wrinkles are not as steep as is allowed here.) Lengths are in model units.
///
/// Wrinkles are judged by a bound, not by their true depth: by the sum of a row's terms, all taken as
/// positive and at their largest. For tables that fit makes it is up to five times the depth, and up to two
/// hundred times in a region with a rest angle or an onset.
struct WorkingRange {
    static constexpr double min_length = 1e-12;   ///< of a region, and least radius
    static constexpr double max_length = 1e12;    ///< of a region; most radius, and most rho of a vertex
    static constexpr double max_origin = 1e15;    ///< |origin| on each axis
    static constexpr double min_angle = 1e-12;    ///< least max_angle, of a region and of its tables, radians
    static constexpr double max_angle = 1000;     ///< most max_angle; most |rest_direction|, radians
    static constexpr double max_rest = 1 - 1e-5;  ///< most rest_angle, as a share of length / (2 radius)
    static constexpr double max_wrinkle = 1e18;   ///< |wrinkle| and |slope| of a vertex, 1 / model units
    static constexpr double max_depth = 1e15;     ///< deepest wrinkle that a table may ask for
    static constexpr double max_growth = 1e6;     ///< what a wrinkle may stretch the surface by
    /// What a vertex's distance from the axis, lifted by the deepest wrinkle, may be of the arc's radius
    /// length / max_angle. (From 1 on the body folds through itself.)
    static constexpr double max_radius_ratio = 1e4;
};

/// What of a BodyInput is wrong.
enum class BodyField : std::uint8_t {
    none,
    origin,
    axes,
    radius,
    regions,  ///< how many there are
    length,   ///< this and those up to vertex_count: of a region
    max_angle,
    rest_angle,
    rest_direction,
    onset,
    table,
    factors,
    vertex_count,  ///< of all regions together
    vertices,      ///< how many there are
    beta,          ///< this and those up to slope: of a vertex
    z,
    rho,
    wrinkle,
    slope,
    normals,
    tangents,
    tangent_signs,
};

/// The first fault of a BodyInput. A plain value; a default-made one is none.
struct BodyFault {
    static constexpr std::size_t nowhere = Fault::nowhere;

    BodyField field = BodyField::none;
    Reason reason = Reason::none;
    /// Of the region, vertex, normal or tangent. Nowhere: of the body, or of all of them.
    std::size_t index = nowhere;

    [[nodiscard]] bool none() const noexcept { return reason == Reason::none; }
    [[nodiscard]] bool operator==(const BodyFault&) const noexcept = default;
};

/// `fault` in words: what, where, and what it should be, as in "regions[2].max_angle: not finite; ...".
/// "no fault" for none. Does not allocate. Thread-safe.
[[nodiscard]] FaultText describe(const BodyFault& fault) noexcept;

struct BodyData;

/// An immutable body. Move-only; share it by reference among jobs and threads. All functions are thread-safe.
///
/// Vertices keep the order they were given in: vertex i of the body is vertex i of every output stream. A
/// body that was default-made or moved from is empty: it has no vertices and no regions, and validate()
/// refuses it.
class Body {
public:
    Body() noexcept;
    Body(Body&& other) noexcept;
    Body& operator=(Body&& other) noexcept;
    ~Body();

    /// The first fault of `input`: what is missing, not finite, contradictory or outside WorkingRange. None
    /// if a body can be made from it. Does not allocate.
    [[nodiscard]] static BodyFault check(const BodyInput& input) noexcept;

    /// Makes a body, or nothing where `check(input)` finds a fault. Allocates; may throw std::bad_alloc.
    [[nodiscard]] static std::optional<Body> make(const BodyInput& input);

    [[nodiscard]] bool empty() const noexcept { return data_ == nullptr; }
    [[nodiscard]] std::size_t vertex_count() const noexcept;
    [[nodiscard]] bool has_tangents() const noexcept;
    /// From base to tip; of a body that is not empty, at least one.
    [[nodiscard]] std::span<const Region> regions() const noexcept;
    /// What the regions were made from, unrounded. With origin(), axes() and radius() that is all of a
    /// BodyInput but its vertices: a body made from them deforms a vertex of the same rest coordinates to the
    /// same bits.
    [[nodiscard]] std::span<const RegionInput> region_inputs() const noexcept;
    [[nodiscard]] std::size_t region_count() const noexcept { return regions().size(); }
    /// Of all regions together, model units.
    [[nodiscard]] double length() const noexcept;
    [[nodiscard]] double radius() const noexcept;
    /// Region::max_angle of region `region` < region_count().
    [[nodiscard]] float max_angle(std::size_t region = 0) const noexcept;
    /// Region::rest of region `region` < region_count().
    [[nodiscard]] Pose rest_pose(std::size_t region = 0) const noexcept;
    /// Center of the base end, model space. An empty body has the frame of a default-made BodyInput.
    [[nodiscard]] glm::dvec3 origin() const noexcept;
    /// Columns e1, e2, e3 of the body frame.
    [[nodiscard]] glm::dmat3 axes() const noexcept;
    /// Bytes of memory that the body holds.
    [[nodiscard]] std::size_t bytes() const noexcept;
    /// For the runtime's own files; null of an empty body.
    [[nodiscard]] const BodyData* data() const noexcept { return data_.get(); }

private:
    std::unique_ptr<const BodyData> data_;
};

}  // namespace goffer::bend
