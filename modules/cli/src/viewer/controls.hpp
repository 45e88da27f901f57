// SPDX-License-Identifier: MIT
#pragma once

#include "viewer/loader.hpp"
#include "viewer/stage.hpp"

#include <array>
#include <cstddef>
#include <string>
#include <vector>

/// What is chosen in the viewer's panel: plain values, and the words of the command line that they stand for.

namespace goffer::cli {

/// A region's pose in degrees.
struct Bend {
    float angle = 0, direction = 0;
};

/// All that the panel's controls are set to.
struct Controls {
    std::vector<Bend> regions{{90, 0}};  ///< one for each region
    bool animated = false;
    /// Of these the words are made. 0 folds, a fold length of 0, an onset below 0: what suits the body.
    int folds = 0;
    float fold_length = 0, onset = -0.01f, roundness = 0.25f;
    std::string profile = "even", amplitude = "mesh", shape = "auto", refine = "auto";
    int instances = 0;  ///< of a crowd; 0: one body
    Deformer deformer = Deformer::processor;
    Show show;
    std::array<char, 4096> path{};  ///< of a file to open, as it is typed

    /// Takes over what the words of the command line say.
    void set(const BindWords& words);
    /// What the body was bent to by the words of the command line.
    void set(const std::vector<Target>& targets);
};

/// `wish` with the words that these controls stand for. A body file was bound when it was made: its words
/// stay.
[[nodiscard]] Wish wish_of(const Controls& controls, Wish wish);

/// Poses of the regions, in radians.
[[nodiscard]] std::vector<bend::Pose> poses_of(const Controls& controls);

/// The command that bends the model like this, to be typed in a shell.
[[nodiscard]] std::string command_of(const Controls& controls, const Wish& wish, const BoundModel& model);

}  // namespace goffer::cli
