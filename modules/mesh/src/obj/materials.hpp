// SPDX-License-Identifier: MIT
#pragma once

#include "budget.hpp"

#include <goffer/mesh/mesh.hpp>

#include <cstdint>
#include <filesystem>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace goffer::mesh {

/// What the text of an OBJ file says of materials, as views into it.
struct MaterialLines {
    std::vector<std::string_view> libraries;                  ///< what mtllib lines name
    std::unordered_map<std::string_view, std::int32_t> used;  ///< numbers in Mesh::materials, by name
};

/// Reads the material files that `lines` name, and gives the materials of `mesh` their colors and textures.
/// What is missing, outside or malformed is told in the warnings of `mesh`. `text` is the content of `file`.
/// Throws OverLimit.
void read_materials(const std::filesystem::path& file, std::string_view text, const MaterialLines& lines,
                    const LoadOptions& options, Budget& budget, Mesh& mesh);

/// Returns the material files that `lines` name, and the textures that these name.
[[nodiscard]] std::vector<std::filesystem::path> material_files(const std::filesystem::path& file,
                                                                std::string_view text,
                                                                const MaterialLines& lines,
                                                                const LoadOptions& options, Budget& budget);

}  // namespace goffer::mesh
