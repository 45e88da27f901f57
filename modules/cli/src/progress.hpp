// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <functional>
#include <mutex>
#include <string>
#include <thread>

namespace goffer::cli {

/// Says on the terminal what is going on, once it has taken two seconds, and how long it may still take where
/// its steps are counted or somebody says the share that is done; nothing at all when standard error is no
/// terminal. Gone without a trace when it goes out of scope.
class Progress {
public:
    /// `steps`: how many calls of advance() there will be; 0: nobody knows.
    explicit Progress(const std::string& stage, std::size_t steps = 0);
    ~Progress();
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    /// A step is done. Thread-safe; costs next to nothing.
    void advance() noexcept { done_steps_.fetch_add(1, std::memory_order_relaxed); }

    /// This share is done, 0 to 1; the largest one said so far counts, and none where steps are counted.
    /// Thread-safe; costs next to nothing.
    void at(double share) noexcept;

    /// What work that says its share calls. To be dropped before this goes out of scope.
    [[nodiscard]] std::function<void(double)> listener() {
        return [this](double share) { at(share); };
    }

private:
    void show();
    [[nodiscard]] std::string line(double seconds) const;

    std::string stage_;
    std::size_t steps_;
    std::atomic<std::size_t> done_steps_ = 0;
    std::atomic<double> share_ = 0;
    std::mutex mutex_;
    std::condition_variable wake_;
    bool done_ = false;
    std::thread thread_;
};

/// What a terminal shows of a stage after `seconds`: how long it has taken or, once some of its `steps` are
/// done, a bar and the time that the others will take if they are as quick.
[[nodiscard]] std::string progress_line(const std::string& stage, std::size_t done, std::size_t steps,
                                        double seconds);

/// The same of a stage of which a share is done, 0 to 1, in percent.
[[nodiscard]] std::string progress_line(const std::string& stage, double share, double seconds);

}  // namespace goffer::cli
