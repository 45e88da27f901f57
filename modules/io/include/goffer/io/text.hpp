// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

/// Words and numbers of text files. All functions are thread-safe and know nothing of locales; views that
/// they return are into their argument.

namespace goffer::io {

/// Returns whether `c` stands between words: a blank, a tab or an end of a line.
[[nodiscard]] bool is_blank(char c);

/// Returns `text` without the byte order mark that some editors put in front of UTF-8.
[[nodiscard]] std::string_view without_bom(std::string_view text);

/// Returns `text` without blanks and ends of lines at either end.
[[nodiscard]] std::string_view trimmed(std::string_view text);

/// Convert a whole word to a number, correctly rounded; nothing if it is none. A plus sign may stand in
/// front. What is beyond the type's range becomes an infinity or 0. nan and inf are read too.
[[nodiscard]] std::optional<float> to_float(std::string_view word);
[[nodiscard]] std::optional<double> to_double(std::string_view word);

/// Converts a whole word to a whole number; nothing if it is none, or is out of range.
[[nodiscard]] std::optional<std::int64_t> to_integer(std::string_view word);

}  // namespace goffer::io
