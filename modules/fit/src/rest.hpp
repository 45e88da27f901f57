// SPDX-License-Identifier: MIT
#pragma once

#include <goffer/bend/body.hpp>
#include <goffer/bend/rest_vertex.hpp>
#include <goffer/fit/bind.hpp>
#include <goffer/fit/cylinder.hpp>
#include <goffer/fit/geometry.hpp>
#include <goffer/paper/chain.hpp>
#include <goffer/paper/closed_form.hpp>

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

/// A mesh in the coordinates of its base cylinder.

namespace goffer::fit {

/// A region as bind plans it.
struct RestRegion {
    double start = 0;  ///< z where it begins
    double length = 0;
    paper::FoldRange folds = 0;
    std::shared_ptr<const paper::Shape> shape = {};  ///< null: of a cylinder, with folds of one length
    double blend = 0;                                ///< bend::RegionInput::blend
    paper::Pose rest = {};                           ///< the arc that it is bent along at rest
};

/// Returns the arc that the stretch of a base from z = `start` on is bent along at rest. If the base is a
/// chain, this is the arc that begins there.
[[nodiscard]] paper::Pose rest_of(const Cylinder& cylinder, double start, double length);

/// Lets the folds of neighboring regions run on over their joints, wherever both wrinkle there. `radius`: of
/// the base.
void join_folds(std::vector<RestRegion>& regions, double radius, double onset);

/// Returns bend::RegionInput::blend_gain at the joint of two regions.
[[nodiscard]] double gain_at_joint(const RestRegion& region, const RestRegion& next);

/// Returns the regions that `binding` was made with.
[[nodiscard]] std::vector<RestRegion> rest_regions(const Binding& binding);

/// Knots that a shape has, and that the weights of slices need.
inline constexpr std::size_t fewest_knots = 5, slice_knots = 49;

/// Returns how many knots a stretch has that lie a quarter of the radius apart, if these are `least` or more.
[[nodiscard]] std::size_t knots_along(double length, double radius, std::size_t least);

/// Returns the shape of a region with its wrinkles times `factors`, control values at equal steps. `radius`:
/// of the base.
[[nodiscard]] std::shared_ptr<const paper::Shape> weighted(const RestRegion& region, double radius,
                                                           const std::vector<double>& factors);

/// Whether bind() takes one radius for a body, whatever radii its cylinder has.
[[nodiscard]] inline bool has_one_radius(const Cylinder& cylinder, const BindOptions& options) {
    return options.shape == ShapeMode::cylinder || options.amplitude == paper::Amplitude::area ||
           (cylinder.rest_angle != 0 && options.regions.size() > 1);
}

/// Returns the regions that `options` ask for: one over the whole length if there are none. Those without
/// folds of their own get BindOptions::folds.
[[nodiscard]] std::vector<RegionOptions> regions_of(const BindOptions& options);

/// Returns `cylinder` with another length: a stretch of it, for sensible_folds().
[[nodiscard]] inline Cylinder stretch_of(Cylinder cylinder, double length) {
    cylinder.length = length;
    return cylinder;
}

/// Returns the options with the regions of a base that is bent along a chain, which has one for each arc, and
/// shares BindOptions::folds out over them by their lengths; of any other, the options themselves. Throws
/// Error if there are regions, but not one for each arc.
[[nodiscard]] BindOptions with_regions_of(const Cylinder& cylinder, const BindOptions& options);

/// Returns the radii of the stretch of a base from z = `start` on, as knots of a shape; none where it has one
/// radius.
[[nodiscard]] std::vector<double> radii_of(const Cylinder& cylinder, double start, double length);

/// Returns the cylinder without its radii. The outer lines of a chain's arcs become those of its one radius;
/// each center line stays where it is.
[[nodiscard]] Cylinder with_one_radius(const Cylinder& cylinder);

/// Returns the mean radius of such a stretch, which is that of a region there.
[[nodiscard]] double radius_of(const Cylinder& cylinder, double start, double length);

/// Returns a radius that no part of such a stretch is thicker than, nor the shape of a region there.
[[nodiscard]] double thickest_of(const Cylinder& cylinder, double start, double length);

/// Returns how far from the axis the base is at `count` equal steps of such a stretch.
[[nodiscard]] std::vector<double> radii_at(const Cylinder& cylinder, double start, double length,
                                           std::size_t count);

/// Returns the axes of the base in model space: columns e1, e2, e3.
[[nodiscard]] glm::dmat3 axes_of(const Cylinder& cylinder);

/// Maps model space to coordinates of the base, those of the straightened body.
class Straightening {
public:
    explicit Straightening(const Cylinder& cylinder);

