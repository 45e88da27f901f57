// SPDX-License-Identifier: MIT
#include "progress.hpp"

#include <goffer/io/error.hpp>

#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <system_error>

namespace goffer::cli {

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
        const auto seconds =
            std::chrono::duration_cast<std::chrono::seconds>(std::chrono::steady_clock::now() - start);
        std::fprintf(stderr, "\r%s ... %lld s", stage_.c_str(), static_cast<long long>(seconds.count()));
    } while (!wake_.wait_for(lock, 500ms, [this] { return done_; }));
    std::fprintf(stderr, "\r\033[K");
}

}  // namespace goffer::cli
