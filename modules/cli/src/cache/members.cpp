// SPDX-License-Identifier: MIT
#include "cache/members.hpp"

#include "arguments.hpp"
#include "json.hpp"

#include <goffer/io/error.hpp>
#include <goffer/io/read_file.hpp>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>

namespace goffer::cli {
namespace {

std::string text_of(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%g", value);
    return text;
}

}  // namespace

nlohmann::json read_document(const std::filesystem::path& file, std::uint64_t most) {
    if (io::size_of_file(file) > most)
        throw InputError(io::about(
            file, "has more than " + io::size_text(most) + ", which is more than such a document needs"));
    return parse_json(file, io::read_file(file));
}

Members::Members(const nlohmann::json& object, std::string where)
    : object_(&object), where_(std::move(where)) {
    if (!object.is_object())
        throw InputError(where_ + ": is " + object.type_name() + ", and should be an object {..}");
}

void Members::allow(std::initializer_list<std::string_view> names) const {
    for (const auto& [name, value] : object_->items()) {
        if (std::ranges::find(names, std::string_view(name)) != names.end()) continue;
        std::string known;
        for (const std::string_view other : names) known.append(known.empty() ? "" : ", ").append(other);
        throw InputError(where_ + ": has no field '" + io::escaped(name) + "'; there are " + known);
    }
}

void Members::refuse(const std::string& name, const std::string& what) const {
    throw InputError(where(name) + ": " + what);
}

const nlohmann::json& Members::at(const char* name) const {
    const auto found = object_->find(name);
    if (found == object_->end()) throw InputError(where_ + ": lacks '" + name + "'; add it");
    return *found;
}

double Members::number(const char* name, double low, double high) const {
    const nlohmann::json& value = at(name);
    const double number = value.is_number() ? value.get<double>() : std::nan("");
    if (!(number >= low && number <= high))
        refuse(name, "is not a number within " + text_of(low) + ".." + text_of(high));
    return number;
}

double Members::number(const char* name, double low, double high, double usual) const {
    return has(name) ? number(name, low, high) : usual;
}

std::uint64_t Members::whole(const char* name, std::uint64_t low, std::uint64_t high) const {
    const nlohmann::json& value = at(name);
    std::optional<std::uint64_t> number;
    if (value.is_number_unsigned()) {
        number = value.get<std::uint64_t>();
    } else if (value.is_number_float()) {  // 1e6 is one, too
        constexpr double exact = 9007199254740992.0;
        const auto real = value.get<double>();
        if (real >= 0 && real <= exact && real == std::floor(real)) number = static_cast<std::uint64_t>(real);
    }
    if (!number || *number < low || *number > high)
        refuse(name, "is not a whole number within " + std::to_string(low) + ".." + std::to_string(high));
    return *number;
}

std::string Members::text(const char* name) const {
    constexpr std::size_t longest = 4096;
    const nlohmann::json& value = at(name);
    if (!value.is_string() || value.get_ref<const std::string&>().empty() ||
        value.get_ref<const std::string&>().size() > longest)
        refuse(name, "is not a text of 1 to " + std::to_string(longest) + " bytes");
    return value.get<std::string>();
}

std::vector<std::string> Members::texts(const char* name) const {
    if (!at(name).is_array()) return {text(name)};
    std::vector<std::string> all;
    for (const nlohmann::json& value : at(name)) {
        if (!value.is_string()) refuse(name, "is neither a text nor a list of texts");
        all.push_back(value.get<std::string>());
    }
    if (all.empty()) refuse(name, "is an empty list");
    return all;
}

std::vector<double> Members::numbers(const char* name, std::size_t count) const {
    std::optional<std::vector<double>> list = list_of(at(name), count);
    if (!list)
        refuse(name, "is not a list of " + std::to_string(count) + " numbers within -" + text_of(most_far) +
                         ".." + text_of(most_far));
    return std::move(*list);
}

std::uint64_t Members::hash(const char* name) const {
    const std::string digits = text(name);
    std::uint64_t number = 0;
    const char* end = digits.data() + digits.size();
    const auto [next, error] = std::from_chars(digits.data(), end, number, 16);
    if (digits.size() != 16 || error != std::errc() || next != end)
        refuse(name, "is not 16 hexadecimal digits");
    return number;
}

std::optional<std::vector<double>> list_of(const nlohmann::json& list, std::size_t count) {
    if (!list.is_array() || list.size() != count) return std::nullopt;
    std::vector<double> numbers;
    numbers.reserve(count);
    for (const nlohmann::json& value : list) {
        if (!value.is_number() || !(std::fabs(value.get<double>()) <= most_far)) return std::nullopt;
        numbers.push_back(value.get<double>());
    }
    return numbers;
}

}  // namespace goffer::cli
