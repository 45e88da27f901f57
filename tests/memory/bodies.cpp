// SPDX-License-Identifier: MIT
#include "small_mesh.hpp"
#include "starve.hpp"

#include <goffer/bend/body_file.hpp>
#include <goffer/bend/body_table.hpp>
#include <goffer/bend/sockets.hpp>
#include <goffer/fit/bake.hpp>
#include <goffer/fit/refine.hpp>
#include <goffer/fit/sockets.hpp>

using namespace goffer;
using namespace goffer::test;

/// modules/bend is compiled without exceptions: what it had half made when memory ran out is not freed
/// (modules/README.md, "Errors"). All else has to be.
extern "C" const char* __lsan_default_suppressions() {  // NOLINT(bugprone-reserved-identifier): its name
    return "leak:goffer::bend::Body::make\nleak:goffer::bend::load\nleak:goffer::bend::save\n"
           "leak:goffer::bend::Sockets::make\n";
}

namespace {

void starve_bind(const fit::BindOptions& options, std::uint64_t most) {
    const TestMesh mesh = small_mesh();
    starve<fit::Error>([&] { (void)fit::bind(mesh.geometry(), mesh.cylinder, options); }, {.most = most});
}

}  // namespace

TEST_CASE("a fit without it ends in an error") {
    const TestMesh mesh = small_mesh();
    starve<fit::Error>([&] { (void)fit::fit_cylinder(mesh.geometry()); });
    starve<fit::Error>([&] { (void)fit::fit_shape(mesh.geometry(), mesh.cylinder); });
}

TEST_CASE("a bind without it ends in an error") {
    fit::BindOptions options = fit::BindOptions::as_in_paper();
    options.folds = 2;
    options.table_rows = 4;
    starve_bind(options, 400);
    options.profile = fit::Profile::even;
    options.shape = fit::ShapeMode::automatic;
    options.regions = {{0.4, 2}, {0.6, 3}};
    starve_bind(options, 400);
}

TEST_CASE("a bind that solves for the mesh's area, on several threads, ends in an error without it") {
    fit::BindOptions options;
    options.folds = 2;
    options.table_rows = 4;
    options.amplitude = fit::Amplitude::mesh;
    starve_bind(options, 120);
}

TEST_CASE("a refinement without it ends in an error") {
    const TestMesh mesh = small_mesh();
    starve<fit::Error>([&] { (void)fit::refine(mesh.geometry(), mesh.cylinder, 6); });
}

TEST_CASE("a body file without it is not written, and not loaded") {
    const TestMesh mesh = small_mesh();
    fit::BindOptions options;
    options.folds = 2;
    options.regions = {{0.4, 2}, {0.6, 3}};
    const fit::Binding binding = fit::bind(mesh.geometry(), mesh.cylinder, options);
    fit::BakeLevel level{&binding, {}};
    level.mesh.triangles = mesh.triangles;
    const bend::NamedSocket tip{"tip",
                                fit::socket_at(binding, 0.5 * mesh.cylinder.length, 0, mesh.cylinder.radius)};
    const fit::BakeInput input{.levels = {&level, 1}, .sockets = {&tip, 1}};
    starve<fit::Error>([&] { (void)fit::bake(input); });

    const std::vector<std::byte> bytes = fit::bake(input);
    starve<fit::Error>([&] { (void)bend::load_copy(bytes).value(); });
    const std::string file = GOFFER_SOURCE_DIR "/tests/data/cylinder_v1.goffer";
    starve<fit::Error>([&] { (void)bend::load_file(file.c_str()).value(); });
}

TEST_CASE("a table of bodies without it keeps those that it has") {
    const TestMesh mesh = small_mesh();
    fit::BindOptions options;
    options.folds = 0;
    starve<fit::Error>(
        [&] {
            bend::BodyTable bodies;
            for (int i = 0; i < 40; ++i)
                (void)bodies.add(fit::bind(mesh.geometry(), mesh.cylinder, options).body);
            CHECK(bodies.size() == 40);
        },
        {.most = 200});
}
