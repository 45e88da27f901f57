// SPDX-License-Identifier: MIT
#include "memory.hpp"

#include <algorithm>
#include <fstream>
#include <string>

namespace goffer::cli {
namespace {

/// The machine's, in kB in the line "MemAvailable:".
std::optional<std::uint64_t> machine() {
    std::ifstream file("/proc/meminfo");
    std::string name, line;
    for (std::uint64_t kilobytes = 0; file >> name >> kilobytes; std::getline(file, line)) {
        if (name == "MemAvailable:") return 1024 * kilobytes;
    }
    return std::nullopt;
}

/// A container's limit; "max", no number, where there is none.
std::optional<std::uint64_t> container() {
    std::ifstream file("/sys/fs/cgroup/memory.max");
    std::uint64_t bytes = 0;
    return file >> bytes ? std::optional(bytes) : std::nullopt;
}

}  // namespace

std::optional<std::uint64_t> free_memory() {
    const std::optional<std::uint64_t> free = machine();
    const std::optional<std::uint64_t> limit = container();
    return free && limit ? std::min(*free, *limit) : (free ? free : limit);
}

}  // namespace goffer::cli
