// SPDX-License-Identifier: MIT
#pragma once

#include <goffer/fit/geometry.hpp>

#include <string>

/// What fit says of what it refuses.

namespace goffer::test {

/// The message of the fit::Error that `work` throws; empty if it throws none.
template <class Work>
std::string error_of(Work&& work) {
    try {
        (void)work();
    } catch (const fit::Error& error) {
        return error.what();
    }
    return {};
}

}  // namespace goffer::test
