// SPDX-License-Identifier: MIT
#pragma once

#include "cache/hash.hpp"

#include <goffer/bend/checksum.hpp>
#include <goffer/engine/isa.hpp>
#include <goffer/io/atomic_file.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

/// A shard: some frames of some instances in a file of their own. The format is in samples/farm/README.md,
/// "A shard". A change here is a new version.

namespace goffer::cli {

/// What is kept of an instance in a frame.
enum class CacheFormat : std::uint32_t {
    positions = 0,  ///< 3 floats for each vertex
    packed = 1,     ///< its bounds, and a bend::PackedVertex for each vertex
    poses = 2,      ///< its transform, the weight of its wrinkles, and a pose for each region
};

/// "positions", "packed" or "poses".
[[nodiscard]] std::string_view name_of(CacheFormat format) noexcept;
[[nodiscard]] std::optional<CacheFormat> parse_format(std::string_view name) noexcept;

/// Bytes of an instance's block in a frame: with zeros behind it up to a multiple of a cache line, which for
/// vertices is also one of 12 bytes.
[[nodiscard]] std::uint64_t block_bytes(CacheFormat format, std::uint64_t vertices,
                                        std::uint64_t regions) noexcept;

/// What a block of packed vertices begins with: two vectors, which take as much as two vertices.
inline constexpr std::uint64_t bounds_bytes = 24, vertex_bytes = 12;
/// What a block of poses begins with: the transform's columns, the weight, and a word of zeros.
inline constexpr std::uint64_t placing_bytes = 56;

struct ShardHeader {
    std::array<char, 8> magic{'G', 'O', 'F', 'F', 'C', 'A', '\r', '\n'};
    std::uint32_t byte_order = 0x01020304;
    std::uint32_t version = 1;
    std::uint64_t bytes = 0;     ///< of the whole file
    std::uint64_t checksum = 0;  ///< of the whole file, with this number taken as 0
    std::uint64_t scene = 0;     ///< checksum of the scene and of all files that it names
    std::uint64_t bodies = 0;    ///< checksum of the body files' checksums
    std::uint32_t format = 0;    ///< a CacheFormat
    std::uint32_t isa = 0;       ///< an Isa
    std::uint64_t first_frame = 0, frame_count = 0, first_instance = 0, instance_count = 0;
    std::uint64_t data = 0;         ///< offset of the first frame
    std::uint64_t frame_bytes = 0;  ///< from one frame to the next
    std::uint64_t zero[3] = {};

    [[nodiscard]] bool operator==(const ShardHeader&) const noexcept = default;
};
static_assert(sizeof(ShardHeader) == 128);

/// An instance of a shard, one for each behind the header.
struct ShardInstance {
    std::uint32_t body = 0;      ///< which of the scene's, in the order of their names
    std::uint32_t vertices = 0;  ///< of that body
    std::uint64_t offset = 0;    ///< of its block in a frame
};
static_assert(sizeof(ShardInstance) == 16);

/// Where the first frame begins: at a cache line.
[[nodiscard]] std::uint64_t data_offset(std::uint64_t instances) noexcept;

/// A shard being written, beside its place; nothing is left of it without finish().
class ShardWriter {
public:
    /// `header` but for its checksum. Throws io::Error.
    ShardWriter(const std::filesystem::path& file, const ShardHeader& header,
                std::span<const ShardInstance> instances);

    /// Appends blocks of a frame.
    void add(std::span<const std::byte> blocks);

    /// Puts the shard in its place. Returns its checksum.
    std::uint64_t finish();

private:
    io::AtomicFile file_;
    ShardHeader header_;
    bend::Checksum checksum_;
};

/// What is wrong with a file that should be the shard with this header but for its checksum, all of whose
/// bytes are read; nothing, and its checksum in *checksum, where it is.
[[nodiscard]] std::optional<std::string> fault_in_shard(const std::filesystem::path& file,
                                                        const ShardHeader& expected, std::uint64_t* checksum);

}  // namespace goffer::cli
