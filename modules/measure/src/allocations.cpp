// SPDX-License-Identifier: MIT
#include <goffer/measure/allocations.hpp>

#include <atomic>
#include <cerrno>
#include <cstddef>
#include <cstdlib>

#if defined(__GLIBC__) && !defined(GOFFER_SANITIZED)

namespace {

constinit std::atomic<std::uint64_t> calls = 0;

void count() noexcept {
    calls.fetch_add(1, std::memory_order_relaxed);
}

}  // namespace

// NOLINTBEGIN(bugprone-reserved-identifier): glibc's own names for what it does behind malloc and the others
extern "C" {

void* __libc_malloc(std::size_t size) noexcept;
void* __libc_calloc(std::size_t number, std::size_t size) noexcept;
void* __libc_realloc(void* memory, std::size_t size) noexcept;
void* __libc_memalign(std::size_t alignment, std::size_t size) noexcept;
void* __libc_valloc(std::size_t size) noexcept;
void* __libc_pvalloc(std::size_t size) noexcept;
void __libc_free(void* memory) noexcept;

void* malloc(std::size_t size) noexcept {
    count();
    return __libc_malloc(size);
}

void* calloc(std::size_t number, std::size_t size) noexcept {
    count();
    return __libc_calloc(number, size);
}

void* realloc(void* memory, std::size_t size) noexcept {
    count();
    return __libc_realloc(memory, size);
}

void* memalign(std::size_t alignment, std::size_t size) noexcept {
    count();
    return __libc_memalign(alignment, size);
}

void* aligned_alloc(std::size_t alignment, std::size_t size) noexcept {
    count();
    return __libc_memalign(alignment, size);
}

int posix_memalign(void** memory, std::size_t alignment, std::size_t size) noexcept {
    count();
    const bool power_of_two = alignment != 0 && (alignment & (alignment - 1)) == 0;
    if (!power_of_two || alignment % sizeof(void*) != 0) return EINVAL;
    void* const block = __libc_memalign(alignment, size);
    if (block == nullptr) return ENOMEM;
    *memory = block;
    return 0;
}

void* valloc(std::size_t size) noexcept {
    count();
    return __libc_valloc(size);
}

void* pvalloc(std::size_t size) noexcept {
    count();
    return __libc_pvalloc(size);
}

// Not counted, but of the same family: tools that replace malloc expect all of it in one place.
void free(void* memory) noexcept {
    __libc_free(memory);
}

}  // extern "C"
// NOLINTEND(bugprone-reserved-identifier)

namespace goffer::measure {

std::optional<std::uint64_t> allocations() noexcept {
    const std::uint64_t so_far = calls.load(std::memory_order_relaxed);
    if (so_far == 0) return std::nullopt;  // every start-up allocates: a tool has put its own functions there
    return so_far;
}

}  // namespace goffer::measure

#else

namespace goffer::measure {

std::optional<std::uint64_t> allocations() noexcept {
    return std::nullopt;
}

}  // namespace goffer::measure

#endif
