// SPDX-License-Identifier: MIT
#pragma once

#include <cassert>
#include <cstddef>
#include <memory>
#include <span>

/// Structure-of-arrays storage: equally long columns of floats in one aligned block.

namespace goffer {

/// Bytes that every column starts at a multiple of: a cache line, and the widest register.
inline constexpr std::size_t column_alignment = 64;

/// Floats that any kernel reads at once at most: two of the widest registers.
inline constexpr std::size_t widest_batch = 32;

/// A block of `columns` columns with `count` floats each.
///
/// Every column starts on a cache line and is padded with zeros so that a kernel may read a whole widest
/// batch from any index below count(). Move-only; the memory is the object's own. Reading from several
/// threads is safe.
class Columns {
public:
    Columns() = default;

    /// Allocates zero-filled columns: about columns * (count + 32) * 4 bytes. May throw std::bad_alloc.
    Columns(std::size_t columns, std::size_t count);

    [[nodiscard]] std::size_t columns() const noexcept { return columns_; }
    [[nodiscard]] std::size_t count() const noexcept { return count_; }
    [[nodiscard]] std::size_t bytes() const noexcept { return columns_ * stride_ * sizeof(float); }

    /// The values of column `index` < columns(), without the padding.
    [[nodiscard]] std::span<float> operator[](std::size_t index) noexcept {
        assert(index < columns_);
        return {memory_.get() + index * stride_, count_};
    }
    [[nodiscard]] std::span<const float> operator[](std::size_t index) const noexcept {
        assert(index < columns_);
        return {memory_.get() + index * stride_, count_};
    }

private:
    struct Free {
        void operator()(float* memory) const noexcept;
    };
    std::unique_ptr<float[], Free> memory_;
    std::size_t columns_ = 0;
    std::size_t count_ = 0;
    std::size_t stride_ = 0;  // floats from one column to the next
};

}  // namespace goffer
