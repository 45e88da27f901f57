// SPDX-License-Identifier: MIT
#include "support/bent_pipe.hpp"
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
#include <glm/gtc/type_ptr.hpp>
#include <goffer.h>

#include <cstdlib>
#include <cstring>
#include <string>
#include <vector>

/// The C interface gives the bits of the C++ one, and an error for whatever is wrong: one instance.

namespace goffer::test {

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

        std::ranges::fill(cp, 0.0f);
        goffer_bounds run_box = {};
        from.bounds = &run_box;
        CHECK(goffer_job_run_range(&from, count / 3, count).at_rest == 0);
        CHECK(run_box.high[0] == 0);
        const std::vector<float> third = cp;
        goffer_job_run_range(&from, 0, count + 1);
        goffer_job_run_range(&from, count / 4, 1);
        CHECK(same_bits(third, cp));
        goffer_job_run_range(&from, 0, count / 3);
        CHECK(same_bits(p, cp));

        const goffer_bounds box = goffer_job_bounds(&from);
        CHECK(std::memcmp(&box, &run_box, sizeof box) == 0);
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

TEST_CASE("C: gaps between outputs are kept") {
    Random random(77);
    const Twice twice(random, 1);
    const std::size_t count = goffer_body_vertex_count(twice.body);
    std::vector<float> records(4 * count, 7.0f);
    goffer_job job = goffer_job_defaults();
    job.body = twice.body;
    job.poses = twice.poses.data();
    job.pose_count = 1;
    job.positions = stream(records, 4);
    job.positions.component[3] = nullptr;
    REQUIRE(goffer_job_validate(&job, nullptr) == 1);
    goffer_job_run(&job);
    for (std::size_t i = 0; i < count; ++i) REQUIRE(records[4 * i + 3] == 7);
    CHECK(records[4 * count - 4] != 7);
}

TEST_CASE("C: a level is bound as from C++, and told from what is no rig") {
    Random random(78);
    const Twice twice(random, 2);
    TestMesh coarse = twice.mesh;
    coarse.triangles.resize(coarse.triangles.size() / 2);
    const goffer_mesh mesh = mesh_of(coarse);
    goffer_error error;
    goffer_body* const level = goffer_body_bind_level(&mesh, twice.body, &error);
    INFO(error.text);
    REQUIRE(level != nullptr);
    const fit::Binding expected = fit::bind_level(coarse.geometry(), twice.binding);
    const std::size_t count = goffer_body_vertex_count(level);
    REQUIRE(count == expected.body.vertex_count());
    for (std::size_t r = 0; r < 2; ++r) {
        CHECK(goffer_body_folds(level, r).made == expected.folds(r));
        CHECK(goffer_body_folds(level, r).capacity == expected.folds_capacity(r));
    }
    const std::vector<bend::Pose> poses = twice.cpp_poses();
    std::vector<float> p(3 * count), cp(3 * count);
    bend::DeformJob job{.body = &expected.body, .poses = poses};
    job.positions = interleaved<3>(p.data(), count);
    bend::run(job);
    goffer_job from = goffer_job_defaults();
    from.body = level;
    from.poses = twice.poses.data();
    from.pose_count = 2;
    from.positions = stream(cp, 3);
    goffer_job_run(&from);
    CHECK(same_bits(p, cp));
    goffer_body_free(level);

    const std::vector<std::byte> bytes = baked_bytes(twice);
    goffer_file* const file = goffer_file_load(bytes.data(), bytes.size(), GOFFER_VERIFY_LAYOUT, 1, nullptr);
    REQUIRE(file != nullptr);
    for (const goffer_body* rig : {static_cast<const goffer_body*>(nullptr), goffer_file_body(file, 0)}) {
        CHECK(goffer_body_bind_level(&mesh, rig, &error) == nullptr);
        CHECK(error.code == GOFFER_ERROR_ARGUMENT);
    }
    CHECK(goffer_body_bind_level(nullptr, twice.body, &error) == nullptr);
    CHECK(error.code == GOFFER_ERROR_ARGUMENT);
    goffer_file_free(file);
}

TEST_CASE("C: what bind found is the base, and folds that are made, possible and suitable") {
    Random random(77);
    for (const auto& [rows, regions] : {std::pair{9, 1}, std::pair{513, 1}, std::pair{513, 3}}) {
        const TestMesh mesh = random_mesh(random, 12, 2, 24, rows, 0);
        const goffer_mesh from = mesh_of(mesh);
        const std::vector<double> shares(static_cast<std::size_t>(regions), 1.0 / regions);
        const fit::Cylinder fitted = fit::fit_cylinder(mesh.geometry());
        for (const int asked : {-1, 3}) {
            goffer_bind_options wanted = goffer_bind_defaults();
            wanted.profile = GOFFER_PROFILE_DAMPED;
            wanted.folds = asked;
            wanted.shares = shares.data();
            wanted.region_count = shares.size();
            goffer_error error;
            goffer_body* body = goffer_body_bind(&from, &wanted, &error);
            INFO(error.text);
            REQUIRE(body != nullptr);
            const goffer_base base = goffer_body_base(body);
            CHECK(glm::make_vec3(base.origin) == fitted.origin);
            CHECK(glm::make_vec3(base.axis) == fitted.axis);
            CHECK(glm::make_vec3(base.zero) == fitted.zero);
            CHECK(base.length == fitted.length);
            CHECK(base.radius == fitted.radius);
            CHECK(base.rest_angle == fitted.rest_angle);
            CHECK(base.rest_direction == fitted.rest_direction);
            CHECK(base.residual == fitted.residual);
            // A fold of the half length is two radii long, and takes 16 rows of the whole length.
            const goffer_folds folds = goffer_body_folds(body, shares.size() - 1);
            CHECK(folds.suitable == 6 / regions);
            const int carried = rows / 16 / regions;
            CHECK(std::abs(folds.capacity - carried) <= carried / 10);
            CHECK(folds.made == (asked > 0 ? asked : rows < 100 ? 0 : folds.suitable));
            CHECK(folds.shortage == (rows < 100 ? GOFFER_SHORTAGE_ROWS : GOFFER_SHORTAGE_NONE));
            const goffer_folds none = goffer_body_folds(body, shares.size());
            CHECK((none.made == 0 && none.capacity == 0 && none.suitable == 0));
            goffer_body_free(body);
        }
    }
    CHECK(goffer_body_base(nullptr).length == 0);
    CHECK(goffer_body_folds(nullptr, 0).suitable == 0);
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
    goffer_bounds box;
    goffer_crowd_bounds(crowd, 0, &box);
    const bend::Bounds same = bend::bounds(scalar);
    CHECK(std::memcmp(&box, &same, sizeof box) == 0);
    goffer_crowd_set_isa(crowd, -1);
    CHECK(goffer_crowd_validate(crowd, &error) == 0);
    goffer_crowd_free(crowd);
}

TEST_CASE("C: a mask is the mesh's own") {
    Random random(78);
    const TestMesh mesh = random_mesh(random, 12, 2, 24, 257, 0);
    std::vector<float> mask(mesh.positions.size());
    for (float& value : mask) value = static_cast<float>(uniform(random, 0, 1));
    fit::Geometry geometry = mesh.geometry();
    goffer_mesh from = mesh_of(mesh);
    geometry.wrinkle_mask = mask;
    from.wrinkle_mask = mask.data();
    goffer_error error;
    goffer_body* body = goffer_body_bind(&from, nullptr, &error);
    REQUIRE(body != nullptr);
    const fit::Binding binding = fit::bind(geometry, fit::fit_cylinder(geometry));
    const goffer_pose pose{1.2f, 0.3f};
    const bend::Pose same{pose.angle, pose.direction};
    std::vector<glm::vec3> p(mesh.positions.size()), cp = p;
    bend::DeformJob job{.body = &binding.body, .poses = std::span(&same, 1)};
    job.positions = interleaved<3>(&p[0].x, p.size());
    bend::run(job);
    goffer_job c_job = goffer_job_defaults();
    c_job.body = body;
    c_job.poses = &pose;
    c_job.pose_count = 1;
    c_job.positions = {{&cp[0].x, &cp[0].y, &cp[0].z, nullptr}, 3 * sizeof(float), cp.size()};
    goffer_job_run(&c_job);
    CHECK(p == cp);
    const fit::Binding plain = fit::bind(mesh.geometry(), fit::fit_cylinder(mesh.geometry()));
    job.body = &plain.body;
    bend::run(job);
    CHECK_FALSE(p == cp);
    goffer_body_free(body);
    mask[5] = 2;
    CHECK(goffer_body_bind(&from, nullptr, &error) == nullptr);
    CHECK(std::string(error.text).starts_with("wrinkle mask of vertex 5"));
}

TEST_CASE("C: a chain of arcs is that of C++") {
    const BentPipe pipe;
    const fit::Geometry geometry{pipe.positions, pipe.triangles};
    goffer_mesh from = {};
    from.positions = &pipe.positions[0].x;
    from.vertex_count = pipe.positions.size();
    from.triangles = pipe.triangles.data();
    from.triangle_count = pipe.triangles.size() / 3;
    goffer_bind_options options = goffer_bind_defaults();
    for (const int arcs : {-1, 0, 1, 3}) {
        CAPTURE(arcs);
        options.arcs = arcs;
        goffer_error error;
        goffer_body* body = goffer_body_bind(&from, &options, &error);
        INFO(error.text);
        REQUIRE(body != nullptr);
        CHECK(goffer_body_region_count(body) == (arcs < 0 ? 2 : arcs > 1 ? 3 : 1));
        const bool chain = arcs != 0 && arcs != 1;
        const fit::Cylinder cylinder =
            fit::fit_cylinder(geometry, {}, chain ? fit::RestPose::chain : fit::RestPose::automatic,
                              arcs > 1 ? static_cast<std::size_t>(arcs) : 0);
        const fit::Binding binding = fit::bind(geometry, cylinder);
        REQUIRE(binding.body.region_count() == goffer_body_region_count(body));
        for (std::size_t r = 0; r < binding.body.region_count(); ++r) {
            const goffer_pose rest = goffer_body_rest_pose(body, r);
            CHECK(rest.angle == binding.body.rest_pose(r).angle);
            CHECK(rest.direction == binding.body.rest_pose(r).direction);
            CHECK(goffer_body_max_angle(body, r) == binding.body.max_angle(r));
        }
        goffer_body_free(body);
    }
    options.straight = 1;
    goffer_error error;
    CHECK(goffer_body_bind(&from, &options, &error) == nullptr);
    CHECK(std::string(error.text).starts_with("arcs: "));
    options.straight = 0;
    options.region_count = 1;
    const double whole = 1;
    options.shares = &whole;
    CHECK(goffer_body_bind(&from, &options, &error) == nullptr);
    CHECK(std::string(error.text).starts_with("arcs: "));
    options.arcs = 0;
    options.region_count = ~std::size_t{0};
    CHECK(goffer_body_bind(&from, &options, &error) == nullptr);
    CHECK(std::string(error.text).starts_with("regions: "));
    options.region_count = 0;
    options.arcs = 33;
    CHECK(goffer_body_bind(&from, &options, &error) == nullptr);
    CHECK(std::string(error.text).starts_with("arcs: 33"));
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
    CHECK(error_of_job(job).starts_with("body: not given"));
    job.body = twice.body;
    CHECK(error_of_job(job).starts_with("poses: none"));
    job.poses = twice.poses.data();
    job.pose_count = 1;
    CHECK(error_of_job(job).starts_with("outputs: "));
    float number = 0;
    for (float*& component : job.previous_positions.component) component = &number;
    CHECK(error_of_job(job).starts_with("previous_poses: none"));
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
