// SPDX-License-Identifier: MIT
#include "json_mutator.hpp"

/// Mutates either the words of fit.cpp's input, its first line, or the JSON behind them.

using namespace goffer::test;

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t max_size,
                                               unsigned int seed) {
    Random random(seed);
    const std::string bytes(reinterpret_cast<const char*>(data), size);
    const std::size_t line = bytes.find('\n');
    std::string mutated;
    if (line != bytes.npos && random() % 8 != 0) {
        const std::string words = bytes.substr(0, line), json = bytes.substr(line + 1);
        if (random() % 3 == 0) {
            mutated = mutated_bytes(words, words.size() + 32) + '\n' + json;
        } else if (const std::string other = mutated_json(json, random); !other.empty()) {
            mutated = words + '\n' + other;
        }
    }
    return put_back(mutated, data, size, max_size);
}
