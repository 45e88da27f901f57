// SPDX-License-Identifier: MIT
#pragma once

#include <doctest/doctest.h>

#include <cstdlib>
#include <filesystem>
#include <string>

/// The real meshes. tests/data has some, with free licenses; others are where GOFFER_MODELS says, or beside
/// the repository in shared/models. A test that needs one of these is about that one alone, so that ctest can
/// skip it.

namespace goffer::test {

/// Path of a real model. Empty where it is not at hand: what is said then makes ctest count the test as
/// skipped, whatever it checks besides.
inline std::filesystem::path model(const std::string& name) {
    const char* named = std::getenv("GOFFER_MODELS");
    for (const std::filesystem::path folder :
         {GOFFER_SOURCE_DIR "/tests/data", named ? named : GOFFER_TEST_MODELS}) {
        if (std::filesystem::exists(folder / name)) return folder / name;
    }
    MESSAGE("skipped: the model is not at hand: ", name);
    return {};
}

}  // namespace goffer::test
