// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

/// What the text formats share: tokens, exact numbers, error messages, and an editor that replaces tokens.
/// All views are into the bytes of the file.

namespace goffer::mesh {

/// Throws Error "<file>: <what>".
[[noreturn]] void fail(const std::filesystem::path& file, const std::string& what);

/// `text` in quotes, cut short and escaped, so that a message stays one line.
[[nodiscard]] std::string quoted(std::string_view text);

/// "line N", where `place` points into `text`; lines count from 1.
[[nodiscard]] std::string line_of(std::string_view text, const char* place);

/// `count` and the word for so many: "1 face", "2 faces". Warnings that formats share.
[[nodiscard]] std::string number_of(std::uint64_t count, std::string_view one, std::string_view several);
[[nodiscard]] std::string short_faces_warning(std::uint64_t faces);
[[nodiscard]] std::string not_finite_warning(std::uint64_t values);

/// Takes the next token off the front of `rest`; empty at its end. A backslash before the end of a line
/// counts as a blank.
std::string_view next_token(std::string_view& rest);

/// Takes the next line off the front of `rest`, without its end (LF, CRLF, or CR as on old Macs).
std::string_view next_line(std::string_view& rest);

/// `text` in lower case (ASCII).
[[nodiscard]] std::string lower(std::string_view text);

/// Appends the shortest text that reads back as exactly this value.
void append(std::string& out, float value);
void append(std::string& out, double value);
void append(std::string& out, std::uint64_t value);

/// Appends each value after a blank.
template <class... T>
void append_all(std::string& out, T... values) {
    ((out += ' ', append(out, values)), ...);
}

/// A file's bytes with some of them replaced, from front to back.
class Editor {
public:
    explicit Editor(std::string_view source) : source_(source) {
        out_.reserve(source.size() + source.size() / 8);
    }

    /// Puts `with` in the place of `old`, a view into the source behind everything replaced so far.
    void replace(std::string_view old, std::string_view with);
    void replace(std::string_view old, float with);

    /// Returns the edited bytes. To be called once, last.
    [[nodiscard]] std::string finish();

private:
    std::string_view source_;
    std::string out_;
    std::size_t done_ = 0;  ///< how many bytes of the source are in out_, or replaced
};

}  // namespace goffer::mesh
