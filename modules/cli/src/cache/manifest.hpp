// SPDX-License-Identifier: MIT
#pragma once

#include "cache/baker.hpp"
#include "cache/plan.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace goffer::cli {

/// What a whole cache consists of.
struct Manifest {
    Plan plan;
    std::vector<ShardFile> shards;
};

/// Writes the manifest into `folder`, unless it is there already. Throws io::Error.
void write_manifest(const std::filesystem::path& folder, const Manifest& manifest);

/// Reads the manifest of a folder. Throws an error that names it where it is missing or cannot be one.
[[nodiscard]] Manifest read_manifest(const std::filesystem::path& folder);

/// Returns the shards and bodies in a folder that the plan does not have, in order, their names relative to
/// the folder.
[[nodiscard]] std::vector<std::string> strays_in(const std::filesystem::path& folder, const Plan& plan);

}  // namespace goffer::cli
