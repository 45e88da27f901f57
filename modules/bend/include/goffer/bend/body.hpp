// SPDX-License-Identifier: MIT
#pragma once

#include <goffer/bend/region.hpp>
#include <goffer/engine/columns.hpp>

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

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
    glm::dvec3 origin{0};  ///< centre of the base end, model space
    glm::dmat3 axes{1};    ///< columns e1, e2, e3 of the body frame, orthonormal, right-handed
    double radius = 0;     ///< r > 0, model units
    std::span<const RegionInput> regions;  ///< from base to tip, 1..max_regions
    std::span<const RestVertex> vertices;  ///< at least one; those of a region after those of the one before
    std::span<const RestVector> normals;   ///< one per vertex, of unit length
    std::span<const RestVector> tangents;  ///< none, or one per vertex, of unit length
    std::span<const float> tangent_signs;  ///< as many as tangents: w, the bitangent's sign
};

/// What is wrong with a BodyInput. describe() names the field and what it should be.
enum class BodyFault : std::uint8_t {
    none,
    origin,
    axes,
    radius,
    regions,
    region_length,
    region_max_angle,
    region_rest,
    region_onset,
    region_table,
    region_factors,
    region_vertices,
    vertices,
    normals,
    tangents,
    tangent_signs
};

/// One line on `fault`, in static storage. Thread-safe.
[[nodiscard]] std::string_view describe(BodyFault fault) noexcept;

/// Where a region begins: axes and origin in float, model space.
struct Joint {
    float axes[3][4];  ///< e1, e2, e3, each followed by a 0
    float origin[4];   ///< centre of the cross-section, followed by a 0
};

/// A body's frame and size in float: what an instance's set-up reads.
struct BodyFrame {
    Joint base = {};  ///< of the whole: where the first region begins
    float radius = 1;
};

/// An immutable body. Move-only; share it by reference among jobs and threads. All functions are thread-safe.
///
/// Vertices keep the order they were given in: vertex i of the body is vertex i of every output stream.
class Body {
public:
    /// The columns that kernels read, one value per vertex.
    enum Column : std::size_t {
        cos_half_beta,  ///< sqrt(2) cos(beta / 2)
        sin_half_beta,  ///< sqrt(2) sin(beta / 2)
        rho,
        lift,     ///< g w S, S of the column at rest: rho' = rho + amplitude * lift
        height,   ///< z / L - 1/2, of its region
        wrinkle,  ///< g w S / rho
        slope,    ///< d(g w S) / dz
        normal_rho,
        normal_beta,
        normal_z,
        tangent_rho,
        tangent_beta,
        tangent_z,
        tangent_sign,
        cos_beta,     ///< cos(beta)
        sin_beta,     ///< sin(beta)
        rest_cosine,  ///< cos(beta) / S
        rest_sine,    ///< sin(beta) / S
    };

    /// Checks `input`; BodyFault::none if a body can be made from it. Does not allocate.
    [[nodiscard]] static BodyFault check(const BodyInput& input) noexcept;

    /// Makes a body, or nothing where `check(input)` finds a fault. Allocates; may throw std::bad_alloc.
    [[nodiscard]] static std::optional<Body> make(const BodyInput& input);

    [[nodiscard]] std::size_t vertex_count() const noexcept { return columns_.count(); }
    [[nodiscard]] bool has_tangents() const noexcept { return has_tangents_; }
    /// From base to tip; at least one.
    [[nodiscard]] std::span<const Region> regions() const noexcept {
        return {regions_.data(), region_count_};
    }
    [[nodiscard]] std::size_t region_count() const noexcept { return region_count_; }
    /// Of all regions together.
    [[nodiscard]] double length() const noexcept { return length_; }
    [[nodiscard]] double radius() const noexcept { return radius_; }
    /// The largest usable |angle| of a region, region < region_count(), radians: beyond it the body would
    /// fold through itself, and poses are clamped to it.
    [[nodiscard]] float max_angle(std::size_t region = 0) const noexcept {
        return regions_[region].max_angle;
    }
    /// The pose of a region, region < region_count(), that returns the rest mesh.
    [[nodiscard]] Pose rest_pose(std::size_t region = 0) const noexcept { return regions_[region].rest; }
    [[nodiscard]] const glm::dvec3& origin() const noexcept { return origin_; }
    [[nodiscard]] const glm::dmat3& axes() const noexcept { return axes_; }
    /// origin(), axes() and radius(), rounded.
    [[nodiscard]] const BodyFrame& frame() const noexcept { return frame_; }
    /// Bytes of memory that the body holds.
    [[nodiscard]] std::size_t bytes() const noexcept;

    /// A column, aligned and padded as Columns says. Tangent columns exist only where has_tangents(),
    /// those from cos_beta on only where a region compares_with_rest.
    [[nodiscard]] std::span<const float> column(Column column) const noexcept {
        return columns_[column < cos_beta || has_tangents_ ? column : column - (cos_beta - tangent_rho)];
    }

private:
    Body() = default;

    Columns columns_;
    std::vector<Region> regions_;
    std::size_t region_count_ = 0;  // the vector would divide to know
    BodyFrame frame_;
    glm::dvec3 origin_{0};
    glm::dmat3 axes_{1};
    double length_ = 1;
    double radius_ = 1;
    bool has_tangents_ = false;
};

}  // namespace goffer::bend
