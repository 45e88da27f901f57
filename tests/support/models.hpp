// SPDX-License-Identifier: MIT
#pragma once

#include <doctest/doctest.h>

#include <cstdlib>
#include <filesystem>

/// The real meshes, which are not part of the repository: beside it in shared/models, or where GOFFER_MODELS
/// says.

namespace goffer::test {

/// Path of a real model, or an empty path, said in the test's output, where the set is not at hand.
inline std::filesystem::path model(const char* name) {
    const char* folder = std::getenv("GOFFER_MODELS");
    const std::filesystem::path path = std::filesystem::path(folder ? folder : GOFFER_TEST_MODELS) / name;
    if (std::filesystem::exists(path)) return path;
    MESSAGE("not at hand, left out: ", path.string());
    return {};
}

}  // namespace goffer::test
