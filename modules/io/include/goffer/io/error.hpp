// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>

/// How modules speak of files that are at fault.

namespace goffer::io {

/// A file that cannot be written. what() is one line: what is wrong, where, how to mend it.
class Error : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

/// `text` fit for one line: control characters become '_'.
[[nodiscard]] std::string one_line(std::string_view text);

/// "<file>: <what>", where the file's name is kept to one line.
[[nodiscard]] std::string about(const std::filesystem::path& file, std::string_view what);

}  // namespace goffer::io
