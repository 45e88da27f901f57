// SPDX-License-Identifier: MIT
#pragma once

#include "body/body_data.hpp"

#include <goffer/bend/body_file.hpp>

#include <array>
#include <cstddef>
#include <cstdint>

/// The records of a body file, version 2, as they lie in it. A change here is a new version.
/// See modules/bend/README.md, "The body file".

namespace goffer::bend {

struct FileHeader {
    std::array<char, 8> magic;
    std::uint32_t byte_order;
    std::uint32_t version;
    std::uint64_t bytes;     ///< of the whole file
    std::uint64_t checksum;  ///< of the whole file, with this number taken as 0
    std::uint32_t level_count;
    std::uint32_t zero_word;
    std::uint64_t zero[3];
};

/// One for each section, in the order of FileSection: those from `rig` to `notes`, then those from `level` to
/// `parts` for each level.
struct SectionRecord {
    std::uint64_t offset;  ///< of its first byte in the file
    std::uint64_t count;   ///< of its records
};

struct RigRecord {
    double origin[3];
    double axes[9];  ///< e1, e2, e3
    double radius;
};

/// As version 1 has it, in which wrinkles vanish at joints.
struct FirstRegionRecord {
    double length, max_angle, rest_angle, rest_direction, onset, radius, max_scale;
    float table_max_angle, factors_max_angle;
    std::uint32_t wrinkle_rows, factor_rows;  ///< how many of these sections' are its own
};

struct RegionRecord {
    FirstRegionRecord first;
    double blend, blend_gain;
};

/// Characters of the section `names`.
struct NameRecord {
    std::uint32_t first, count;
};

struct MaterialRecord {
    NameRecord name;
    float base_color[4];
};

struct SocketRecord {
    NameRecord name;
    std::uint64_t region;
    double vertex[8];  ///< in the order of RestVertex
    double normal[3], tangent[3];
};

struct LevelRecord {
    std::uint64_t vertex_count;
    std::uint64_t stride;                 ///< floats from one column to the next
    std::uint32_t tangents, shape, rest;  ///< 1 where it has these columns, else 0
    float low[3], high[3];                ///< box at rest
    std::uint32_t zero;
};

/// A region's vertices in one level, as version 1 has them. See Bands.
struct FirstBandsRecord {
    std::uint64_t vertex_count;
    float lowest, highest, drift_error, max_drift_step, max_scale;
    std::uint32_t shaped;
    float rho[Bands::places], outward[Bands::places], inward[Bands::places], drift[Bands::places];
};

struct BandsRecord {
    FirstBandsRecord first;
    /// The region's vertices near the joint below come before `below_last`, those near the joint above from
    /// `above_first` on. See Joint, and for the scales Joint::max_scale.
    std::uint64_t below_last, above_first;
    float below_scale, above_scale;
};

struct PartRecord {
    NameRecord name;
    std::uint32_t first_triangle, triangle_count;
    std::int32_t material;
};

inline constexpr std::array<char, 8> file_magic{'G', 'O', 'F', 'F', 'E', 'R', '\r', '\n'};
inline constexpr std::uint32_t file_byte_order = 0x01020304;
/// The most rows of a region's table: each level has a copy.
inline constexpr std::size_t most_rows = WrinkleTable::max_rows;
inline constexpr std::size_t shared_sections = 8;  ///< from `rig` to `notes`
inline constexpr std::size_t level_sections = 7;   ///< from `level` to `parts`

// These are their sizes, whatever the compiler thinks of padding.
static_assert(sizeof(FileHeader) == 64 && sizeof(SectionRecord) == 16 && sizeof(RigRecord) == 104);
static_assert(sizeof(FirstRegionRecord) == 72 && sizeof(RegionRecord) == 88);
static_assert(sizeof(MaterialRecord) == 24 && sizeof(SocketRecord) == 128);
static_assert(sizeof(LevelRecord) == 56 && sizeof(FirstBandsRecord) == 288 && sizeof(BandsRecord) == 312 &&
              sizeof(PartRecord) == 20);
static_assert(wrinkle_degree == 7 && FactorTable::directions == 16 && Bands::count == 11);
static_assert(all_columns == 14 && all_shape_columns == 3 && all_rest_columns == 5);
static_assert(column_alignment == 64 && widest_batch == 32);

/// Where the next section begins, behind `bytes` bytes.
[[nodiscard]] constexpr std::uint64_t aligned(std::uint64_t bytes) noexcept {
    return (bytes + column_alignment - 1) / column_alignment * column_alignment;
}

[[nodiscard]] constexpr std::size_t section_count(std::size_t levels) noexcept {
    return shared_sections + levels * level_sections;
}

/// The place of a section in the directory. `level` counts from `level` on.
[[nodiscard]] constexpr std::size_t place_of(FileSection section, std::size_t level) noexcept {
    const auto place = static_cast<std::size_t>(section) - static_cast<std::size_t>(FileSection::rig);
    return section < FileSection::level ? place : place + level * level_sections;
}

/// A region's bands as a record.
[[nodiscard]] FirstBandsRecord record_of(const Bands& bands, std::size_t vertex_count) noexcept;
/// The same with its joints. `first`: the region's first vertex.
[[nodiscard]] BandsRecord record_of(const Bands& bands, const Joints& joints, std::size_t first,
                                    std::size_t vertex_count) noexcept;

/// The first fault in the columns of `data`, all of whose regions are there: a number with which a run might
/// leave float's range or the bounds. Numbers of several vertices are looked at together, and one by one only
/// where the most extreme of them would make no good vertex. Finds anew which vertices are near joints: one
/// where a blend begins may round to either side of it, as this build has it.
[[nodiscard]] BodyFault check_columns(BodyData& data) noexcept;

/// Whether all indices are below `count`. A function of its own: within code that runs once compilers make no
/// vectors of a loop.
[[nodiscard]] bool all_below(std::size_t count, std::span<const std::uint32_t> indices) noexcept;

/// The checksum of a file, of which at least the header is there.
[[nodiscard]] std::uint64_t checksum_of(std::span<const std::byte> bytes) noexcept;

}  // namespace goffer::bend
