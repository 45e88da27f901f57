// SPDX-License-Identifier: MIT
#pragma once

#include <goffer/mesh/mesh.hpp>

#include <glm/mat4x3.hpp>
#include <glm/vec3.hpp>
#include <nlohmann/json.hpp>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

/// A crowd over time, as a document says it. samples/farm/README.md, "The scene", has all that may be in it.

namespace goffer::cli {

/// The most instances that a scene may have.
inline constexpr std::uint64_t most_instances = 10'000'000;

struct SceneBody {
    std::string name;
    std::filesystem::path file;
    std::size_t level = 0;                              ///< of a body file
    nlohmann::json options = nlohmann::json::object();  ///< how a model is bound
};

struct SceneMotion {
    std::string name;
    nlohmann::json document;  ///< what read_motion() takes
    std::string where;        ///< begins its errors
};

/// An entry of "instances": one instance, or several that are made alike.
struct SceneGroup {
    std::string where;  ///< begins errors
    std::uint64_t first = 0, count = 1;
    std::vector<std::size_t> bodies;   ///< in turn, at least one
    std::vector<std::size_t> motions;  ///< in turn; none: `poses`, or at rest
    std::filesystem::path poses;       ///< a NumberFile of frames x count x regions x (angle, direction)
    std::filesystem::path transforms;  ///< a NumberFile of count x 12, or frames x count x 12
    glm::dmat4x3 place{1.0};           ///< of all of them
    std::uint64_t columns = 1;         ///< of a grid
    glm::dvec3 right{0.0}, back{0.0};  ///< from a column and a row of it to the next
    double offset = 0, stagger = 0, scatter = 0;  ///< seconds: of all; from each to the next; spread over
    double speed = 1;
    float weight = 1;
};

/// A scene's document, understood. Motions have been read, and models as far as the names of their buffers;
/// whether the other files exist has not been looked at.
struct Scene {
    std::filesystem::path file;
    double fps = 0;
    std::uint64_t frames = 0, instances = 0;
    std::vector<SceneBody> bodies;
    std::vector<SceneMotion> motions;
    std::vector<SceneGroup> groups;            ///< in order of their instances
    std::vector<std::filesystem::path> files;  ///< all that it and its glTF files name
};

/// Reads a scene. `options`: whether the files that it names may lie outside its folder. Throws an error that
/// names the file.
[[nodiscard]] Scene read_scene(const std::filesystem::path& file, const mesh::LoadOptions& options);

/// The group of instance `index` < scene.instances.
[[nodiscard]] const SceneGroup& group_of(const Scene& scene, std::uint64_t index);

/// Where instance `index` of a group stands, but for its `transforms`.
[[nodiscard]] glm::dmat4x3 place_in(const SceneGroup& group, std::uint64_t index);

/// The seconds of its motion that instance `index` of a group begins at.
[[nodiscard]] double offset_in(const SceneGroup& group, std::uint64_t index);

}  // namespace goffer::cli
