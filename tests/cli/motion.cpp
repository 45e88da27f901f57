// SPDX-License-Identifier: MIT
#include "motion/motion.hpp"

#include "command.hpp"
#include "key.hpp"
#include "motion/document.hpp"
#include "support/angles.hpp"

#include <goffer/fit/bind.hpp>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

#include <cmath>
#include <memory>

/// Documents of motions, and what they say of a body: against closed forms.

using namespace goffer;
using namespace goffer::test;
using nlohmann::json;

namespace {

/// A cylinder of L = 10, r = 1 along z, of equal regions, without folds.
bend::Body body_of(int regions) {
    const Folder folder;
    const mesh::VertexArrays arrays = mesh::vertex_arrays(mesh::load(folder / base(folder)));
    const fit::Geometry geometry{arrays.positions, arrays.triangles, arrays.normals};
    fit::BindOptions options;
    options.folds = 0;
    options.regions.assign(static_cast<std::size_t>(regions), {1.0 / regions, std::nullopt});
    return std::move(fit::bind(geometry, fit::fit_cylinder(geometry), options).body);
}

std::unique_ptr<const cli::Motion> motion_of(const json& document, std::size_t regions = 1) {
    return cli::read_motion(document, regions, "keys.json");
}

/// How a region bends, as a vector in degrees.
glm::dvec2 vector_of(const bend::Pose& pose) {
    const double angle = static_cast<double>(pose.angle) / degree;
    const auto direction = static_cast<double>(pose.direction);
    return {angle * std::cos(direction), angle * std::sin(direction)};
}

void check_bend(const bend::Pose& pose, double x, double y) {
    CHECK(std::abs(vector_of(pose).x - x) < 2e-5);
    CHECK(std::abs(vector_of(pose).y - y) < 2e-5);
}

/// Where the body's axis begins and where it points at the base.
struct Base {
    glm::dvec3 point, heading, side;
};

Base base_of(const cli::Moment& moment, const bend::Body& body) {
    const glm::dmat4x3 to_scene(moment.transform);
    const glm::dmat3 axes = glm::dmat3(to_scene) * body.axes();
    return {to_scene * glm::dvec4(body.origin(), 1), axes[2], axes[0]};
}

}  // namespace

TEST_CASE("motion: linear keys, against the straight line between two vectors") {
    const bend::Body body = body_of(1);
    const auto motion =
        motion_of({{"interpolation", "linear"}, {"keys", {key(1, 40, 0), key(3, 30, 90), key(4, 0, 0)}}});
    CHECK(motion->seconds() == 4);
    CHECK(!motion->repeats());
    for (const double share : {0.0, 0.25, 0.5, 0.9, 1.0})
        check_bend(motion->at(1 + 2 * share, body).poses[0], 40 * (1 - share), 30 * share);
    check_bend(motion->at(3.5, body).poses[0], 0, 15);
    check_bend(motion->at(-5, body).poses[0], 40, 0);
    check_bend(motion->at(50, body).poses[0], 0, 0);
}

TEST_CASE("motion: a region that bends in one plane keeps its direction, and passes through straight") {
    const bend::Body body = body_of(1);
    const auto motion =
        motion_of({{"interpolation", "linear"}, {"keys", {key(0, -40, 20), key(1, 0, 77), key(2, 40, 20)}}});
    for (const double time : {0.5, 0.75, 1.25, 1.5}) {
        const bend::Pose pose = motion->at(time, body).poses[0];
        CHECK(pose.direction == static_cast<float>(20 * degree));
        CHECK(pose.angle == static_cast<float>(40 * (time - 1) * degree));
    }
}

TEST_CASE("motion: directions go the short way") {
    const bend::Body body = body_of(1);
    const auto motion =
        motion_of({{"interpolation", "linear"}, {"keys", {key(0, 50, 170), key(1, 50, -170)}}});
    const glm::dvec2 half = vector_of(motion->at(0.5, body).poses[0]);
    CHECK(half.x == doctest::Approx(-50 * std::cos(10 * degree)));
    CHECK(std::abs(half.y) < 1e-4);
}

