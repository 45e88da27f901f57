// SPDX-License-Identifier: MIT
#pragma once

#include "stage/load.hpp"

#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

/// Models for the viewer, read and bound while its window goes on.

namespace goffer::cli {

/// Loads on a thread of its own, one wish after the other; of several that wait, the last alone.
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