    [[nodiscard]] paper::Cylindrical vertex(const glm::dvec3& position) const;
    /// vertex(position).z, at less cost where the body is straight anyway.
    [[nodiscard]] double height(const glm::dvec3& position) const;
    /// Whether an edge between vertices at the heights `from` and `to` lies between these, as far as `slack`.
    /// One that leads across the gap between two ends of arcs does not: its middle is of another height.
    [[nodiscard]] bool leads_along(const glm::dvec3& middle, double from, double to, double slack) const;
    /// A normal, or a tangent, at the vertex `at`; the result has unit length.
    [[nodiscard]] bend::RestVector normal(const glm::dvec3& vector, const paper::Cylindrical& at) const;
    [[nodiscard]] bend::RestVector tangent(const glm::dvec3& vector, const paper::Cylindrical& at) const;

    /// Where a place of the straightened body is, in model space.
    [[nodiscard]] glm::dvec3 bent(const paper::Cylindrical& at) const;

private:
    /// A stretch along one arc: all of the body, unless that is bent along a chain.
    struct Piece {
        double start, length, radius;
        paper::Pose rest;
        std::shared_ptr<const paper::Shape> shape;  // null where it makes no difference
        paper::Frame frame;                         // that it begins in

        [[nodiscard]] paper::Cylindrical straightened(const glm::dvec3& in_body) const;
    };
    [[nodiscard]] glm::dvec3 in_body(const glm::dvec3& position) const;
    [[nodiscard]] const Piece& piece_at(double z) const;
    void add_piece(const Cylinder& cylinder, double start, double length);

    glm::dvec3 origin_;
    glm::dmat3 to_body_;
    std::vector<Piece> pieces_;
};

/// Returns the vertex at `at`, which lies in `region`, with its wrinkle and with z from where the region
/// begins.
[[nodiscard]] bend::RestVertex rest_vertex(const paper::Cylindrical& at, const RestRegion& region,
                                           double radius, paper::Profile profile);

/// Returns the region that holds height z; a joint belongs to the region that begins there.
[[nodiscard]] std::size_t region_at(std::span<const RestRegion> regions, double z);

/// Rows of vertices that a fold needs.
inline constexpr double rows_of_fold = 8;

/// How far apart a mesh's rows of vertices lie along its base.
class Rows {
public:
    Rows(const Geometry& geometry, const Cylinder& cylinder);

    /// The most folds that the heights from `low` to `high` can carry, as `profile` counts them: those of
    /// Profile::even may each have a length of its own (folds_capacity).
    [[nodiscard]] int folds(paper::Profile profile, double low, double high) const;

    /// How far the coarsest triangles that count reach along z about height z.
    [[nodiscard]] double reach_at(double z) const;

private:
    [[nodiscard]] double even_folds(double low, double high) const;

    double length_;
    double reach_;                // of the coarsest triangles that count anywhere
    std::vector<double> slices_;  // of those in each of so many slices
};

/// Returns how long a fold is to be where the body has `radius`; model units.
[[nodiscard]] double fold_length_at(const Cylinder& cylinder, Profile profile, std::optional<double> in_radii,
                                    double radius);

/// The shape of a region and of its folds.
struct FoldPlan {
    int folds = 0;
    std::shared_ptr<const paper::Shape> shape = {};
};

/// Plans the folds of Profile::even from z = `start` on: `asked` of them, or as many of the length that
/// `options` say as fit, longer ones where rows are too far apart, and none where these would be too long for
/// the body. Profiles other than `even` get `asked` folds and the shape alone.
[[nodiscard]] FoldPlan plan_folds(const Cylinder& cylinder, const Rows& rows, const BindOptions& options,
                                  double start, double length, std::optional<int> asked);

/// A mesh's vertices at rest, straightened, region by region.
struct RestMesh {
    std::vector<bend::RestVertex> vertices;  ///< z from where the vertex's region begins
    std::vector<bend::RestVector> normals;
    std::vector<bend::RestVector> tangents;  ///< none, or one per vertex
    std::vector<float> tangent_signs;
    std::vector<bool> used;            ///< whether a triangle uses vertex i
    std::vector<std::size_t> counts;   ///< vertices in each region
    std::vector<std::uint32_t> order;  ///< vertex i is the geometry's order[i]; empty: i
};

/// Returns where in the body each vertex of the geometry is, of which `order` tells as RestMesh::order; empty
/// where the order is the same.
[[nodiscard]] std::vector<std::uint32_t> places_in_body(std::span<const std::uint32_t> order);

/// Returns the vertices without a mask. `parts`: what they bear of their wrinkles; null: all. Throws Error
/// where a vertex of a triangle lies beyond the ends.
[[nodiscard]] RestMesh rest_mesh(const Geometry& geometry, const Cylinder& cylinder, paper::Profile profile,
                                 std::span<const RestRegion> regions, const Parts* parts);

}  // namespace goffer::fit
