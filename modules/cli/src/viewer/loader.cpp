// SPDX-License-Identifier: MIT
#include "viewer/loader.hpp"

#include <exception>
#include <new>
#include <utility>

namespace goffer::cli {

Loader::Loader(std::function<void()> wake) : wake_window_(std::move(wake)), thread_([this] { work(); }) {}

Loader::~Loader() {
    {
        const std::lock_guard lock(mutex_);
        stop_ = true;
    }
    wake_.notify_one();
    thread_.join();
}

void Loader::ask(Wish wish) {
    {
        const std::lock_guard lock(mutex_);
        next_ = std::make_unique<Wish>(std::move(wish));
    }
    wake_.notify_one();
}

Loader::Answer Loader::take() {
    const std::lock_guard lock(mutex_);
    Answer answer = std::exchange(answer_, {});
    answer.last = !working_ && next_ == nullptr;
    return answer;
}

bool Loader::answered() {
    const std::lock_guard lock(mutex_);
    return answer_.loaded != nullptr || !answer_.error.empty();
}

bool Loader::busy() {
    const std::lock_guard lock(mutex_);
    return working_ || next_ != nullptr;
}

void Loader::work() {
    std::unique_lock lock(mutex_);
    for (;;) {
        wake_.wait(lock, [&] { return stop_ || next_ != nullptr; });
        if (stop_) return;
        const std::unique_ptr<Wish> wish = std::move(next_);
        working_ = true;
        lock.unlock();
        Answer answer;
        try {
            answer.loaded = std::make_unique<Loaded>(load(*wish));
        } catch (const std::bad_alloc&) {
            answer.error = "not enough memory for this; use a smaller file";
        } catch (const std::exception& error) {
            answer.error = error.what();
        }
        lock.lock();
        answer_ = std::move(answer);
        working_ = false;
        wake_window_();
    }
}

}  // namespace goffer::cli
