// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json.hpp>

#include <cstddef>
#include <cstdint>
#include <random>
#include <string>

/// Mutations of JSON that stay JSON, for libFuzzer, which by itself hardly finds another document that
/// parses.

/// libFuzzer's own mutation, in place. Returns the new size.
extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t max_size);

namespace goffer::test {

using Json = nlohmann::ordered_json;
using Random = std::mt19937;

/// `text` with some of its values replaced, copied elsewhere, or removed. Empty if it is no JSON.
[[nodiscard]] std::string mutated_json(const std::string& text, Random& random);

/// `bytes` as libFuzzer mutates them, at most `max_size` of them.
[[nodiscard]] std::string mutated_bytes(std::string bytes, std::size_t max_size);

/// Puts `bytes` in place of what a custom mutator was given. Where they are none or too many, what it was
/// given is mutated as libFuzzer does. Returns the new size.
[[nodiscard]] std::size_t put_back(const std::string& bytes, std::uint8_t* data, std::size_t size,
                                   std::size_t max_size);

}  // namespace goffer::test
