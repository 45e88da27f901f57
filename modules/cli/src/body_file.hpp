// SPDX-License-Identifier: MIT
#pragma once

#include "model.hpp"

#include <goffer/bend/body_file.hpp>

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

/// Body files in the place of models, and what `goffer bake` notes in them.

namespace goffer::cli {

/// Whether `file` is to be read as a body file: it begins as one, or its name ends as one's.
[[nodiscard]] bool is_body_file(const std::filesystem::path& file);

/// Refuses (InputError) a body file where only a model will do.
void refuse_body_file(const std::filesystem::path& file);

/// Reads a body file, which takes about four times its size. Throws where that is more than limits.memory,
/// and an error that names it.
[[nodiscard]] bend::BodyFile read_body_file(const std::filesystem::path& file, const mesh::Limits& limits);

/// A file that a command takes for a model: a body file, which is read, or a model, which has yet to be.
struct ModelFile {
    std::filesystem::path file;
    std::optional<bend::BodyFile> baked;

    /// Throws as read_body_file().
    ModelFile(std::filesystem::path name, const mesh::Limits& limits);
};

/// The regions of a body that was baked with several; none of any other file.
[[nodiscard]] std::vector<fit::RegionOptions> baked_regions(const ModelFile& model);

/// The regions of the first of `models` that has any: the others are to have as many.
[[nodiscard]] std::vector<fit::RegionOptions> baked_regions(std::span<const ModelFile> models);

/// bind_model() of a model, and the same of a body file, which is bound: throws UsageError if the words ask
/// for what was decided when it was made, and an error that names the file if it has no such level, or
/// nothing to draw.
[[nodiscard]] BoundModel bind_model(ModelFile model, const BindRequest& request,
                                    const std::filesystem::path& fit = {});

/// The body file of a model alone, which was bound with texture coordinates (BindRequest::with_uvs): what
/// `goffer bake` writes where it is given nothing else.
[[nodiscard]] std::vector<std::byte> baked_bytes(BoundModel model, const BindRequest& request);

/// What `goffer bake` notes in a file about how it was made. Nothing in it can be relied on.
struct Notes {
    struct Region {
        int folds = 0;
        int capacity = 0;  ///< 0: not known
    };
    std::string model;  ///< the name of its file
    std::string amplitude, profile;
    std::vector<Region> regions;
};

/// These notes as the text that goes into a file, and read back: what a file does not say is left empty.
[[nodiscard]] std::string text_of(const Notes& notes);
[[nodiscard]] Notes read_notes(const bend::BodyFile& file);

}  // namespace goffer::cli
