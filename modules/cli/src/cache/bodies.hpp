// SPDX-License-Identifier: MIT
#pragma once

#include "cache/scene.hpp"

#include <goffer/mesh/mesh.hpp>

#include <string>

namespace goffer::cli {

/// The body file of one of a scene's bodies: its own bytes, or its model bound as `goffer bake` does with the
/// options that the scene says. Throws an error that names the file, or the option and the scene.
[[nodiscard]] std::string body_bytes(const Scene& scene, const SceneBody& body,
                                     const mesh::LoadOptions& options);

}  // namespace goffer::cli
