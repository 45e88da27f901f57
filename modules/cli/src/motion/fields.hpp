// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json.hpp>

#include <string>
#include <string_view>
#include <vector>

/// Fields of a JSON document, asked for by name. Throws InputError in one line that says where it is wrong.

namespace goffer::cli {

/// An object of a document. It must outlive this.
class Fields {
public:
    /// `where` begins errors: the file, and the way to this object. Throws unless `object` is one.
    Fields(const nlohmann::json& object, std::string where);

    /// The field, or null where there is none. What is never asked for is refused by finish().
    [[nodiscard]] const nlohmann::json* find(std::string_view name);
    [[nodiscard]] const nlohmann::json& get(std::string_view name);  ///< throws where there is none

    /// A number within `low`..`high`; `otherwise` where there is none.
    [[nodiscard]] double number(std::string_view name, double low, double high, double otherwise);
    [[nodiscard]] bool flag(std::string_view name);  ///< false where there is none
    /// One of `words`, the first of them where there is none.
    [[nodiscard]] std::string word(std::string_view name, const std::vector<std::string>& words);

    /// Refuses fields that nobody has asked for.
    void finish() const;

    [[nodiscard]] std::string place(std::string_view name) const;  ///< "where: name"

private:
    const nlohmann::json& object_;
    std::string where_;
    std::vector<std::string> asked_;
};

/// A finite number within `low`..`high`. `place` begins the error.
[[nodiscard]] double read_number(const nlohmann::json& value, double low, double high,
                                 const std::string& place);

/// An angle in degrees, an infinity for "max" and "-max".
[[nodiscard]] double read_angle(const nlohmann::json& value, const std::string& place);

/// What a document may hold of each.
inline constexpr double most_degrees = 1e6, most_seconds = 1e6, least_seconds = 1e-3;

}  // namespace goffer::cli
