// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <array>
#include <cstdio>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

/// A function that the AVX-512 file emits under a name which another file emits too may be the copy that the
/// linker keeps, and then fails on an older processor. So every function that a kernel's file defines must
/// carry its own lanes' name.

namespace goffer::test {
namespace {

std::string output_of(const std::string& command) {
    std::string text;
    const std::unique_ptr<FILE, int (*)(FILE*)> pipe(popen(command.c_str(), "r"), pclose);
    std::array<char, 4096> part{};
    while (pipe && fgets(part.data(), part.size(), pipe.get()) != nullptr) text += part.data();
    return text;
}

std::vector<std::string> kernel_objects() {
    std::vector<std::string> objects;
    std::istringstream list(GOFFER_KERNEL_OBJECTS);
    for (std::string object; std::getline(list, object, '|');) {
        if (object.find("/kernel_") != std::string::npos && object.find("scalar") == std::string::npos) {
            objects.push_back(object);
        }
    }
    return objects;
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

}  // namespace

TEST_CASE("kernel files define nothing that another file could take for its own") {
    for (const std::string& object : kernel_objects()) {
        const std::vector<std::string> names = shared_names(object);
        CHECK(!names.empty());
        for (const std::string& name : names) {
            const bool tagged =
                name.find("Lanes") != std::string::npos || name.find("xsimd::") != std::string::npos;
            CHECK_MESSAGE((tagged || name.find("DW.ref.") == 0), object, " defines ", name);
        }
        CHECK(output_of("nm '" + object + "' 2>&1").find("_GLOBAL__sub_I") == std::string::npos);
    }
}

}  // namespace goffer::test
