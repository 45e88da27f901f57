# SPDX-License-Identifier: MIT
# 64-bit Arm from another Debian or Ubuntu machine: g++-aarch64-linux-gnu builds, qemu-user runs the tests.
set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_SYSTEM_PROCESSOR aarch64)
set(CMAKE_CXX_COMPILER aarch64-linux-gnu-g++)
set(CMAKE_CROSSCOMPILING_EMULATOR qemu-aarch64 -L /usr/aarch64-linux-gnu)
# g++ would tell of every pair passed by value that the ABI of C++14 had another register for it.
set(CMAKE_CXX_FLAGS_INIT -Wno-psabi)

# Header-only packages are the machine's own. Debian's cross compiler looks into /usr/include itself, after its own
# headers; CMake knows that and leaves that folder out of the command line, where it would come before them.
# Among these packages, xsimd alone may have its config file where only the machine's own architecture is looked for.
set(xsimd_DIR /usr/lib/${CMAKE_HOST_SYSTEM_PROCESSOR}-linux-gnu/cmake/xsimd CACHE PATH "Where xsimdConfig.cmake is")
