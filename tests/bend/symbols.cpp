// SPDX-License-Identifier: MIT
#include "support/commands.hpp"

#include <goffer/engine/isa.hpp>

#include <doctest/doctest.h>

#include <algorithm>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

/// What the library's object files define, and what they call.

namespace goffer::test {
namespace {

/// The object files in a list by CMake.
std::vector<std::string> objects(const char* list) {
    std::vector<std::string> objects;
    std::istringstream names(list);
    for (std::string object; std::getline(names, object, '|');) objects.push_back(object);
    return objects;
}

bool is(const std::string& object, std::string_view source) {
    return object.find("/" + std::string(source)) != std::string::npos;
}

/// Names of the functions and data that `object` defines and others could share.
std::vector<std::string> shared_names(const std::string& object) {
    std::vector<std::string> names;
    std::istringstream lines(output_of("nm --defined-only -C '" + object + "' 2>&1"));
    for (std::string line; std::getline(lines, line);) {
        if (line.size() < 20) continue;
        const char kind = line[17];
        if (kind == 'W' || kind == 'V' || kind == 'T' || kind == 'u') names.push_back(line.substr(19));
    }
    return names;
}

/// Names of the functions and data that `object` wants of others.
std::vector<std::string> wanted_names(const std::string& object) {
    std::vector<std::string> names;
    std::istringstream lines(output_of("nm --undefined-only -C '" + object + "' 2>&1"));
    for (std::string line; std::getline(lines, line);) {
        if (line.size() >= 20) names.push_back(line.substr(19));
    }
    return names;
}

/// Functions of the C library that only compute, copy or compare.
bool is_harmless(const std::string& name) {
    constexpr std::string_view functions[] = {
        "memcpy", "memmove", "memset", "memcmp", "sinf",       "cosf",      "sincosf",
        "sqrtf",  "floorf",  "fmodf",  "fabsf",  "nearbyintf", "sqrt",      "copysignf",
        "sin",    "cos",     "sincos", "atan2",  "hypot",      "remainder", "strlen"};
    return std::ranges::find(functions, name) != std::end(functions);
}

/// What compilers ask for on their own account (on Arm also atomic arithmetic, chosen by processor; where the
/// machine is looked at, the guard of a constant that is made once), sanitizers, and assertions of builds
/// that have them.
bool is_compilers(const std::string& name) {
    constexpr std::string_view beginnings[] = {"_GLOBAL_OFFSET_TABLE_",
                                               "__asan_",
                                               "__ubsan_",
                                               "__tsan_",
                                               "__sanitizer_",
                                               "__stack_chk_",
                                               "__cxa_guard_",
                                               "__assert_fail",
                                               "__gcov_",
                                               "__aarch64_",
                                               "std::__glibcxx_assert_fail("};
    return std::ranges::any_of(beginnings, [&](std::string_view start) { return name.starts_with(start); });
}

}  // namespace

// A function that the AVX-512 file emits under a name which another file emits too may be the copy that the
// linker keeps, and then fails on an older processor. So every function that a kernel's file defines must
// carry its own lanes' name, and not that of the lanes which files for everybody use (simd::Float4).
TEST_CASE("kernel files define nothing that another file could take for its own") {
    int kernels = 0;
    for (const std::string& object : objects(GOFFER_BEND_OBJECTS)) {
        if (!is(object, "kernel_") || is(object, "kernel_scalar")) continue;
        ++kernels;
        const std::vector<std::string> names = shared_names(object);
        CHECK(!names.empty());
        for (const std::string& name : names) {
            // Ours or xsimd's; nm reads not all names that newer compilers make.
            const std::size_t simd = name.find(name.starts_with("_Z") ? "4simd" : "simd::");
            const bool tagged = name.find("xsimd::") != std::string::npos ||
                                (simd != std::string::npos && name.find("Lanes", simd) != std::string::npos);
            const bool everybodys =
                name.find("Float4") != std::string::npos || name.find("xsimd::sse2>") != std::string::npos;
            CHECK_MESSAGE(((tagged && !everybodys) || name.find("DW.ref.") == 0), object, " defines ", name);
        }
        CHECK(output_of("nm '" + object + "' 2>&1").find("_GLOBAL__sub_I") == std::string::npos);
    }
    CHECK(kernels == static_cast<int>(built_isas().size()) - 1);
}

// P6: what frames go through, all but the scheduler and the making of bodies, calls nothing that could
// allocate, lock, or open, read and write a file. Sources that are compiled together are one object.
TEST_CASE("P6: the frame path calls nothing but itself and arithmetic" *
          doctest::skip(GOFFER_COMPILED_TOGETHER)) {
    std::vector<std::string> frame_path;
    for (const std::string& object : objects(GOFFER_BEND_OBJECTS)) {
        const bool makes = (is(object, "body/") && !is(object, "body/table.cpp")) || is(object, "file/") ||
                           is(object, "pose/socket_body.cpp");
        if (!makes) frame_path.push_back(object);
    }
    for (const std::string& object : objects(GOFFER_ENGINE_OBJECTS)) {
        if (is(object, "isa.cpp")) frame_path.push_back(object);
    }
    CHECK(frame_path.size() > 8);
    std::size_t wanted = 0;
    for (const std::string& object : frame_path) {
        for (const std::string& name : wanted_names(object)) {
            ++wanted;
            const bool own = name.starts_with("goffer::bend::") || name.starts_with("goffer::runs_here(") ||
                             name.starts_with("goffer::resolve(") || name.starts_with("goffer::built_isas(");
            const bool scheduler = name.starts_with("goffer::parallel_ranges(");
            CHECK_MESSAGE((own || scheduler || is_harmless(name) || is_compilers(name)), object, " calls ",
                          name);
        }
    }
    CHECK(wanted > 20);
}

}  // namespace goffer::test
