// SPDX-License-Identifier: MIT
#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <iterator>
#include <random>

/// Some numbers of a body file become others; now and then its bytes are changed as libFuzzer likes.
extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t max_size);

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t max_size,
                                               unsigned seed) {
    std::minstd_rand random(seed);
    if (size < 64 || random() % 8 == 0) return LLVMFuzzerMutate(data, size, max_size);
    for (std::size_t n = 1 + random() % 4; n-- > 0;) {
        // Half of them in what comes first, where small numbers mean much.
        const std::size_t within = random() % 2 == 0 ? std::min<std::size_t>(size, 1500) : size;
        std::uint8_t* const word = data + random() % (within / 4) * 4;
        std::uint32_t bits = 0;
        std::memcpy(&bits, word, sizeof bits);
        const float value = std::bit_cast<float>(bits);
        constexpr float edges[] = {0, 1, -1, 1e-40f, 1e30f, -1e30f, 0.5f, 1e12f, 3e38f};
        switch (random() % 7) {
            case 0:
                bits ^= 1u << random() % 32;
                break;
            case 1:
                bits += static_cast<std::uint32_t>(random() % 65) - 32;
                break;
            case 2:
                bits = std::bit_cast<std::uint32_t>(-value);
                break;
            case 3:
                bits = std::bit_cast<std::uint32_t>(value * 1.00001f);
                break;
            case 4:
                bits = std::bit_cast<std::uint32_t>(edges[random() % std::size(edges)]);
                break;
            case 5:
                std::memcpy(&bits, data + random() % (size / 4) * 4, sizeof bits);
                break;
            default:
                bits = static_cast<std::uint32_t>(random() * 2654435761u);
                break;
        }
        std::memcpy(word, &bits, sizeof bits);
    }
    return size;
}
