// SPDX-License-Identifier: MIT
#include "guarded_buffer.hpp"
#include "support/bodies.hpp"

#include <goffer/bend/body_input.hpp>
#include <goffer/bend/crowd.hpp>
#include <goffer/paper/shape.hpp>

#include <glm/gtc/matrix_transform.hpp>

#include <cstddef>
#include <cstdint>

/// A small mesh, its cylinder and options to bind it with, made of the bytes; what binds is deformed into
/// guarded memory, in poses and by transforms that may hold any bits. Numbers that are within range have to
/// give numbers that are finite.

using namespace goffer;
using namespace goffer::test;

namespace {

glm::dmat3 rotation(Bytes& bytes) {
    glm::dmat4 turned(1);
    for (const glm::dvec3 axis : {glm::dvec3(0, 0, 1), glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0)})
        turned = glm::rotate(turned, bytes.within(-4, 4), axis);
    return glm::dmat3(turned);
}

fit::Cylinder cylinder_of(Bytes& bytes) {
    fit::Cylinder cylinder;
    const glm::dmat3 axes = rotation(bytes);
    cylinder.axis = axes[2];
    cylinder.zero = axes[0];
    cylinder.length = bytes.flag() ? 1 : bytes.magnitude(-14, 14);
    cylinder.radius = cylinder.length / (bytes.flag() ? 10 : bytes.magnitude(-3, 4));
    const double far = cylinder.length * bytes.magnitude(-3, 3);
    for (int i = 0; i < 3; ++i) cylinder.origin[i] = far * bytes.within(-1, 1);
    if (bytes.flag()) {
        for (std::size_t knots = 2 + bytes.below(8); knots > 0; --knots)
            cylinder.radii.push_back(cylinder.radius * bytes.within(0.05, 2));
        cylinder.radius = paper::Spline(cylinder.length, cylinder.radii).mean();
    }
    if (bytes.flag()) {
        const double most = std::min(6.0, cylinder.length / (2 * cylinder.radius));
        cylinder.rest_angle = most * bytes.within(0, 0.999);
        cylinder.rest_direction = bytes.within(-4, 4);
    }
    return cylinder;
}

/// A place by its coordinates about the cylinder, or about its rest arc.
glm::dvec3 place(const fit::Cylinder& cylinder, double beta, double z, double rho) {
    const glm::dvec3 e1 = cylinder.zero, e3 = cylinder.axis, e2 = glm::cross(e3, e1);
    const glm::dvec3 out = rho * (std::cos(beta) * e1 + std::sin(beta) * e2);
    if (cylinder.rest_angle == 0) return cylinder.origin + out + z * e3;
    const double radius = fit::rest_radius(cylinder), turned = cylinder.rest_angle * z / cylinder.length;
    const double sine = std::sin(turned), cosine = std::cos(turned);
    const glm::dvec3 to = std::cos(cylinder.rest_direction) * e1 + std::sin(cylinder.rest_direction) * e2;
    const double along = glm::dot(out, to);
    return cylinder.origin + out + (radius * (1 - cosine) + along * (cosine - 1)) * to +
           (radius - along) * sine * e3;
}

/// Rings about the cylinder, more or less, and vertices that no triangle uses, which may be anywhere.
struct Mesh {
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> normals;
    std::vector<glm::vec4> tangents;
    std::vector<std::uint32_t> triangles;

