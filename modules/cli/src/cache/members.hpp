// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json.hpp>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

/// JSON from anybody, read strictly: what is missing, of another kind or not known is an InputError of one
/// line that says where.

namespace goffer::cli {

/// The largest number of a place or a matrix: a job takes no transform with larger ones.
constexpr double most_far = 1e18;

/// Reads a document of at most `most` bytes, as parse_json() does. Throws an error that names the file.
[[nodiscard]] nlohmann::json read_document(const std::filesystem::path& file, std::uint64_t most);

/// The members of an object. It must outlive this.
class Members {
public:
    /// `where` begins errors, as in "scene.json: instances[3]". Throws where `object` is none.
    Members(const nlohmann::json& object, std::string where);

    /// Throws where there is a member that is none of `names`.
    void allow(std::initializer_list<std::string_view> names) const;

    [[nodiscard]] bool has(const char* name) const { return object_->contains(name); }
    /// A member. Throws where it is missing.
    [[nodiscard]] const nlohmann::json& at(const char* name) const;
    /// "scene.json: instances[3]"
    [[nodiscard]] const std::string& place() const { return where_; }
    /// "scene.json: instances[3].NAME"
    [[nodiscard]] std::string where(const std::string& name) const { return where_ + "." + name; }

    /// A finite number within low..high. Throws where it is missing or is none.
    [[nodiscard]] double number(const char* name, double low, double high) const;
    /// The same, or `usual` where it is missing.
    [[nodiscard]] double number(const char* name, double low, double high, double usual) const;
    /// A whole number within low..high.
    [[nodiscard]] std::uint64_t whole(const char* name, std::uint64_t low, std::uint64_t high) const;
    /// A text of 1 to 4096 bytes.
    [[nodiscard]] std::string text(const char* name) const;
    /// A text, or a list of such that is not empty.
    [[nodiscard]] std::vector<std::string> texts(const char* name) const;
    /// A list of `count` finite numbers within -most_far..most_far.
    [[nodiscard]] std::vector<double> numbers(const char* name, std::size_t count) const;
    /// A number of 64 bits as text of 16 hexadecimal digits (see hex()).
    [[nodiscard]] std::uint64_t hash(const char* name) const;

    /// Throws the error that says so of a member.
    [[noreturn]] void refuse(const std::string& name, const std::string& what) const;

private:
    const nlohmann::json* object_;
    std::string where_;
};

/// The finite numbers of a list, of which there are `count`; nothing where it is no such list.
[[nodiscard]] std::optional<std::vector<double>> list_of(const nlohmann::json& list, std::size_t count);

}  // namespace goffer::cli
