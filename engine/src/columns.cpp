// SPDX-License-Identifier: MIT
#include <goffer/engine/columns.hpp>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <new>
#include <utility>

namespace goffer {
namespace {

// Leaves room for a whole batch behind the last value. Never a multiple of a page: a vertex's values in
// different columns would compete for the same lines of the first-level cache.
std::size_t column_stride(std::size_t count) {
    const std::size_t padded = (count + widest_batch + widest_batch - 1) / widest_batch * widest_batch;
    constexpr std::size_t page = 4096 / sizeof(float);
    return padded % page == 0 ? padded + widest_batch : padded;
}

/// Bytes of all columns; where no std::size_t holds these, more than any machine has, which `new` refuses.
std::size_t bytes_of(std::size_t columns, std::size_t count, std::size_t stride) {
    constexpr std::size_t most = std::numeric_limits<std::ptrdiff_t>::max() - column_alignment + 1;
    const bool fits = stride > count && stride <= most / sizeof(float) / columns;
    return fits ? columns * stride * sizeof(float) : most;
}

}  // namespace

Columns::Columns(std::size_t columns, std::size_t count)
    : columns_(columns), count_(count), stride_(column_stride(count)) {
    if (columns == 0) return;
    void* block = ::operator new (bytes_of(columns, count, stride_), std::align_val_t{column_alignment});
    memory_ = static_cast<float*>(block);
    std::fill_n(memory_, columns_ * stride_, 0.0f);
}

Columns::Columns(Columns&& other) noexcept
    : memory_(std::exchange(other.memory_, nullptr)),
      columns_(other.columns_),
      count_(other.count_),
      stride_(other.stride_) {}

Columns& Columns::operator=(Columns&& other) noexcept {
    std::swap(memory_, other.memory_);
    columns_ = other.columns_;
    count_ = other.count_;
    stride_ = other.stride_;
    return *this;
}

Columns::~Columns() {
    ::operator delete (memory_, std::align_val_t{column_alignment});
}

}  // namespace goffer
