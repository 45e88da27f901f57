// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>

namespace goffer::cli {

/// The names of a sequence's files, as in "frames/worm_%04d.obj". Frames count from 1 in them.
class Pattern {
public:
    /// Nothing where the name of `file` has no %d. Throws UsageError where what follows a % is something
    /// else.
    [[nodiscard]] static std::optional<Pattern> read(const std::filesystem::path& file);

    /// The file of frame `frame`, which counts from 0.
    [[nodiscard]] std::filesystem::path file(std::size_t frame) const;

    /// Whether `file` lies where a frame of the sequence would, whatever its number.
    [[nodiscard]] bool holds(const std::filesystem::path& file) const;

    /// The same, or where an OBJ of the sequence would have its materials.
    [[nodiscard]] bool writes(const std::filesystem::path& file) const;

    /// Throws InputError if there are files of the sequence beyond `frames`, which would be taken for its
    /// end, or a folder or a link in the place of a frame.
    void check_places(std::size_t frames) const;

private:
    /// The number of a frame, from 1, that a file of this name would have.
    [[nodiscard]] std::optional<std::size_t> number_of(const std::string& name) const;

    /// The names of the materials that OBJ files have beside them; nothing for other formats.
    [[nodiscard]] std::optional<Pattern> materials() const;

    std::filesystem::path folder_;
    std::string before_, after_;
    std::size_t digits_ = 0;  // at least
};

}  // namespace goffer::cli
