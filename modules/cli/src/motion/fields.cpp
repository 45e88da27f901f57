// SPDX-License-Identifier: MIT
#include "motion/fields.hpp"

#include "arguments.hpp"
#include "report.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace goffer::cli {
namespace {

using nlohmann::json;

std::string listed(const std::vector<std::string>& words) {
    std::string text;
    for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
    return text;
}

}  // namespace

Fields::Fields(const json& object, std::string where) : object_(object), where_(std::move(where)) {
    if (!object.is_object()) throw InputError(where_ + ": is not a JSON object; give one in braces");
}

const json* Fields::find(std::string_view name) {
    if (std::ranges::count(asked_, name) == 0) asked_.emplace_back(name);
    const auto field = object_.find(name);
    return field == object_.end() ? nullptr : &*field;
}

const json& Fields::get(std::string_view name) {
    const json* const field = find(name);
    if (!field) throw InputError(where_ + ": has no \"" + std::string(name) + "\"; give it one");
    return *field;
}

double Fields::number(std::string_view name, double low, double high, double otherwise) {
    const json* const field = find(name);
    return field ? read_number(*field, low, high, place(name)) : otherwise;
}

bool Fields::flag(std::string_view name) {
    const json* const field = find(name);
    if (field && !field->is_boolean()) throw InputError(place(name) + ": is neither true nor false");
    return field && field->get<bool>();
}

std::string Fields::word(std::string_view name, const std::vector<std::string>& words) {
    const json* const field = find(name);
    if (!field) return words.front();
    if (!field->is_string() || std::ranges::count(words, field->get<std::string>()) == 0)
        throw InputError(place(name) + ": is not known; give one of " + listed(words));
    return field->get<std::string>();
}

void Fields::finish() const {
    for (const auto& [name, value] : object_.items()) {
        if (std::ranges::count(asked_, name) == 0)
            throw InputError(where_ + ": \"" + name + "\" is not a field here; there are " + listed(asked_));
    }
}

std::string Fields::place(std::string_view name) const {
    return where_ + ": " + std::string(name);
}

double read_number(const json& value, double low, double high, const std::string& place) {
    const double number = value.is_number() ? value.get<double>() : std::nan("");
    if (low <= number && number <= high) return number;
    throw InputError(place + ": is not a number within " + cli::number(low) + ".." + cli::number(high));
}

double read_angle(const json& value, const std::string& place) {
    constexpr double largest = std::numeric_limits<double>::infinity();
    if (value == "max") return largest;
    if (value == "-max") return -largest;
    const double angle = value.is_number() ? value.get<double>() : std::nan("");
    if (std::fabs(angle) <= most_degrees) return angle;
    throw InputError(place + ": is not an angle in degrees, within " + cli::number(most_degrees) +
                     ", or \"max\"");
}

}  // namespace goffer::cli
