// SPDX-License-Identifier: MIT
#include "figures/tables.hpp"

#include <goffer/io/error.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdio>

namespace goffer::cli {
namespace {

std::string formatted(const char* format, double value) {
    char text[64];
    std::snprintf(text, sizeof text, format, value);
    return text;
}

std::string cell_text(const Table::Cell& cell) {
    if (const double* const value = std::get_if<double>(&cell)) return formatted("%.9g", *value);
    const std::string* const words = std::get_if<std::string>(&cell);
    return words != nullptr ? *words : "";
}

std::string quoted(const std::string& text) {
    if (text.find_first_of(",\"\n\r") == std::string::npos) return text;
    std::string out = "\"";
    for (const char c : text) out += c == '"' ? std::string("\"\"") : std::string(1, c);
    return out + '"';
}

/// "10,000".
std::string with_commas(std::string digits) {
    constexpr std::size_t unmarked = 4, group = 3;
    const std::size_t first = digits.starts_with('-') ? 1 : 0;
    if (digits.size() - first <= unmarked) return digits;
    for (std::size_t at = digits.size() - group; at > first && at < digits.size(); at -= group)
        digits.insert(at, ",");
    return digits;
}

std::string for_people(double value, Shown shown) {
    switch (shown) {
        case Shown::whole:
            return with_commas(formatted("%.0f", value));
        case Shown::change:
            return std::fabs(value) < 0.5e-4 ? "0.00&nbsp;%" : formatted("%+.2f", 100 * value) + "&nbsp;%";
        case Shown::percent:
            return formatted("%.2f", 100 * value) + "&nbsp;%";
        case Shown::plain:
            break;
    }
    return formatted("%.3g", value);
}

}  // namespace

void Table::add(std::vector<Cell> row) {
    assert(row.size() == columns_.size());
    rows_.push_back(std::move(row));
}

const Table::Cell& Table::at(std::size_t row, std::string_view column) const {
    const auto found = std::ranges::find(columns_, column);
    assert(row < rows_.size() && found != columns_.end());
    return rows_[row][static_cast<std::size_t>(found - columns_.begin())];
}

double Table::number(std::size_t row, std::string_view column) const {
    return std::get<double>(at(row, column));
}

std::string Table::csv() const {
    std::string text;
    const auto line = [&](const auto& cells, const auto& words) {
        for (std::size_t i = 0; i < cells.size(); ++i) text += (i > 0 ? "," : "") + quoted(words(cells[i]));
        text += '\n';
    };
    line(columns_, [](const std::string& name) { return name; });
    for (const std::vector<Cell>& row : rows_) line(row, cell_text);
    return text;
}

nlohmann::ordered_json Table::json() const {
    nlohmann::ordered_json rows = nlohmann::ordered_json::array();
    for (const std::vector<Cell>& cells : rows_) {
        nlohmann::ordered_json row = nlohmann::ordered_json::array();
        for (const Cell& cell : cells) {
            const double* const value = std::get_if<double>(&cell);
            const bool none = std::holds_alternative<std::monostate>(cell);
            row.push_back(none               ? nlohmann::ordered_json(nullptr)
                          : value != nullptr ? nlohmann::ordered_json(*value)
                                             : nlohmann::ordered_json(cell_text(cell)));
        }
        rows.push_back(row);
    }
    return {{"columns", columns_}, {"rows", rows}};
}

std::string html_text(std::string_view text) {
    std::string out;
    for (const char c : io::escaped(text)) {
        switch (c) {
            case '&':
                out += "&amp;";
                break;
            case '<':
                out += "&lt;";
                break;
            case '>':
                out += "&gt;";
                break;
            case '"':
                out += "&quot;";
                break;
            default:
                out += c;
        }
    }
    return out;
}

std::string html(const Table& table, std::size_t row, std::string_view column, Shown shown) {
    const Table::Cell& cell = table.at(row, column);
    if (std::holds_alternative<std::monostate>(cell)) return "&ndash;";
    const double* const value = std::get_if<double>(&cell);
    if (value == nullptr) return html_text(cell_text(cell));
    return "<data value=\"" + cell_text(cell) + "\">" + for_people(*value, shown) + "</data>";
}

std::string html(const Table& table) {
    std::string text = "<div class=\"wide\"><table>\n<tr>";
    for (const std::string& column : table.columns()) {
        std::string name = html_text(column);
        std::ranges::replace(name, '_', ' ');
        text += "<th>" + name + "</th>";
    }
    text += "</tr>\n";
    for (std::size_t row = 0; row < table.rows(); ++row) {
        text += "<tr>";
        for (const std::string& column : table.columns()) {
            const bool whole = std::holds_alternative<double>(table.at(row, column)) &&
                               table.number(row, column) ==
                                   static_cast<double>(static_cast<long long>(table.number(row, column)));
            text += "<td>" + html(table, row, column, whole ? Shown::whole : Shown::plain) + "</td>";
        }
        text += "</tr>\n";
    }
    return text + "</table></div>\n";
}

}  // namespace goffer::cli
