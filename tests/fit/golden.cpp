// SPDX-License-Identifier: MIT
#include "support/models.hpp"
#include "support/worst.hpp"
#include "synthetic.hpp"

#include <goffer/bend/job.hpp>
#include <goffer/fit/bind.hpp>
#include <goffer/fit/refine.hpp>
#include <goffer/mesh/mesh.hpp>

#include <array>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <istream>
#include <map>
#include <ostream>
#include <string>

/// What the models of tests/data become, against what they became before: tests/data/bent.txt. Other tests
/// say what a result has to be like; this one, that nothing about it changes by accident, down to constants
/// that are a matter of judgment. Where a change is meant, GOFFER_WRITE_BENT=1 writes the file anew.

namespace goffer::test {
namespace {

constexpr const char* file = GOFFER_SOURCE_DIR "/tests/data/bent.txt";
constexpr std::size_t places = 24;
constexpr double within = 3e-4;

struct Golden {
    std::size_t vertices = 0, regions = 0;
    int folds = 0, capacity = 0;          // of all regions
    double radius = 0, residual = 0;      // over the length, over the radius
    double max_angle = 0;                 // of all regions, radians
    std::array<glm::dvec3, places> bent;  // vertices at equal steps, from the origin, in radii
};

std::istream& operator>>(std::istream& in, Golden& g) {
    in >> g.vertices >> g.regions >> g.folds >> g.capacity >> g.radius >> g.residual >> g.max_angle;
    for (glm::dvec3& p : g.bent) in >> p.x >> p.y >> p.z;
    return in;
}

std::ostream& operator<<(std::ostream& out, const Golden& g) {
    out << g.vertices << ' ' << g.regions << ' ' << g.folds << ' ' << g.capacity << ' ' << g.radius << ' '
        << g.residual << ' ' << g.max_angle;
    for (const glm::dvec3& p : g.bent) out << ' ' << p.x << ' ' << p.y << ' ' << p.z;
    return out;
}

enum class Rows { as_given, refined };

struct Case {
    std::string name, model;
    std::function<fit::Cylinder(const fit::Geometry&)> fitted;
    fit::BindOptions options;
    Rows rows = Rows::refined;
    double masked = 0;  // the mask is 0 below this share of the length, 1 from a tenth above it on
};

std::function<fit::Cylinder(const fit::Geometry&)> with(fit::RestPose rest, std::size_t arcs = 0) {
    return
        [=](const fit::Geometry& geometry) { return fit::fit_cylinder(geometry, std::nullopt, rest, arcs); };
}

std::vector<Case> cases() {
    fit::BindOptions mesh;
    mesh.amplitude = fit::Amplitude::mesh;
    fit::BindOptions parts = mesh;
    parts.wrinkle_range = {0.2, 0.7};
    parts.regions = {{.share = 0.3}, {.share = 0.4}, {.share = 0.3}};
    fit::BindOptions area = fit::BindOptions::as_in_paper();
    area.amplitude = fit::Amplitude::area;
    fit::BindOptions gentle = fit::BindOptions::as_in_paper();
    gentle.amplitude = fit::Amplitude::mesh;
    gentle.profile = fit::Profile::smooth;
    gentle.onset = 0.02;
    using enum fit::RestPose;
    std::vector<Case> all;
    for (const char* model : {"blub_open.obj", "fuze.ply", "log_01.glb", "wine_bottle.glb"})
        all.push_back({std::string(model) + ":mesh", model, with(chain), mesh});
    // How many arcs are found where nobody says so may depend on the compiler.
    all.push_back({"insect_leg.glb:arc", "insect_leg.glb", with(automatic), mesh});
    all.push_back({"insect_leg.glb:straight", "insect_leg.glb", with(straight), mesh});
    all.push_back({"insect_leg.glb:arcs3", "insect_leg.glb", with(chain, 3), mesh});
    all.push_back({"fuze.ply:regions", "fuze.ply", with(straight), parts});
    all.push_back({"log_01.glb:area", "log_01.glb", with(straight), area});
    all.push_back({"wine_bottle.glb:gentle", "wine_bottle.glb", with(straight), gentle});
    all.push_back({"fuze.ply:coarse", "fuze.ply", with(straight), mesh, Rows::as_given});
    all.push_back({"blub_open.obj:masked", "blub_open.obj", with(straight), mesh, Rows::as_given, 0.4});
    return all;
}

Golden result(const Case& one) {
    const mesh::VertexArrays records = mesh::vertex_arrays(mesh::load(model(one.model)));
    Solid solid{records.positions, records.triangles};
    const fit::Cylinder cylinder = one.fitted(solid.geometry());
    if (one.rows == Rows::refined) {
        const auto refinement =
            fit::refine(solid.geometry(), cylinder, fit::stretches_of(cylinder, one.options));
        solid = {fit::refined_positions(solid.positions, refinement), refinement.triangles};
    }
    fit::Geometry geometry = solid.geometry();
    std::vector<float> mask;
    for (const glm::vec3& p : solid.positions) {
        const double z = glm::dot(glm::dvec3(p) - cylinder.origin, cylinder.axis) / cylinder.length;
        mask.push_back(static_cast<float>(glm::smoothstep(one.masked, one.masked + 0.1, z)));
    }
    if (one.masked > 0) geometry.wrinkle_mask = mask;
    const fit::Binding binding = fit::bind(geometry, cylinder, one.options);
    Golden g;
    g.vertices = solid.positions.size();
    g.regions = binding.regions.size();
    g.radius = binding.cylinder.radius / binding.cylinder.length;
    g.residual = binding.cylinder.residual;
    std::vector<bend::Pose> poses;
    for (std::size_t r = 0; r < g.regions; ++r) {
        g.folds += binding.folds(r);
        g.capacity += binding.folds_capacity(r);
        g.max_angle += binding.body.max_angle(r);
        const bend::Pose rest = binding.body.rest_pose(r);
        const float more = 0.6f * (binding.body.max_angle(r) - rest.angle);
        poses.push_back({rest.angle + more, rest.direction + 0.4f});
    }
    std::vector<glm::vec3> bent(g.vertices);
    bend::DeformJob job;
    job.body = &binding.body;
    job.poses = poses;
    job.positions = interleaved<3>(&bent[0].x, bent.size());
    REQUIRE(bend::validate(job).none());
    bend::run(job);
    const std::vector<std::uint32_t> in_body = binding.vertices_in_body();
    for (std::size_t i = 0; i < places; ++i)
        g.bent[i] = glm::dvec3(bent[in_body[i * (g.vertices - 1) / (places - 1)]]) / binding.cylinder.radius;
    return g;
}

std::map<std::string, Golden> read() {
    std::map<std::string, Golden> all;
    std::ifstream in(file);
    for (std::string name; in >> name;) in >> all[name];
    return all;
}

}  // namespace

TEST_CASE("models become what they became before") {
    std::map<std::string, Golden> found;
    for (const Case& one : cases()) found[one.name] = result(one);
    if (std::getenv("GOFFER_WRITE_BENT") != nullptr) {
        std::ofstream out(file);
        out.precision(6);
        for (const auto& [name, g] : found) out << name << ' ' << g << '\n';
    }
    const std::map<std::string, Golden> before = read();
    REQUIRE(before.size() == found.size());
    for (const auto& one : found) {
        CAPTURE(one.first);
        REQUIRE(before.contains(one.first));
        const Golden &now = one.second, &then = before.at(one.first);
        CHECK(now.vertices == then.vertices);
        CHECK(now.regions == then.regions);
        CHECK(now.folds == then.folds);
        CHECK(now.capacity == then.capacity);
        CHECK(std::abs(now.radius / then.radius - 1) < within);
        CHECK(std::abs(now.residual / then.residual - 1) < within);
        CHECK(std::abs(now.max_angle / then.max_angle - 1) < within);
        double worst = 0;
        for (std::size_t i = 0; i < places; ++i) take_worst(worst, glm::distance(now.bent[i], then.bent[i]));
        CHECK(worst < within);
    }
}

}  // namespace goffer::test
