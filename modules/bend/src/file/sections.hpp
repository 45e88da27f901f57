// SPDX-License-Identifier: MIT
#pragma once

#include "file/format.hpp"

#include <goffer/bend/body_file_fault.hpp>

#include <cstddef>
#include <cstdint>
#include <span>

namespace goffer::bend {

/// The sections of a file, whose memory is aligned and begins with a whole header. Sections may only lie
/// one behind the other, each at the next cache line.
class FileSections {
public:
    FileSections(std::span<const std::byte> bytes, std::size_t levels) : bytes_(bytes), levels_(levels) {}

    [[nodiscard]] BodyFileFault check() const;

    /// The version that the header says.
    [[nodiscard]] std::uint32_t version() const {
        return reinterpret_cast<const FileHeader*>(bytes_.data())->version;
    }

    /// The records of a section. T is what size_of() has for it.
    template <class T>
    [[nodiscard]] std::span<const T> get(FileSection section, std::size_t level = 0) const {
        const SectionRecord& record = records()[place_of(section, level)];
        return {reinterpret_cast<const T*>(bytes_.data() + record.offset),
                static_cast<std::size_t>(record.count)};
    }

private:
    [[nodiscard]] const SectionRecord* records() const {
        return reinterpret_cast<const SectionRecord*>(bytes_.data() + sizeof(FileHeader));
    }
    [[nodiscard]] bool zeros(std::uint64_t first, std::uint64_t last) const;

    std::span<const std::byte> bytes_;
    std::size_t levels_;
};

}  // namespace goffer::bend
