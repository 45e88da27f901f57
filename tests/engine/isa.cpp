// SPDX-License-Identifier: MIT
#include <goffer/engine/isa.hpp>

#include <doctest/doctest.h>

#include <algorithm>

/// The choice of an instruction set.

namespace goffer::test {
namespace {

bool is_built(Isa isa) {
    return std::ranges::find(built_isas(), isa) != built_isas().end();
}

constexpr Isa all_isas[] = {Isa::automatic, Isa::scalar, Isa::sse42, Isa::avx2, Isa::avx512, Isa::neon};

}  // namespace

TEST_CASE("scalar kernels run on every machine, and what is not built on none") {
    CHECK(is_built(Isa::scalar));
    CHECK(built_isas().front() == Isa::scalar);
    CHECK(std::ranges::is_sorted(built_isas()));
    CHECK(runs_here(Isa::automatic));
    CHECK(runs_here(Isa::scalar));
    for (const Isa isa : all_isas) {
        if (isa != Isa::automatic && !is_built(isa)) CHECK_FALSE(runs_here(isa));
    }
}

TEST_CASE("automatic is the widest set that runs here, and others are themselves") {
    Isa widest = Isa::scalar;
    for (const Isa isa : built_isas()) {
        if (runs_here(isa)) widest = isa;
    }
    CHECK(resolve(Isa::automatic) == widest);
    for (const Isa isa : all_isas) {
        if (isa != Isa::automatic) CHECK(resolve(isa) == isa);
    }
}

#if defined(__x86_64__) && (defined(__GNUC__) || defined(__clang__))
TEST_CASE("what runs here is what the compiler's own test finds") {
    const bool avx2 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
    const bool avx512 = avx2 && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512cd") &&
                        __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512bw");
    if (is_built(Isa::sse42)) CHECK(runs_here(Isa::sse42) == (__builtin_cpu_supports("sse4.2") != 0));
    if (is_built(Isa::avx2)) CHECK(runs_here(Isa::avx2) == avx2);
    if (is_built(Isa::avx512)) CHECK(runs_here(Isa::avx512) == avx512);
}
#endif

TEST_CASE("names of instruction sets lead back to them") {
    for (const Isa isa : all_isas) CHECK(parse_isa(name(isa)) == isa);
    CHECK_FALSE(parse_isa("").has_value());
    CHECK_FALSE(parse_isa("AVX2").has_value());
    CHECK(name(static_cast<Isa>(99)) == "unknown");
}

}  // namespace goffer::test
