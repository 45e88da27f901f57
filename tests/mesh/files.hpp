// SPDX-License-Identifier: MIT
#pragma once

#include "support/files.hpp"

#include <goffer/mesh/mesh.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <string>

/// Meshes in small files, and what loading and saving makes of them.

namespace goffer::test {

/// A triangle as an OBJ.
inline const std::string triangle_obj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

inline mesh::Mesh load_text(const std::string& name, const std::string& bytes) {
    const Folder folder;
    return mesh::load(folder.write(name, bytes));
}

/// What `save` writes.
inline std::string saved(const mesh::Mesh& mesh, const std::string& name) {
    const Folder folder;
    mesh::save(mesh, folder / name);
    return bytes_of(folder / name);
}

/// `mesh` written to a file of that name and read again.
inline mesh::Mesh reloaded(const mesh::Mesh& mesh, const std::string& name) {
    const Folder folder;
    mesh::save(mesh, folder / name);
    return mesh::load(folder / name);
}

/// The message of the mesh::Error that `work` throws; empty if it throws none.
template <class Work>
std::string error_of(Work work) {
    return message_of<mesh::Error>(work);
}

inline std::string load_error(const std::string& name, const std::string& bytes) {
    return error_of([&] { (void)load_text(name, bytes); });
}

/// `file`'s bytes with `from` replaced by `to` wherever it stands.
inline std::string replaced(std::string bytes, const std::string& from, const std::string& to) {
    for (auto at = bytes.find(from); at != bytes.npos; at = bytes.find(from, at + to.size()))
        bytes.replace(at, from.size(), to);
    return bytes;
}

/// Appends the bytes of a number, the most significant first if `big`.
template <class T>
void append_number(std::string& bytes, T value, bool big) {
    std::array<char, sizeof(T)> raw;
    std::memcpy(raw.data(), &value, sizeof(T));
    if (big != (std::endian::native == std::endian::big)) std::ranges::reverse(raw);
    bytes.append(raw.data(), raw.size());
}

}  // namespace goffer::test
