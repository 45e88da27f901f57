// SPDX-License-Identifier: MIT
#include "output/processor.hpp"

#if defined(__x86_64__) || defined(_M_X64)
#if defined(__GNUC__) || defined(__clang__)
#include <cpuid.h>
#else
#include <intrin.h>
#endif

#include <cstring>
#endif

namespace goffer::bend {

#if defined(__x86_64__) || defined(_M_X64)

namespace {

bool is_intel() noexcept {
    unsigned words[4] = {};  // eax, ebx, ecx, edx: the maker's name is in the last three, in another order
#if defined(__GNUC__) || defined(__clang__)
    if (__get_cpuid(0, &words[0], &words[1], &words[2], &words[3]) == 0) return false;
#else
    __cpuid(reinterpret_cast<int*>(words), 0);
#endif
    const unsigned name[3] = {words[1], words[3], words[2]};
    return std::memcmp(name, "GenuineIntel", sizeof name) == 0;
}

}  // namespace

bool planes_compete() noexcept {
    // Asked once: in a virtual machine the host answers cpuid, which takes longer than many a job.
    static const bool compete = !is_intel();
    return compete;
}

#else

bool planes_compete() noexcept {
    return true;
}

#endif

}  // namespace goffer::bend
