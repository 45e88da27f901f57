// SPDX-License-Identifier: MIT
#include "body/check.hpp"
#include "body_files.hpp"
#include "not_finite.hpp"
#include "support/bodies.hpp"
#include "support/rounds.hpp"

#include <goffer/bend/body_input.hpp>
#include <goffer/bend/job.hpp>

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <vector>

/// The working range: whatever Body::check accepts, outputs are finite.

namespace goffer::test {
namespace {

using bend::WorkingRange;

/// 10^low..10^high, evenly over the exponents.
double power(Random& random, double low, double high) {
    return std::pow(10, uniform(random, low, high));
}

double random_sign(Random& random) {
    return random() % 2 == 0 ? -1 : 1;
}

/// Up to four regions and their vertices, of which some numbers are as large or as small as is allowed, and a
/// few of some bodies larger.
struct Wild {
    double radius = 1;
    std::vector<bend::RegionInput> regions;
    std::vector<bend::RestVertex> vertices;
    std::vector<bend::RestVector> normals, tangents;
    std::vector<float> signs;

    explicit Wild(Random& random) : radius(power(random, -12, 12)), exceeds_(random() % 4 == 0) {
        const bool compares = random() % 2 == 0, shaped = random() % 2 == 0;
        const double least = std::max(-12.0, std::log10(radius) - 7);  // most are not too thick to be bent
        const double length = power(random, least, 12);
        regions.resize(1 + random() % 4);
        for (std::size_t r = 0; r < regions.size(); ++r) set_region(random, r, length, compares, shaped);
        for (std::size_t r = 0; r + 1 < regions.size(); ++r) set_blend(random, r);
        for (std::size_t r = 0; r < regions.size(); ++r) add_vertices(random, r, shaped);
    }

    [[nodiscard]] std::optional<bend::Body> body() const {
        bend::BodyInput input;
        input.origin = {WorkingRange::max_origin, 0, -1};
        input.radius = radius;
        input.regions = regions;
        input.vertices = vertices;
        input.normals = normals;
        input.tangents = tangents;
        input.tangent_signs = signs;
        return bend::Body::make(input);
    }

    /// Whether folds run on between different arcs over the joint behind a region.
    [[nodiscard]] bool blends_arcs(std::size_t r) const {
        return regions[r].blend != 0 && !bend::share_rest_arc(regions[r], regions[r + 1], radius);
    }

private:
    bool exceeds_;

    /// `limit`, a number that is smaller by up to so many powers of ten, or, rarely, a larger one.
    [[nodiscard]] double up_to(Random& random, double limit, double powers = 9) const {
        if (exceeds_ && random() % 300 == 0) return limit * power(random, 0, 20);
        return random() % 4 == 0 ? limit : limit * power(random, -powers, 0);
    }

    [[nodiscard]] double radius_of(const bend::RegionInput& region) const {
        return region.radius == 0 ? radius : region.radius;
    }

    /// The angle at which nothing is left of the inner line, where the region is thickest.
    [[nodiscard]] double most_angle(const bend::RegionInput& region) const {
        return region.length / (2 * radius_of(region) * region.max_scale);
    }

    void set_region(Random& random, std::size_t r, double length, bool compares, bool shaped) {
        bend::RegionInput& region = regions[r];
        const auto about = [&](double value) {
            return std::clamp(value * power(random, -1.5, 1.5), WorkingRange::min_length,
                              WorkingRange::max_length);
        };
        region.length = about(length);
        if (random() % 2 == 0) region.radius = about(radius);
        if (shaped) region.max_scale = up_to(random, WorkingRange::max_scale, 3);
        const double most = std::min(most_angle(region), WorkingRange::max_angle);
        region.max_angle = random() % 2 == 0 ? most : most * power(random, -3, 0);
        if (compares) set_rest(random, r);
        if (random() % 16 != 0) set_table(random, region);
    }

