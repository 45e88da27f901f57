// SPDX-License-Identifier: MIT
#pragma once

#include <doctest/doctest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

namespace goffer::test {

/// Khronos' validator over `files`. What it says goes to the test's output. `strict`: it must not warn
/// either.
inline void check_valid(const std::vector<std::filesystem::path>& files, bool strict = false) {
    if (std::system("node --version > /dev/null 2>&1") != 0) {
        MESSAGE("skipped: node is not installed, so Khronos' validator cannot run");
        return;
    }
    std::string command = "node '" GOFFER_SOURCE_DIR "/tests/mesh/validate_gltf.mjs'";
    if (strict) command += " --strict";
    for (const auto& file : files) command += " '" + file.string() + "'";
    const int status = WEXITSTATUS(std::system(command.c_str()));
    if (status == 77) {
        MESSAGE("skipped: run npm install --prefix build gltf-validator@2.0.0-dev.3.10");
    } else {
        CHECK(status == 0);
    }
}

}  // namespace goffer::test
