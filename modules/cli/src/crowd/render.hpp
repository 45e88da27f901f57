// SPDX-License-Identifier: MIT
#pragma once

#include "crowd/crowd.hpp"
#include "model.hpp"
#include "textures.hpp"

#include <goffer/view/picture.hpp>

#include <cstddef>
#include <filesystem>
#include <span>

namespace goffer::cli {

/// Renders what the crowd's memory holds, seen from above its front edge, and writes a PNG, which `outputs`
/// puts in its place. A large crowd is shown by the middle of its front: at most 400 instances and about 4
/// million triangles. `models`: those of the crowd, and the textures of each. Returns how many instances
/// there are in the picture.
std::size_t write_crowd_picture(const Crowd& crowd, std::span<const BoundModel> models,
                                std::span<const Textures> textures, const view::Settings& settings,
                                const std::filesystem::path& file, io::AtomicFiles& outputs);

}  // namespace goffer::cli
