// SPDX-License-Identifier: MIT
#pragma once

#include <goffer/bend/body_fault.hpp>
#include <goffer/bend/region.hpp>

#include <glm/fwd.hpp>
#include <glm/vec3.hpp>

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

/// A body: a mesh bound to its base cylinder, which is a chain of one or more regions. goffer::fit::bind
/// makes one offline; all instances share it. What it is made from is in body_input.hpp.

namespace goffer::bend {

struct BodyData;
struct BodyInput;

/// An immutable body. Move-only; jobs and threads share it by reference. All functions are thread-safe, and
/// do not allocate unless they say so.
///
/// Vertices keep the order that they were given in: vertex i of the body is vertex i of every output stream.
/// (fit::bind() sorts the vertices of several regions by region: see Binding::order.)
/// A body that was default-constructed or moved from is empty: it has no vertices and no regions, and
/// validate() refuses it.
class Body {
public:
    Body() noexcept;
    /// For goffer's own sources: takes `data`, which was made with new.
    explicit Body(const BodyData* data) noexcept;
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
    /// a BodyInput but what it has of its vertices. A body made from it deforms a vertex with the same rest
    /// coordinates to the same position, bit for bit; normals differ in last bits where one of the bodies has
    /// a shape (a vertex with scale other than 1, or scale_slope or drift other than 0), and the other none.
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
    /// Center of the base end, model space. An empty body has origin and axes of a default-constructed
    /// BodyInput.
    [[nodiscard]] glm::dvec3 origin() const noexcept;
    /// Columns e1, e2, e3 of the body frame, in model space. Include glm/mat3x3.hpp to call this.
    [[nodiscard]] glm::dmat3 axes() const noexcept;
    /// About how many bytes of memory the body takes, itself included. Columns that lie in a body file do not
    /// count, nor the bytes of the file that it keeps: see BodyFile.
    [[nodiscard]] std::size_t bytes() const noexcept;
    /// For goffer's own sources; null if the body is empty.
    [[nodiscard]] const BodyData* data() const noexcept { return data_; }

private:
    const BodyData* data_ = nullptr;  // its own
};

}  // namespace goffer::bend
