// SPDX-License-Identifier: MIT
#include <goffer/measure/timer.hpp>

#include <doctest/doctest.h>

#include <chrono>
#include <thread>

namespace goffer::test {

TEST_CASE("a quantile is the smallest value that its share of them do not exceed") {
    CHECK(measure::quantile({5, 1, 4, 2, 3}, 0.5) == 3);
    CHECK(measure::quantile({4, 1, 3, 2}, 0.5) == 2);
    CHECK(measure::quantile({4, 1, 3, 2}, 0.75) == 3);
    CHECK(measure::quantile({4, 1, 3, 2}, 0.76) == 4);
    CHECK(measure::quantile({4, 1, 3, 2}, 0) == 1);
    CHECK(measure::quantile({4, 1, 3, 2}, 1) == 4);
    CHECK(measure::quantile({}, 0.5) == 0);
    CHECK(measure::median({9, 7, 8}) == 8);
}

TEST_CASE("one thread is timed by its own clock, several by the wall's") {
    constexpr double milliseconds = 1e6;
    const auto sleep = [] { std::this_thread::sleep_for(std::chrono::milliseconds(50)); };
    CHECK(measure::nanoseconds_of(2, sleep) >= 45 * milliseconds);  // a coarse clock may wake it early
#ifndef _WIN32
    CHECK(measure::nanoseconds_of(1, sleep) < 25 * milliseconds);
#endif
    const auto work = [] {
        const double start = measure::now(1);
        while (measure::now(1) - start < 5 * milliseconds) {
        }
    };
    CHECK(measure::nanoseconds_of(1, work) >= 5 * milliseconds);
    CHECK(measure::nanoseconds_of(2, work) >= 5 * milliseconds);
}

}  // namespace goffer::test
