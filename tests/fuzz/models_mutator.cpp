// SPDX-License-Identifier: MIT
#include "json_mutator.hpp"

#include <cstring>

/// Mutates the JSON of a glTF or a GLB most of the time, and the chunks of a GLB so that their lengths remain
/// right most of the time.

using namespace goffer::test;

namespace {

constexpr std::size_t header = 20;  // up to the JSON of a GLB

std::uint32_t u32(const std::string& bytes, std::size_t at) {
    std::uint32_t value = 0;
    std::memcpy(&value, bytes.data() + at, sizeof value);
    return value;
}

/// A length, or now and then what is none.
std::string written(std::size_t length, Random& random) {
    constexpr std::uint32_t wrong[] = {0, 1, 12, 0x7fffffff, 0x80000000, 0xffffffff};
    auto value = static_cast<std::uint32_t>(length);
    if (random() % 40 == 0) value = wrong[random() % std::size(wrong)];
    if (random() % 40 == 0) value += static_cast<std::uint32_t>(random() % 9) - 4;
    std::string bytes(sizeof value, '\0');
    std::memcpy(bytes.data(), &value, sizeof value);
    return bytes;
}

std::string padded(std::string bytes, char with) {
    bytes.resize((bytes.size() + 3) / 4 * 4, with);
    return bytes;
}

/// A GLB of this JSON and this buffer.
std::string glb(const std::string& json, const std::string& buffer, Random& random) {
    const std::string text = padded(json, ' '), binary = padded(buffer, '\0');
    std::string chunks = written(text.size(), random) + "JSON" + text;
    if (!binary.empty()) chunks += written(binary.size(), random) + std::string("BIN\0", 4) + binary;
    return "glTF" + std::string("\2\0\0\0", 4) + written(12 + chunks.size(), random) + chunks;
}

/// Empty where the bytes are no GLB whose JSON parses.
std::string mutated_glb(const std::string& bytes, std::size_t max_size, Random& random) {
    if (bytes.size() < header || u32(bytes, 12) > bytes.size() - header) return {};
    const std::size_t text_size = u32(bytes, 12), behind = header + text_size + 8;
    std::string json = bytes.substr(header, text_size);
    std::string buffer = behind < bytes.size() ? bytes.substr(behind) : std::string();
    if (random() % 4 == 0) {
        buffer = mutated_bytes(buffer, std::max<std::size_t>(buffer.size() + 64, 1));
        if (!Json::accept(json)) return {};
    } else {
        json = mutated_json(json, random);
    }
    return json.empty() || json.size() > max_size ? std::string() : glb(json, buffer, random);
}

}  // namespace

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t max_size,
                                               unsigned int seed) {
    Random random(seed);
    const std::string bytes(reinterpret_cast<const char*>(data), size);
    std::string mutated;
    if (random() % 5 != 0 && bytes.starts_with("glTF")) mutated = mutated_glb(bytes, max_size, random);
    if (random() % 5 != 0 && bytes.starts_with('{')) mutated = mutated_json(bytes, random);
    return put_back(mutated, data, size, max_size);
}
