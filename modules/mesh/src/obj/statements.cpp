// SPDX-License-Identifier: MIT
#include "obj.hpp"

#include <goffer/io/text.hpp>

#include <algorithm>

namespace goffer::mesh {

bool next_statement(std::string_view& rest, Statement& out) {
    if (rest.empty()) return false;
    const char* const begin = rest.data();
    std::string_view line = next_line(rest);
    const bool comment = io::trimmed(line).starts_with('#');
    while (!comment && line.ends_with('\\') && !rest.empty()) {
        const std::string_view more = next_line(rest);
        line = {begin, static_cast<std::size_t>(more.data() + more.size() - begin)};
    }
    out.end = line.substr(line.size());
    out.windows = rest.data() - out.end.data() == 2;
    out.arguments = line;
    out.keyword = comment ? std::string_view() : next_token(out.arguments);
    return true;
}

std::string_view next_argument(std::string_view& rest) {
    const std::string_view token = next_token(rest);
    if (!token.starts_with('#')) return token;
    rest = {};
    return {};
}

void Counts::add(const Statement& statement) {
    v += statement.keyword == "v";
    vt += statement.keyword == "vt";
    vn += statement.keyword == "vn";
}

std::vector<std::string_view> library_names(const std::filesystem::path& obj, std::string_view arguments) {
    arguments = io::trimmed(arguments);
    std::error_code error;
    if (std::filesystem::is_regular_file(obj.parent_path() / arguments, error)) return {arguments};
    std::vector<std::string_view> names;
    for (std::string_view name = next_token(arguments); !name.empty(); name = next_token(arguments))
        names.push_back(name);
    return names;
}

std::array<std::string_view, 3> corner_parts(std::string_view argument) {
    std::array<std::string_view, 3> parts;
    for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t end = i < 2 ? std::min(argument.find('/'), argument.size()) : argument.size();
        parts[i] = argument.substr(0, end);
        argument.remove_prefix(std::min(end + 1, argument.size()));
    }
    return parts;
}

}  // namespace goffer::mesh