    /// A rest arc, an onset, or both. Most arcs leave the room that blends between different ones ask for.
    void set_rest(Random& random, std::size_t r) {
        bend::RegionInput& region = regions[r];
        if (r > 0 && random() % 4 == 0) {  // the arc of the region before, which goes on
            region = regions[r - 1];
            return;
        }
        const std::size_t kind = random() % 3;
        if (kind != 0) region.onset = power(random, -13, 0);
        if (kind == 1) return;
        const double share = random() % 16 == 0 ? WorkingRange::max_rest : 0.98;
        const double most = std::min(share * most_angle(region), region.max_angle);
        region.rest_angle = random() % 2 == 0 ? most : most * uniform(random, 0, 1);
        region.rest_direction = random_sign(random) * power(random, -3, random() % 8 == 0 ? 3 : 0.5);
    }

    void set_table(Random& random, bend::RegionInput& region) {
        region.table.max_angle = static_cast<float>(region.max_angle);
        region.table.rows.resize(2 + random() % 20);
        const double fall = power(random, -2, 0) / region.max_scale;
        for (bend::WrinkleRow& row : region.table.rows) {
            double size = 1;
            for (float& coefficient : row) {
                coefficient = static_cast<float>(size * uniform(random, -1, 1));
                size *= fall;
            }
        }
        if (random() % 2 == 0) {
            region.factors.max_angle = region.table.max_angle;
            region.factors.rows.resize(2);
            for (auto& row : region.factors.rows) row.fill(static_cast<float>(power(random, -2, 4)));
        }
        const double depth = random() % 2 == 0 ? region.length * power(random, -3, 1)
                                               : up_to(random, 0.99 * WorkingRange::max_depth, 30);
        const double larger = depth / bend::deepest_wrinkle({&region, 1}, 0, radius);
        for (bend::WrinkleRow& row : region.table.rows) {
            for (float& coefficient : row) coefficient = static_cast<float>(larger * coefficient);
        }
    }

    /// Lets wrinkles pass over the joint behind a region, where there is room for it.
    void set_blend(Random& random, std::size_t r) {
        bend::RegionInput& own = regions[r];
        const bend::RegionInput& next = regions[r + 1];
        const double before = r == 0 ? 0 : regions[r - 1].blend,
                     most = std::min(own.length - before, next.length),
                     least = 1e-5 * std::max(own.length, next.length);
        if (random() % 4 == 0 || !(most > least) || own.table.empty() || next.table.empty()) return;
        own.blend = std::max(up_to(random, most, 5), least);
        own.blend_gain = std::pow(up_to(random, WorkingRange::max_blend_gain, 3), random_sign(random));
    }

    void add_vertices(Random& random, std::size_t r, bool shaped) {
        constexpr std::size_t count = 20;
        regions[r].vertex_count = count;
        std::vector<double> heights{0, regions[r].length};
        while (heights.size() < count) heights.push_back(height_in(random, r));
        std::ranges::sort(heights);
        const double depth = bend::deepest_wrinkle(regions, r, radius);
        for (const double z : heights) add_vertex(random, r, z, depth, shaped);
    }

    [[nodiscard]] double height_in(Random& random, std::size_t r) const {
        const double length = regions[r].length, share = uniform(random, 0, 1);
        switch (random() % 4) {
            case 0:
                return r > 0 ? std::min(share * regions[r - 1].blend, length) : share * length;
            case 1:
                return length - std::min(share * regions[r].blend, length);
            default:
                return share * length;
        }
    }

    /// What a vertex may be where joints are near: how thick, and how far from the axis at a growth of 1.
    struct Limits {
        double scale, offset = std::numeric_limits<double>::infinity();
    };

