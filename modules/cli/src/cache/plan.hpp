// SPDX-License-Identifier: MIT
#pragma once

#include "cache/scene.hpp"
#include "cache/shard.hpp"

#include <goffer/engine/isa.hpp>

#include <nlohmann/json.hpp>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

/// How a scene is cut into shards, and what they are made from: a file beside them, and the first part of the
/// manifest.

namespace goffer::cli {

class Members;

inline constexpr std::uint64_t most_plan_bytes = std::uint64_t{256} << 20;  ///< of a manifest of most_shards
inline constexpr std::uint64_t most_shards = 1'000'000;
inline constexpr std::uint64_t most_shard_bytes = std::numeric_limits<std::int64_t>::max();

/// The files of a cache.
inline constexpr const char* plan_name = "plan.json";
inline constexpr const char* manifest_name = "manifest.json";
[[nodiscard]] std::string shard_name(std::uint64_t index);
/// The number in such a name; nothing where it is none.
[[nodiscard]] std::optional<std::uint64_t> shard_number(const std::string& name);

/// A body of the cache, whose file is beside the shards.
struct PlanBody {
    std::string name;
    std::uint64_t level = 0, vertices = 0, regions = 0;
    std::uint64_t bytes = 0, checksum = 0;  ///< of its file

    [[nodiscard]] std::string file() const { return "bodies/" + name + ".goffer"; }
    [[nodiscard]] bool operator==(const PlanBody&) const noexcept = default;
};

/// A large file that the scene names, so that it is read again only after it has changed.
struct PlanFile {
    std::string file;
    std::uint64_t bytes = 0, checksum = 0;
    std::int64_t modified = 0;  ///< of the file system's clock

    [[nodiscard]] bool operator==(const PlanFile&) const noexcept = default;
};

/// Frames and instances of a shard.
struct ShardRange {
    std::uint64_t first_frame = 0, frames = 0, first_instance = 0, instances = 0;
};

/// What shards are to be like. 0 means as many as `bytes` has room for.
struct ShardShape {
    std::uint64_t bytes = 0, frames = 0, instances = 0;

    [[nodiscard]] bool operator==(const ShardShape&) const noexcept = default;
};

struct Plan {
    std::uint64_t scene = 0;  ///< checksum
    CacheFormat format = CacheFormat::positions;
    Isa isa = Isa::scalar;
    double fps = 0;
    std::uint64_t frames = 0, instances = 0;
    ShardShape shape;                    ///< as asked for
    std::uint64_t frames_per_shard = 0;  ///< of all shards but the last ones
    std::vector<std::uint64_t> firsts;   ///< the first instances of shards, from 0
    std::vector<PlanBody> bodies;
    std::vector<PlanFile> files;

    [[nodiscard]] std::uint64_t shards() const noexcept {
        return (frames + frames_per_shard - 1) / frames_per_shard * firsts.size();
    }
    /// The range of shard `index` < shards(). All instances of the first frames come first.
    [[nodiscard]] ShardRange range(std::uint64_t index) const noexcept;
    /// The shard that has an instance in a frame.
    [[nodiscard]] std::uint64_t shard_of(std::uint64_t frame, std::uint64_t instance) const noexcept;
    /// Checksum of the bodies' checksums.
    [[nodiscard]] std::uint64_t bodies_checksum() const;
    /// The header of a shard as far as the plan knows it: without sizes.
    [[nodiscard]] ShardHeader header(std::uint64_t index) const;

    [[nodiscard]] bool operator==(const Plan&) const noexcept = default;
};

/// Sets how `plan`, which has all else, is cut. `block`: bytes of an instance in a frame. Throws InputError
/// where there are too many shards.
void cut(Plan& plan, const std::function<std::uint64_t(std::uint64_t)>& block);

[[nodiscard]] nlohmann::ordered_json json_of(const Plan& plan);

/// Reads what json_of() made. Throws an error that names the member at fault: whatever a plan says is safe to
/// use.
[[nodiscard]] Plan plan_of(const Members& fields);

/// Reads it from a file. Throws an error that names that too.
[[nodiscard]] Plan read_plan(const std::filesystem::path& file);

/// Throws InputError where the folder of a cache that is to be read is not there, or is none.
void check_cache(const std::filesystem::path& folder);

/// The checksum of a scene and all files that it names; large ones that are as `before` are not read. Puts
/// these into `files`. Throws an error that names the file.
[[nodiscard]] std::uint64_t checksum_of(const Scene& scene, const std::vector<PlanFile>& before,
                                        std::vector<PlanFile>& files);

}  // namespace goffer::cli
