// SPDX-License-Identifier: MIT
#pragma once

#include "model.hpp"
#include "poses.hpp"
#include "textures.hpp"

#include <condition_variable>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

/// Models for the viewer, read and bound while its window goes on.

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

/// Reads, fits, refines and binds. Throws what the commands throw.
[[nodiscard]] Loaded load(const Wish& wish);

/// Does so on a thread of its own, one wish after the other; of several that wait, the last alone.
class Loader {
public:
    /// Calls `wake`, on its own thread, whenever there is an answer.
    explicit Loader(std::function<void()> wake);
    ~Loader();
    Loader(const Loader&) = delete;
    Loader& operator=(const Loader&) = delete;

    void ask(Wish wish);

    /// What has come since the last call: models, or an error's line, or neither.
    struct Answer {
        std::unique_ptr<Loaded> loaded;
        std::string error;
        bool last = true;  ///< nothing that was asked for later is still to come
    };
    [[nodiscard]] Answer take();
    /// Whether there is something to take, and whether a wish is being worked on.
    [[nodiscard]] bool answered();
    [[nodiscard]] bool busy();

private:
    void work();

    std::mutex mutex_;
    std::condition_variable wake_;
    std::unique_ptr<Wish> next_;
    Answer answer_;
    bool working_ = false, stop_ = false;
    std::function<void()> wake_window_;
    std::thread thread_;
};

}  // namespace goffer::cli
