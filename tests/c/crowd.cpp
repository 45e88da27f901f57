// SPDX-License-Identifier: MIT
#include "twice.hpp"

#include <goffer/bend/bounds.hpp>
#include <goffer/bend/capsules.hpp>
#include <goffer/bend/crowd.hpp>
#include <goffer/bend/kernel_input.hpp>
#include <goffer/fit/bake.hpp>
#include <goffer/fit/sockets.hpp>
#include <goffer/gpu/source.hpp>
#include <goffer/gpu/vertices.hpp>

#include <doctest/doctest.h>
#include <goffer.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string>
#include <vector>

/// The C interface gives the bits of the C++ one: crowds, body files and what shaders read.

namespace goffer::test {

TEST_CASE("C: a crowd gives the bits of single jobs, whole, in parallel and in pieces") {
    Random random(72);
    const Twice twice(random, 2);
    const std::size_t count = goffer_body_vertex_count(twice.body), instances = 9;
    struct Worm {
        std::uint8_t visible;
        goffer_pose poses[2];
        float rows[12];
    };
    std::vector<Worm> worms(instances);
    std::vector<float> expected(3 * count * instances), out(expected.size());
    for (std::size_t i = 0; i < instances; ++i) {
        Worm& worm = worms[i];
        worm = {
            static_cast<std::uint8_t>(i != 4), {}, {1, 0, 0, static_cast<float>(i), 0, 1, 0, 2, 0, 0, 1, 3}};
        for (goffer_pose& pose : worm.poses)
            pose = {static_cast<float>(uniform(random, -2, 2)), static_cast<float>(uniform(random, -4, 4))};
        if (worm.visible == 0) continue;
        const float transform[12] = {1, 0, 0, 0, 1, 0, 0, 0, 1, worm.rows[3], 2, 3};
        goffer_job job = {};
        job.body = twice.body;
        job.poses = worm.poses;
        job.pose_count = 2;
        job.wrinkle_weight = 1;
        job.transform = transform;
        float* const first = &expected[3 * count * i];
        job.positions = {{first, first + 1, first + 2, nullptr}, 12, count};
        REQUIRE(goffer_job_validate(&job, nullptr) == 1);
        goffer_job_run(&job);
    }
    goffer_batch batch = {};
    batch.body = twice.body;
    batch.count = instances;
    const auto column = [&](std::size_t offset) {
        return goffer_column{worms.data(), instances, sizeof(Worm), static_cast<std::uint32_t>(offset), 0};
    };
    batch.poses = column(offsetof(Worm, poses));
    batch.transforms = column(offsetof(Worm, rows));
    batch.transform_layout = GOFFER_ROWS4;
    batch.visible = column(offsetof(Worm, visible));
    batch.positions = stream(out, 3);
    batch.vertex_step = count;
    std::vector<goffer_bounds> boxes(instances), boxes_after(instances);
    batch.bounds = boxes.data();
    goffer_error error;
    goffer_crowd* crowd = goffer_crowd_create(1, &error);
    REQUIRE(crowd != nullptr);
    REQUIRE(goffer_crowd_set(crowd, 0, &batch, &error) == 1);
    const int valid = goffer_crowd_validate(crowd, &error);
    INFO(error.text);
    REQUIRE(valid == 1);
    CHECK(goffer_crowd_run(crowd).deformed == instances - 1);
    CHECK(same_bits(expected, out));
    std::ranges::fill(out, 0.0f);
    CHECK(goffer_crowd_run_parallel(crowd).deformed == instances - 1);
    CHECK(same_bits(expected, out));
    std::ranges::fill(out, 0.0f);
    std::size_t deformed = 0;
    for (std::size_t piece = 5; piece-- > 0;) deformed += goffer_crowd_run_piece(crowd, piece, 5).deformed;
    CHECK(deformed == instances - 1);
    CHECK(same_bits(expected, out));
    CHECK(goffer_crowd_run_piece(crowd, 0, 0).deformed == 0);
    CHECK(goffer_crowd_run_piece(crowd, 5, 3).deformed == 0);
    goffer_crowd_bounds(crowd, 0, boxes_after.data());
    CHECK(std::memcmp(&boxes[0], &boxes_after[0], 4 * sizeof boxes[0]) == 0);

    // Pages of four worms, and a turn in every second frame.
    std::vector<Worm> padded = worms;
    padded.resize(12);
    const Worm* const pages[] = {&padded[0], &padded[4], &padded[8]};
    const std::uint8_t interval = 2;
    batch.poses.data = batch.transforms.data = batch.visible.data = pages;
    batch.poses.page_size = batch.transforms.page_size = batch.visible.page_size = 4;
    batch.update_intervals = {&interval, instances, 0, 0, 0};
    REQUIRE(goffer_crowd_set(crowd, 0, &batch, &error) == 1);
    REQUIRE(goffer_crowd_validate(crowd, &error) == 1);
    std::ranges::fill(out, 0.0f);
    goffer_crowd_set_frame(crowd, 6);
    CHECK(goffer_crowd_run(crowd).deformed == 4);
    goffer_crowd_set_frame(crowd, 7);
    CHECK(goffer_crowd_run(crowd).deformed == 4);
    CHECK(same_bits(expected, out));

    batch.poses.page_size = 3;
    CHECK(goffer_crowd_set(crowd, 0, &batch, &error) == 0);
    CHECK(std::string(error.text) == "page_size: not a power of two up to 2^32");
    batch.poses.page_size = 4;
    batch.transform_layout = 3;
    CHECK(goffer_crowd_set(crowd, 0, &batch, &error) == 0);
    CHECK(goffer_crowd_set(crowd, 1, &batch, &error) == 0);
    CHECK(goffer_crowd_set(crowd, 0, nullptr, nullptr) == 0);
    batch.transform_layout = GOFFER_ROWS4;
    batch.vertex_step = 1;
    CHECK(goffer_crowd_set(crowd, 0, &batch, &error) == 1);
    CHECK(goffer_crowd_validate(crowd, &error) == 0);
    CHECK(std::string(error.text).starts_with("batches[0].vertex_step: "));
    goffer_crowd_free(crowd);
}

TEST_CASE("C: a body file") {
    Random random(73);
    const Twice twice(random, 2);
    const bend::NamedSocket socket{"hat", fit::socket_at(twice.binding, 1, 0, 0.1)};
    const bend::DrawMaterial material{"skin", {1, 0.5f, 0.25f, 1}};
    const auto triangles = static_cast<std::uint32_t>(twice.mesh.triangles.size() / 3);
    const bend::DrawPart part{"all", 0, triangles, 0};
    const fit::BakeLevel level{&twice.binding, {twice.mesh.triangles, {}, {}, {&part, 1}}};
    const std::vector<std::byte> bytes = fit::bake({{&level, 1}, {&material, 1}, {&socket, 1}, "notes"});
    goffer_error error;
    goffer_file* file = goffer_file_load(bytes.data(), bytes.size(), GOFFER_VERIFY_EVERYTHING, 1, &error);
    INFO(error.text);
    REQUIRE(file != nullptr);
    CHECK(goffer_file_level_count(file) == 1);
    CHECK(goffer_file_body(file, 1) == nullptr);
    const goffer_body* body = goffer_file_body(file, 0);
    CHECK(goffer_body_vertex_count(body) == twice.binding.body.vertex_count());
    CHECK(goffer_body_order(body) == nullptr);
    const goffer_file_draw draw = goffer_file_mesh(file, 0);
    CHECK(draw.triangle_count == triangles);
    CHECK(draw.uvs == nullptr);
    CHECK(draw.part_count == 1);
    for (int axis = 0; axis < 3; ++axis) {
        const auto [low, high] = std::ranges::minmax(
            twice.mesh.positions, {}, [&](const glm::vec3& position) { return position[axis]; });
        CHECK(std::fabs(draw.rest_bounds.low[axis] - low[axis]) < 1e-4f);
        CHECK(std::fabs(draw.rest_bounds.high[axis] - high[axis]) < 1e-4f);
    }
    const auto text = [](const goffer_string& string) { return std::string(string.data, string.size); };
    CHECK(text(goffer_file_part(file, 0, 0).name) == "all");
    CHECK(goffer_file_part(file, 0, 0).triangle_count == triangles);
    CHECK(goffer_file_material_count(file) == 1);
    CHECK(text(goffer_file_material(file, 0).name) == "skin");
    CHECK(goffer_file_material(file, 0).base_color[1] == 0.5f);
    CHECK(goffer_file_socket_count(file) == 1);
    CHECK(text(goffer_file_socket_name(file, 0)) == "hat");
    CHECK(text(goffer_file_notes(file)) == "notes");

    goffer_sockets* sockets = goffer_file_sockets(file, &error);
    REQUIRE(sockets != nullptr);
    goffer_job job = goffer_job_defaults();
    job.body = body;
    job.poses = twice.poses.data();
    job.pose_count = 2;
    goffer_socket_frame frame;
    goffer_sockets_frames(sockets, &job, &frame);
    bend::SocketFrame expected;
    bend::Sockets::make(twice.binding.body, {&socket.socket, 1})
        .value()
        .frames(twice.cpp_poses(), {&expected, 1});
    CHECK(std::memcmp(&frame, &expected, sizeof frame) == 0);
    goffer_sockets_free(sockets);
    goffer_file_free(file);

    CHECK(goffer_file_load(bytes.data(), bytes.size() - 1, GOFFER_VERIFY_EVERYTHING, 1, &error) == nullptr);
    CHECK(std::string(error.text).find("fewer bytes") != std::string::npos);
    CHECK(goffer_file_load(bytes.data(), bytes.size(), 7, 1, &error) == nullptr);
    CHECK(std::string(error.text).starts_with("verify: "));
    CHECK(goffer_file_load(nullptr, 5, GOFFER_VERIFY_LAYOUT, 0, &error) == nullptr);

    goffer_file* opened = goffer_file_open(GOFFER_SOURCE_DIR "/tests/data/cylinder_v1.goffer",
                                           GOFFER_VERIFY_EVERYTHING, &error);
    REQUIRE(opened != nullptr);
    CHECK(goffer_file_level_count(opened) == 2);
    CHECK(goffer_body_base(goffer_file_body(opened, 0)).length == 0);
    CHECK(goffer_body_folds(goffer_file_body(opened, 0), 0).suitable == 0);
    goffer_file_free(opened);
    CHECK(goffer_file_open("none.goffer", GOFFER_VERIFY_EVERYTHING, &error) == nullptr);
    CHECK(std::string(error.text) ==
          "body file: there is no such file; check its name, and the working folder");
    CHECK(goffer_file_open(nullptr, GOFFER_VERIFY_EVERYTHING, &error) == nullptr);
}

TEST_CASE("C: what a shader reads is what C++ writes") {
    Random random(76);
    const Twice twice(random, 3);
    const bend::Body& body = twice.binding.body;
    const gpu::VertexLayout layout = gpu::vertex_layout(body);
    const goffer_vertex_layout c_layout = goffer_body_vertex_layout(twice.body);
    CHECK(std::memcmp(&layout, &c_layout, sizeof layout) == 0);
    std::vector<std::byte> records(body.vertex_count() * layout.stride), c_records(records.size());
    gpu::write_vertices(body, records);
    goffer_body_write_vertices(twice.body, c_records.data());
    CHECK(same_bits(records, c_records));
    CHECK(std::string_view(goffer_deform_glsl().data, goffer_deform_glsl().size) == gpu::deform_glsl());

    goffer_error error;
    goffer_batch batch = {};
    batch.body = twice.body;
    batch.count = 1;
    batch.poses = {twice.poses.data(), 1, 3 * sizeof(goffer_pose), 0, 0};
    batch.previous_poses = {twice.poses.data(), 1, 3 * sizeof(goffer_pose), 0, 0};
    goffer_crowd* crowd = goffer_crowd_create(1, &error);
    REQUIRE(goffer_crowd_set(crowd, 0, &batch, &error) == 1);
    const std::vector<bend::Pose> poses = twice.cpp_poses();
    const bend::DeformJob job{.body = &body, .poses = poses};
    std::vector<bend::Coefficients> expected(3), now(3), before(3);
    bend::set_up(bend::batch_of(job), expected);
    goffer_crowd_set_up(crowd, 0, reinterpret_cast<float*>(now.data()));
    goffer_crowd_set_up_previous(crowd, 0, reinterpret_cast<float*>(before.data()));
    CHECK(std::memcmp(expected.data(), now.data(), 3 * sizeof now[0]) == 0);
    CHECK(std::memcmp(expected.data(), before.data(), 3 * sizeof now[0]) == 0);
    goffer_crowd_free(crowd);
}

}  // namespace goffer::test
