// SPDX-License-Identifier: MIT
#include "file/sections.hpp"

#include <goffer/bend/table.hpp>

#include <glm/vec2.hpp>

#include <algorithm>

namespace goffer::bend {
namespace {

FileSection section_at(std::size_t place) {
    constexpr auto first = static_cast<std::size_t>(FileSection::rig);
    const std::size_t in_level = (place - shared_sections) % level_sections;
    return static_cast<FileSection>(first + (place < shared_sections ? place : shared_sections + in_level));
}

std::size_t size_of(FileSection section, std::uint32_t version) {
    switch (section) {
        case FileSection::rig:
            return sizeof(RigRecord);
        case FileSection::regions:
            return version == 1 ? sizeof(FirstRegionRecord) : sizeof(RegionRecord);
        case FileSection::wrinkle_rows:
            return sizeof(WrinkleRow);
        case FileSection::factor_rows:
            return sizeof(FactorTable::rows[0]);
        case FileSection::materials:
            return sizeof(MaterialRecord);
        case FileSection::sockets:
            return sizeof(SocketRecord);
        case FileSection::level:
            return sizeof(LevelRecord);
        case FileSection::bands:
            return version == 1 ? sizeof(FirstBandsRecord) : sizeof(BandsRecord);
        case FileSection::columns:
            return sizeof(float);
        case FileSection::triangles:
        case FileSection::source:
            return sizeof(std::uint32_t);
        case FileSection::uvs:
            return sizeof(glm::vec2);
        case FileSection::parts:
            return sizeof(PartRecord);
        default:
            return 1;
    }
}

}  // namespace

BodyFileFault FileSections::check() const {
    const std::uint64_t size = bytes_.size();
    std::uint64_t end = sizeof(FileHeader) + section_count(levels_) * sizeof(SectionRecord);
    if (end > size) return {FileReason::truncated, FileSection::directory};
    for (std::size_t i = 0; i < section_count(levels_); ++i) {
        const SectionRecord record = records()[i];
        const std::uint64_t begin = aligned(end);
        if (record.offset != begin || begin > size || !zeros(end, begin))
            return {FileReason::layout, FileSection::directory, BodyFileFault::nowhere, i};
        const std::uint64_t bytes_each = size_of(section_at(i), version());
        if (record.count > (size - begin) / bytes_each)
            return {FileReason::layout, FileSection::directory, BodyFileFault::nowhere, i};
        end = begin + record.count * bytes_each;
    }
    const bool whole = aligned(end) == size && zeros(end, size);
    return whole ? BodyFileFault{} : BodyFileFault{FileReason::layout, FileSection::directory};
}

bool FileSections::zeros(std::uint64_t first, std::uint64_t last) const {
    const auto gap = bytes_.subspan(static_cast<std::size_t>(first), static_cast<std::size_t>(last - first));
    return std::ranges::all_of(gap, [](std::byte byte) { return byte == std::byte{0}; });
}

}  // namespace goffer::bend
