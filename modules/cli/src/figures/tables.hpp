// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json.hpp>

#include <cstddef>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

/// The data of a figure: what its CSV file, its chart and the numbers in its text are all made from.

namespace goffer::cli {

/// Rows of named columns.
class Table {
public:
    using Cell = std::variant<std::monostate, double, std::string>;  ///< nothing, a number or words

    explicit Table(std::vector<std::string> columns) : columns_(std::move(columns)) {}

    /// Adds a row of as many cells as there are columns.
    void add(std::vector<Cell> row);

    [[nodiscard]] std::size_t rows() const noexcept { return rows_.size(); }
    [[nodiscard]] const std::vector<std::string>& columns() const noexcept { return columns_; }
    /// The cell of a row and column, both of which must be there.
    [[nodiscard]] const Cell& at(std::size_t row, std::string_view column) const;
    /// Such a cell, which must be a number.
    [[nodiscard]] double number(std::size_t row, std::string_view column) const;

    /// RFC 4180, but for lines that end as Unix has them: the columns' names, and a line for each row.
    [[nodiscard]] std::string csv() const;
    [[nodiscard]] nlohmann::ordered_json json() const;

private:
    std::vector<std::string> columns_;
    std::vector<std::vector<Cell>> rows_;
};

/// How a number is shown to a person.
enum class Shown {
    plain,    ///< three significant digits
    whole,    ///< no decimals
    change,   ///< a fraction as per cent, with its sign
    percent,  ///< a fraction as per cent
};

/// A cell as HTML: its number for a person, as the element <data>, whose value is the number of the CSV. A
/// cell without a number is words, or a dash.
[[nodiscard]] std::string html(const Table& table, std::size_t row, std::string_view column,
                               Shown shown = Shown::plain);

/// The whole table as HTML.
[[nodiscard]] std::string html(const Table& table);

/// Words as HTML: what has a meaning there is escaped.
[[nodiscard]] std::string html_text(std::string_view text);

}  // namespace goffer::cli
