// SPDX-License-Identifier: MIT
#include "file/holdings.hpp"

namespace goffer::bend {

FileMemory::FileMemory(const FileMemory& other) noexcept : holdings_(other.holdings_) {
    if (holdings_ != nullptr) holdings_->shares.fetch_add(1, std::memory_order_relaxed);
}

FileMemory::~FileMemory() {
    if (holdings_ != nullptr && holdings_->shares.fetch_sub(1, std::memory_order_acq_rel) == 1)
        delete holdings_;
}

}  // namespace goffer::bend
