// SPDX-License-Identifier: MIT
#pragma once

#include "file/holdings.hpp"
#include "file/sections.hpp"

#include <goffer/bend/body_file.hpp>
#include <goffer/bend/body_input.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

/// The parts of load_held() that read levels, and what they share with those that read what all levels share.

namespace goffer::bend {

[[nodiscard]] inline BodyFileFault bad_number(FileSection section, std::size_t index,
                                              const BodyFault& body = {}) {
    return {FileReason::number, section, BodyFileFault::nowhere, index, body};
}
[[nodiscard]] inline BodyFileFault bad_count(FileSection section) {
    return {FileReason::count, section};
}
[[nodiscard]] inline BodyFileFault no_such(FileSection section, std::size_t index) {
    return {FileReason::index, section, BodyFileFault::nowhere, index};
}

[[nodiscard]] inline bool all_finite(std::span<const float> numbers) {
    return std::ranges::all_of(numbers, [](float x) { return std::isfinite(x); });
}

/// The names in a file. They follow each other in the order in which they are read, so that all of them
/// together are no longer than the file.
class NameReader {
public:
    explicit NameReader(std::span<const char> characters) : characters_(characters) {}

    /// The characters of a name, or nothing where they are not the next ones.
    [[nodiscard]] std::optional<std::string_view> read(const NameRecord& name) {
        if (name.first != read_ || name.count > characters_.size() - read_) return std::nullopt;
        read_ += name.count;
        return std::string_view(characters_.data() + name.first, name.count);
    }

private:
    std::span<const char> characters_;
    std::size_t read_ = 0;  ///< characters of the names so far
};

/// What a level is loaded with. All of it must outlive the call.
struct LevelContext {
    const FileSections& sections;
    const BodyInput& rig;  ///< its regions are without vertices
    NameReader& names;
    std::size_t materials;  ///< how many there are
    bool everything;        ///< Verify::everything
    const FileMemory& holdings;
};

/// Appends a level to `levels`, or returns the first fault, which does not say the level.
[[nodiscard]] BodyFileFault load_level(const LevelContext& context, std::size_t level,
                                       std::vector<BodyFileLevel>& levels);

}  // namespace goffer::bend
