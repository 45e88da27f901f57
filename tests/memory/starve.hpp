// SPDX-License-Identifier: MIT
#pragma once

#include <doctest/doctest.h>

#include <algorithm>
#include <cstdint>
#include <new>
#include <string>

/// Memory that runs out: operator new of this executable fails once, wherever a test wants it to.

namespace goffer::test {

/// Counts the calls of operator new for `least` bytes or more, from any thread, while it lives; the one of
/// this number throws.
class Starved {
public:
    static constexpr std::uint64_t never = UINT64_MAX;

    explicit Starved(std::size_t least, std::uint64_t failing_call = never);
    ~Starved();
    Starved(const Starved&) = delete;
    Starved& operator=(const Starved&) = delete;

    [[nodiscard]] std::uint64_t calls() const;
};

/// Which allocations fail.
struct Diet {
    std::size_t least = 0;      ///< bytes
    std::uint64_t most = 2000;  ///< of them, at equal steps
};

/// Runs `work` once as it is, and then again and again, each time with another of its allocations failing. It
/// may then succeed all the same, throw std::bad_alloc, or throw an
/// Error of one line. `after` is called each time, to see what is left behind.
template <class Error, class Work, class After>
void starve(Work work, After after, Diet diet = {}) {
    std::uint64_t count = 0;
    {
        const Starved counting(diet.least);
        work();
        count = counting.calls();
    }
    after();
    REQUIRE(count > 0);
    std::uint64_t refused = 0;
    const std::uint64_t step = (count + diet.most - 1) / diet.most;
    for (std::uint64_t call = 0; call < count; call += step) {
        std::string fault;  // checks allocate: they wait until there is memory again
        try {
            const Starved starving(diet.least, call);
            work();
        } catch (const std::bad_alloc&) {
            ++refused;
        } catch (const Error& error) {
            ++refused;
            fault = error.what();
        }
        CHECK(fault.find('\n') == fault.npos);
        after();
    }
    CHECK(refused > 0);
}

template <class Error, class Work>
void starve(Work work, Diet diet = {}) {
    const auto nothing = [] {};
    starve<Error>(work, nothing, diet);
}

}  // namespace goffer::test
