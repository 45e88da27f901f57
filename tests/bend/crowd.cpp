// SPDX-License-Identifier: MIT
#include "support/bodies.hpp"

#include <goffer/bend/crowd.hpp>

#include <doctest/doctest.h>
#include <tbb/task_arena.h>

#include <cstring>
#include <limits>

/// The crowd's contract: the bits of single jobs, whatever the arena, the stores and the neighbours; faults
/// named.

namespace goffer::test {
namespace {

/// Instances of several bodies of very different sizes, in runs and alone, their outputs in one buffer each.
class Crowd {
public:
    Crowd(Random& random, std::size_t instances, std::size_t misalignment) {
        for (const int rows : {9, 41, 400}) {
            const Subject subject = random_subject(random, 10, 1, 24, rows, 0);
            bodies_.push_back(std::move(fit::bind(subject.geometry(), subject.cylinder).body));
        }
        for (std::size_t i = 0; i < instances; ++i) {
            const bend::Body& body = bodies_[i % 40 == 7 ? 2 : i % 5 == 0 ? 1 : 0];
            const std::size_t count = body.vertex_count();
            buffers_.emplace_back(10, count + misalignment);
            Columns& out = buffers_.back();
            const auto plane = [&](std::size_t c) { return out[c].subspan(misalignment); };
            bend::DeformJob job;
            job.body = &body;
            job.pose = {static_cast<float>(uniform(random, -1, i % 3 == 0 ? 60 : 1)),
                        static_cast<float>(uniform(random, -9, 9))};
            job.positions = planar(plane(0), plane(1), plane(2));
            if (i % 2 == 0) job.normals = planar(plane(3), plane(4), plane(5));
            if (i % 3 == 0) job.tangents = planar(plane(6), plane(7), plane(8), plane(9));
            jobs.push_back(job);
        }
    }

    void clear() {
        for (Columns& buffer : buffers_) {
            for (std::size_t c = 0; c < buffer.columns(); ++c)
                std::fill(buffer[c].begin(), buffer[c].end(), 0.0f);
        }
    }

    /// FNV-1a over every output.
    [[nodiscard]] std::uint64_t hash() const {
        std::uint64_t sum = 14695981039346656037u;
        for (const Columns& buffer : buffers_) {
            for (std::size_t c = 0; c < buffer.columns(); ++c) {
                for (const float value : buffer[c]) {
                    std::uint32_t bits = 0;
                    std::memcpy(&bits, &value, sizeof bits);
                    sum = (sum ^ bits) * 1099511628211u;
                }
            }
        }
        return sum;
    }

    std::vector<bend::DeformJob> jobs;

private:
    std::vector<bend::Body> bodies_;
    std::vector<Columns> buffers_;
};

}  // namespace

TEST_CASE("P5: a crowd gives the bits of its single jobs, in any arena, by any stores") {
    for (const std::size_t misalignment : {0u, 5u}) {
        Random random(31);
        Crowd crowd(random, 150, misalignment);
        for (const Isa isa : built_isas()) {
            if (!runs_here(isa)) continue;
            CAPTURE(name(isa));
            std::size_t clamped = 0;
            crowd.clear();
            for (bend::DeformJob& job : crowd.jobs) {
                job.isa = isa;
                clamped += bend::run(job).clamped ? 1 : 0;
            }
            CHECK(clamped > 10);
            const std::uint64_t expected = crowd.hash();
            for (const bend::Stores stores :
                 {bend::Stores::automatic, bend::Stores::cached, bend::Stores::streaming}) {
                const bend::CrowdJob job{.instances = crowd.jobs, .stores = stores};
                REQUIRE(bend::validate(job).none());
                crowd.clear();
                CHECK(bend::run(job).clamped == clamped);
                CHECK(crowd.hash() == expected);
                for (const int threads : {1, 2, 4, 7}) {
                    tbb::task_arena arena(threads);
                    crowd.clear();
                    arena.execute([&] { CHECK(bend::run_parallel(job).clamped == clamped); });
                    CHECK(crowd.hash() == expected);
                }
            }
        }
    }
}

TEST_CASE("instances that are not active are not touched") {
    Random random(32);
    Crowd crowd(random, 60, 0);
    std::vector<std::uint8_t> active(60);
    for (std::size_t i = 0; i < active.size(); ++i) active[i] = i % 3 != 1;
    for (std::size_t i = 0; i < active.size(); ++i) {
        if (active[i] != 0) bend::run(crowd.jobs[i]);
    }
    const std::uint64_t expected = crowd.hash();
    const bend::CrowdJob job{.instances = crowd.jobs, .active = active};
    crowd.clear();
    bend::run_parallel(job);
    CHECK(crowd.hash() == expected);

    crowd.jobs[1].body = nullptr;  // asleep: nobody looks
    CHECK(bend::validate(job).none());
    crowd.clear();
    bend::run(job);
    CHECK(crowd.hash() == expected);
}

TEST_CASE("interleaved instances stand beside planar ones") {
    Random random(33);
    Crowd crowd(random, 20, 0);
    bend::DeformJob& job = crowd.jobs[4];
    std::vector<float> alone(job.body->vertex_count() * 6), among(alone.size());
    const auto redirect = [&](std::vector<float>& buffer) {
        job.positions = interleaved<3>(buffer.data(), job.body->vertex_count(), 24);
        job.normals = interleaved<3>(buffer.data() + 3, job.body->vertex_count(), 24);
        job.tangents = {};
    };
    redirect(alone);
    bend::run(job);
    redirect(among);
    bend::run_parallel({.instances = crowd.jobs, .stores = bend::Stores::streaming});
    CHECK(alone == among);
}

TEST_CASE("a crowd's fault names its instance") {
    Random random(34);
    Crowd crowd(random, 12, 0);
    crowd.jobs[9].pose.angle = std::numeric_limits<float>::quiet_NaN();
    const bend::CrowdFault fault = bend::validate(bend::CrowdJob{.instances = crowd.jobs});
    CHECK_FALSE(fault.none());
    CHECK(fault.instance == 9);
    CHECK(fault.fault == bend::JobFault::pose_angle);
    const std::vector<std::uint8_t> short_mask(11, 1);
    CHECK(bend::validate(bend::CrowdJob{.instances = crowd.jobs, .active = short_mask}).active_count);
    CHECK(bend::validate(bend::CrowdJob{}).none());
    CHECK(bend::run_parallel(bend::CrowdJob{}).clamped == 0);
}

}  // namespace goffer::test
