// SPDX-License-Identifier: MIT
#include "support/body_bytes.hpp"
#include "twice.hpp"

#include <goffer/bend/body_file.hpp>

#include <doctest/doctest.h>
#include <goffer.h>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

/// What the C interface says of what is wrong, and what it does with handles and indices of nothing.

namespace goffer::test {
namespace {

/// The code of the error that `call` tells, which has a text.
template <class Call>
int code_of(const Call& call) {
    goffer_error error;
    std::memset(&error, 0xff, sizeof error);
    const bool good = call(&error) != 0;
    CHECK(good == (error.code == GOFFER_ERROR_NONE));
    CHECK(good == std::string(error.text).empty());
    return error.code;
}

}  // namespace

TEST_CASE("C: an error has a code for programs") {
    Random random(80);
    const Twice twice(random, 1);
    const auto code_of_bind = [&](const goffer_mesh* mesh, const goffer_bind_options& options) {
        return code_of([&](goffer_error* error) {
            goffer_body* const body = goffer_body_bind(mesh, &options, error);
            goffer_body_free(body);
            return body != nullptr;
        });
    };
    goffer_mesh mesh = mesh_of(twice.mesh);
    goffer_bind_options options = goffer_bind_defaults();
    CHECK(code_of_bind(&mesh, options) == GOFFER_ERROR_NONE);
    CHECK(code_of_bind(nullptr, options) == GOFFER_ERROR_ARGUMENT);
    options.profile = 9;
    CHECK(code_of_bind(&mesh, options) == GOFFER_ERROR_ARGUMENT);
    mesh.vertex_count = 3;  // not those of the triangles
    CHECK(code_of_bind(&mesh, goffer_bind_defaults()) == GOFFER_ERROR_BIND);

    const goffer_job job = goffer_job_defaults();
    CHECK(code_of([&](goffer_error* e) { return goffer_job_validate(&job, e); }) == GOFFER_ERROR_ARGUMENT);
    CHECK(code_of([&](goffer_error* e) { return goffer_job_validate(nullptr, e); }) == GOFFER_ERROR_ARGUMENT);
    CHECK(code_of([&](goffer_error* e) { return goffer_crowd_validate(nullptr, e); }) ==
          GOFFER_ERROR_ARGUMENT);
    CHECK(code_of([&](goffer_error* e) { return goffer_crowd_set(nullptr, 0, nullptr, e); }) ==
          GOFFER_ERROR_ARGUMENT);
    CHECK(code_of([&](goffer_error* e) { return goffer_crowd_create(SIZE_MAX, e) != nullptr; }) ==
          GOFFER_ERROR_MEMORY);
}

TEST_CASE("C: the code of a body file says whether to look for it, to bake it again, or to call otherwise") {
    Random random(81);
    const Twice twice(random, 1);
    const AlignedBytes file(baked_bytes(twice));
    const auto code_of_load = [](std::span<const std::byte> bytes, int verify, int copy) {
        return code_of([&](goffer_error* error) {
            goffer_file* const loaded = goffer_file_load(bytes.data(), bytes.size(), verify, copy, error);
            goffer_file_free(loaded);
            return loaded != nullptr;
        });
    };
    const std::span<std::byte> bytes = file.bytes();
    CHECK(code_of_load(bytes, GOFFER_VERIFY_EVERYTHING, 0) == GOFFER_ERROR_NONE);
    CHECK(code_of_load(bytes, 7, 0) == GOFFER_ERROR_ARGUMENT);
    CHECK(code_of_load(bytes.first(100), GOFFER_VERIFY_LAYOUT, 1) == GOFFER_ERROR_FILE);
    CHECK(code_of_load({}, GOFFER_VERIFY_LAYOUT, 1) == GOFFER_ERROR_FILE);
    std::vector<std::byte> moved(bytes.size() + 65);
    std::byte* const odd = moved.data() + 1 + (64 - reinterpret_cast<std::uintptr_t>(moved.data()) % 64) % 64;
    std::ranges::copy(bytes, odd);
    CHECK(code_of_load({odd, bytes.size()}, GOFFER_VERIFY_EVERYTHING, 0) == GOFFER_ERROR_ARGUMENT);
    bytes[bytes.size() / 2] ^= std::byte{1};
    CHECK(code_of_load(bytes, GOFFER_VERIFY_CHECKSUM, 0) == GOFFER_ERROR_FILE);
    bytes[12] = static_cast<std::byte>(bend::body_file_version + 1);
    CHECK(code_of_load(bytes, GOFFER_VERIFY_CHECKSUM, 0) == GOFFER_ERROR_VERSION);
    std::ranges::reverse(bytes.subspan(8, 4));
    CHECK(code_of_load(bytes, GOFFER_VERIFY_CHECKSUM, 0) == GOFFER_ERROR_VERSION);

    const auto code_of_open = [](const char* name) {
        return code_of([&](goffer_error* error) {
            return goffer_file_open(name, GOFFER_VERIFY_EVERYTHING, error) != nullptr;
        });
    };
    CHECK(code_of_open(nullptr) == GOFFER_ERROR_ARGUMENT);
    CHECK(code_of_open(GOFFER_SOURCE_DIR "/none.goffer") == GOFFER_ERROR_MISSING);
    CHECK(code_of_open(GOFFER_SOURCE_DIR "/tests") == GOFFER_ERROR_SYSTEM);
    CHECK(code_of_open(GOFFER_SOURCE_DIR "/README.md") == GOFFER_ERROR_FILE);
}

TEST_CASE("C: handles that are null, and indices of what is not there, give zeros or do nothing") {
    Random random(82);
    const Twice twice(random, 1);
    const std::vector<std::byte> bytes = baked_bytes(twice);
    goffer_file* const file = goffer_file_load(bytes.data(), bytes.size(), GOFFER_VERIFY_LAYOUT, 1, nullptr);
    REQUIRE(file != nullptr);
    for (const goffer_file* of :
         {static_cast<const goffer_file*>(nullptr), static_cast<const goffer_file*>(file)}) {
        const std::size_t level = of != nullptr ? 1 : 0;
        CHECK(goffer_file_body(of, level) == nullptr);
        CHECK(goffer_file_mesh(of, level).triangle_count == 0);
        CHECK(goffer_file_part(of, level, 0).triangle_count == 0);
        CHECK(goffer_file_part(of, 0, 0).triangle_count == 0);  // there is a level, but no part
        CHECK(goffer_file_material(of, 0).name.size == 0);
        CHECK(goffer_file_socket_name(of, 0).size == 0);
    }
    CHECK(goffer_file_notes(nullptr).size == 0);
    const goffer_job job = {};
    CHECK(goffer_job_bounds(nullptr).high[0] == 0);
    CHECK(goffer_job_bounds(&job).high[0] == 0);
    goffer_file_free(file);

    CHECK(goffer_body_vertex_layout(nullptr).stride == 0);
    goffer_body_write_vertices(nullptr, nullptr);
    goffer_sockets_frames(nullptr, nullptr, nullptr);
    CHECK(goffer_sockets_count(nullptr) == 0);
    goffer_crowd_set_frame(nullptr, 1);
    goffer_crowd_set_stores(nullptr, GOFFER_STORES_CACHED);
    goffer_crowd_set_isa(nullptr, GOFFER_ISA_SCALAR);
    goffer_crowd* const crowd = goffer_crowd_create(1, nullptr);
    REQUIRE(crowd != nullptr);
    for (const std::size_t index : {0, 1}) {  // a batch that was not set, and none
        for (const goffer_crowd* of :
             {static_cast<const goffer_crowd*>(nullptr), static_cast<const goffer_crowd*>(crowd)}) {
            goffer_crowd_bounds(of, index, nullptr);
            goffer_crowd_set_up(of, index, nullptr);
            goffer_crowd_set_up_previous(of, index, nullptr);
        }
    }
    goffer_crowd_free(crowd);
}

}  // namespace goffer::test
