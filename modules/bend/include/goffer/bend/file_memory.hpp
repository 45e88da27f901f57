// SPDX-License-Identifier: MIT
#pragma once

#include <utility>

namespace goffer::bend {

struct FileHoldings;

/// A share in what the views of a BodyFile refer to. For goffer's own sources. (No std::shared_ptr: the
/// runtime is built without type information, and its inline functions may be the program's.)
class FileMemory {
public:
    FileMemory() = default;
    /// Takes a share that was counted already; null: none.
    explicit FileMemory(FileHoldings* holdings) noexcept : holdings_(holdings) {}
    FileMemory(const FileMemory& other) noexcept;
    FileMemory(FileMemory&& other) noexcept : holdings_(std::exchange(other.holdings_, nullptr)) {}
    FileMemory& operator=(FileMemory other) noexcept {
        std::swap(holdings_, other.holdings_);
        return *this;
    }
    ~FileMemory();

    [[nodiscard]] FileHoldings* operator->() const noexcept { return holdings_; }

private:
    FileHoldings* holdings_ = nullptr;
};

}  // namespace goffer::bend
