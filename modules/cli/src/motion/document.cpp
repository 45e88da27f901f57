// SPDX-License-Identifier: MIT
#include "motion/document.hpp"

#include "arguments.hpp"
#include "json.hpp"

#include <goffer/io/error.hpp>
#include <goffer/io/read_file.hpp>
#include <goffer/io/text.hpp>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

namespace goffer::cli {
namespace {

using nlohmann::json;

constexpr std::uint64_t most_bytes = std::uint64_t{8} << 20;  // read, they have taken 50 times as many

[[noreturn]] void refuse(const std::filesystem::path& file, const std::string& what) {
    throw InputError(io::about(file, what));
}

std::string read_text(const std::filesystem::path& file) {
    if (io::size_of_file(file) > most_bytes)
        refuse(file, "has more than " + io::size_text(most_bytes) + "; give fewer keys or points");
    return std::string(io::without_bom(io::read_file(file)));
}

bool is_json(std::string_view text) {
    const std::size_t first = text.find_first_not_of(" \t\r\n");
    return first != text.npos && (text[first] == '{' || text[first] == '[');
}

/// As spreadsheets write cells.
std::string_view unquoted(std::string_view cell) {
    const bool quoted = cell.size() >= 2 && cell.front() == '"' && cell.back() == '"';
    return quoted ? io::trimmed(cell.substr(1, cell.size() - 2)) : cell;
}

/// A line of a table, as its cells.
struct Row {
    std::size_t line = 0;  ///< from 1
    std::vector<std::string> cells;
};

/// Cells stand between commas or semicolons or, where `spaces`, between blanks too. Lines that are empty or
/// begin with # are left out.
std::vector<Row> rows_of(const std::string& text, bool spaces) {
    std::vector<Row> rows;
    std::istringstream lines(text);
    std::size_t count = 0;
    for (std::string line; std::getline(lines, line);) {
        ++count;
        if (spaces)
            std::ranges::replace_if(
                line, [](char c) { return c == ',' || c == '\t' || c == '\r'; }, ' ');
        if (!spaces) std::ranges::replace(line, ';', ',');
        const std::string_view content = io::trimmed(line);
        if (content.empty() || content.front() == '#') continue;
        Row& row = rows.emplace_back();
        row.line = count;
        std::istringstream cells(std::string(content) + (spaces ? "" : ","));
        for (std::string cell;
             spaces ? static_cast<bool>(cells >> cell) : static_cast<bool>(std::getline(cells, cell, ','));)
            row.cells.emplace_back(unquoted(io::trimmed(cell)));
    }
    return rows;
}

/// A number or, where `or_max`, the words max and -max.
json read_cell(const std::filesystem::path& file, const Row& row, const std::string& cell, bool or_max) {
    if (or_max && (cell == "max" || cell == "-max")) return cell;
    const std::optional<double> value = io::to_double(cell);
    if (!value || !std::isfinite(*value))
        refuse(file, "line " + std::to_string(row.line) + ": '" + io::escaped(cell.substr(0, 40)) +
                         "' is not a number");
    return *value;
}

/// What a column of keys holds.
struct Column {
    std::string field;       ///< time, angle or direction
    std::size_t region = 0;  ///< from 1; 0: of all together
};

Column read_column(const std::filesystem::path& file, std::string name) {
    const std::string written = name.substr(0, 40);
    std::erase_if(name, [](unsigned char c) { return std::isspace(c) != 0 || c == '_' || c == '"'; });
    std::ranges::transform(name, name.begin(),
                           [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    Column column;
    const std::size_t digits = std::min(name.find_first_of("0123456789"), name.size());
    column.field = name.substr(0, digits);
    const char* const end = name.data() + name.size();
    const auto [next, error] = std::from_chars(name.data() + digits, end, column.region);
    const bool numbered = digits < name.size();
    const bool known =
        column.field == "time" ? !numbered : column.field == "angle" || column.field == "direction";
    if (!known || (numbered && (error != std::errc() || next != end || column.region == 0)))
        refuse(file, "is not a table of keys: its first line has a column '" + io::escaped(written) +
                         "'; there are time, angle, direction, and angle1, direction1, angle2, ..");
    return column;
}

/// Puts a cell where JSON has it.
void put(json& key, const Column& column, json value) {
    if (column.region == 0) {
        key[column.field] = std::move(value);
    } else {
        key[column.field + "s"][column.region - 1] = std::move(value);
    }
}

std::vector<Column> read_columns(const std::filesystem::path& file, const Row& head) {
    constexpr std::size_t most = 100;
    if (head.cells.size() > most) refuse(file, "has more than 100 columns");
    std::vector<Column> columns;
    columns.reserve(head.cells.size());
    for (const std::string& name : head.cells) {
        columns.push_back(read_column(file, name));
        const Column& added = columns.back();
        const auto same = [&](const Column& other) {
            return other.field == added.field && other.region == added.region;
        };
        if (std::ranges::count_if(columns, same) > 1) refuse(file, "has two columns '" + name + "'");
        if (added.region > head.cells.size())
            refuse(file, "has a column '" + name + "', and not all before it");
    }
    return columns;
}

json keys_of(const std::filesystem::path& file, const std::string& text) {
    const std::vector<Row> rows = rows_of(text, false);
    if (rows.empty())
        refuse(file, "is empty; give JSON, or a table whose first line is time,angle,direction");
    const std::vector<Column> columns = read_columns(file, rows.front());
    json keys = json::array();
    for (std::size_t i = 1; i < rows.size(); ++i) {
        const Row& row = rows[i];
        if (row.cells.size() != columns.size())
            refuse(file, "line " + std::to_string(row.line) + ": has " + std::to_string(row.cells.size()) +
                             " values for " + std::to_string(columns.size()) + " columns");
        json key = json::object();
        for (std::size_t c = 0; c < columns.size(); ++c)
            put(key, columns[c], read_cell(file, row, row.cells[c], columns[c].field == "angle"));
        keys.push_back(std::move(key));
    }
    return {{"keys", std::move(keys)}};
}

}  // namespace

json read_keys_file(const std::filesystem::path& file) {
    const std::string text = read_text(file);
    return is_json(text) ? parse_json(file, text) : keys_of(file, text);
}

json read_path_file(const std::filesystem::path& file) {
    const std::string text = read_text(file);
    if (is_json(text)) return parse_json(file, text);
    json points = json::array();
    for (const Row& row : rows_of(text, true)) {
        json point = json::array();
        for (const std::string& cell : row.cells) point.push_back(read_cell(file, row, cell, false));
        if (point.size() != 3)
            refuse(file, "line " + std::to_string(row.line) +
                             ": is not a point; give three numbers a line, or JSON");
        points.push_back(std::move(point));
    }
    return points;
}

}  // namespace goffer::cli
