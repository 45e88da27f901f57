// SPDX-License-Identifier: MIT
#pragma once

#include <goffer/bend/table.hpp>
#include <goffer/engine/columns.hpp>

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

/// A body: a mesh bound to its base cylinder. Made once, offline (goffer::fit::bind), shared by all its
/// instances.

namespace goffer::bend {

/// One vertex at rest, in cylinder coordinates of the body frame.
struct RestVertex {
    double beta = 0;  ///< direction about the axis, radians
    double z = 0;     ///< height along the axis, 0..length, model units
    double rho = 0;   ///< distance from the axis, model units
    double wrinkle =
        0;  ///< g w / rho: rho' = rho (1 + amplitude * wrinkle); finite on the axis, where w / rho = 2 / r
    double slope = 0;  ///< d(g w) / dz, 1 / model units
};

/// A rest normal's or tangent's components along (e_rho, e_beta, e_z) at its vertex.
struct RestVector {
    double rho = 0;
    double beta = 0;
    double z = 0;
};

/// What a body is made from. The spans are the caller's and are copied.
struct BodyInput {
    glm::dvec3 origin{0};  ///< centre of the base end, model space
    glm::dmat3 axes{1};    ///< columns e1, e2, e3 of the body frame, orthonormal, right-handed
    double length = 0;     ///< L > 0, model units
    double radius = 0;     ///< r > 0, model units
    double max_angle = 0;  ///< radians, > 0 and < length / (2 radius) (1 + 1e-6)
    WrinkleTable table;    ///< empty: no wrinkle
    std::span<const RestVertex> vertices;  ///< at least one
    std::span<const RestVector> normals;   ///< one per vertex, of unit length
    std::span<const RestVector> tangents;  ///< none, or one per vertex, of unit length
    std::span<const float> tangent_signs;  ///< as many as tangents: w, the bitangent's sign
};

/// What is wrong with a BodyInput. describe() names the field and what it should be.
enum class BodyFault : std::uint8_t {
    none,
    origin,
    axes,
    length,
    radius,
    max_angle,
    table,
    vertices,
    normals,
    tangents,
    tangent_signs
};

/// One line on `fault`, in static storage. Thread-safe.
[[nodiscard]] std::string_view describe(BodyFault fault) noexcept;

/// A body's frame and size in float: what an instance's set-up reads.
struct BodyFrame {
    float axes[3][4] = {};  ///< e1, e2, e3, each followed by a 0
    float origin[4] = {};   ///< centre of the base end, followed by a 0
    float length = 1;
    float per_length = 1;  ///< 1 / length
    float radius = 1;
};

/// What bounds() needs to know of the vertices in a band of z: one of `count` between the lowest and the
/// highest vertex. Band j is at place j + 1; the places around them are empty.
struct Bands {
    static constexpr std::size_t count = 11;
    static constexpr std::size_t places = 16;
    float lowest = 0;                  ///< v = z / L - 1/2 where the first band begins
    float highest = 0;                 ///< and where the last one ends
    std::array<float, places> rho{};   ///< largest distance from the axis, model units; below 0: no vertex
    std::array<float, places> lift{};  ///< largest g w, at least 0
    std::array<float, places> dip{};   ///< largest -g w, at least 0
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
        lift,     ///< g w: rho' = rho + amplitude * lift
        height,   ///< z / L - 1/2
        wrinkle,  ///< g w / rho
        slope,    ///< d(g w) / dz
        normal_rho,
        normal_beta,
        normal_z,
        tangent_rho,
        tangent_beta,
        tangent_z,
        tangent_sign,
        column_count,
        column_count_without_tangents = tangent_rho,
    };

    /// Checks `input`; BodyFault::none if a body can be made from it. Does not allocate.
    [[nodiscard]] static BodyFault check(const BodyInput& input) noexcept;

    /// Makes a body, or nothing where `check(input)` finds a fault. Allocates; may throw std::bad_alloc.
    [[nodiscard]] static std::optional<Body> make(const BodyInput& input);

    [[nodiscard]] std::size_t vertex_count() const noexcept { return columns_.count(); }
    [[nodiscard]] bool has_tangents() const noexcept { return columns_.columns() == column_count; }
    [[nodiscard]] double length() const noexcept { return length_; }
    [[nodiscard]] double radius() const noexcept { return radius_; }
    /// The largest usable |angle|, radians: beyond it the body would fold through itself, and poses are
    /// clamped to it.
    [[nodiscard]] float max_angle() const noexcept { return max_angle_; }
    [[nodiscard]] const glm::dvec3& origin() const noexcept { return origin_; }
    [[nodiscard]] const glm::dmat3& axes() const noexcept { return axes_; }
    [[nodiscard]] const WrinkleTable& table() const noexcept { return table_; }
    /// origin(), axes(), length() and radius(), rounded.
    [[nodiscard]] const BodyFrame& frame() const noexcept { return frame_; }
    /// The vertices' extent, band by band.
    [[nodiscard]] const Bands& bands() const noexcept { return bands_; }
    /// Bytes of memory that the body holds.
    [[nodiscard]] std::size_t bytes() const noexcept;

    /// A column, aligned and padded as Columns says. Tangent columns exist only where has_tangents().
    [[nodiscard]] std::span<const float> column(Column column) const noexcept { return columns_[column]; }

private:
    Body() = default;

    Columns columns_;
    WrinkleTable table_;
    Bands bands_;
    BodyFrame frame_;
    glm::dvec3 origin_{0};
    glm::dmat3 axes_{1};
    double length_ = 1;
    double radius_ = 1;
    float max_angle_ = 0;
};

}  // namespace goffer::bend
