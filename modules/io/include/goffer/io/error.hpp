// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>

/// How modules speak of files that are at fault.

namespace goffer::io {

/// A file that cannot be read or written. what() is one line: what is wrong, where, how to mend it.
class Error : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

/// Returns `text` fit for one line: control characters become '_'. Thread-safe.
[[nodiscard]] std::string one_line(std::string_view text);

/// Returns `text` fit for a terminal: bytes that are no UTF-8, control characters, and characters that end a
/// line or turn its direction become \xNN, so that a file's name, or text out of a file, does nothing but be
/// read. Thread-safe.
[[nodiscard]] std::string escaped(std::string_view text);

/// Returns "<file>: <what>", with the file's name escaped. Thread-safe.
[[nodiscard]] std::string about(const std::filesystem::path& file, std::string_view what);

/// Returns "2 GiB", "100 MiB", "3 bytes": in the largest unit that leaves a whole number. Thread-safe.
[[nodiscard]] std::string size_text(std::uint64_t bytes);

}  // namespace goffer::io