TEST_CASE("motion: smooth keys, against the cubic with slopes worked out by hand") {
    const bend::Body body = body_of(1);
    // At time 1: in 30, out 10 per second; the parabola's slope (2 * 30 + 1 * 10) / 3 is below 3 * 10.
    const auto motion = motion_of({{"keys", {key(0, 0), key(1, 30), key(3, 50)}}});
    const double slope = 70.0 / 3;
    for (const double u : {0.25, 0.5, 0.75}) {
        const double up = u * u * (3 - 2 * u) * 30 + u * u * (u - 1) * slope;
        check_bend(motion->at(u, body).poses[0], up, 0);
        const double on = 30 + u * u * (3 - 2 * u) * 20 + 2 * u * (1 - u) * (1 - u) * slope;
        check_bend(motion->at(1 + 2 * u, body).poses[0], on, 0);
    }
}

TEST_CASE("motion: smooth keys do not overshoot along a line, stand still where it turns, and are smooth") {
    const bend::Body body = body_of(1);
    const auto motion = motion_of({{"keys", {key(0, 0), key(1, 1), key(1.1, 60), key(2, 60), key(3, 20)}}});
    double before = 0, fastest_change = 0, speed_before = 0;
    constexpr double step = 1e-3;
    for (int i = 0; i <= 3000; ++i) {
        const double angle = vector_of(motion->at(i * step, body).poses[0]).x;
        CHECK(angle > -1e-4);
        CHECK(angle < 60 + 1e-4);
        if (i <= 2000) CHECK(angle > before - 1e-4);
        const double speed = (angle - before) / step;
        if (i > 1) fastest_change = std::max(fastest_change, std::abs(speed - speed_before));
        speed_before = speed, before = angle;
    }
    const auto turning = motion_of({{"keys", {key(0, 0), key(1, 40), key(2, 10)}}});
    for (int i = 0; i <= 200; ++i) CHECK(vector_of(turning->at(i / 100.0, body).poses[0]).x < 40 + 1e-4);
    CHECK(fastest_change < 60);  // linear keys jump by 589 at the time 1
    CHECK(vector_of(motion->at(1.5, body).poses[0]).x == doctest::Approx(60));
}

TEST_CASE("motion: smooth keys give the same bend in whichever direction they are turned") {
    const bend::Body body = body_of(1);
    const auto turned_by = [](double turn) {
        return motion_of({{"keys", {key(0, 10, turn), key(1, 50, 70 + turn), key(3, 30, 160 + turn)}}});
    };
    const auto plain = turned_by(0), turned = turned_by(33);
    for (const double time : {0.3, 0.8, 1.7, 2.6}) {
        const glm::dvec2 a = vector_of(plain->at(time, body).poses[0]);
        const double c = std::cos(33 * degree), s = std::sin(33 * degree);
        check_bend(turned->at(time, body).poses[0], c * a.x - s * a.y, s * a.x + c * a.y);
    }
}

TEST_CASE("motion: a round of smooth keys goes on without a jump in its speed") {
    const bend::Body body = body_of(1);
    const auto motion = motion_of(
        {{"repeat", true}, {"keys", {key(0, 20), key(1, 50), key(2, -30), key(3, -10), key(4, 20)}}});
    CHECK(motion->repeats());
    const auto angle = [&](double time) { return vector_of(motion->at(time, body).poses[0]).x; };
    CHECK(angle(4.5) == doctest::Approx(angle(0.5)));
    CHECK(angle(-0.5) == doctest::Approx(angle(3.5)));
    // In and out of the first key 30 per second: the slope there is 30.
    CHECK((angle(0.01) - angle(0)) / 0.01 == doctest::Approx(30).epsilon(0.05));
    CHECK((angle(4) - angle(3.99)) / 0.01 == doctest::Approx(30).epsilon(0.05));
}

