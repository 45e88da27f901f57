// SPDX-License-Identifier: MIT
#pragma once

#include "cache/plan.hpp"

#include <goffer/engine/isa.hpp>
#include <goffer/mesh/mesh.hpp>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

/// What `goffer cache` does: make a cache or a share of one, verify one, and take an instance out of one.

namespace goffer::cli {

/// What is not said is as the cache in the folder has it, or else as usual.
struct CacheRequest {
    std::filesystem::path scene, folder;
    std::optional<CacheFormat> format;
    std::optional<Isa> isa;
    std::optional<std::uint64_t> shard_size, shard_frames, shard_instances;
    std::uint64_t share = 1, shares = 1;  ///< shards whose number is share - 1 modulo shares
    bool whole = true;                    ///< all shards, and then the manifest
    bool prepare = false;                 ///< none of them
    int threads = 1;
    mesh::LoadOptions load;
    std::filesystem::path json;
};

/// Each of these reports, and throws an error of one line that names what is at fault.
void make_cache(const CacheRequest& request);
void verify_cache(const std::filesystem::path& folder, const std::filesystem::path& json, int threads);

/// Writes what the cache in `folder` has of an instance in a frame as a model.
struct ExtractRequest {
    std::filesystem::path folder, output;
    std::uint64_t frame = 0, instance = 0;
    mesh::LoadOptions load;
    std::filesystem::path json;
};
void extract(const ExtractRequest& request);

}  // namespace goffer::cli
