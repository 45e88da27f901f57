// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace goffer::bend {

/// XXH64 with seed 0, as its specification has it (xxHash, doc/xxhash_spec.md), of bytes that come piece by
/// piece: what goffer's files are checked by. Finds accidents, not forgeries. A plain value.
class Checksum {
public:
    /// Appends `bytes`. All pieces but the last one are of a multiple of 32 bytes.
    void add(std::span<const std::byte> bytes) noexcept;

    /// Returns the checksum of all that was added.
    [[nodiscard]] std::uint64_t value() const noexcept;

    /// The first two of the specification's five primes.
    static constexpr std::uint64_t prime1 = 0x9e3779b185ebca87, prime2 = 0xc2b2ae3d27d4eb4f;

private:
    std::array<std::uint64_t, 4> lanes_{prime1 + prime2, prime2, 0, 0 - prime1};
    std::array<std::byte, 32> rest_{};
    std::size_t rest_count_ = 0;
    std::uint64_t total_ = 0;
};

}  // namespace goffer::bend