TEST_CASE("motion: regions share an angle by their lengths, have their own, or go as far as they can") {
    const bend::Body body = body_of(4);
    const auto shared = motion_of({{"keys", {key(0, 0), key(1, 80, 30)}}}, 4);
    for (const bend::Pose& pose : shared->at(1, body).poses) {
        CHECK(pose.angle == doctest::Approx(20 * degree));
        CHECK(pose.direction == doctest::Approx(30 * degree));
    }
    const json last{{"time", 1}, {"angles", {10, "max", "-max", -5}}, {"directions", {0, 10, 20, 30}}};
    const auto own = motion_of({{"interpolation", "linear"}, {"keys", {key(0, 0), last}}}, 4);
    const std::vector<bend::Pose> poses = own->at(0.5, body).poses;
    CHECK(poses[0].angle == doctest::Approx(5 * degree));
    CHECK(poses[1].angle == doctest::Approx(body.max_angle(1) / 2));
    CHECK(poses[2].angle == doctest::Approx(-body.max_angle(2) / 2));
    CHECK(poses[3].direction == doctest::Approx(30 * degree));
}

TEST_CASE("motion: a swing is a cosine, from one end to the other and back") {
    const bend::Body body = body_of(2);
    const auto motion = motion_of(
        {{"swing", {{"from", -20}, {"to", {40, 60}}}}, {"direction", 15}, {"seconds", 3}, {"lag", 0.5}}, 2);
    CHECK(motion->repeats());
    for (const double time : {0.0, 0.4, 1.5, 2.9, 7.3}) {
        const std::vector<bend::Pose> poses = motion->at(time, body).poses;
        const auto swing = [&](double from, double to, double late) {
            return from + (to - from) * (1 - std::cos(2 * pi * (time / 3 - late))) / 2;
        };
        CHECK(poses[0].angle == doctest::Approx(swing(-10, 40, 0) * degree).epsilon(1e-5));
        CHECK(poses[1].angle == doctest::Approx(swing(-10, 60, 0.25) * degree).epsilon(1e-5));
        CHECK(poses[1].direction == doctest::Approx(15 * degree));
    }
}

TEST_CASE("motion: a walk along a circle, against the circle") {
    const bend::Body body = body_of(8);
    constexpr double radius = 6;
    json points = json::array();
    for (int i = 0; i < 24; ++i) {
        const double turn = 2 * pi * i / 24;
        points.push_back({radius * std::cos(turn), 3, radius * std::sin(turn)});
    }
    const auto motion = motion_of({{"path", {{"points", points}, {"closed", true}}}, {"seconds", 5}}, 8);
    CHECK(motion->repeats());
    for (const double time : {0.0, 1.1, 2.5, 3.7, 4.99, 6.1}) {
        const cli::Moment moment = motion->at(time, body);
        const Base at = base_of(moment, body);
        const double turn = 2 * pi * time / 5;
        CHECK(glm::length(at.point - glm::dvec3(radius * std::cos(turn), 3, radius * std::sin(turn))) < 2e-3);
        CHECK(glm::length(at.heading - glm::dvec3(-std::sin(turn), 0, std::cos(turn))) < 0.02);
        CHECK(moment.path_error < 0.06);
        CHECK(!moment.clamped);
        // It bends as the circle does: by (length of a region's center line) / radius.
        const double angle = 1.25 / (radius + 1);
        for (const bend::Pose& pose : moment.poses) CHECK(pose.angle == doctest::Approx(angle).epsilon(0.1));
    }
}

TEST_CASE("motion: a body that walks does not roll, whichever way the path goes against its axis") {
    const bend::Body body = body_of(8);
    // A loop close by the direction that is opposite to the body's axis.
    const json loop{{0, 0, 0}, {0, 0, 10}, {8, 1, 14}, {14, 1, 8}, {13, 0, -6}, {14, -1, -20}, {30, 0, -30}};
    const auto motion = motion_of({{"path", loop}, {"seconds", 1}}, 8);
    Base before = base_of(motion->at(0, body), body);
    for (int i = 1; i <= 400; ++i) {
        const Base now = base_of(motion->at(i / 400.0, body), body);
        CHECK(glm::length(now.side - before.side) < glm::length(now.heading - before.heading) + 0.005);
        before = now;
    }
    const cli::Moment first = motion->at(0, body), last = motion->at(1, body);
    CHECK(glm::length(base_of(first, body).point) < 1e-6);
    CHECK(last.path_error < 0.5);
}

