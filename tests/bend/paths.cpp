// SPDX-License-Identifier: MIT
#include "curves.hpp"
#include "support/chains.hpp"
#include "support/worst.hpp"

#include <goffer/bend/path.hpp>

#include <doctest/doctest.h>

#include <bit>
#include <limits>

/// Poses along a path: what is said of their error, and paths that are hardly any.

namespace goffer::test {
namespace {

bend::Body body_of_regions(Random& random, std::size_t regions) {
    const TestMesh test_mesh = random_mesh(random, 30, 10, 12, 65, 0);
    fit::BindOptions options;
    options.folds = 0;
    for (std::size_t i = 0; i < regions; ++i)
        options.regions.push_back({1.0 / static_cast<double>(regions), std::nullopt});
    return std::move(fit::bind(test_mesh.geometry(), test_mesh.cylinder, options).body);
}

glm::dvec3 random_vector(Random& random) {
    return {uniform(random, -1, 1), uniform(random, -1, 1), uniform(random, -1, 1)};
}

/// A curve that turns by a right angle or so, about as long as `length`. Its control points lie between
/// `nearest` and `farthest` thirds of the length apart.
void set_curve(Random& random, double length, double nearest, double farthest, Control& control) {
    glm::dvec3 point = random_vector(random), direction = glm::normalize(random_vector(random));
    for (glm::vec3& p : control) {
        p = glm::vec3(point);
        direction = glm::normalize(direction + 0.8 * random_vector(random));
        point += direction * (length / 3 * uniform(random, nearest, farthest));
    }
}

void set_smooth(Random& random, double length, Control& control) {
    set_curve(random, length, 0.7, 1.5, control);
}

/// The center line at 16 places of each region, by the poses.
std::vector<glm::dvec3> center_line(const bend::Body& body, const bend::PathFit& fit,
                                    std::span<const bend::Pose> poses) {
    glm::dmat3 axes = glm::dmat3(glm::mat3(fit.transform)) * body.axes();
    glm::dvec3 begin = glm::dmat4x3(fit.transform) * glm::dvec4(body.origin(), 1);
    std::vector<glm::dvec3> places;
    for (std::size_t r = 0; r < poses.size(); ++r) {
        const double angle = static_cast<double>(poses[r].angle);
        const double direction = static_cast<double>(poses[r].direction);
        const double length = static_cast<double>(body.regions()[r].length) - angle * body.radius();
        const glm::dvec3 n = std::cos(direction) * axes[0] + std::sin(direction) * axes[1];
        const glm::dvec3 b = std::cos(direction) * axes[1] - std::sin(direction) * axes[0];
        const glm::dvec3 t = axes[2];
        for (int i = 1; i <= 16; ++i) {
            const double half = angle * i / 32, sinc = half != 0 ? std::sin(half) / half : 1;
            places.push_back(begin + length * i / 16 * sinc * (std::sin(half) * n + std::cos(half) * t));
        }
        begin = places.back();
        const glm::dvec3 turned = std::cos(angle) * n - std::sin(angle) * t;
        axes = {std::cos(direction) * turned - std::sin(direction) * b,
                std::sin(direction) * turned + std::cos(direction) * b,
                std::sin(angle) * n + std::cos(angle) * t};
    }
    return places;
}

/// The direction in which the first region ends.
glm::dvec3 end_direction(const bend::Body& body, const bend::PathFit& fit, const bend::Pose& pose) {
    const glm::dmat3 axes = glm::dmat3(glm::mat3(fit.transform)) * body.axes();
    const double angle = static_cast<double>(pose.angle), direction = static_cast<double>(pose.direction);
    return std::sin(angle) * (std::cos(direction) * axes[0] + std::sin(direction) * axes[1]) +
           std::cos(angle) * axes[2];
}

/// The direction of a polyline at a distance from its beginning.
glm::dvec3 direction_at(std::span<const glm::dvec3> points, double length) {
    std::size_t i = 0;
    while ((length -= glm::distance(points[i], points[i + 1])) > 0) ++i;
    return glm::normalize(points[i + 1] - points[i]);
}

double error_of(const bend::Body& body, const bend::PathFit& fit, std::span<const bend::Pose> poses,
                std::span<const glm::dvec3> path) {
    double worst = 0;
    for (const glm::dvec3& place : center_line(body, fit, poses))
        test::take_worst(worst, distance_to_polyline(place, path));
    return worst;
}

bool same_poses(std::span<const bend::Pose> a, std::span<const bend::Pose> b) {
    return std::ranges::equal(a, b, [](const bend::Pose& p, const bend::Pose& q) {
        return p.angle == q.angle && p.direction == q.direction;
    });
}

bool is_sane(const bend::PathFit& fit, std::span<const bend::Pose> poses) {
    for (const bend::Pose& pose : poses) {
        if (!std::isfinite(pose.angle) || !std::isfinite(pose.direction)) return false;
    }
    for (int c = 0; c < 4; ++c) {
        for (int r = 0; r < 3; ++r) {
            if (!std::isfinite(fit.transform[c][r])) return false;
        }
    }
    return fit.error >= 0;
}

}  // namespace

TEST_CASE("the error of a path's poses is what it is said to be") {
    Random random(91);
    for (const std::size_t regions : {1u, 3u, 8u, 16u}) {
        const bend::Body body = body_of_regions(random, regions);
        std::vector<bend::Pose> poses(regions);
        for (int trial = 0; trial < 20; ++trial) {
            CAPTURE(regions);
            CAPTURE(trial);
            Control control;
            set_smooth(random, body.length(), control);
            const bend::PathFit fit = bend::poses_along_bezier(body, control, poses);
            const double exact = error_of(body, fit, poses, line_of(control, 2000));
            CHECK(static_cast<double>(fit.error) == doctest::Approx(exact).epsilon(2e-4).scale(0.01));
            std::vector<glm::vec3> points;
            for (const glm::dvec3& p : line_of(control, 60)) points.emplace_back(p);
            const std::vector<glm::dvec3> line(points.begin(), points.end());
            const bend::PathFit along = bend::poses_along(body, points, poses);
            CHECK(static_cast<double>(along.error) ==
                  doctest::Approx(error_of(body, along, poses, line)).epsilon(1e-4).scale(0.01));
        }
    }
}

TEST_CASE("a body of which few poses are asked for lies as the whole does") {
    Random random(92);
    const bend::Body body = body_of_regions(random, 8);
    Control control;
    set_smooth(random, body.length(), control);
    std::vector<bend::Pose> all(8), few(3), many(11, {7, 7});
    bend::poses_along_bezier(body, control, all);
    bend::poses_along_bezier(body, control, few);
    bend::poses_along_bezier(body, control, many);
    CHECK(same_poses(few, std::span(all).first(3)));
    CHECK(same_poses(std::span(many).first(8), all));
    CHECK(many[8].angle == 7);
    CHECK(bend::poses_along_bezier(body, control, {}).error == 0);
}

TEST_CASE("a line between two points makes a body straight, and one point is no line") {
    Random random(96);
    const bend::Body body = body_of_regions(random, 3);
    const glm::vec3 ends[] = {{1, 2, 3}, {1, 2 + 2 * static_cast<float>(body.length()), 3}};
    std::vector<bend::Pose> poses(3, {1, 1});
    const bend::PathFit fit = bend::poses_along(body, ends, poses);
    CHECK(fit.error < 1e-4f);
    for (const bend::Pose& pose : poses) CHECK(std::abs(pose.angle) < 1e-4f);
    CHECK(glm::distance(glm::normalize(fit.transform * glm::vec4(glm::vec3(body.axes()[2]), 0)), {0, 1, 0}) <
          1e-4f);
    CHECK(bend::poses_along(body, std::span(ends).first(1), poses).error > 1);
}

TEST_CASE("repeated points are passed over") {
    Random random(93);
    const bend::Body body = body_of_regions(random, 4);
    const glm::vec3 a(1, 2, 3), b(3, 3, 3), c(6, 2, 4);
    const glm::vec3 once[] = {a, b, c}, again[] = {a, a, b, b, b, c, c};
    std::vector<bend::Pose> poses(4), repeated(4);
    const bend::PathFit fit = bend::poses_along(body, once, poses);
    CHECK(bend::poses_along(body, again, repeated).error == fit.error);
    CHECK(same_poses(repeated, poses));
    const glm::vec3 point[] = {a, a, a};
    const glm::vec3 control[] = {a, a, a, a};
    for (const bend::PathFit& still :
         {bend::poses_along(body, point, poses), bend::poses_along(body, point, poses, {.distance = 40}),
          bend::poses_along_bezier(body, control, poses),
          bend::poses_along_bezier(body, control, poses, {.distance = 40}),
          bend::poses_along_bezier(body, control, poses, {.distance = 3e38f})}) {
        CHECK(still.error == 0);
        CHECK(glm::distance(glm::dvec3(still.transform[3]), glm::dvec3(a) - body.origin()) < 1e-6);
        CHECK(same_poses(poses, std::vector<bend::Pose>(4)));
    }
}

TEST_CASE("a body that begins farther on lies as on the rest of the path") {
    Random random(97);
    for (int trial = 0; trial < 20; ++trial) {
        const bend::Body body = body_of_regions(random, 1 + random() % 8);
        Control control;
        set_smooth(random, body.length(), control);
        std::vector<glm::vec3> points;
        for (int i = 0; i <= 60; ++i) points.emplace_back(point_of(control, i / 60.0));
        const std::size_t first = random() % 40;
        double before = 0;
        for (std::size_t i = 0; i < first; ++i)
            before += glm::distance(glm::dvec3(points[i]), glm::dvec3(points[i + 1]));
        // A little behind the point: which of the pieces there it is on would be for rounding to say.
        const glm::dvec3 piece(points[first + 1] - points[first]);
        const double beyond = 0.01 * glm::length(piece);
        std::vector<bend::Pose> poses(body.region_count()), rest(poses);
        const bend::PathStart start{.distance = static_cast<float>(before + beyond)};
        const bend::PathFit fit = bend::poses_along(body, points, poses, start);
        points[first] += glm::vec3(0.01 * piece);
        const bend::PathFit of_rest = bend::poses_along(body, std::span(points).subspan(first), rest);
        for (int c = 0; c < 4; ++c)
            CHECK(glm::distance(fit.transform[c], of_rest.transform[c]) < 1e-5 * body.length());
        for (std::size_t r = 0; r < poses.size(); ++r)
            CHECK(poses[r].angle == doctest::Approx(rest[r].angle).epsilon(1e-4));
        CHECK(std::fabs(fit.error - of_rest.error) < 1e-5 * body.length());
        // The curve is longer than its chords.
        const bend::PathFit along = bend::poses_along_bezier(body, control, poses, start);
        const glm::vec3 base = along.transform * glm::vec4(glm::vec3(body.origin()), 1);
        CHECK(glm::distance(base, points[first]) < 1e-3 * body.length());
    }
}

TEST_CASE("a body on a path is rolled so that its back is up, or not at all where there is no up") {
    Random random(98);
    for (int trial = 0; trial < 200; ++trial) {
        const bend::Body body = body_of_regions(random, 3);
        const glm::vec3 axis(body.axes()[2]);
        const glm::vec3 model_up(random_vector(random)), up(random_vector(random)), from(1, 2, 3);
        const glm::vec3 ends[] = {from, from + glm::vec3(random_vector(random))};
        std::vector<bend::Pose> poses(3);
        const auto turn_with = [&](const bend::PathStart& start) {
            return glm::mat3(bend::poses_along(body, ends, poses, start).transform);
        };
        const glm::mat3 turn = turn_with({.model_up = model_up, .up = up});
        const glm::vec3 heading = glm::normalize(ends[1] - ends[0]), back = turn * model_up;
        CHECK(glm::distance(turn * axis, heading) < 1e-5f);
        CHECK(std::fabs(glm::determinant(turn) - 1) < 1e-5f);
        CHECK(std::fabs(glm::dot(glm::cross(heading, back), up)) < 1e-5f);
        CHECK(glm::dot(back - glm::dot(back, heading) * heading, up) >= 0);
        // Where the back is already, it stays.
        const glm::mat3 same = turn_with({.model_up = model_up, .up = back});
        const glm::mat3 shortest = turn_with({});
        const float nan = std::numeric_limits<float>::quiet_NaN();
        for (int c = 0; c < 3; ++c) {
            CHECK(glm::distance(same[c], turn[c]) < 1e-5f);
            CHECK(shortest[c] == turn_with({.model_up = axis, .up = up})[c]);
            CHECK(shortest[c] == turn_with({.model_up = model_up, .up = {nan, 0, 0}})[c]);
            CHECK(shortest[c] == turn_with({.model_up = model_up, .up = heading})[c]);
        }
    }
}

TEST_CASE("a body that walks, each frame turned from the one before, does not roll") {
    Random random(99);
    const bend::Body body = body_of_regions(random, 2);
    const auto length = static_cast<float>(body.length());
    std::vector<glm::vec3> circle;  // of one round and more, far from the axis at rest and back
    for (int i = 0; i <= 500; ++i) {
        const float angle = 6.2831853f * static_cast<float>(i) / 400;
        circle.push_back(3 * length * glm::vec3(std::cos(angle), 0, std::sin(angle)));
    }
    std::vector<bend::Pose> poses(2);
    // The component of the body's own direction across the plane: what a roll would change.
    const auto across = [&](const glm::mat3& turn) { return (turn * glm::mat3(body.axes()))[0].y; };
    bend::PathStart walking, fixed;
    float least = 1, most = -1, first = 0;
    for (int step = 0; step <= 400; ++step) {
        walking.before = glm::mat3(bend::poses_along(body, circle, poses, walking).transform);
        if (step == 0) first = across(walking.before);
        CHECK(std::fabs(across(walking.before) - first) < 1e-4f);
        const float own = across(glm::mat3(bend::poses_along(body, circle, poses, fixed).transform));
        least = std::min(least, own);
        most = std::max(most, own);
        walking.distance = fixed.distance += 3 * length * 6.2831853f / 400;
    }
    CHECK(most - least > 0.2f);  // it would roll otherwise
    const auto turn_from = [&](const glm::mat3& before) {
        return bend::poses_along(body, circle, poses, {.before = before}).transform;
    };
    const float nan = std::numeric_limits<float>::quiet_NaN();
    for (const glm::mat3& none : {glm::mat3(0), glm::mat3(2), glm::mat3(-1), glm::mat3(nan)})
        CHECK(turn_from(none) == turn_from(glm::mat3(1)));
}

TEST_CASE("a path may hold any bits") {
    Random random(94);
    const float some[] = {0, 1, 2, 1e-45f, -1e20f, 3e38f, -3e38f, std::numeric_limits<float>::quiet_NaN()};
    for (int trial = 0; trial < 6; ++trial) {
        const bend::Body body = body_of_regions(random, 1 + random() % 32);
        std::vector<bend::Pose> poses(body.region_count());
        for (int i = 0; i < 2000; ++i) {
            Control control;
            for (glm::vec3& p : control) {
                for (int c = 0; c < 3; ++c)
                    p[c] = i % 2 == 0 ? some[random() % (i % 4 == 0 ? 8 : 7)]
                                      : std::bit_cast<float>(static_cast<std::uint32_t>(random()));
            }
            bend::PathStart start;
            if (i % 3 == 0)
                start = {control[0].x, glm::mat3(control[3], control[2], control[1]), control[1], control[2]};
            REQUIRE(is_sane(bend::poses_along_bezier(body, control, poses, start), poses));
            const std::span<const glm::vec3> points = std::span(control).first(random() % 5);
            const bend::PathFit fit = bend::poses_along(body, points, poses, start);
            REQUIRE(is_sane(fit, poses));
            const bend::PathFault fault = bend::check_path(points);
            if (fault == bend::PathFault::not_finite || fault == bend::PathFault::too_few_points)
                CHECK(fit.error == std::numeric_limits<float>::infinity());
        }
    }
}

// Where a curve is run through so unevenly, the nearest points are found only by a search that begins near
// them.
TEST_CASE("the error is right, too, along curves with crowded control points that end before the body") {
    Random random(95);
    double worst = 0, sum = 0;
    int trials = 0;
    for (const std::size_t regions : {1u, 2u, 3u, 5u, 8u}) {
        const bend::Body body = body_of_regions(random, regions);
        std::vector<bend::Pose> poses(regions);
        for (int trial = 0; trial < 100; ++trial, ++trials) {
            Control control;
            set_curve(random, uniform(random, 0.3, 1.2) * body.length(), 0.1, 2, control);
            const bend::PathFit fit = bend::poses_along_bezier(body, control, poses);
            const double exact = error_of(body, fit, poses, line_of(control, 1000));
            const double off = std::fabs(static_cast<double>(fit.error) - exact) / (exact + 0.01);
            test::take_worst(worst, off);
            sum += off;
        }
    }
    MESSAGE("off by ", worst, " at most, ", sum / trials, " on the average");
    CHECK(worst < 0.03);
    CHECK(sum / trials < 1e-4);
}

TEST_CASE("a curve is as long as it is where its handles are collapsed") {
    Random random(98);
    const bend::Body body = body_of_regions(random, 2);
    std::vector<bend::Pose> poses(2);
    const Control control{{0, 0, 0}, {0, 0, 0}, {8, 0, 0}, {8, 0, 0}};
    for (const float distance : {0.5f, 2.0f, 4.0f, 7.0f, 7.9f, 8.0f, 8.5f, 20.0f}) {
        CAPTURE(distance);
        const bend::PathFit fit = bend::poses_along_bezier(body, control, poses, {.distance = distance});
        const glm::vec3 base = fit.transform * glm::vec4(glm::vec3(body.origin()), 1);
        CHECK(glm::distance(base, {distance, 0, 0}) < 0.01f);
        CHECK(fit.error < 1e-5f);
    }
}

TEST_CASE("control points that are all but the same count as the same") {
    Random random(97);
    double turned = 0, off = 0;
    const auto compare = [&](const bend::Body& body, const Control& control, const Control& other) {
        std::vector<bend::Pose> poses(body.region_count()), others = poses;
        const bend::PathFit fit = bend::poses_along_bezier(body, control, poses);
        const bend::PathFit same = bend::poses_along_bezier(body, other, others);
        for (std::size_t r = 0; r < poses.size(); ++r)
            test::take_worst(turned, std::fabs(static_cast<double>(poses[r].angle - others[r].angle)));
        test::take_worst(off, std::fabs(static_cast<double>(fit.error - same.error)) /
                                  (static_cast<double>(same.error) + 0.01));
    };
    for (const std::size_t regions : {1u, 2u, 4u, 8u}) {
        const bend::Body body = body_of_regions(random, regions);
        for (const float little : {1e-5f, 1e-6f, 1e-9f, 1e-12f, 1e-20f, 1e-30f, 1e-40f}) {
            for (int trial = 0; trial < 8; ++trial) {
                Control control, same;
                set_smooth(random, uniform(random, 0.3, 1.2) * body.length(), control);
                for (const bool first : {false, true}) {
                    const std::size_t end = first ? 0 : 3, handle = first ? 1 : 2;
                    const glm::vec3 shift = control[end];  // what is left of the handle must not be rounded
                    for (std::size_t i = 0; i < 4; ++i) same[i] = control[i] -= shift;
                    same[handle] = {};
                    control[handle] = little * glm::normalize(control[3 - end]);
                    compare(body, control, same);
                }
                for (std::size_t i = 0; i < 4; ++i) control[i] *= little, same[i] *= 1e-4f;
                compare(body, control, same);  // curves that are all but a point
            }
        }
    }
    MESSAGE("turned by ", turned, " at most, errors differ by a share of ", off);
    CHECK(turned < 1e-3);
    CHECK(off < 0.05);
}

TEST_CASE(
    "the error is no less than it is where the search for the nearest place does not settle, nor far more") {
    const bend::RestVertex vertex{.rho = 0.05};
    const bend::RestVector normal{.rho = 1};
    const bend::Body body = bare_body({&vertex, 1}, {&normal, 1});
    Random random(96);
    Control control{
        {}, {-0.6350f, 1.0727f, 0.6292f}, {-0.2434f, 0.0844f, 0.0440f}, {0.8980f, -0.8217f, -0.6875f}};
    double understated = 0, overstated = 0;
    for (int trial = 0; trial < 2000; ++trial) {
        bend::Pose pose;
        const bend::PathFit fit = bend::poses_along_bezier(body, control, {&pose, 1});
        const double exact = error_of(body, fit, {&pose, 1}, line_of(control, 300));
        const double error = static_cast<double>(fit.error);
        understated = std::max(understated, exact - error);
        overstated = std::max(overstated, error - exact);
        for (std::size_t i = 1; i < 4; ++i) {
            for (int axis = 0; axis < 3; ++axis)
                control[i][axis] = static_cast<float>(uniform(random, -1.2, 1.2));
        }
    }
    MESSAGE("understated by ", understated, " lengths at most, overstated by ", overstated);
    CHECK(understated < 0.01);
    CHECK(overstated < 0.6);  // not all of the curve is searched
}

TEST_CASE("the first region ends in the direction that the path has there") {
    Random random(96);
    double worst = 0, sum = 0;
    int trials = 0;
    for (const std::size_t regions : {1u, 2u, 4u}) {
        const bend::Body body = body_of_regions(random, regions);
        std::vector<bend::Pose> poses(regions);
        for (int trial = 0; trial < 100; ++trial) {
            Control control;
            set_smooth(random, 1.5 * body.length(), control);
            const bend::PathFit fit = bend::poses_along_bezier(body, control, poses);
            if (fit.clamped) continue;
            const double length = static_cast<double>(body.regions()[0].length) -
                                  static_cast<double>(poses[0].angle) * body.radius();
            const double off = glm::distance(end_direction(body, fit, poses[0]),
                                             direction_at(line_of(control, 2000), length));
            test::take_worst(worst, off);
            sum += off;
            ++trials;
        }
    }
    MESSAGE("off by ", worst, " at most, ", sum / trials, " on the average of ", trials);
    CHECK(worst < 0.0125);
    CHECK(sum / trials < 2.7e-4);
}

TEST_CASE("beyond its end a polyline goes straight on") {
    Random random(97);
    for (const std::size_t regions : {1u, 3u, 8u}) {
        const bend::Body body = body_of_regions(random, regions);
        std::vector<bend::Pose> poses(regions), longer(regions);
        for (int trial = 0; trial < 20; ++trial) {
            std::vector<glm::vec3> points;
            glm::dvec3 point = random_vector(random), direction = glm::normalize(random_vector(random));
            for (int i = 0; i < 6; ++i) {
                points.emplace_back(point);
                direction = glm::normalize(direction + 0.4 * random_vector(random));
                point += direction * (0.12 * body.length());
            }
            const bend::PathFit fit = bend::poses_along(body, points, poses);
            points.emplace_back(points[5] + 10.0f * (points[5] - points[4]));
            const bend::PathFit same = bend::poses_along(body, points, longer);
            CHECK(static_cast<double>(fit.error) ==
                  doctest::Approx(static_cast<double>(same.error)).epsilon(1e-4).scale(0.01));
            for (std::size_t r = 0; r < regions; ++r)
                CHECK(std::fabs(poses[r].angle - longer[r].angle) < 1e-5f);
        }
    }
}

TEST_CASE("a path that turns more sharply than the body can clamps it") {
    Random random(98);
    const bend::Body body = body_of_regions(random, 8);
    std::vector<bend::Pose> poses(8);
    const float half = 0.5f * static_cast<float>(body.length());
    const glm::vec3 straight[] = {{0, 0, 0}, {0, 0, half}, {0, 0, 2 * half}};
    const glm::vec3 there_and_back[] = {{0, 0, 0}, {0, 0, half}, {0.1f, 0, 0}};
    CHECK_FALSE(bend::poses_along(body, straight, poses).clamped);
    CHECK(bend::poses_along(body, there_and_back, poses).clamped);
    for (std::size_t r = 0; r < 8; ++r) CHECK(poses[r].angle <= body.max_angle(r));
}

}  // namespace goffer::test
