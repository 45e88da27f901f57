// SPDX-License-Identifier: MIT
#include "cache/shard.hpp"

#include "cache/members.hpp"
#include "report.hpp"

#include <goffer/io/error.hpp>

#include <algorithm>
#include <cstdio>
#include <cstring>

namespace goffer::cli {
namespace {

constexpr std::array<std::string_view, 3> names{"positions", "packed", "poses"};

std::uint64_t up_to(std::uint64_t bytes, std::uint64_t multiple) {
    return (bytes + multiple - 1) / multiple * multiple;
}

std::string_view view_of(std::span<const std::byte> bytes) {
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

/// How the two differ, but for their checksums; empty where they do not.
std::string difference(const ShardHeader& has, const ShardHeader& wanted) {
    if (has.magic != wanted.magic) return "is not a shard of goffer cache";
    if (has.byte_order != wanted.byte_order) return "is of another byte order";
    if (has.version != wanted.version)
        return "is of version " + std::to_string(has.version) + " of the format, not " +
               std::to_string(wanted.version);
    if (has.scene != wanted.scene) return "was made from another scene, or other files";
    if (has.bodies != wanted.bodies) return "was made with other bodies";
    if (has.format != wanted.format) return "is of another format";
    if (has.isa != wanted.isa) return "was made with kernels of another instruction set";
    ShardHeader same = has;
    same.checksum = wanted.checksum;
    return same == wanted ? "" : "has other frames or instances";
}

}  // namespace

std::string_view name_of(CacheFormat format) noexcept {
    return names[static_cast<std::size_t>(format)];
}

std::optional<CacheFormat> parse_format(std::string_view name) noexcept {
    const auto found = std::ranges::find(names, name);
    if (found == names.end()) return std::nullopt;
    return static_cast<CacheFormat>(found - names.begin());
}

std::uint64_t block_bytes(CacheFormat format, std::uint64_t vertices, std::uint64_t regions) noexcept {
    constexpr std::uint64_t line = 64, lines_of_vertices = 192, pose_bytes = 8;
    switch (format) {
        case CacheFormat::positions:
            return up_to(vertices * vertex_bytes, lines_of_vertices);
        case CacheFormat::packed:
            return up_to(bounds_bytes + vertices * vertex_bytes, lines_of_vertices);
        case CacheFormat::poses:
            break;
    }
    return up_to(placing_bytes + regions * pose_bytes, line);
}

std::uint64_t data_offset(std::uint64_t instances) noexcept {
    constexpr std::uint64_t line = 64;
    return up_to(sizeof(ShardHeader) + instances * sizeof(ShardInstance), line);
}

ShardWriter::ShardWriter(const std::filesystem::path& file, const ShardHeader& header,
                         std::span<const ShardInstance> instances)
    : file_(file), header_(header) {
    header_.checksum = 0;
    std::vector<std::byte> start(static_cast<std::size_t>(data_offset(instances.size())));
    std::memcpy(start.data(), &header_, sizeof header_);
    std::ranges::copy(std::as_bytes(instances), start.begin() + sizeof header_);
    add(start);
}

void ShardWriter::add(std::span<const std::byte> blocks) {
    checksum_.add(blocks);
    file_.write(view_of(blocks));
}

std::uint64_t ShardWriter::finish() {
    header_.checksum = checksum_.value();
    file_.replace_start(view_of(std::as_bytes(std::span(&header_, 1))));
    file_.commit();
    return header_.checksum;
}

std::optional<std::string> fault_in_shard(const std::filesystem::path& file, const ShardHeader& expected,
                                          std::uint64_t* checksum) {
    std::error_code error;
    const std::filesystem::file_status status = std::filesystem::symlink_status(file, error);
    if (!std::filesystem::exists(status)) return "is missing";
    if (!std::filesystem::is_regular_file(status)) return "is not a regular file";
    try {
        const InputFile shard(file);
        ShardHeader header;
        if (shard.size() < sizeof header) return "is cut off";
        shard.read(0, std::as_writable_bytes(std::span(&header, 1)));
        if (std::string other = difference(header, expected); !other.empty()) return other;
        if (shard.size() != header.bytes)
            return "has " + std::to_string(shard.size()) + " bytes, not " + std::to_string(header.bytes);
        bend::Checksum sum;
        ShardHeader unsigned_header = header;
        unsigned_header.checksum = 0;
        sum.add(std::as_bytes(std::span(&unsigned_header, 1)));
        read_pieces(shard, sizeof header, [&](std::span<const std::byte> bytes) { sum.add(bytes); });
        if (sum.value() != header.checksum)
            return "is damaged: its checksum is " + hex(sum.value()) + ", not " + hex(header.checksum);
        if (checksum != nullptr) *checksum = header.checksum;
        return std::nullopt;
    } catch (const io::Error& failed) {
        const std::string text = failed.what(), name = io::about(file, "");
        return text.starts_with(name) ? text.substr(name.size()) : text;
    }
}

}  // namespace goffer::cli
