// SPDX-License-Identifier: MIT
#pragma once

#include <goffer/mesh/mesh.hpp>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <string>

/// Small files, and what loading and saving makes of them.

namespace goffer::test {

/// A folder of its own for each object, removed with all that is in it.
class Folder {
public:
    Folder() {
        std::random_device random;
        do path_ = std::filesystem::temp_directory_path() / ("goffer-mesh-" + std::to_string(random()));
        while (!std::filesystem::create_directory(path_));
    }
    ~Folder() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;

    std::filesystem::path operator/(const std::string& name) const { return path_ / name; }
    std::filesystem::path write(const std::string& name, const std::string& bytes) const {
        std::ofstream(path_ / name, std::ios::binary) << bytes;
        return path_ / name;
    }
    std::size_t files() const {
        return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(path_), {}));
    }

private:
    std::filesystem::path path_;
};

inline std::string bytes_of(const std::filesystem::path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

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

/// The message of the Error that `work` throws; empty if it throws none.
template <class Work>
std::string error_of(Work work) {
    try {
        work();
    } catch (const mesh::Error& error) {
        return error.what();
    }
    return {};
}

inline std::string load_error(const std::string& name, const std::string& bytes) {
    return error_of([&] { (void)load_text(name, bytes); });
}

/// Whether the error names the file, is one line and says `what`.
inline bool tells(const std::string& message, const std::string& what) {
    return message.find("goffer-mesh-") != message.npos && message.find('\n') == message.npos &&
           message.find(what) != message.npos;
}

/// `file`'s bytes with `from` replaced by `to` wherever it stands.
inline std::string replaced(std::string bytes, const std::string& from, const std::string& to) {
    for (auto at = bytes.find(from); at != bytes.npos; at = bytes.find(from, at + to.size()))
        bytes.replace(at, from.size(), to);
    return bytes;
}

}  // namespace goffer::test
