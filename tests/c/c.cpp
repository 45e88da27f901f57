// SPDX-License-Identifier: MIT
#include "support/bodies.hpp"

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

#include <cstring>
#include <string>
#include <vector>

/// The C interface gives the bits of the C++ one, and an error for whatever is wrong.

namespace goffer::test {
namespace {

goffer_mesh mesh_of(const TestMesh& mesh) {
    return {&mesh.positions[0].x,  &mesh.normals[0].x,    &mesh.tangents[0].x,
            mesh.positions.size(), mesh.triangles.data(), mesh.triangles.size() / 3};
}

/// A mesh bound twice: from C, and from C++.
struct Twice {
    TestMesh mesh;
    fit::Binding binding;
    goffer_body* body;
    std::vector<goffer_pose> poses;

    explicit Twice(Random& random, std::size_t regions) : mesh(random_mesh(random, 12, 2, 24, 65)) {
        const fit::Geometry geometry = mesh.geometry();
        fit::BindOptions options;
        std::vector<double> shares(regions, 1.0 / static_cast<double>(regions));
        for (const double share : shares) options.regions.push_back({share, {}});
        binding = fit::bind(geometry, fit::fit_cylinder(geometry), options);
        goffer_bind_options wanted = goffer_bind_defaults();
        wanted.shares = shares.data();
        wanted.region_count = regions;
        const goffer_mesh from = mesh_of(mesh);
        goffer_error error;
        body = goffer_body_bind(&from, &wanted, &error);
        INFO(error.text);
        REQUIRE(body != nullptr);
        for (std::size_t r = 0; r < regions; ++r)
            poses.push_back(
                {static_cast<float>(uniform(random, -2, 2)), static_cast<float>(uniform(random, -4, 4))});
    }
    Twice(const Twice&) = delete;
    Twice& operator=(const Twice&) = delete;
    ~Twice() { goffer_body_free(body); }

