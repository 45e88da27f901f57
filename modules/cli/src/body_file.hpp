// SPDX-License-Identifier: MIT
#pragma once

#include "model.hpp"

#include <goffer/bend/body_file.hpp>

#include <filesystem>
#include <vector>

/// Body files in the place of models, and what `goffer bake` notes in them.

namespace goffer::cli {

/// Whether `file` can be read and begins as a body file does.
[[nodiscard]] bool is_body_file(const std::filesystem::path& file);

/// Refuses (InputError) a body file where only a model will do.
void refuse_body_file(const std::filesystem::path& file);

/// Reads a body file of at most `limits.memory`. Throws an error that names it.
[[nodiscard]] bend::BodyFile read_body_file(const std::filesystem::path& file, const mesh::Limits& limits);

/// The regions of the body in a body file, where it has several; none of any other file.
[[nodiscard]] std::vector<fit::RegionOptions> baked_regions(const std::filesystem::path& file,
                                                            const mesh::Limits& limits);

/// What bind_model() returns for a body file. Throws UsageError if the words ask for what was decided when
/// it was made, and an error that names the file if it cannot be loaded.
[[nodiscard]] BoundModel baked_model(const std::filesystem::path& file, const BindRequest& request);

/// What `goffer bake` says in a file about how it was made, as JSON.
[[nodiscard]] nlohmann::ordered_json notes_of(const BoundModel& model, const BindRequest& request);

/// The same, read back: an object, which is empty if the file says something else. Nothing in it can be
/// relied on.
[[nodiscard]] nlohmann::ordered_json read_notes(const bend::BodyFile& file);

}  // namespace goffer::cli
