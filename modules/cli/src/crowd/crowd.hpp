// SPDX-License-Identifier: MIT
#pragma once

#include "model.hpp"

#include <goffer/engine/columns.hpp>
#include <goffer/measure/crowd_scene.hpp>

#include <glm/mat4x3.hpp>

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace goffer::cli {

/// What a crowd is made of, besides its models.
struct CrowdPlan {
    std::size_t instances = 0;
    /// The farthest, one per region; a region that cannot be bent so far goes as far as it can.
    std::vector<bend::Pose> poses;
    bool from_rest = false;  ///< swing from the rest pose, by `poses` at most, instead of from straight
    measure::StreamLayout layout;
    Isa isa = Isa::automatic;
    bend::Stores stores = bend::Stores::automatic;
    std::string option = "--instances";  ///< that their number was given by
};

/// From straight (or the rest pose) to the farthest, and back.
inline constexpr double frames_per_swing = 120;

/// Where an instance stands: row 0 is in front.
struct Spot {
    std::size_t column = 0;
    std::size_t row = 0;
};

/// A crowd that moves like grass in the wind: instances of all models, about as many of each, on a grid.
/// Every one stands with its base end on the ground (z = 0) and its axis up, is scaled to a length of 1, and
/// is turned its own way. Where there are several regions, each follows the one below it, as a wave does.
class Crowd {
public:
    /// `models`, each bound with as many regions as the plan has poses, must outlive the crowd. Throws
    /// InputError where the crowd is more than memory holds.
    Crowd(std::span<const BoundModel> models, const CrowdPlan& plan);
    Crowd(const Crowd&) = delete;
    Crowd& operator=(const Crowd&) = delete;

    /// Sets how far it swings: as CrowdPlan::poses.
    void set_farthest(std::span<const bend::Pose> poses) noexcept;

    /// Sets the poses of `frame`, which depend on nothing else. Does not allocate.
    void set_poses(std::size_t frame) noexcept;

    /// All instances: a group for each model.
    [[nodiscard]] const measure::CrowdScene& scene() const noexcept { return scene_; }
    [[nodiscard]] const bend::CrowdJob& job() const noexcept { return job_; }
    [[nodiscard]] std::size_t instances() const noexcept { return members_.size(); }
    /// Fills as much memory as a frame writes past the cache (measure::fill): the least that it can cost.
    void fill(float seed, int threads);

    /// Return which of the models instance `index` is, and where it stands.
    [[nodiscard]] std::size_t model(std::size_t index) const noexcept { return members_[index].model; }
    [[nodiscard]] Spot spot(std::size_t index) const noexcept;
    /// Instances that stand side by side.
    [[nodiscard]] std::size_t columns() const noexcept { return columns_; }

private:
    struct Member {
        std::size_t model = 0;
        std::size_t place = 0;  // on the grid, row after row
        double phase = 0;       // of the swing, in turns
        double direction = 0;   // at frame 0, about the body's axis, in turns
    };

    void add(const BoundModel& model, std::size_t index, std::size_t place);
    [[nodiscard]] Spot spot_of(std::size_t place) const noexcept;

    std::size_t columns_;
    double spacing_;
    std::vector<bend::Pose> farthest_;  // of a body's regions
    bool from_rest_;
    Columns memory_;
    measure::CrowdScene scene_;
    std::vector<Member> members_;
    std::vector<glm::mat4x3> transforms_;  // of each instance
    bend::CrowdJob job_;
};

}  // namespace goffer::cli
