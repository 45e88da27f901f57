// SPDX-License-Identifier: MIT
#include "support/sanitized.hpp"
#include "support/test_batch.hpp"

#include <goffer/bend/capsules.hpp>
#include <goffer/bend/path.hpp>
#include <goffer/bend/sockets.hpp>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cfenv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#if defined(__SSE2__)
#include <xmmintrin.h>
#endif

/// The floating-point environment that a caller may have: traps, rounding modes, flush-to-zero. Traps are
/// looked for by their status flags.

namespace goffer::test {
namespace {

/// What every function makes of a pose.
struct PoseOutputs {
    OutputBuffer out;
    bend::Bounds box;
    std::vector<bend::Capsule> capsules;
    std::vector<bend::SocketFrame> frames;
    bend::PathFit path;

    PoseOutputs(bend::DeformJob job, const bend::Sockets& sockets)
        : out(OutputBuffer::all_planes, job.body->vertex_count()),
          capsules(bend::capsule_count(*job.body, 2)),
          frames(sockets.count()) {
        out.attach(job);
        job.bounds = &box;
        bend::run(job);
        bend::capsules(job, 2, capsules);
        sockets.frames(job, frames);
        std::vector<bend::Pose> poses(job.body->region_count());
        const glm::vec3 curve[4] = {{0, 0, 0}, {0.2f, 0, 0.5f}, {0.5f, 0.5f, 1}, {1, 1, 1.5f}};
        path = bend::poses_along(*job.body, curve, poses);
        path.error += bend::poses_along_bezier(*job.body, curve, poses).error;
        const glm::vec3 standing[4] = {{0, 0, 0}, {0, 0, 0}, {10, 0, 20}, {10, 0, 20}};
        path.error += bend::poses_along_bezier(*job.body, standing, poses).error;
        run_many(job);
    }

    /// How many vertices have a number of `streams` that differs by more than `much`, or is a NaN.
    [[nodiscard]] std::size_t count_from(const PoseOutputs& other, std::string_view streams,
                                         float much) const {
        std::size_t found = 0;
        for (std::size_t i = 0; i < out.count(); ++i) {
            found += std::ranges::all_of(
                         streams,
                         [&](char c) { return std::fabs(out.value(c, i) - other.out.value(c, i)) <= much; })
                         ? 0
                         : 1;
        }
        return found;
    }

    /// Runs nine instances of the job as a batch that may be deformed many instances at a time.
    static void run_many(const bend::DeformJob& job) {
        constexpr std::size_t count = 9;
        OutputBuffer many("x y z u v w", count * job.body->vertex_count());
        const std::vector<std::uint32_t> all_the_same(count, 0);
        bend::Batch batch = bend::batch_of(job);
        batch.count = count;
        batch.indices = all_the_same;
        batch.vertex_step = job.body->vertex_count();
        batch.bounds = {};
        many.attach(batch);
        const bend::Fault fault = bend::validate({.batches = {&batch, 1}, .isa = job.isa});
        REQUIRE((fault.none() || fault.field == bend::Field::wrinkle_weight));  // a run takes any bits there
        bend::run({.batches = {&batch, 1}, .isa = job.isa});
    }

