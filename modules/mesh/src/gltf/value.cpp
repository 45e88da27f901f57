// SPDX-License-Identifier: MIT
#include "gltf.hpp"
#include "text.hpp"

#include <cmath>

namespace goffer::mesh::gltf {

namespace {

/// 2^53: beyond it doubles, and so JSON, skip whole numbers.
constexpr double largest_whole = 9007199254740992.0;

}  // namespace

void Value::fail(const std::string& what) const {
    throw Error((path_.empty() ? "the document" : path_) + ": " + what);
}

void Value::fail_type(const char* expected) const {
    fail(std::string("is a JSON ") + json_->type_name() + ", expected " + expected +
         "; export the file again");
}

bool Value::has(const char* key) const {
    if (!json_->is_object()) fail_type("an object");
    return json_->contains(key);
}

Value Value::operator[](const char* key) const {
    if (!has(key)) fail(std::string("has no \"") + key + "\", which glTF requires; export the file again");
    return Value((*json_)[key], path_.empty() ? key : path_ + "." + key);
}

std::size_t Value::size() const {
    if (!json_->is_array()) fail_type("an array");
    return json_->size();
}

Value Value::operator[](std::size_t element) const {
    if (element >= size()) {
        fail("has " + std::to_string(size()) + " elements, but number " + std::to_string(element) +
             " (counted from 0) is needed; export the file again");
    }
    return Value((*json_)[element], path_ + "[" + std::to_string(element) + "]");
}

double Value::number() const {
    if (!json_->is_number()) fail_type("a number");
    return json_->get<double>();
}

std::uint64_t Value::whole() const {
    const double value = number();
    if (value > largest_whole)
        fail("is " + json_->dump() + ", more than any file has; export the file again");
    if (!(value >= 0.0) || value != std::floor(value)) {
        fail("is " + json_->dump() + ", expected a whole number of 0 or more; export the file again");
    }
    return static_cast<std::uint64_t>(value);
}

const std::string& Value::text() const {
    if (!json_->is_string()) fail_type("a string");
    return json_->get_ref<const std::string&>();
}

std::vector<double> Value::numbers(std::size_t count) const {
    if (size() != count) {
        fail("has " + std::to_string(size()) + " elements, expected " + std::to_string(count) +
             " numbers; export the file again");
    }
    std::vector<double> values(count);
    for (std::size_t i = 0; i < count; ++i) values[i] = (*this)[i].number();
    return values;
}

std::uint64_t Value::whole_or(const char* key, std::uint64_t otherwise) const {
    return has(key) ? (*this)[key].whole() : otherwise;
}

std::string Value::text_or(const char* key, const char* otherwise) const {
    return has(key) ? (*this)[key].text() : otherwise;
}

bool Value::flag(const char* key) const {
    if (!has(key)) return false;
    const Value value = (*this)[key];
    if (!value.json_->is_boolean()) value.fail_type("true or false");
    return value.json_->get<bool>();
}

std::size_t Document::count(const char* list) const {
    return root().has(list) ? root()[list].size() : 0;
}

std::size_t Document::number(const char* list, const Value& index) const {
    const std::uint64_t number = index.whole();
    if (number >= count(list)) {
        index.fail("names " + std::string(list) + "[" + std::to_string(number) + "], but there are " +
                   std::to_string(count(list)) + "; export the file again");
    }
    return number;
}

Value Document::entry(const char* list, const Value& index) const {
    const std::size_t element = number(list, index);
    return Value(json[list][element], index.path() + " -> " + list + "[" + std::to_string(element) + "]");
}

}  // namespace goffer::mesh::gltf
