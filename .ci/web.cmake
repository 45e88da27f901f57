# SPDX-License-Identifier: MIT
# WebAssembly from a Debian or Ubuntu machine: Emscripten builds, a browser runs.
find_program(GOFFER_EMCC em++ REQUIRED)
file(REAL_PATH ${GOFFER_EMCC} emcc)
cmake_path(GET emcc PARENT_PATH emscripten)
include(${emscripten}/cmake/Modules/Platform/Emscripten.cmake)

# Header-only packages are the machine's own. The compiler is to look into /usr/include after its own headers; CMake, told
# so, leaves that folder out of the command line, where it would come before them.
set(CMAKE_CXX_FLAGS_INIT "-idirafter /usr/include -include ${CMAKE_CURRENT_LIST_DIR}/web.hpp")
set(CMAKE_CXX_IMPLICIT_INCLUDE_DIRECTORIES /usr/include)
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE BOTH)
set(CMAKE_PREFIX_PATH /usr)
