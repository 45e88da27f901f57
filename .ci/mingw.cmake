# SPDX-License-Identifier: MIT
# 64-bit Windows from a Debian or Ubuntu machine: g++-mingw-w64-x86-64-posix builds, wine64 runs the tests.
set(CMAKE_SYSTEM_NAME Windows)
set(CMAKE_SYSTEM_PROCESSOR x86_64)
set(CMAKE_CXX_COMPILER x86_64-w64-mingw32-g++-posix)
# Programs without DLLs of the compiler's, which wine would have to be told of.
set(CMAKE_EXE_LINKER_FLAGS_INIT -static)

# Without a display, and with a Windows of its own, which wine makes at its first start.
find_program(GOFFER_WINE NAMES wine64 wine PATHS /usr/lib/wine REQUIRED)
file(MAKE_DIRECTORY ${CMAKE_BINARY_DIR}/wine)
set(CMAKE_CROSSCOMPILING_EMULATOR ${CMAKE_COMMAND} -E env --unset=DISPLAY WINEDEBUG=-all
    WINEPREFIX=${CMAKE_BINARY_DIR}/wine ${GOFFER_WINE})

# Header-only packages are the machine's own. The compiler looks into /usr/include after its own headers; CMake finds
# out that it does, and leaves that folder out of the command line, where it would come before them.
set(CMAKE_CXX_FLAGS_INIT "-idirafter /usr/include")
set(CMAKE_PREFIX_PATH /usr)
set(xsimd_DIR /usr/lib/${CMAKE_HOST_SYSTEM_PROCESSOR}-linux-gnu/cmake/xsimd CACHE PATH "Where xsimdConfig.cmake is")
