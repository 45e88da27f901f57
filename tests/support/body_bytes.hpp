// SPDX-License-Identifier: MIT
#pragma once

#include <goffer/bend/checksum.hpp>
#include <goffer/engine/columns.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>

/// Body files as bytes, for tests that change them.

namespace goffer::test {

/// Bytes at a multiple of 64 bytes, as a mapped file has them.
class AlignedBytes {
public:
    explicit AlignedBytes(std::span<const std::byte> bytes)
        : memory_(1, (bytes.size() + sizeof(float) - 1) / sizeof(float)),
          bytes_(std::as_writable_bytes(memory_[0]).first(bytes.size())) {
        std::ranges::copy(bytes, bytes_.begin());
    }
    [[nodiscard]] std::span<std::byte> bytes() const { return bytes_; }

private:
    Columns memory_;
    std::span<std::byte> bytes_;
};

/// Makes size and checksum of a file fit again, as somebody would who changes it on purpose.
inline void sign(std::span<std::byte> bytes) {
    if (bytes.size() < 64) return;
    const std::uint64_t size = bytes.size();
    std::memcpy(&bytes[16], &size, sizeof size);
    std::memset(&bytes[24], 0, 8);
    bend::Checksum checksum;
    checksum.add(bytes);
    const std::uint64_t value = checksum.value();
    std::memcpy(&bytes[24], &value, sizeof value);
}

}  // namespace goffer::test