TEST_CASE("motion: on a closed path in space a body ends as it began") {
    const bend::Body body = body_of(8);
    const json ring{{20, 0, 0}, {0, 20, 16}, {-20, 0, -3}, {-4, -20, 14}};
    const auto motion = motion_of({{"path", {{"points", ring}, {"closed", true}}}, {"seconds", 2}}, 8);
    Base before = base_of(motion->at(0, body), body);
    for (int i = 1; i <= 400; ++i) {
        const Base now = base_of(motion->at(i / 200.0, body), body);
        const double turned = glm::length(now.heading - before.heading);
        CHECK(turned < 0.2);
        CHECK(glm::length(now.side - before.side) < turned + 0.005);
        before = now;
    }
}

TEST_CASE("motion: paths by keys, whose points move") {
    const bend::Body body = body_of(4);
    const json straight{{0, 0, 0}, {0, 0, 20}}, beside{{4, 0, 0}, {4, 0, 20}}, across{{4, 0, 0}, {24, 0, 0}};
    const auto motion = motion_of({{"interpolation", "linear"},
                                   {"scale", 0.5},
                                   {"keys",
                                    {{{"time", 0}, {"path", straight}},
                                     {{"time", 1}, {"path", beside}},
                                     {{"time", 2}, {"path", across}}}}},
                                  4);
    const Base half = base_of(motion->at(0.5, body), body);
    CHECK(glm::length(half.point - glm::dvec3(1, 0, 0)) < 1e-6);
    CHECK(glm::length(half.heading - glm::dvec3(0, 0, 1)) < 1e-6);
    const Base turning = base_of(motion->at(1.5, body), body);
    CHECK(glm::length(turning.heading - glm::normalize(glm::dvec3(1, 0, 1))) < 1e-6);
}

TEST_CASE("motion: a table says what JSON says") {
    const Folder folder;
    folder.write("keys.csv",
                 "# of two regions\r\ntime, Angle 1, direction_1,angle2,direction2\r\n0,0,0,0,0\r\n\r\n"
                 "1.5,30,-20,max,+45\r\n");
    const json same{{"keys",
                     {{{"time", 0.0}, {"angles", {0.0, 0.0}}, {"directions", {0.0, 0.0}}},
                      {{"time", 1.5}, {"angles", {30.0, "max"}}, {"directions", {-20.0, 45.0}}}}}};
    CHECK(cli::read_keys_file(folder / "keys.csv") == same);
    folder.write("keys.json", same.dump());
    CHECK(cli::read_keys_file(folder / "keys.json") == same);
    folder.write("one.csv", "time,angle\n0,1\n2,-3");
    CHECK(cli::read_keys_file(folder / "one.csv") ==
          json{{"keys", {{{"time", 0.0}, {"angle", 1.0}}, {{"time", 2.0}, {"angle", -3.0}}}}});
    folder.write("path.txt", "# x y z\n0 0 1e1\n1,2,-3\n\t4, 5  6\n");
    CHECK(cli::read_path_file(folder / "path.txt") ==
          json{{0.0, 0.0, 10.0}, {1.0, 2.0, -3.0}, {4.0, 5.0, 6.0}});
}

TEST_CASE("motion: a body without room on its path is refused") {
    const bend::Body body = body_of(2);
    const auto motion = motion_of({{"path", {{0, 0, 0}, {0, 0, 9}}}, {"seconds", 1}}, 2);
    CHECK_THROWS_WITH((void)motion->at(0, body), doctest::Contains("no room to walk on a path of 9"));
    const json ring{{"points", {{0, 0, 0}, {0, 0, 2}, {0, 2, 2}}}, {"closed", true}};
    const auto round = motion_of({{"path", ring}, {"seconds", 1}}, 2);
    CHECK_THROWS_WITH((void)round->at(0, body), doctest::Contains("does not fit on a closed path"));
}
