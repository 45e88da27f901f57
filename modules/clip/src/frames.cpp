// SPDX-License-Identifier: MIT
#include <goffer/clip/frames.hpp>
