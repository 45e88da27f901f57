// SPDX-License-Identifier: MIT
#include "threads.hpp"

#include <tbb/info.h>

#include <algorithm>

namespace goffer::cli {

int usable_threads(int asked) {
    // oneTBB has no more than the machine's anyway, and would say so on standard error.
    const int most = tbb::info::default_concurrency();
    return asked == 0 ? most : std::min(asked, most);
}

}  // namespace goffer::cli
