// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>

namespace goffer::cli {

/// Says on the terminal what is going on, once it has taken two seconds; nothing at all when standard error
/// is no terminal. Gone without a trace when it goes out of scope.
class Progress {
public:
    explicit Progress(const std::string& stage);
    ~Progress();
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    /// Says how much is done, 0..1: the time that is left is then shown too. From any thread.
    void reached(double share) noexcept { share_ = share; }

private:
    void show();

    std::string stage_;
    std::atomic<double> share_ = 0;
    std::mutex mutex_;
    std::condition_variable wake_;
    bool done_ = false;
    std::thread thread_;
};

}  // namespace goffer::cli
