// SPDX-License-Identifier: MIT
#pragma once

#include "cache/members.hpp"
#include "cache/scene.hpp"

#include <goffer/io/named_files.hpp>

/// The parts that a scene is read in.

namespace goffer::cli {

/// Reads one entry of "instances". `scene` has its bodies and motions; `files` finds what it names.
[[nodiscard]] SceneGroup read_group(const Members& fields, const Scene& scene, const io::NamedFiles& files);

/// The file that a member names. Throws where it may not be read.
[[nodiscard]] std::filesystem::path named_file(const Members& fields, const char* name,
                                               const io::NamedFiles& files);

}  // namespace goffer::cli
