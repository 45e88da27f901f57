// SPDX-License-Identifier: MIT
#include "progress.hpp"

#include <goffer/io/error.hpp>

#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <system_error>

namespace goffer::cli {
namespace {

/// "; 34 %, 2 min 5 s left", once enough is done to tell.
std::string left_text(double share, double seconds) {
    constexpr double little = 0.001;
    if (!(share > little)) return {};
    const auto left = static_cast<long long>(seconds * (1 - share) / share);
    constexpr long long minute = 60, hour = 60 * minute;
    std::string time;
    if (left >= hour) time += std::to_string(left / hour) + " h ";
    if (left >= minute) time += std::to_string(left % hour / minute) + " min ";
    if (left < hour) time += std::to_string(left % minute) + " s ";
    return "; " + std::to_string(static_cast<int>(100 * share)) + " %, " + time + "left";
}

}  // namespace

Progress::Progress(const std::string& stage) : stage_(io::escaped(stage)) {
    if (isatty(STDERR_FILENO) == 0) return;
    try {
        thread_ = std::thread([this] { show(); });
    } catch (const std::system_error&) {
        // Where no thread is to be had, as in a browser, nothing is shown.
    }
}

Progress::~Progress() {
    if (!thread_.joinable()) return;
    {
        const std::lock_guard lock(mutex_);
        done_ = true;
    }
    wake_.notify_one();
    thread_.join();
}

void Progress::show() {
    using namespace std::chrono_literals;
    std::unique_lock lock(mutex_);
    const auto start = std::chrono::steady_clock::now();
    if (wake_.wait_for(lock, 2s, [this] { return done_; })) return;
    do {
        const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
        std::fprintf(stderr, "\r\033[K%s ... %lld s%s", stage_.c_str(),
                     static_cast<long long>(seconds.count()), left_text(share_, seconds.count()).c_str());
    } while (!wake_.wait_for(lock, 500ms, [this] { return done_; }));
    std::fprintf(stderr, "\r\033[K");
}

}  // namespace goffer::cli
