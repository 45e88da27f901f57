// SPDX-License-Identifier: MIT
#pragma once

#include "cache/columns.hpp"
#include "cache/scene.hpp"
#include "motion/motion.hpp"

#include <goffer/bend/body.hpp>
#include <goffer/bend/pose.hpp>

#include <glm/mat4x3.hpp>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <span>
#include <utility>
#include <vector>

namespace goffer::cli {

/// What instances do at one moment.
struct Moments {
    std::size_t stride = 0;         ///< poses of an instance: those of the body with the most regions
    std::vector<bend::Pose> poses;  ///< stride for each instance, of which it has as its body has regions
    std::vector<glm::mat4x3> transforms;  ///< from model space to the scene's
    std::vector<float> weights;           ///< of wrinkles
    std::vector<std::uint8_t> clamped;    ///< 1 where a motion asks for more than a body can
};

/// The instances of a scene, with their bodies and what moves them.
class Cast {
public:
    /// `bodies`: those of the scene, in its order; they and `scene` must outlive this. `memory`: bytes that
    /// numbers out of texts may take. Throws an error that names the file at fault: a motion or a file of
    /// numbers that does not fit the bodies.
    Cast(const Scene& scene, std::span<const bend::Body> bodies, std::uint64_t memory);

    [[nodiscard]] std::uint64_t instances() const noexcept { return scene_.instances; }
    [[nodiscard]] std::span<const bend::Body> bodies() const noexcept { return bodies_; }

    /// Which of the bodies an instance is.
    [[nodiscard]] std::size_t body_of(std::uint64_t instance) const;

    /// What instances [first, first + count) do in `frame`, with oneTBB in the arena that it is called from.
    /// Depends on nothing else. Throws an error that names the file where a number in it is not finite.
    void read(std::uint64_t frame, std::uint64_t first, std::uint64_t count, Moments& moments) const;

private:
    /// A group's motions, for each body that they move, and files.
    struct Member {
        const SceneGroup* group;
        std::vector<const Motion*> motions = {};  ///< of instance i: that of i modulo their number
        const NumberFile *poses = nullptr, *transforms = nullptr;
        std::size_t regions = 1;  ///< that `poses` has
        bool carried = false;     ///< `transforms` has rows for each frame
    };
    struct Stretch;

    void add(const SceneGroup& group, std::uint64_t& memory);
    /// A file is opened once, however many groups name it. Takes what it holds from `memory`.
    [[nodiscard]] const NumberFile* file_of(const std::filesystem::path& path, std::uint64_t& memory);
    [[nodiscard]] const Motion* motion_for(const SceneMotion& motion, std::size_t regions);
    void read(const Stretch& stretch, Moments& moments) const;
    void read_one(const Stretch& stretch, std::uint64_t index, Moments& moments) const;

    const Scene& scene_;
    std::span<const bend::Body> bodies_;
    std::size_t stride_ = 1;
    std::vector<std::vector<bend::Pose>> rest_;  // of each body
    /// By what it is made of: a motion of the scene, and how many regions a body has.
    std::map<std::pair<const SceneMotion*, std::size_t>, std::unique_ptr<const Motion>> motions_;
    std::map<std::filesystem::path, std::unique_ptr<NumberFile>> files_;
    std::vector<Member> members_;  // of each group
};

}  // namespace goffer::cli
