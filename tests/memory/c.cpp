// SPDX-License-Identifier: MIT
#include "small_mesh.hpp"
#include "starve.hpp"

#include <goffer/fit/bake.hpp>
#include <goffer/fit/sockets.hpp>

#include <goffer.h>

#include <cstring>
#include <string>
#include <utility>
#include <vector>

/// The C interface where memory runs out: null and an error, and never an exception. What leaks is what
/// bodies.cpp names, which is not this interface's.

using namespace goffer;
using namespace goffer::test;

namespace {

goffer_mesh mesh_of(const TestMesh& mesh) {
    goffer_mesh from = {};
    from.positions = &mesh.positions[0].x;
    from.vertex_count = mesh.positions.size();
    from.triangles = mesh.triangles.data();
    from.triangle_count = mesh.triangles.size() / 3;
    return from;
}

std::vector<std::byte> baked_bytes(const TestMesh& mesh) {
    fit::BindOptions options;
    options.folds = 2;
    options.regions = {{0.4, 2}, {0.6, 3}};
    const fit::Binding binding = fit::bind(mesh.geometry(), mesh.cylinder, options);
    const fit::BakeLevel level{&binding, {mesh.triangles, {}, {}, {}}};
    const bend::NamedSocket tip{"tip", fit::socket_at(binding, 1, 0, mesh.cylinder.radius)};
    return fit::bake({.levels = {&level, 1}, .sockets = {&tip, 1}});
}

/// Starves `make`, which returns an object, or null and an error; `free` takes the object.
template <class Make, class Free>
void starve_call(const Make& make, const Free& free, Diet diet = {}) {
    bool told = true;
    starve<fit::Error>(
        [&] {
            goffer_error error;
            std::memset(&error, 0xff, sizeof error);
            auto* const made = make(&error);
            const int code = made != nullptr ? GOFFER_ERROR_NONE : GOFFER_ERROR_MEMORY;
            const char* const text = made != nullptr ? "" : "not enough memory";
            told = told && error.code == code && std::strcmp(error.text, text) == 0;
            free(made);
            if (made == nullptr) throw std::bad_alloc();
        },
        diet);
    CHECK(told);
}

}  // namespace

TEST_CASE("C: a bind without it is an error") {
    const TestMesh mesh = small_mesh();
    const goffer_mesh from = mesh_of(mesh);
    const double shares[] = {0.4, 0.6};
    goffer_bind_options options = goffer_bind_defaults();
    options.folds = 2;
    options.shares = shares;
    options.region_count = 2;
    starve_call([&](goffer_error* error) { return goffer_body_bind(&from, &options, error); },
                goffer_body_free, {.most = 150});
}

TEST_CASE("C: a body file without it is not loaded, nor are its sockets") {
    const std::vector<std::byte> bytes = baked_bytes(small_mesh());
    starve_call(
        [&](goffer_error* error) {
            return goffer_file_load(bytes.data(), bytes.size(), GOFFER_VERIFY_EVERYTHING, 1, error);
        },
        goffer_file_free);
    starve_call(
        [](goffer_error* error) {
            return goffer_file_open(GOFFER_SOURCE_DIR "/tests/data/cylinder_v1.goffer",
                                    GOFFER_VERIFY_EVERYTHING, error);
        },
        goffer_file_free);
    goffer_file* const file =
        goffer_file_load(bytes.data(), bytes.size(), GOFFER_VERIFY_EVERYTHING, 1, nullptr);
    REQUIRE(file != nullptr);
    starve_call([&](goffer_error* error) { return goffer_file_sockets(file, error); }, goffer_sockets_free);
    goffer_file_free(file);
}

TEST_CASE("C: sockets and levels of a bound body, and a crowd, without it are errors") {
    const TestMesh mesh = small_mesh();
    const goffer_mesh from = mesh_of(mesh);
    goffer_body* const body = goffer_body_bind(&from, nullptr, nullptr);
    REQUIRE(body != nullptr);
    const float points[] = {0, 0, 0, 1, 1, 1};
    starve_call([&](goffer_error* error) { return goffer_body_sockets(body, &from, points, 2, error); },
                goffer_sockets_free);
    starve_call([&](goffer_error* error) { return goffer_body_bind_level(&from, body, error); },
                goffer_body_free);
    goffer_body_free(body);
    starve_call([](goffer_error* error) { return goffer_crowd_create(3, error); }, goffer_crowd_free);
}
