// SPDX-License-Identifier: MIT
#pragma once

#include "command_line.hpp"
#include "report.hpp"

#include <goffer/bend/body.hpp>
#include <goffer/bend/pose.hpp>
#include <goffer/fit/bind.hpp>

#include <optional>
#include <span>
#include <string>
#include <vector>

/// How far and which way a body bends, region by region, from the words of the command line.

namespace goffer::cli {

struct BoundModel;

/// Words on poses. Lists are numbers with commas between them, from base to tip.
struct PoseWords {
    std::optional<std::string> angle;
    std::optional<std::string> by;
    std::optional<double> direction;
    std::optional<std::string> regions;
    std::optional<std::string> angles;
    std::optional<std::string> directions;
};

/// Adds --angle, --regions and --angles. `angle` says what --angle is; `words` must outlive `command`.
void add_angle_words(CLI::App& command, PoseWords& words, const std::string& angle);

/// Adds these, --by, --direction and --directions.
void add_pose_words(CLI::App& command, PoseWords& words);

/// `count` regions of one length.
[[nodiscard]] std::vector<fit::RegionOptions> equal_regions(std::size_t count);

/// Such words, understood. Throws UsageError.
struct PoseRequest {
    std::vector<fit::RegionOptions> regions;  ///< none: the body is one region
    bool from_rest = false;                   ///< angles count from the rest pose (--by), not from straight
    bool by_default = false;                  ///< no word says how far
    bool along_path = false;                  ///< a path says how far regions bend, no angle
    std::vector<double> angles;               ///< degrees, one per region; an infinity: as far as it can
    std::optional<double> shared;             ///< the angle that all regions share, if it is one
    std::vector<std::optional<double>> directions;  ///< degrees, one per region, where they are said

    /// To be filled in.
    PoseRequest() = default;
    /// `arcs`: of --arcs, 0 where nobody says. `baked`: the regions of a body that has them already, if it
    /// has several.
    explicit PoseRequest(const PoseWords& words, std::size_t arcs = 0,
                         std::vector<fit::RegionOptions> baked = {});

    /// Shares one angle out over regions by the lengths that they have in `body`.
    void share_out(const bend::Body& body);
};

/// A region's rest arc, in degrees; both are 0 of a straight one.
struct RestPose {
    double angle, direction;
};

[[nodiscard]] RestPose rest_pose(const bend::Body& body, std::size_t region);

/// Returns the pose of a region that is `share` of the way from its rest pose to the one that is `by` degrees
/// from there in `direction`, or as far as it can. Does not allocate.
[[nodiscard]] bend::Pose pose_from_rest(const bend::Body& body, std::size_t region, double by,
                                        double direction, double share);

/// What a region is of the length of its body.
[[nodiscard]] double share_of(const bend::Body& body, std::size_t region);

/// Returns which way a body is bent at rest as a whole, degrees: as its rest arcs are, added up as vectors
/// (alpha cos theta, alpha sin theta), or, where they cancel out, as the one that is bent furthest; 0 of a
/// straight body.
[[nodiscard]] double rest_direction(const bend::Body& body);

/// Whether a body is bent at rest: a chain of arcs may be straight.
[[nodiscard]] bool bent_at_rest(const bend::Body& body);

/// Whether a body is bent at rest along arcs that are not one.
[[nodiscard]] bool is_chain(const bend::Body& body);

/// Returns how a body is bent at rest, in words: as a whole if that is one arc, else region by region.
[[nodiscard]] std::string rest_words(const bend::Body& body);

/// Where a region is bent to. Angle and direction are degrees, the angle counts from straight.
struct Target {
    double angle = 0;  ///< as asked for: it may be beyond the largest
    double direction = 0;
    bend::Pose pose = {};  ///< the same, in radians
};

/// Returns the targets of `request`, one per region, as if no body were bent at rest; the largest angle is
/// beyond that of every body. For a crowd, whose models differ.
[[nodiscard]] std::vector<Target> targets_from_straight(const PoseRequest& request);

/// Whether the angles of `request` count from the rest pose of `body`: those of a body that is bent at rest
/// do, too, where no word says how far.
[[nodiscard]] bool counts_from_rest(const PoseRequest& request, const bend::Body& body);

/// Returns the targets of `request` for `body`, which has its regions, or shares its angle out over them by
/// their lengths if it is for one. Without a direction, regions bend toward rest_direction(). Angles that
/// count from the rest pose are added to it as vectors (alpha cos theta, alpha sin theta); where no word says
/// how far, they are at most what the body can do.
[[nodiscard]] std::vector<Target> targets_on(const bend::Body& body, const PoseRequest& request);

/// The target that a pose is.
[[nodiscard]] Target target_of(const bend::Pose& pose);

/// The targets' poses.
[[nodiscard]] std::vector<bend::Pose> poses_of(const std::vector<Target>& targets);

/// "3", or a list of one number of folds per region: the one, or into `regions`. Nothing for no text. Throws
/// UsageError.
[[nodiscard]] std::optional<int> read_folds(const std::optional<std::string>& text,
                                            std::vector<fit::RegionOptions>& regions);

/// What begins a line about one of `count` regions: nothing where there is one alone.
[[nodiscard]] std::string region_words(std::size_t region, std::size_t count);

/// The angle of a pose that a run uses, radians, >= 0: clamped to the region's largest.
[[nodiscard]] double used_angle(const bend::Body& body, std::size_t region, const bend::Pose& pose);

/// Whether a body in these poses, one per region, bends by more than a full turn in all.
[[nodiscard]] bool beyond_full_turn(const bend::Body& body, std::span<const bend::Pose> poses);

/// What more than a full turn comes to, for the end of a warning.
inline constexpr const char* full_turn_words =
    "more than a full turn: parts of the body may go through each other";

/// What each region of a body has of a right angle, radians, or its largest angle if that is less.
[[nodiscard]] std::vector<double> right_angle_of(const bend::Body& body);

/// How many folds a mesh carries.
[[nodiscard]] std::string capacity_words(int folds);

/// Warns where the area of a body that gets straighter than at rest grows: what was squeezed there is
/// stretched, and wrinkles take no area away. `when` is put behind the change; `then` ends the line.
void warn_of_stretch(Report& report, double change, const std::string& when = {},
                     const std::string& then = {});

/// Whether an angle is beyond the largest by more than how numbers are shown, both in degrees.
[[nodiscard]] bool is_beyond(double asked, double limit);

/// Warns that an angle is beyond the largest, both in degrees. `which` begins the line; `then` ends it: what
/// is done.
void warn_of_angle(Report& report, const std::string& which, double asked, double limit,
                   const std::string& then);

/// Says what each region was bent to, and warns of those that were clamped. If the body is bent at rest, also
/// says what angles count from, and whether it is straightened, which is returned.
bool report_poses(Report& report, const PoseRequest& request, const std::vector<Target>& targets,
                  const BoundModel& model);

}  // namespace goffer::cli