    [[nodiscard]] std::vector<bend::Pose> cpp_poses() const {
        std::vector<bend::Pose> result;
        for (const goffer_pose& pose : poses) result.push_back({pose.angle, pose.direction});
        return result;
    }
};

goffer_stream stream(std::vector<float>& memory, std::size_t floats) {
    goffer_stream result = {};
    for (std::size_t c = 0; c < floats; ++c) result.component[c] = memory.data() + c;
    result.stride = floats * sizeof(float);
    result.count = memory.size() / floats;
    return result;
}

template <class T>
bool same_bits(const std::vector<T>& a, const std::vector<T>& b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0;
}

std::string error_of_job(const goffer_job& job) {
    goffer_error error;
    CHECK(goffer_job_validate(&job, &error) == 0);
    return error.text;
}

}  // namespace

TEST_CASE("C: a job gives the bits of C++, and so do bounds, capsules and sockets") {
    Random random(71);
    for (const std::size_t regions : {1, 3}) {
        const Twice twice(random, regions);
        const bend::Body& body = twice.binding.body;
        const std::size_t count = body.vertex_count();
        CHECK(goffer_body_vertex_count(twice.body) == count);
        CHECK(goffer_body_region_count(twice.body) == regions);
        CHECK(goffer_body_has_tangents(twice.body) == 1);
        CHECK(goffer_body_length(twice.body) == body.length());
        CHECK(goffer_body_radius(twice.body) == body.radius());
        CHECK(goffer_body_max_angle(twice.body, regions - 1) == body.max_angle(regions - 1));
        CHECK(goffer_body_max_angle(twice.body, regions) == 0);
        CHECK((goffer_body_order(twice.body) == nullptr) == (regions == 1));

        const std::vector<bend::Pose> poses = twice.cpp_poses();
        std::vector<float> p(3 * count), n(3 * count), t(4 * count), q(3 * count), w(3 * count);
        std::vector<float> cp(3 * count), cn(3 * count), ct(4 * count), cq(3 * count), cw(3 * count);
        const glm::mat4x3 transform = {1, 0, 0, 0, 2, 0, 0, 0, 1, 5, 6, 7};
        bend::DeformJob job{.body = &body, .poses = poses, .wrinkle_weight = 0.5f, .transform = transform};
        job.positions = interleaved<3>(p.data(), count);
        job.normals = interleaved<3>(n.data(), count);
        job.tangents = interleaved<4>(t.data(), count);
        job.previous_positions = interleaved<3>(q.data(), count);
        job.previous_poses = poses;
        job.packed = {reinterpret_cast<bend::PackedVertex*>(w.data()), 12, count};
        bend::run(job);

        goffer_job from = {};
        from.body = twice.body;
        from.poses = from.previous_poses = twice.poses.data();
        from.pose_count = regions;
        from.wrinkle_weight = 0.5f;
        from.transform = &transform[0].x;
        from.positions = stream(cp, 3);
        from.normals = stream(cn, 3);
        from.tangents = stream(ct, 4);
        from.previous_positions = stream(cq, 3);
        from.packed = {cw.data(), 12, count};
        goffer_error error;
        const int valid = goffer_job_validate(&from, &error);
        INFO(error.text);
        REQUIRE(valid == 1);
        goffer_job_run(&from);
        CHECK(same_bits(p, cp));
        CHECK(same_bits(n, cn));
        CHECK(same_bits(t, ct));
        CHECK(same_bits(q, cq));
        CHECK(same_bits(w, cw));
        std::ranges::fill(cp, 0.0f);
        goffer_job_run_parallel(&from);
        CHECK(same_bits(p, cp));

        const goffer_bounds box = goffer_job_bounds(&from);
        const bend::Bounds bounds = bend::bounds(job);
        CHECK(std::memcmp(&box, &bounds, sizeof box) == 0);
        std::vector<goffer_capsule> c_capsules(4 * regions);
        std::vector<bend::Capsule> capsules(4 * regions);
        goffer_job_capsules(&from, 4, c_capsules.data());
        bend::capsules(job, 4, capsules);
        CHECK(std::memcmp(c_capsules.data(), capsules.data(), 4 * regions * sizeof capsules[0]) == 0);

        const float points[] = {0, 0, 0, 1, 1, 1};
        const goffer_mesh mesh = mesh_of(twice.mesh);
        goffer_sockets* c_sockets = goffer_body_sockets(twice.body, &mesh, points, 2, &error);
        REQUIRE(c_sockets != nullptr);
        const bend::Socket made[] = {fit::socket_near(twice.binding, twice.mesh.geometry(), glm::dvec3(0)),
                                     fit::socket_near(twice.binding, twice.mesh.geometry(), glm::dvec3(1))};
        bend::SocketFrame frames[2];
        goffer_socket_frame c_frames[2];
        bend::Sockets::make(body, made).value().frames(job, frames);
        CHECK(goffer_sockets_count(c_sockets) == 2);
        goffer_sockets_frames(c_sockets, &from, c_frames);
        CHECK(std::memcmp(frames, c_frames, sizeof frames) == 0);
        goffer_sockets_free(c_sockets);
    }
}

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
    CHECK(std::string(error.text) == "page_size: not a power of two");
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
}

