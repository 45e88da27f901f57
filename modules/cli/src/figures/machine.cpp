// SPDX-License-Identifier: MIT
#include "figures/machine.hpp"

#include <sys/utsname.h>

#include <fstream>

namespace goffer::cli {

std::string processor_name() {
    std::ifstream file("/proc/cpuinfo");
    for (std::string line; std::getline(file, line);) {
        const std::size_t colon = line.find(": ");
        if (line.starts_with("model name") && colon != std::string::npos) return line.substr(colon + 2);
    }
    utsname system{};
    return uname(&system) == 0 ? system.machine : "a processor without a name";
}

}  // namespace goffer::cli
