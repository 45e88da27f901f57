// SPDX-License-Identifier: MIT
#pragma once

#include "cache/cast.hpp"
#include "cache/plan.hpp"

#include <goffer/bend/crowd.hpp>
#include <goffer/engine/columns.hpp>

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <vector>

namespace goffer::cli {

/// Bytes that are deformed at a time: they stay in the cache until they are summed up and written. An
/// instance that takes more is a piece of its own.
inline constexpr std::uint64_t piece_bytes = std::uint64_t{8} << 20;

/// A shard on the disk.
struct ShardFile {
    std::uint64_t bytes = 0, checksum = 0;
};

/// Makes shards. What it holds beside bodies and numbers are two pieces, 100 bytes for each instance of a
/// piece and 16 for each instance of a shard. Not thread-safe; works with oneTBB in the arena that it is
/// called from, and writes a piece while it deforms the next.
class Baker {
public:
    /// Both must outlive this. The plan is one of the cast's scene and bodies.
    Baker(const Plan& plan, const Cast& cast) : plan_(plan), cast_(cast) {}

    /// The whole header of a shard but for its checksum.
    [[nodiscard]] ShardHeader header(std::uint64_t index) const;

    /// Writes a shard in the place of whatever is there. Calls `frame_done` after each frame. Throws
    /// an error that names the file at fault, here or of the scene.
    ShardFile bake(std::uint64_t index, const std::filesystem::path& file,
                   const std::function<void()>& frame_done);

    /// What became of the poses so far, each instance counted in each frame.
    [[nodiscard]] const bend::CrowdResult& result() const noexcept { return result_; }

private:
    /// Instances of one body in a piece, as columns.
    struct Company {
        std::vector<bend::Pose> poses;
        std::vector<glm::mat4x3> transforms;
        std::vector<float> weights;
        std::vector<std::uint32_t> offsets;  ///< in vertices of the piece
        std::vector<bend::Bounds> bounds;
    };
    /// Instances [first, last) of a shard, counted in it.
    struct Piece {
        std::size_t first, last;
        std::uint64_t bytes;
    };

    [[nodiscard]] std::vector<ShardInstance> instances_of(const ShardRange& range) const;
    [[nodiscard]] static std::vector<Piece> pieces_of(std::span<const ShardInstance> instances,
                                                      std::uint64_t frame_bytes);
    void make_piece(const ShardRange& range, std::uint64_t frame, const Piece& piece,
                    std::span<const ShardInstance> instances, std::span<std::byte> blocks);
    void write_poses(const Piece& piece, std::span<const ShardInstance> instances,
                     std::span<std::byte> blocks);
    void gather(const Piece& piece, std::span<const ShardInstance> instances, std::span<std::byte> blocks);
    [[nodiscard]] std::vector<bend::Batch> batches_into(std::span<std::byte> blocks);
    void deform(std::span<std::byte> blocks);

    const Plan& plan_;
    const Cast& cast_;
    Moments moments_;
    std::vector<Company> companies_;
    std::array<Columns, 2> memory_;
    bend::CrowdResult result_;
};

}  // namespace goffer::cli
