// SPDX-License-Identifier: MIT
#pragma once

#include <goffer/bend/body.hpp>
#include <goffer/bend/pose.hpp>

#include <glm/mat4x3.hpp>
#include <nlohmann/json.hpp>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

/// How a body bends over time.

namespace goffer::cli {

/// The most frames that a motion is written in.
inline constexpr std::uint64_t most_frames = 1'000'000;

/// What a body does at one moment.
struct Moment {
    std::vector<bend::Pose> poses;  ///< one per region
    glm::mat4x3 transform{1.0f};    ///< from model space to the scene's: a rotation and a shift
    bool clamped = false;           ///< a path asks for more than a region can, which `poses` do not show
    double path_error = 0;          ///< how far the center line is from the path that it follows, if any
};

/// A movement of bodies with a certain number of regions. Immutable and thread-safe.
class Motion {
public:
    virtual ~Motion() = default;

    [[nodiscard]] virtual double seconds() const noexcept = 0;  ///< its length, > 0
    [[nodiscard]] virtual bool repeats() const noexcept = 0;    ///< whether it ends as it begins

    /// Returns the moment `seconds` after the beginning, for `body`, which has the regions that the motion
    /// was made for. Before the beginning and after the end: as there, or, where it repeats, as in another
    /// round. Throws InputError where the body has no room on a path.
    [[nodiscard]] virtual Moment at(double seconds, const bend::Body& body) const = 0;
};

/// The motion that a document says, for bodies of `regions` regions: what a file of `goffer animate --keys`
/// holds, and `motion` in a scene of `goffer cache`. `where` begins its errors. Throws InputError.
[[nodiscard]] std::unique_ptr<const Motion> read_motion(const nlohmann::json& document, std::size_t regions,
                                                        const std::string& where);

}  // namespace goffer::cli
