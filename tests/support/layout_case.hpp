// SPDX-License-Identifier: MIT
#pragma once

#include "support/bodies.hpp"
#include "support/output_buffer.hpp"

#include <cstddef>
#include <string_view>
#include <utility>
#include <vector>

/// A body, a job for it, and what the job leaves in planes: what other layouts are held against.

namespace goffer::test {

class LayoutCase {
public:
    LayoutCase(Random& random, bend::Body body)
        : body_(std::move(body)), planes_(OutputBuffer::all_planes, body_.vertex_count()) {
        for (std::size_t region = 0; region < body_.region_count(); ++region) {
            poses_.push_back(
                {static_cast<float>(uniform(random, -4.8, 4.8)), static_cast<float>(uniform(random, -9, 9))});
            previous_poses_.push_back({poses_.back().angle * 0.9f, poses_.back().direction + 0.1f});
        }
        job_.transform = random_transform(random, 3);
        job_.previous_transform = random_transform(random, 3);
    }

    /// Leaves the wrinkles out, or puts them in again.
    void set_wrinkles(bool wanted) { job_.wrinkle_weight = wanted ? 1.0f : 0.0f; }

    void make_planes(Isa isa) {
        planes_.clear();
        job_.isa = isa;
        bend::run(job(planes_));
    }

    /// The job, which writes to `out`.
    bend::DeformJob& job(OutputBuffer& out) {
        out.clear();
        out.attach(job_);
        job_.body = &body_;
        job_.poses = poses_;
        job_.previous_poses = previous_poses_;
        return job_;
    }

    [[nodiscard]] const OutputBuffer& planes() const { return planes_; }
    [[nodiscard]] std::size_t count() const { return body_.vertex_count(); }

private:
    bend::Body body_;
    OutputBuffer planes_;
    std::vector<bend::Pose> poses_, previous_poses_;
    bend::DeformJob job_;
};

}  // namespace goffer::test
