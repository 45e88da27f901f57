// SPDX-License-Identifier: MIT
#include <goffer/bend/checksum.hpp>

#include <bit>
#include <cassert>
#include <cstring>

namespace goffer::bend {
namespace {

constexpr std::uint64_t prime1 = Checksum::prime1, prime2 = Checksum::prime2, prime3 = 0x165667b19e3779f9,
                        prime4 = 0x85ebca77c2b2ae63, prime5 = 0x27d4eb2f165667c5;

std::uint64_t round(std::uint64_t lane, std::uint64_t word) noexcept {
    return std::rotl(lane + word * prime2, 31) * prime1;
}

/// The file is of this machine's byte order, and so is its checksum.
template <class Word>
Word word_at(const std::byte* bytes) noexcept {
    Word word;
    std::memcpy(&word, bytes, sizeof word);
    return word;
}

}  // namespace

void Checksum::add(std::span<const std::byte> bytes) noexcept {
    assert(rest_count_ == 0);
    total_ += bytes.size();
    std::array<std::uint64_t, 4> lanes = lanes_;
    for (; bytes.size() >= 32; bytes = bytes.subspan(32)) {
        for (std::size_t i = 0; i < 4; ++i)
            lanes[i] = round(lanes[i], word_at<std::uint64_t>(bytes.data() + 8 * i));
    }
    lanes_ = lanes;
    rest_count_ = bytes.size();
    if (rest_count_ > 0) std::memcpy(rest_.data(), bytes.data(), rest_count_);
}

std::uint64_t Checksum::value() const noexcept {
    std::uint64_t hash = prime5;
    if (total_ >= 32) {
        hash = std::rotl(lanes_[0], 1) + std::rotl(lanes_[1], 7) + std::rotl(lanes_[2], 12) +
               std::rotl(lanes_[3], 18);
        for (const std::uint64_t lane : lanes_) hash = (hash ^ round(0, lane)) * prime1 + prime4;
    }
    hash += total_;
    std::size_t at = 0;
    for (; at + 8 <= rest_count_; at += 8) {
        hash ^= round(0, word_at<std::uint64_t>(rest_.data() + at));
        hash = std::rotl(hash, 27) * prime1 + prime4;
    }
    for (; at + 4 <= rest_count_; at += 4) {
        hash ^= word_at<std::uint32_t>(rest_.data() + at) * prime1;
        hash = std::rotl(hash, 23) * prime2 + prime3;
    }
    for (; at < rest_count_; ++at) {
        hash ^= std::to_integer<std::uint64_t>(rest_[at]) * prime5;
        hash = std::rotl(hash, 11) * prime1;
    }
    hash = (hash ^ (hash >> 33)) * prime2;
    hash = (hash ^ (hash >> 29)) * prime3;
    return hash ^ (hash >> 32);
}

}  // namespace goffer::bend
