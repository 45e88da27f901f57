// SPDX-License-Identifier: MIT
#include "json_mutator.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

namespace goffer::test {
namespace {

/// Numbers at the edges of types and of what is allowed, and values of other types.
constexpr const char* edges[] = {"0",
                                 "1",
                                 "2",
                                 "3",
                                 "4",
                                 "-1",
                                 "5",
                                 "16",
                                 "255",
                                 "65535",
                                 "65536",
                                 "1048576",
                                 "5120",
                                 "5121",
                                 "5123",
                                 "5125",
                                 "5126",
                                 "0.5",
                                 "-0.0",
                                 "1e-9",
                                 "1e-300",
                                 "1e12",
                                 "1e13",
                                 "3.4e38",
                                 "8e38",
                                 "1e308",
                                 "-1e308",
                                 "2147483647",
                                 "2147483648",
                                 "4294967295",
                                 "4294967296",
                                 "9007199254740992",
                                 "9223372036854775807",
                                 "9223372036854775808",
                                 "18446744073709551615",
                                 "null",
                                 "true",
                                 "\"\"",
                                 "\"VEC3\"",
                                 "\"SCALAR\"",
                                 "\"MAT4\"",
                                 "[]",
                                 "{}",
                                 "[0]",
                                 "[0, 0, 0]",
                                 "[1, 0, 0, 0]"};

std::size_t below(std::size_t count, Random& random) {
    return random() % count;
}

/// A value somewhere in the tree.
Json& any_value(Json& json, Random& random) {
    Json* at = &json;
    while (at->is_structured() && !at->empty() && below(10, random) != 0)
        at = &*std::next(at->begin(), static_cast<std::ptrdiff_t>(below(at->size(), random)));
    return *at;
}

void nudge(Json& value, Random& random) {
    constexpr double factors[] = {-1, 0.5, 2, 1e3, 1e-3, 1e30};
    if (value.is_number_integer()) {
        value = value.get<std::int64_t>() / 2 + static_cast<std::int64_t>(below(9, random)) - 4;
    } else if (value.is_number()) {
        value = value.get<double>() * factors[below(std::size(factors), random)];
    } else {
        value = Json::parse(edges[below(std::size(edges), random)]);
    }
}

void remove_one(Json& value, Random& random) {
    if (!value.is_structured() || value.empty()) return;
    value.erase(std::next(value.begin(), static_cast<std::ptrdiff_t>(below(value.size(), random))));
}

/// Puts a copy of a value that the tree has under another one: at the end of an array, or by another key.
void add_one(Json& value, const Json& copy, Random& random) {
    if (value.is_array()) {
        value.push_back(copy);
    } else if (value.is_object() && copy.is_object() && !copy.empty()) {
        const auto from = std::next(copy.begin(), static_cast<std::ptrdiff_t>(below(copy.size(), random)));
        value[from.key()] = from.value();
    } else {
        value = copy;
    }
}

void mutate(Json& json, Random& random) {
    Json& value = any_value(json, random);
    switch (below(8, random)) {
        case 0:
            return remove_one(value, random);
        case 1: {
            const Json copy = any_value(json, random);
            value = copy;
            return;
        }
        case 2:
        case 3: {
            const Json copy = any_value(json, random);
            return add_one(value, copy, random);
        }
        case 4:
            return nudge(value, random);
        default:
            value = Json::parse(edges[below(std::size(edges), random)]);
    }
}

}  // namespace

std::string mutated_json(const std::string& text, Random& random) {
    Json json = Json::parse(text, nullptr, false);
    if (json.is_discarded()) return {};
    for (std::size_t n = 1 + below(3, random); n > 0; --n) mutate(json, random);
    return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::string mutated_bytes(std::string bytes, std::size_t max_size) {
    const std::size_t size = std::min(bytes.size(), max_size);
    bytes.resize(max_size);
    bytes.resize(LLVMFuzzerMutate(reinterpret_cast<std::uint8_t*>(bytes.data()), size, max_size));
    return bytes;
}

std::size_t put_back(const std::string& bytes, std::uint8_t* data, std::size_t size, std::size_t max_size) {
    if (bytes.empty() || bytes.size() > max_size) return LLVMFuzzerMutate(data, size, max_size);
    std::ranges::copy(bytes, data);
    return bytes.size();
}

}  // namespace goffer::test
