// SPDX-License-Identifier: MIT
#include "unfinished.hpp"

#include <goffer/io/atomic_file.hpp>

#include <array>
#include <atomic>
#include <cstring>
#include <string>

#ifndef _WIN32
#include <unistd.h>

#endif

namespace goffer::io {

#ifdef _WIN32

Making::Making() noexcept = default;
Making::~Making() = default;
int note_unfinished(const std::filesystem::path&) noexcept {
    return -1;
}
void forget_unfinished(int) noexcept {}
void remove_unfinished() noexcept {}

#else

namespace {

/// A place of the list. Whoever takes it, from `unused` or `noted`, may touch the path, nobody else.
struct Slot {
    enum State { unused, taken, noted };
    std::atomic<int> state{unused};
    std::array<char, 4096> path{};

    bool change(int from, int to) { return state.compare_exchange_strong(from, to); }
};
static_assert(std::atomic<int>::is_always_lock_free, "a signal handler must not wait");

/// State of the process, of which goffer has hardly any: a signal handler is given nothing, must not allocate
/// and must not wait, so that what it needs lies here, at a fixed size.
std::array<Slot, 128> slots;
std::atomic<int> made_now{0};  // and not noted yet
std::atomic<bool> ending{false};
static_assert(std::atomic<bool>::is_always_lock_free);

}  // namespace

Making::Making() noexcept {
    sigset_t all;
    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, &held_back_before_);
    ++made_now;
    too_late_ = ending;
}

Making::~Making() {
    --made_now;
    pthread_sigmask(SIG_SETMASK, &held_back_before_, nullptr);
}

int note_unfinished(const std::filesystem::path& file) noexcept {
    const std::string& path = file.native();
    for (std::size_t place = 0; place < slots.size(); ++place) {
        Slot& slot = slots[place];
        if (path.size() >= slot.path.size() || !slot.change(Slot::unused, Slot::taken)) continue;
        std::memcpy(slot.path.data(), path.c_str(), path.size() + 1);
        slot.state = Slot::noted;
        return static_cast<int>(place);
    }
    return -1;
}

void forget_unfinished(int place) noexcept {
    if (place >= 0) (void)slots[static_cast<std::size_t>(place)].change(Slot::noted, Slot::unused);
}

void remove_unfinished() noexcept {
    ending = true;
    // Other threads are about to note what they have made; longer than two seconds none takes.
    constexpr timespec millisecond{0, 1'000'000};
    for (int i = 0; i < 2000 && made_now != 0; ++i) nanosleep(&millisecond, nullptr);
    for (Slot& slot : slots) {
        if (slot.change(Slot::noted, Slot::taken)) unlink(slot.path.data());
    }
}

#endif

}  // namespace goffer::io