    [[nodiscard]] Limits limits_at(std::size_t r, double z) const {
        const bend::RegionInput& own = regions[r];
        Limits limits{own.max_scale};
        const auto add = [&](const bend::RegionInput& neighbor, double distance, double blend) {
            if (distance >= blend) return;
            const double thinner = radius_of(neighbor) / radius_of(own);
            limits.scale = std::min(limits.scale, neighbor.max_scale * thinner);
            if (!exceeds_) limits.offset = std::min(limits.offset, blend);
        };
        if (r > 0) add(regions[r - 1], z, regions[r - 1].blend);
        if (r + 1 < regions.size()) add(regions[r + 1], own.length - z, own.blend);
        return limits;
    }

    void add_vertex(Random& random, std::size_t r, double z, double depth, bool shaped) {
        const bend::RegionInput& region = regions[r];
        const bend::RegionInput& other = regions[random() % regions.size()];
        constexpr double growth_limit = 0.99 * WorkingRange::max_growth;
        const Limits limits = limits_at(r, z);
        bend::RestVertex v;
        v.beta = random() % 4 == 0 ? other.rest_direction
                                   : random_sign(random) * power(random, -3, random() % 8 == 0 ? 3 : 0.5);
        v.z = z;
        const double steepest = std::min(WorkingRange::max_wrinkle, growth_limit / depth);
        v.wrinkle = random_sign(random) * up_to(random, steepest, 12);
        v.slope = random_sign(random) * up_to(random, steepest, 12);
        const double growth = depth * std::fabs(v.wrinkle),
                     reach = 0.99 * WorkingRange::max_radius_ratio * region.length / region.max_angle;
        const double widest =
            std::min({WorkingRange::max_length, reach / (1 + growth), growth_limit * limits.offset / growth});
        v.rho = random() % 9 == 0 ? 0 : up_to(random, widest, 12);
        if (shaped) {
            v.scale = std::max(up_to(random, limits.scale, 3), 1 / WorkingRange::max_scale);
            double taper = 0.99 * WorkingRange::max_taper / region.length;
            if (!exceeds_) taper = std::min(taper, growth_limit / (growth * v.rho));
            v.scale_slope = random_sign(random) * v.scale * up_to(random, taper);
            v.drift = random_sign(random) *
                      up_to(random, 0.99 * region.length * radius_of(region) * region.max_scale);
        }
        vertices.push_back(v);
        const glm::dmat3 frame = random_rotation(random);
        normals.push_back({frame[0].x, frame[0].y, frame[0].z});
        tangents.push_back({frame[1].x, frame[1].y, frame[1].z});
        signs.push_back(1);
    }
};

/// How many outputs of `job` are not finite, or, of directions, longer than 1.
std::size_t bad_outputs(const bend::DeformJob& job, const Output& out) {
    bend::run(job);
    std::size_t bad = 0;
    for (std::size_t i = 0; i < job.body->vertex_count(); ++i) {
        bad += finite(out.position(i)) ? 0 : 1;
        for (const glm::dvec3& direction : {out.normal(i), out.tangent(i)})
            bad += finite(direction) && glm::length(direction) < 1.001 ? 0 : 1;
    }
    return bad;
}

/// Poses of `share` of the largest angles, each toward where it may be, or at rest.
std::vector<bend::Pose> wild_poses(Random& random, const bend::Body& body, float share) {
    std::vector<bend::Pose> poses = body.rest_poses();
    for (std::size_t r = 0; r < poses.size(); ++r) {
        if (random() % 8 == 0) continue;
        poses[r] = {share * body.max_angle(r), static_cast<float>(uniform(random, -1000, 1000))};
    }
    return poses;
}

}  // namespace

TEST_CASE("whatever a body is made of, within the working range its outputs are finite") {
    Random random(91);
    const int trials = rounds(8000, 2000);
    int made = 0, joints = 0, between_arcs = 0;
    for (int trial = 0; trial < trials; ++trial) {
        const Wild wild(random);
        const std::optional<bend::Body> body = wild.body();
        if (!body) continue;
        ++made;
        for (std::size_t r = 0; r + 1 < wild.regions.size(); ++r) {
            joints += wild.regions[r].blend != 0 ? 1 : 0;
            between_arcs += wild.blends_arcs(r) ? 1 : 0;
        }
        Output out(body->vertex_count());
        for (const float share : {0.0f, 1e-6f, -0.01f, 0.4f, 1.0f}) {
            const std::vector<bend::Pose> poses = wild_poses(random, *body, share);
            for (const Isa isa : isas_here()) {
                bend::DeformJob job = make_job(*body, {}, isa, out);
                job.poses = poses;
                job.transform = glm::mat4x3(trial % 2 == 0 ? 1.0f : 1e6f);
                CAPTURE(trial);
                CAPTURE(share);
                CAPTURE(name(isa));
                CHECK(bad_outputs(job, out) == 0);
            }
        }
    }
    MESSAGE(made, " bodies of ", trials, " are within the range; folds run over ", joints,
            " of their joints, ", between_arcs, " of these between different arcs");
    CHECK(made > trials / 4);
    CHECK(joints > trials / 8);
    CHECK(between_arcs > trials / 32);
}

TEST_CASE("body file: whatever is within the working range is loaded again") {
    Random random(92);
    const int trials = rounds(2000, 500);
    int made = 0;
    for (int trial = 0; trial < trials; ++trial) {
        const std::optional<bend::Body> body = Wild(random).body();
        if (!body) continue;
        ++made;
        const bend::LevelInput level{&*body};
        bend::BodyFileInput input;
        input.levels = {&level, 1};
        BodyFileFault fault;
        const std::vector<std::byte> bytes = bend::save(input, &fault);
        const bool loaded = fault.none() && bend::load(AlignedBytes(bytes).bytes(), &fault).has_value();
        const std::string what = bend::describe(fault).c_str();
        CAPTURE(what);
        CHECK(loaded);
    }
    CHECK(made > trials / 4);
}

TEST_CASE("bodies from the smallest to the largest keep their shape") {
    for (const double slenderness : {2.0, 20.0, 1e4}) {
        const double max_angle = std::min(0.99 * slenderness / 2, 6.0);
        for (const bool bent : {false, true}) {
            std::vector<std::vector<glm::dvec3>> shapes;
            for (const double length : {1.0, 1e-7, 1e-3, 1e6, 1e11}) {
                bend::RegionInput region;
                region.length = length;
                region.max_angle = max_angle;
                region.rest_angle = bent ? max_angle / 3 : 0;
                region.onset = bent ? 1e-3 : 0;
                region.table = fit::make_wrinkle_table(paper::Profile::damped, paper::Amplitude::paper, 1,
                                                       length, length / slenderness, max_angle, 64);
                std::vector<bend::RestVertex> vertices;
                for (int i = 0; i < 64; ++i) {
                    const double radius = length / slenderness;
                    vertices.push_back({0.1 * i, length * i / 63, radius, std::sin(0.5 * i) / radius, 0});
                }
                const std::vector<bend::RestVector> normals(vertices.size(), {1, 0, 0});
                region.vertex_count = vertices.size();
                bend::BodyInput input;
                input.radius = length / slenderness;
                input.regions = {&region, 1};
                input.vertices = vertices;
                input.normals = normals;
                CAPTURE(length);
                CAPTURE(slenderness);
                const bend::BodyFault fault = bend::Body::check(input);
                CAPTURE(std::string(bend::describe(fault).c_str()));
                REQUIRE(fault.none());
                const bend::Body body = std::move(bend::Body::make(input).value());
                Output out(body.vertex_count());
                bend::DeformJob job = make_job(body, {0.9f * body.max_angle(), 1}, Isa::automatic, out);
                bend::run(job);
                std::vector<glm::dvec3>& shape = shapes.emplace_back();
                for (std::size_t i = 0; i < vertices.size(); ++i) shape.push_back(out.position(i) / length);
                for (std::size_t i = 0; i < vertices.size(); ++i)
                    REQUIRE(glm::distance(shape[i], shapes[0][i]) < 1e-6);
            }
        }
    }
}

}  // namespace goffer::test