    Mesh(Bytes& bytes, const fit::Cylinder& cylinder) {
        const std::size_t columns = 3 + bytes.below(6), rows = 2 + bytes.below(16);
        const double rough = bytes.flag() ? 0.3 : 0;
        for (std::size_t i = 0; i < columns * rows; ++i) {
            const double beta =
                6.28318530717958 * static_cast<double>(i % columns) / static_cast<double>(columns);
            const double z =
                cylinder.length * static_cast<double>(i / columns) / static_cast<double>(rows - 1);
            const double rho = cylinder.radius * (1 + (rough > 0 ? bytes.within(-rough, rough) : 0));
            positions.emplace_back(place(cylinder, beta, z, rho));
            if (i / columns + 1 < rows) add_square(i, columns);
        }
        const std::size_t loose = bytes.flag() ? bytes.below(1100) : bytes.below(4);
        const bool anywhere = bytes.below(8) == 0;
        for (std::size_t i = 0; i < loose; ++i)
            positions.push_back(anywhere ? any_vector(bytes) : positions[i % (columns * rows)]);
        for (std::size_t i = 0; bytes.flag() && i < positions.size(); ++i) normals.push_back({0, 0.6f, 0.8f});
        const bool with_tangents = bytes.flag();
        for (std::size_t i = 0; with_tangents && i < positions.size(); ++i)
            tangents.emplace_back(any_vector(bytes), bytes.flag() ? 1.0f : -1.0f);
        if (!normals.empty()) normals.resize(positions.size(), {1, 0, 0});
    }

    [[nodiscard]] fit::Geometry geometry() const { return {positions, triangles, normals, tangents}; }

private:
    static glm::vec3 any_vector(Bytes& bytes) {
        if (bytes.empty()) return {0, 0, 1};
        return {bytes.any_float(), bytes.any_float(), bytes.any_float()};
    }

    void add_square(std::size_t i, std::size_t columns) {
        const auto a = static_cast<std::uint32_t>(i), up = static_cast<std::uint32_t>(columns);
        const std::uint32_t b = i % columns + 1 < columns ? a + 1 : a + 1 - up;
        triangles.insert(triangles.end(), {a, b, a + up, b, b + up, a + up});
    }
};

fit::BindOptions options_of(Bytes& bytes) {
    using Kind = paper::Profile::Kind;
    constexpr Kind kinds[] = {Kind::even, Kind::damped, Kind::smooth};
    fit::BindOptions options;
    // To solve for areas, or for many folds or regions with wrinkles, takes longer than all the rest: that is
    // rare.
    const std::size_t amplitude = bytes.below(32);
    options.amplitude = amplitude % 4 == 3 ? fit::Amplitude::paper : fit::Amplitude::none;
    if (amplitude == 31) options.amplitude = fit::Amplitude::mesh;
    if (amplitude == 27) options.amplitude = fit::Amplitude::area;
    options.profile = {bytes.one_of(kinds), bytes.within(0, 0.5)};
    options.table_rows = bytes.flag() ? 2 : 2 + static_cast<int>(bytes.below(20));
    options.folds = static_cast<int>(bytes.below(4));
    if (bytes.below(64) == 63) options.folds.reset();
    if (bytes.flag())
        options.fold_length = bytes.flag() ? bytes.magnitude(-4, 4) : bytes.magnitude(-320, 308);
    if (bytes.flag()) options.shape = fit::ShapeMode::cylinder;
    if (bytes.flag()) options.onset = bytes.flag() ? bytes.within(0, 1) : bytes.magnitude(-12, 0);
    const bool many = options.amplitude == fit::Amplitude::none || bytes.below(64) == 63;
    const std::size_t regions = bytes.flag() ? bytes.below(many ? 40 : 4) : 0;
    double sum = 0;
    for (std::size_t i = 0; i < regions; ++i)
        sum += options.regions.emplace_back().share = bytes.within(0.01, 1);
    for (fit::RegionOptions& region : options.regions) {
        region.share /= sum;
        if (bytes.flag()) region.folds = static_cast<int>(bytes.below(5));
    }
    return options;
}

/// Poses, weight and transforms. Tame ones are finite, and within what WorkingRange speaks of.
struct Motion {
    std::vector<bend::Pose> poses, previous;
    glm::mat4x3 transform{1}, previous_transform{1};
    float weight = 1;

