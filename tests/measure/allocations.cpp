// SPDX-License-Identifier: MIT
#include "support/sanitized.hpp"

#include <goffer/measure/allocations.hpp>

#include <doctest/doctest.h>

#include <cstdlib>
#include <new>

namespace goffer::test {

#ifdef __GLIBC__
inline constexpr bool counted = !sanitized;
#else
inline constexpr bool counted = false;
#endif

TEST_CASE("allocations are counted in a program that asks for them, operator new's too") {
    // Through pointers that the compiler cannot see through, so that no pair of calls is left out.
    void* (*volatile allocate)(std::size_t) = std::malloc;
    void* (*volatile make)(std::size_t) = ::operator new;
    const auto before = measure::allocations();
    REQUIRE(before.has_value() == counted);
    std::free(allocate(24));
    CHECK(measure::allocations().value_or(1) == before.value_or(0) + 1);
    ::operator delete(make(24));
    CHECK(measure::allocations().value_or(2) == before.value_or(0) + 2);
}

}  // namespace goffer::test
