// SPDX-License-Identifier: MIT
#pragma once

#include "stage/load.hpp"
#include "stage/stage.hpp"

#include <array>
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

/// What is chosen in the viewer's panel, or in the page of samples/web: plain values, and the words of the
/// command line that they stand for.

namespace goffer::cli {

/// A region's pose in degrees.
struct Bend {
    float angle = 0, direction = 0;
};

/// All that the panel's controls are set to.
struct Controls {
    std::vector<Bend> regions{{90, 0}};  ///< one for each region of the body on stage
    int region_count = 1;                ///< that it is to have
    bool animated = false;
    /// The words are made of these. Folds below 0, a fold length of 0, an onset below 0: what suits the body.
    int folds = -1;
    std::string folds_list;  ///< in place of `folds`, if not empty: one number for each region
    float fold_length = 0, onset = -0.01f, roundness = 0.25f;
    std::string profile = "even", amplitude = "mesh", shape = "auto", refine = "auto";
    int instances = 0;  ///< of a crowd; 0: one body
    Deformer deformer = Deformer::processor;
    Show show;
    std::array<char, 4096> path{};  ///< of a file to open, as it is typed

    /// Takes over what words say, with those that --paper stands for: of a Loaded.
    void set_words(const BindWords& words);
    /// Takes over the targets of what was loaded, as far as its body bends. Leaves region_count alone.
    void set_poses(const Loaded& loaded);
    /// Has them be about what was loaded: a new pose where that is wanted, else the same as far as it goes.
    void take(const Loaded& loaded);
    /// Turns a region on by so much, at most to `limit`, its body's largest angle in radians.
    void turn(std::size_t region, const Bend& by, float limit);
};

/// `wish`, which is that of the models on stage, with the words that these controls stand for. If there are
/// to be as many regions as there are, they keep their shares; else all are as long, and together bend as
/// these do.
[[nodiscard]] Wish wish_of(const Controls& controls, Wish wish);

/// The same for other files: in the pose that they have, without what was said of those on stage alone.
[[nodiscard]] Wish wish_to_open(std::vector<std::filesystem::path> files, const Controls& controls,
                                Wish wish);

/// Poses of the regions, in radians; and back.
[[nodiscard]] std::vector<bend::Pose> poses_of(const Controls& controls);
[[nodiscard]] Bend bend_of(const bend::Pose& pose);

/// Poses on the way from straight to these and back, once in frames_per_swing.
[[nodiscard]] std::vector<bend::Pose> swung(std::vector<bend::Pose> poses, std::size_t frame);

/// The command that bends the model like this, or shows the crowd, to be typed in a shell. Throws InputError
/// for the base model, which has no file.
[[nodiscard]] std::string command_of(const Controls& controls, const Wish& wish, const BoundModel& model);

}  // namespace goffer::cli
