// SPDX-License-Identifier: MIT
#include "unfinished.hpp"

#include <goffer/io/atomic_file.hpp>

#include <array>
#include <atomic>
#include <cstring>
#include <string>

#ifndef _WIN32
#include <unistd.h>

#include <ctime>
#endif

namespace goffer::io {

#ifdef _WIN32

Making::Making() noexcept = default;
Making::~Making() = default;
void note_unfinished(const std::filesystem::path&) noexcept {}
void forget_unfinished(const std::filesystem::path&) noexcept {}
void remove_unfinished() noexcept {}

#else

namespace {

/// A place of the list. Whoever takes it from `unused` or `noted` may touch the path, nobody else.
struct Slot {
    enum State { unused, taken, noted };
    std::atomic<int> state{unused};
    std::array<char, 4096> path{};

    bool take(int from) { return state.compare_exchange_strong(from, taken); }
};
static_assert(std::atomic<int>::is_always_lock_free, "a handler of signals must not wait");

/// State of the process, the only one in goffer: a handler of signals is given nothing, must not allocate and
/// must not wait, so that what it needs lies here, at a fixed size.
std::array<Slot, 16> slots;
std::atomic<int> made_now{0};  // by other threads, and not noted yet
std::atomic<bool> ending{false};
static_assert(std::atomic<bool>::is_always_lock_free);

}  // namespace

Making::Making() noexcept {
    ++made_now;
    too_late_ = ending;
}

Making::~Making() {
    --made_now;
}

void note_unfinished(const std::filesystem::path& file) noexcept {
    const std::string& path = file.native();
    for (Slot& slot : slots) {
        if (path.size() >= slot.path.size() || !slot.take(Slot::unused)) continue;
        std::memcpy(slot.path.data(), path.c_str(), path.size() + 1);
        slot.state = Slot::noted;
        return;
    }
}

void forget_unfinished(const std::filesystem::path& file) noexcept {
    const std::string& path = file.native();
    for (Slot& slot : slots) {
        if (!slot.take(Slot::noted)) continue;
        slot.state = path == slot.path.data() ? Slot::unused : Slot::noted;
    }
}

void remove_unfinished() noexcept {
    ending = true;
    // No longer than it takes to make a file: the thread that makes one may be this one, interrupted.
    constexpr timespec millisecond{0, 1'000'000};
    for (int i = 0; i < 50 && made_now != 0; ++i) nanosleep(&millisecond, nullptr);
    for (Slot& slot : slots) {
        if (slot.take(Slot::noted)) unlink(slot.path.data());
    }
}

#endif

}  // namespace goffer::io
