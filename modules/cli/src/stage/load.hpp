// SPDX-License-Identifier: MIT
#pragma once

#include "model.hpp"
#include "poses.hpp"
#include "textures.hpp"

#include <filesystem>
#include <string>
#include <vector>

/// Models for the viewer: read, fitted and bound.

namespace goffer::cli {

/// What is asked for.
struct Wish {
    std::vector<std::filesystem::path> files;  ///< none: the base model, a bare cylinder
    BindWords bind;
    PoseWords pose;
    bool keep_rest = false;  ///< a body that is bent in its file stays as it is, whatever `pose` says
    bool new_pose = true;    ///< the body is to take the pose that these words say
};

/// What came of it.
struct Loaded {
    Wish wish;
    std::vector<BoundModel> models;
    std::vector<Textures> textures;     ///< of each model
    BindWords words;                    ///< of the wish, with those that --paper stands for
    std::vector<Target> targets;        ///< of the first model, as the words ask for them
    std::vector<std::string> warnings;  ///< in one line each
};

/// How the wish's models are bound; `pose` is what its words say of poses. Several of them are posed alike,
/// and none is bent along a chain of arcs unless it is said of how many. Throws UsageError.
[[nodiscard]] BindRequest bind_request(const Wish& wish, const PoseRequest& pose);

/// Reads, fits, refines and binds. Throws what the commands throw.
[[nodiscard]] Loaded load(const Wish& wish);

}  // namespace goffer::cli
