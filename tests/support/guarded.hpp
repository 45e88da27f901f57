// SPDX-License-Identifier: MIT
#pragma once

#include <doctest/doctest.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cstddef>
#include <span>
#include <utility>

/// Memory that ends, or begins, at a page that may be neither read nor written, by POSIX.

namespace goffer::test {

enum class Edge { begin, end };

/// Memory for `count` values between two such pages, at its beginning or at its end.
template <class T>
class Guarded {
public:
    Guarded(std::size_t count, Edge edge) : count_(count) {
        const auto page = static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
        const std::size_t bytes = count * sizeof(T), inside = (bytes + page - 1) / page * page;
        whole_ = inside + 2 * page;
        memory_ =
            static_cast<std::byte*>(mmap(nullptr, whole_, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0));
        REQUIRE(memory_ != MAP_FAILED);
        REQUIRE((inside == 0 || mprotect(memory_ + page, inside, PROT_READ | PROT_WRITE) == 0));
        first_ = reinterpret_cast<T*>(memory_ + page + (edge == Edge::end ? inside - bytes : 0));
    }
    Guarded(Guarded&& other) noexcept
        : memory_(std::exchange(other.memory_, nullptr)),
          whole_(other.whole_),
          first_(other.first_),
          count_(other.count_) {}
    Guarded& operator=(const Guarded&) = delete;
    ~Guarded() {
        if (memory_ != nullptr) munmap(memory_, whole_);
    }

    [[nodiscard]] T* data() const { return first_; }
    [[nodiscard]] std::span<T> values() const { return {first_, count_}; }

private:
    std::byte* memory_;
    std::size_t whole_ = 0;
    T* first_;
    std::size_t count_;
};

}  // namespace goffer::test
