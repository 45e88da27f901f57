// SPDX-License-Identifier: MIT
#pragma once

#include "arguments.hpp"
#include "report.hpp"

#include <goffer/fit/bind.hpp>
#include <goffer/fit/refine.hpp>
#include <goffer/mesh/mesh.hpp>

#include <glm/vec3.hpp>
#include <nlohmann/json.hpp>

#include <cstddef>
#include <functional>
#include <vector>

/// A model with the vertices that its folds need: `goffer refine`, and `--refine` of other commands.

namespace goffer::cli {

/// How a mesh grew.
struct Growth {
    int folds = 0;  ///< that it was refined for, as their profile counts them, in all regions together
    std::size_t vertices_before = 0, vertices_after = 0;
    std::size_t triangles_before = 0, triangles_after = 0;
    std::vector<glm::vec3> normals = {};  ///< of its vertices, where it grew and has none of its own

    [[nodiscard]] bool grew() const { return triangles_after != triangles_before; }
};

/// Cuts `mesh` until it carries the folds of `options` on `cylinder`, region by region, or the number that
/// suits the body where nobody says. `sparing`: leaves a mesh as it is that would get more than a million
/// triangles. `progress` is as fit::RefineOptions'. Throws what fit and mesh throw, also where the result
/// would be beyond `limits`.
Growth refine(mesh::Mesh& mesh, const fit::Cylinder& cylinder, const fit::BindOptions& options,
              const mesh::Limits& limits, bool sparing, const std::function<void(double)>& progress = {});

/// Whether refine() adds vertices, if it is `sparing`. Throws likewise.
[[nodiscard]] bool adds_vertices(const mesh::Mesh& mesh, const fit::Cylinder& cylinder,
                                 const fit::BindOptions& options, const mesh::Limits& limits);

/// The growth, as a line and as "refined" in `json`: the report's, or that of a model in it. Warns where
/// there was no fold to refine for.
void report_growth(Report& report, const Growth& growth, nlohmann::ordered_json& json);
inline void report_growth(Report& report, const Growth& growth) {
    report_growth(report, growth, report.json);
}

}  // namespace goffer::cli