    /// The largest difference between numbers of `streams`, bounds and frames; infinite where one is NaN.
    [[nodiscard]] float from(const PoseOutputs& other, std::string_view streams = "xyzuvwabcdpqr") const {
        float largest = 0;
        const auto take = [&](float a, float b) {
            const float off = std::fabs(a - b);
            largest = off >= 0 ? std::max(largest, off) : std::numeric_limits<float>::infinity();
        };
        for (std::size_t i = 0; i < out.count(); ++i) {
            for (const char c : streams) take(out.value(c, i), other.out.value(c, i));
        }
        for (int axis = 0; axis < 3; ++axis) {
            take(box.low[axis], other.box.low[axis]);
            take(box.high[axis], other.box.high[axis]);
        }
        for (std::size_t i = 0; i < frames.size(); ++i)
            take(glm::distance(frames[i][3], other.frames[i][3]), 0);
        take(path.error, other.path.error);
        return largest;
    }
};

/// Another rounding mode, until it goes.
class Rounding {
public:
    explicit Rounding(int mode) : before_(std::fegetround()) { std::fesetround(mode); }
    Rounding(const Rounding&) = delete;
    Rounding& operator=(const Rounding&) = delete;
    ~Rounding() { std::fesetround(before_); }

private:
    int before_;
};

/// Leaves signaling NaNs where the next call has its local variables: a lane that is computed with before it
/// was set raises a flag whatever ran before. Returns one of them, so that none is left out.
[[gnu::noinline]] std::uint32_t leave_signaling_nans(std::size_t which) {
    constexpr std::uint32_t signaling_nan = 0x7fa00000;
    volatile std::uint32_t values[1 << 16];
    for (volatile std::uint32_t& value : values) value = signaling_nan;
    return values[which];
}

/// Returns the status flags, by name, that a trap could be set for and that a job's outputs raise.
std::string raised_by(const bend::DeformJob& job, const bend::Sockets& sockets) {
    leave_signaling_nans(0);
    std::feclearexcept(FE_ALL_EXCEPT);
    const PoseOutputs outputs(job, sockets);
    std::string names;
    if (std::fetestexcept(FE_DIVBYZERO) != 0) names += "divide by zero, ";
    if (std::fetestexcept(FE_INVALID) != 0) names += "invalid, ";
    if (std::fetestexcept(FE_OVERFLOW) != 0) names += "overflow, ";
    return names;
}

/// A thick region and one a tenth as thick, bent along different arcs at rest, with shapes, and with wrinkles
/// that run over their joint. Every other vertex of the thick one is not near the joint, and most of those
/// are so thick that along the thin one's arc nothing would be left of their columns, or all but nothing. So
/// it is with the first ones of the thin region, whose heights are those of vertices near a region's end.
bend::Body beside_a_thin_region(Random& random, double rest_angle) {
    constexpr std::size_t count = 48;
    constexpr double max_scale = LooseVertices::max_scale, radii[] = {0.5, 0.05}, blend = 0.2;
    const double rest_angles[] = {rest_angle, 4}, max_angles[] = {0.7, 7};
    std::vector<bend::RegionInput> regions;
    for (const std::size_t r : {0u, 1u}) {
        regions.push_back({.length = 1, .max_angle = max_angles[r], .rest_angle = rest_angles[r]});
        regions[r].onset = 0.01;
        regions[r].table = fit::make_wrinkle_table(paper::Profile::even, paper::Amplitude::paper, 6, 1,
                                                   radii[r], max_angles[r], 32, max_scale);
        regions[r].vertex_count = count;
        regions[r].radius = radii[r];
        regions[r].max_scale = max_scale;
    }
    regions[0].rest_direction = 2;
    regions[0].blend = blend;
    LooseVertices loose(random, 2 * count, radii[1]);
    loose.add_shape(random);
    const auto scale_at = [&](double beta,
                              double left) {  // of what is left of a thick column, by the thin arc
        const double squeeze = rest_angles[1] * radii[0] * (1 + std::cos(beta));
        return std::clamp((1 - left) / squeeze, 1e-3, max_scale);
    };
    for (std::size_t i = 0; i < count; ++i) {
        bend::RestVertex& v = loose.vertices[i];
        v.z = i % 2 == 0 ? 1 - uniform(random, 0, blend) : uniform(random, 0, 1 - blend);
        if (i % 6 == 1) v.beta = 0;
        if (i % 2 == 0) v.scale *= 0.1;
        if (i % 6 == 1 || i % 6 == 3) v.scale = scale_at(v.beta, 0);
    }
    for (std::size_t i = count; i < count + 16; ++i) {
        bend::RestVertex& v = loose.vertices[i];
        v.z = 1 - uniform(random, 0, blend);
        v.scale = 1 / (1 / scale_at(v.beta, 0.02) + rest_angles[1] * radii[1] * (1 + std::cos(v.beta)));
    }
    return loose.body(regions);
}

/// Bodies of every kind: straight, bent at rest, of several regions, with a shape.
std::vector<bend::Body> bodies_of_every_kind() {
    Random random(3);
    const std::vector<std::size_t> counts{30, 7, 40};
    std::vector<bend::Body> made;
    for (int i = 0; i < 8; ++i) made.push_back(loose_chain(random, counts));
    const std::vector<std::size_t> some_empty{30, 0, 40};
    made.push_back(loose_chain(random, some_empty));
    for (const double rest_angle : {0.0, 0.3}) made.push_back(beside_a_thin_region(random, rest_angle));
    return made;
}

/// At rest, straight, all but straight, and as far as each region goes.
std::vector<std::vector<bend::Pose>> poses_of(const bend::Body& body) {
    std::vector<std::vector<bend::Pose>> poses(6);
    poses[0] = body.rest_poses();
    for (std::size_t r = 0; r < body.region_count(); ++r) {
        poses[1].push_back({0, 0});
        poses[2].push_back({1e-30f, 2});
        poses[3].push_back({1e-42f, -1});
        poses[4].push_back({body.max_angle(r), 1});
        poses[5].push_back({-0.5f * body.max_angle(r), 3});
    }
    return poses;
}

template <class Visit>
void each_case(const Visit& visit) {
    for (const bend::Body& body : bodies_of_every_kind()) {
        std::vector<bend::Socket> socket(3);
        for (std::size_t i = 0; i < socket.size(); ++i)
            socket[i] = {.region = i % body.region_count(),
                         .vertex = {0.3 * static_cast<double>(i), 0.5, 0.1, 0, 0}};
        const bend::Sockets sockets = *bend::Sockets::make(body, socket);
        for (const std::vector<bend::Pose>& poses : poses_of(body)) {
            for (const float weight : {0.0f, 0.5f, 1.0f}) {
                for (const Isa isa : isas_here()) {
                    CAPTURE(name(isa));
                    CAPTURE(poses[0].angle);
                    CAPTURE(weight);
                    bend::DeformJob job{.body = &body, .poses = poses, .wrinkle_weight = weight, .isa = isa};
                    job.previous_poses = poses;
                    visit(job, sockets);
                }
            }
        }
    }
}

/// Whether they do, and says so: between the thread sanitizer's calls clang computes in registers whose other
/// half holds anything, which may raise flags.
bool flags_tell_nothing() {
    if (thread_sanitized) MESSAGE("skipped: the thread sanitizer's code may raise flags");
    return thread_sanitized;
}

}  // namespace

TEST_CASE("floating point: what decays becomes 0 before its products are subnormal, which takes long") {
    Random random(4);
    const std::size_t counts[] = {60, 50, 40};
    for (int trial = 0; trial < 6; ++trial) {
        const bend::Body body = trial < 2 ? loose_body(random, 100) : loose_chain(random, counts);
        const auto outputs = [&](const bend::Pose& pose, float weight, Isa isa) {
            OutputBuffer out("x y z u v w a b c d", body.vertex_count());
            const std::vector<bend::Pose> poses(body.region_count(), pose);
            bend::DeformJob job{.body = &body, .poses = poses, .wrinkle_weight = weight, .isa = isa};
            out.attach(job);
            bend::run(job);
            return out.hash();
        };
        for (const Isa isa : isas_here()) {
            CAPTURE(name(isa));
            const std::uint64_t still = outputs({0, 2}, 1, isa), along_zero = outputs({1, 0}, 1, isa),
                                bare = outputs({1, 2}, 0, isa);
            for (const float decayed : {9e-13f, 1e-20f, 1e-38f, 1e-41f}) {
                CAPTURE(decayed);
                CHECK(outputs({decayed, 2}, 1, isa) == still);
                CHECK(outputs({1, 9e3f * decayed}, 1, isa) == along_zero);
                CHECK(outputs({1, -decayed}, 1, isa) == along_zero);
                CHECK(outputs({1, 2}, decayed, isa) == bare);
            }
        }
    }
}

TEST_CASE("floating point: nothing that a trap could be set for") {
    if (flags_tell_nothing()) return;
    each_case([](const bend::DeformJob& job, const bend::Sockets& sockets) {
        CHECK(raised_by(job, sockets) == "");
    });
}

TEST_CASE("floating point: nor with wrinkle weights of any bits") {
    if (flags_tell_nothing()) return;
    each_case([](bend::DeformJob job, const bend::Sockets& sockets) {
        for (const float weight : {std::numeric_limits<float>::quiet_NaN(), 3e38f, -1.0f, 1e-45f}) {
            job.wrinkle_weight = weight;
            CHECK(raised_by(job, sockets) == "");
        }
    });
}

TEST_CASE("floating point: nor along curves whose control points are all but the same") {
    if (flags_tell_nothing()) return;
    Random random(11);
    const std::size_t counts[] = {60, 50, 40};
    const bend::Body body = loose_chain(random, counts);
    bend::Pose poses[3];
    for (const float size : {1.0f, 1e-3f, 1e-6f, 1e-12f, 1e-15f, 1e-20f, 1e-30f, 1e-40f, 0.0f}) {
        CAPTURE(size);
        const glm::vec3 ends[4] = {{0, 0, 0}, {2, 0, 0}, {4, 1, 0}, {4, 1, size}};
        const glm::vec3 tiny[4] = {{0, 0, 0}, {size, 0, 0}, {size, size, 0}, {0, size, size}};
        for (const auto& control : {ends, tiny}) {
            for (const float distance : {0.0f, 10.0f, 1e20f}) {
                CAPTURE(distance);
                const glm::vec3 curve[4] = {control[0], control[1], control[2], control[3]};
                std::feclearexcept(FE_ALL_EXCEPT);
                bend::poses_along_bezier(body, curve, poses, {.distance = distance});
                CHECK(std::fetestexcept(FE_DIVBYZERO | FE_INVALID | FE_OVERFLOW) == 0);
            }
        }
    }
}

TEST_CASE("floating point: nor with transforms as large and as small as the working range has") {
    if (flags_tell_nothing()) return;
    each_case([](bend::DeformJob job, const bend::Sockets& sockets) {
        for (const float size : {1e-6f, 1e6f}) {
            for (int axis = 0; axis < 3; ++axis) job.transform[axis][axis] = size;
            job.transform[3] = glm::vec3(-size);
            CHECK(raised_by(job, sockets) == "");
        }
    });
}

TEST_CASE("floating point: with other rounding modes results are less exact, and no worse") {
    each_case([](const bend::DeformJob& job, const bend::Sockets& sockets) {
        const PoseOutputs usual(job, sockets);
        for (const int mode : {FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO}) {
            const auto rounded = [&] {
                const Rounding rounding(mode);
                return PoseOutputs(job, sockets);
            }();
            CHECK(rounded.from(usual, "xyzpqr") < 1e-4f);
            // Some of these vertices have slopes that all but cancel their normal, which rounding then turns.
            CHECK(rounded.count_from(usual, "uvwabcd", 0.01f) <= rounded.out.count() / 20);
        }
    });
}

#if defined(__SSE2__)
TEST_CASE("floating point: subnormal numbers may be flushed to zero") {
    constexpr unsigned flush_to_zero = 0x8000, denormals_are_zero = 0x40;
    each_case([&](const bend::DeformJob& job, const bend::Sockets& sockets) {
        const PoseOutputs usual(job, sockets);
        const unsigned before = _mm_getcsr();
        _mm_setcsr(before | flush_to_zero | denormals_are_zero);
        const PoseOutputs flushed(job, sockets);
        _mm_setcsr(before);
        CHECK(flushed.from(usual) < 1e-6f);
    });
}
#endif

}  // namespace goffer::test
