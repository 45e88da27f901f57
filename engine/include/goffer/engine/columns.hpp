// SPDX-License-Identifier: MIT
#pragma once

#include <cassert>
#include <cstddef>
#include <span>

/// Structure-of-arrays storage: equally long columns of floats in one aligned block.

namespace goffer {

/// Alignment of every column in bytes: a cache line, which is also the widest register.
inline constexpr std::size_t column_alignment = 64;

/// The most floats that a kernel reads at once: two of the widest registers.
inline constexpr std::size_t widest_batch = 32;

/// A block of `columns` columns with `count` floats each.
///
/// Every column starts on a cache line and ends in zeros, so that a kernel may read `widest_batch` floats
/// from any index below count(). Owns its memory; move-only. An object that was moved from may only be
/// destroyed or assigned to. Several threads may read at the same time.
class Columns {
public:
    Columns() = default;
    Columns(Columns&& other) noexcept;
    Columns& operator=(Columns&& other) noexcept;
    ~Columns();

    /// Allocates zero-filled columns: less than columns * (count + 96) * 4 bytes, or nothing where columns is
    /// 0. Throws std::bad_alloc, also where that is more than a std::size_t holds.
    Columns(std::size_t columns, std::size_t count);

    [[nodiscard]] std::size_t columns() const noexcept { return columns_; }
    [[nodiscard]] std::size_t count() const noexcept { return count_; }
    /// Floats from the start of a column to that of the next.
    [[nodiscard]] std::size_t stride() const noexcept { return stride_; }
    /// Bytes allocated, with the padding.
    [[nodiscard]] std::size_t bytes() const noexcept { return columns_ * stride_ * sizeof(float); }

    /// The count() values of column `index` < columns(), without the padding.
    [[nodiscard]] std::span<float> operator[](std::size_t index) noexcept {
        assert(index < columns_);
        return {memory_ + index * stride_, count_};
    }
    [[nodiscard]] std::span<const float> operator[](std::size_t index) const noexcept {
        assert(index < columns_);
        return {memory_ + index * stride_, count_};
    }

private:
    float* memory_ = nullptr;  // its own
    std::size_t columns_ = 0;
    std::size_t count_ = 0;
    std::size_t stride_ = 0;  // floats from one column to the next
};

}  // namespace goffer
