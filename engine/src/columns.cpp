// SPDX-License-Identifier: MIT
#include <goffer/engine/columns.hpp>

#include <algorithm>
#include <new>

namespace goffer {
namespace {

// Leaves room for a whole batch behind the last value. Never a multiple of a page: a vertex's values in
// different columns would compete for the same lines of the first-level cache.
std::size_t column_stride(std::size_t count) {
    const std::size_t padded = (count + widest_batch + widest_batch - 1) / widest_batch * widest_batch;
    constexpr std::size_t page = 4096 / sizeof(float);
    return padded % page == 0 ? padded + widest_batch : padded;
}

}  // namespace

Columns::Columns(std::size_t columns, std::size_t count)
    : columns_(columns), count_(count), stride_(column_stride(count)) {
    const std::size_t floats = std::max<std::size_t>(columns_ * stride_, 1);
    void* block = ::operator new (floats * sizeof(float), std::align_val_t{column_alignment});
    memory_.reset(static_cast<float*>(block));
    std::fill_n(memory_.get(), floats, 0.0f);
}

void Columns::Free::operator()(float* memory) const noexcept {
    ::operator delete (memory, std::align_val_t{column_alignment});
}

}  // namespace goffer