TEST_CASE("C: instruction set and stores are the caller's choice") {
    for (int isa = GOFFER_ISA_AUTOMATIC; isa <= GOFFER_ISA_NEON; ++isa)
        CHECK(goffer_isa_runs_here(isa) == (runs_here(static_cast<Isa>(isa)) ? 1 : 0));
    CHECK(goffer_isa_runs_here(-1) == 0);
    CHECK(goffer_isa_runs_here(256 + GOFFER_ISA_SCALAR) == 0);

    Random random(75);
    const Twice twice(random, 2);
    const std::size_t count = goffer_body_vertex_count(twice.body);
    const std::vector<bend::Pose> poses = twice.cpp_poses();
    std::vector<float> expected(3 * count), out(3 * count);
    bend::DeformJob scalar{.body = &twice.binding.body, .poses = poses, .isa = Isa::scalar};
    scalar.positions = interleaved<3>(expected.data(), count);
    bend::run(scalar);

    goffer_job job = goffer_job_defaults();
    job.body = twice.body;
    job.poses = twice.poses.data();
    job.pose_count = 2;
    job.positions = stream(out, 3);
    job.isa = GOFFER_ISA_SCALAR;
    REQUIRE(goffer_job_validate(&job, nullptr) == 1);
    goffer_job_run(&job);
    CHECK(same_bits(expected, out));
    job.isa = 256 + GOFFER_ISA_SCALAR;
    CHECK(error_of_job(job).starts_with("isa: "));

    goffer_error error;
    goffer_batch batch = {};
    batch.body = twice.body;
    batch.count = 1;
    batch.poses = {poses.data(), 1, 2 * sizeof(goffer_pose), 0, 0};
    batch.positions = stream(out, 3);
    goffer_crowd* crowd = goffer_crowd_create(1, &error);
    REQUIRE(goffer_crowd_set(crowd, 0, &batch, &error) == 1);
    goffer_crowd_set_isa(crowd, GOFFER_ISA_SCALAR);
    for (int stores = GOFFER_STORES_AUTOMATIC; stores <= GOFFER_STORES_NON_TEMPORAL + 1; ++stores) {
        goffer_crowd_set_stores(crowd, stores);
        std::ranges::fill(out, 0.0f);
        REQUIRE(goffer_crowd_validate(crowd, &error) == 1);
        goffer_crowd_run(crowd);
        CHECK(same_bits(expected, out));
    }
    goffer_crowd_set_isa(crowd, -1);
    CHECK(goffer_crowd_validate(crowd, &error) == 0);
    goffer_crowd_free(crowd);
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

TEST_CASE("C: what is wrong is said, and null does no harm") {
    Random random(74);
    const Twice twice(random, 1);
    goffer_error error;
    const auto text_of_bind = [&](const goffer_mesh* mesh, const goffer_bind_options* options) {
        CHECK(goffer_body_bind(mesh, options, &error) == nullptr);
        CHECK(goffer_body_bind(mesh, options, nullptr) == nullptr);
        return std::string(error.text);
    };
    goffer_mesh mesh = mesh_of(twice.mesh);
    CHECK(text_of_bind(nullptr, nullptr) == "mesh: null");
    mesh.positions = nullptr;
    CHECK(text_of_bind(&mesh, nullptr).starts_with("positions: null"));
    mesh = mesh_of(twice.mesh);
    mesh.triangles = nullptr;
    CHECK(text_of_bind(&mesh, nullptr).starts_with("triangles: null"));
    mesh = mesh_of(twice.mesh);
    mesh.vertex_count = 3;
    CHECK(!text_of_bind(&mesh, nullptr).empty());
    mesh = mesh_of(twice.mesh);
    goffer_bind_options options;
    for (const auto& [member, name] : {std::pair(&goffer_bind_options::profile, "profile: "),
                                       std::pair(&goffer_bind_options::amplitude, "amplitude: ")}) {
        options = goffer_bind_defaults();
        options.*member = 9;
        CHECK(text_of_bind(&mesh, &options).starts_with(name));
    }
    options = goffer_bind_defaults();
    options.region_count = 2;
    CHECK(text_of_bind(&mesh, &options).starts_with("shares: null"));
    const double axis[3] = {0, 0, 0};
    options = goffer_bind_defaults();
    options.axis = axis;
    CHECK(!text_of_bind(&mesh, &options).empty());

    goffer_job job = {};
    CHECK(error_of_job(job).starts_with("poses: none"));
    job.poses = twice.poses.data();
    job.pose_count = 1;
    CHECK(error_of_job(job).starts_with("body: "));
    job.body = twice.body;
    CHECK(error_of_job(job).starts_with("outputs: "));
    CHECK(goffer_job_validate(nullptr, &error) == 0);
    CHECK(goffer_crowd_validate(nullptr, &error) == 0);
    CHECK(goffer_body_vertex_count(nullptr) == 0);
    CHECK(goffer_body_max_angle(nullptr, 0) == 0);
    CHECK(goffer_file_level_count(nullptr) == 0);
    CHECK(goffer_file_sockets(nullptr, &error) == nullptr);
    CHECK(goffer_body_sockets(nullptr, &mesh, nullptr, 0, &error) == nullptr);
    CHECK(goffer_body_sockets(twice.body, &mesh, nullptr, 1, &error) == nullptr);
    goffer_body_free(nullptr);
    goffer_file_free(nullptr);
    goffer_crowd_free(nullptr);
    goffer_sockets_free(nullptr);
    CHECK(std::string(goffer_version()) == GOFFER_PROJECT_VERSION);
}

}  // namespace goffer::test
