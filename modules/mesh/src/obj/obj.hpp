// SPDX-License-Identifier: MIT
#pragma once

#include "text.hpp"

#include <goffer/mesh/mesh.hpp>

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

/// What reading and writing OBJ share: the statements of the text. tinyobjloader, which reads the material
/// files, does not scan them: the text is given back with some tokens replaced, numbers must be rounded
/// correctly, and an error must name its line. That library rounds in its own way and takes 0 for what it
/// cannot read.

namespace goffer::mesh {

/// Keeps the text that was read, and the mesh that was made of it, which has no source of its own.
struct ObjSource final : Source {
    std::filesystem::path file;
    LoadOptions options;
    std::string text;
    Mesh read;
};

/// One line with its continuation lines.
struct Statement {
    std::string_view keyword;    ///< empty for a comment or a blank line
    std::string_view arguments;  ///< all that follows the keyword
    std::string_view end;        ///< empty, at the end of the statement, before the end of the line
    bool windows = false;        ///< whether the line ends in CRLF
};

/// Takes the next statement off the front of `rest`; false at its end.
bool next_statement(std::string_view& rest, Statement& out);

/// Takes the next argument off the front of `rest`; empty at its end or before a comment.
std::string_view next_argument(std::string_view& rest);

/// How many v, vt and vn lines there are before a place in the text, or in all of it.
struct Counts {
    std::size_t v = 0, vt = 0, vn = 0;

    /// Counts a statement.
    void add(const Statement& statement);
};

/// The material files that an mtllib line names: one, whose name may have blanks, or several. Views into
/// `arguments`.
[[nodiscard]] std::vector<std::string_view> library_names(const std::filesystem::path& obj,
                                                          std::string_view arguments);

/// The v, vt and vn part of a face's argument; empty where absent.
[[nodiscard]] std::array<std::string_view, 3> corner_parts(std::string_view argument);

/// Appends a blank and the indices of a corner of `mesh`: v, v/vt, v//vn or v/vt/vn.
void append_corner(std::string& out, const Mesh& mesh, std::size_t corner);

/// Converts an OBJ index, which counts from 1 or, if negative, backward from the last of `seen` values, to
/// one that counts from 0.
[[nodiscard]] inline std::int64_t from_zero(std::int64_t index, std::size_t seen) {
    return index > 0 ? index - 1 : static_cast<std::int64_t>(seen) + index;
}

}  // namespace goffer::mesh
