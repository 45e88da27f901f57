// SPDX-License-Identifier: MIT
#include "progress.hpp"

#include <goffer/io/error.hpp>

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <system_error>

namespace goffer::cli {
namespace {

/// "12 s", or "3:05" in minutes and seconds, or "2:03:05".
std::string time_text(double seconds) {
    const auto all = static_cast<long long>(std::lround(seconds));
    char text[64];
    if (all < 60) {
        std::snprintf(text, sizeof text, "%lld s", all);
    } else if (all < 3600) {
        std::snprintf(text, sizeof text, "%lld:%02lld", all / 60, all % 60);
    } else {
        std::snprintf(text, sizeof text, "%lld:%02lld:%02lld", all / 3600, all / 60 % 60, all % 60);
    }
    return text;
}

/// `done` is what the bar stands for, in words.
std::string bar(const std::string& stage, double share, const std::string& done, double seconds) {
    constexpr std::size_t width = 24;
    const auto full = static_cast<std::size_t>(share * width);
    return stage + " [" + std::string(full, '#') + std::string(width - full, '.') + "] " + done + ", " +
           time_text(seconds * (1 - share) / share) + " left";
}

}  // namespace

std::string progress_line(const std::string& stage, std::size_t done, std::size_t steps, double seconds) {
    if (steps == 0 || done == 0) return stage + " ... " + time_text(seconds);
    done = std::min(done, steps);
    const double share = static_cast<double>(done) / static_cast<double>(steps);
    return bar(stage, share, std::to_string(done) + " of " + std::to_string(steps), seconds);
}

std::string progress_line(const std::string& stage, double share, double seconds) {
    constexpr double least = 0.001;  // what is left could be no more than a guess before
    if (!(share >= least)) return stage + " ... " + time_text(seconds);
    share = std::min(share, 1.0);
    return bar(stage, share, std::to_string(static_cast<int>(100 * share)) + " %", seconds);
}

Progress::Progress(const std::string& stage, std::size_t steps) : stage_(io::escaped(stage)), steps_(steps) {
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

void Progress::at(double share) noexcept {
    double said = share_.load(std::memory_order_relaxed);
    while (share > said && !share_.compare_exchange_weak(said, share, std::memory_order_relaxed)) {
    }
}

std::string Progress::line(double seconds) const {
    return steps_ > 0 ? progress_line(stage_, done_steps_, steps_, seconds)
                      : progress_line(stage_, share_, seconds);
}

void Progress::show() {
    using namespace std::chrono_literals;
    std::unique_lock lock(mutex_);
    const auto start = std::chrono::steady_clock::now();
    if (wake_.wait_for(lock, 2s, [this] { return done_; })) return;
    do {
        const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
        std::fprintf(stderr, "\r%s\033[K", line(taken.count()).c_str());
    } while (!wake_.wait_for(lock, 500ms, [this] { return done_; }));
    std::fprintf(stderr, "\r\033[K");
}

}  // namespace goffer::cli