    Motion(Bytes& bytes, const bend::Body& body, bool tame) {
        const auto number = [&](double most) {
            return tame ? static_cast<float>(bytes.within(-most, most)) : bytes.any_float();
        };
        for (std::size_t r = 0; r < body.region_count(); ++r) {
            poses.push_back({number(bytes.flag() ? 2000 : 3), number(9)});
            previous.push_back({number(bytes.flag() ? 2000 : 3), number(9)});
        }
        const double size = bytes.flag() ? 1 : bytes.magnitude(-6, 6);
        for (int c = 0; c < 4; ++c) {
            for (int r = 0; r < 3; ++r) {
                transform[c][r] = number(size);
                previous_transform[c][r] = number(size);
            }
        }
        weight = bytes.flag() ? 1 : number(1);
        if (tame) weight = std::fabs(weight);
    }

    void attach(bend::DeformJob& job) const {
        job.poses = poses;
        job.previous_poses = previous;
        job.transform = transform;
        job.previous_transform = previous_transform;
        job.wrinkle_weight = weight;
    }
};

void run(Bytes& bytes, const bend::DeformJob& job) {
    constexpr bend::Stores stores[] = {bend::Stores::automatic, bend::Stores::cached,
                                       bend::Stores::non_temporal};
    const std::size_t count = job.body->vertex_count();
    switch (bytes.below(3)) {
        case 0: {
            bend::run(job);
            return;
        }
        case 1: {
            const std::size_t cut = bytes.below(65536) % (count + 1);
            bend::run_range(job, cut, count);
            bend::run_range(job, 0, cut);
            return;
        }
        default: {
            const bend::Batch batch = bend::batch_of(job);
            const bend::CrowdJob crowd{
                .batches = {&batch, 1}, .stores = bytes.one_of(stores), .isa = job.isa};
            require(bend::validate(job).none() == bend::validate(crowd).none(),
                    "a batch of a job is as valid");
            bend::run(crowd);
        }
    }
}

void deform(Bytes& bytes, const bend::Body& body) {
    static const std::vector<Isa> isas = isas_here();
    const GuardedBuffer out(bytes, body.vertex_count(), body.has_tangents());
    if (out.empty()) return;
    const bool tame = bytes.flag();
    bend::Bounds bounds;
    bend::DeformJob job{.body = &body};
    job.isa = isas[bytes.below(isas.size())];
    job.bounds = &bounds;
    job.scratch_gaps = bytes.flag();
    out.attach(job);
    const std::vector<bend::Pose> straight(body.region_count());
    job.poses = job.previous_poses = straight;
    const bend::Fault fault = bend::validate(job);
    require(fault.none(), bend::describe(fault).c_str());
    const Motion motion(bytes, body, tame);
    motion.attach(job);
    require(!tame || bend::validate(job).none(), "numbers within range are valid");
    out.clear();
    run(bytes, job);
    require(job.scratch_gaps || out.gaps_kept(), "gaps are kept");
    if (!tame) return;
    const auto finite = [](float value) { return std::isfinite(value); };
    require(out.all("xyzuvwabcdpqr", finite), "numbers within range give finite ones");
    require(out.all("xyzuvwabcdpqr", [](float v) { return v != GuardedBuffer::guard; }), "all is written");
    for (int i = 0; i < 3; ++i) require(finite(bounds.low[i]) && finite(bounds.high[i]), "bounds are finite");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    Bytes bytes(data, size);
    const fit::BindOptions options = options_of(bytes);
    const fit::Cylinder cylinder = cylinder_of(bytes);
    Bytes motion = bytes.half();
    const Mesh mesh(bytes, cylinder);
    try {
        const fit::Binding binding = fit::bind(mesh.geometry(), cylinder, options);
        // Several times, since to bind takes a thousand times as long.
        for (int i = 0; i < 16 && (i == 0 || !motion.empty()); ++i) deform(motion, binding.body);
    } catch (const fit::Error& error) {
        require_one_line(error.what());
    }
    return 0;
}
