// SPDX-License-Identifier: MIT
#include "starve.hpp"

#include <atomic>
#include <cstdlib>

namespace {

constinit std::atomic<std::uint64_t> allocations = 0;
constinit std::atomic<std::uint64_t> failing = goffer::test::Starved::never;
constinit std::atomic<std::size_t> least_size = 0;

void count(std::size_t size) {
    if (size >= least_size.load() && allocations.fetch_add(1) == failing.load()) throw std::bad_alloc();
}

void* checked(void* memory) {
    if (memory == nullptr) throw std::bad_alloc();
    return memory;
}

std::size_t alignment_of(std::align_val_t alignment) {
    return static_cast<std::size_t>(alignment);
}

}  // namespace

// The forms for arrays call these; or are a sanitizer's, and not counted.
void* operator new(std::size_t size) {
    count(size);
    return checked(std::malloc(size == 0 ? 1 : size));
}

void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
    try {
        return operator new(size);
    } catch (...) {
        return nullptr;
    }
}

void* operator new(std::size_t size, std::align_val_t alignment) {
    count(size);
    const std::size_t whole =
        (size + alignment_of(alignment) - 1) / alignment_of(alignment) * alignment_of(alignment);
    return checked(std::aligned_alloc(alignment_of(alignment), std::max(whole, alignment_of(alignment))));
}

void operator delete(void* memory) noexcept {
    std::free(memory);
}

void operator delete(void* memory, std::size_t) noexcept {
    std::free(memory);
}

void operator delete(void* memory, std::align_val_t) noexcept {
    std::free(memory);
}

void operator delete(void* memory, std::size_t, std::align_val_t) noexcept {
    std::free(memory);
}

namespace goffer::test {

Starved::Starved(std::size_t least, std::uint64_t failing_call) {
    allocations = 0;
    least_size = least;
    failing = failing_call;
}

Starved::~Starved() {
    failing = never;
}

std::uint64_t Starved::calls() const {
    return allocations;
}

}  // namespace goffer::test
