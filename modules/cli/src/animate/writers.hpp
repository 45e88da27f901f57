// SPDX-License-Identifier: MIT
#pragma once

#include "animate/moving_model.hpp"
#include "animate/pattern.hpp"
#include "looks.hpp"
#include "report.hpp"

#include <goffer/clip/gltf.hpp>
#include <goffer/io/atomic_file.hpp>
#include <goffer/view/picture.hpp>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

/// What an animation is written to.

namespace goffer::cli {

/// What was found in all frames before any is written.
struct Survey {
    double area_before = 0;
    double worst_area_change = 0;      ///< a fraction, of the frame where it is largest, with its sign
    std::size_t worst_frame = 0;       ///< which that is, from 0
    std::vector<double> largest;       ///< of each region, the angle that it is bent by at most, radians
    std::size_t clamped = 0;           ///< frames in which a region was asked to bend further than it can
    std::size_t beyond_full_turn = 0;  ///< frames in which it bends by more than a full turn
    double path_error = 0;             ///< the largest
    double milliseconds = 0;           ///< to deform a frame; the median
    view::Camera camera;               ///< in which also_seen is `seen`
    std::vector<glm::vec3> seen;  ///< view::deciding_points() of all frames; none where no picture is made
};

/// All that a writer may need. What it refers to is the command's.
struct Animation {
    MovingModel& frames;
    const Survey& survey;
    const std::filesystem::path& output;
    const std::optional<Pattern>& pattern;
    const view::Settings& picture;
    const mesh::Limits& limits;
    const clip::GltfOptions& gltf;
    bool max_error_asked = false;  ///< by its option, rather than being usual
    int threads = 1;
    io::AtomicFiles& outputs;  ///< for what is one file; those of a sequence take their places one by one
    Report& report;
};

/// One way of writing: files of these endings, one for each frame or one for all. Beside what all have, each
/// reports what is its own.
struct Writer {
    std::vector<std::string> endings;
    bool sequence = false;
    std::string what;  ///< for a person
    void (*write)(Animation& animation) = nullptr;
};

/// All there are.
[[nodiscard]] const std::vector<Writer>& writers();

/// The one for `output`, which has a pattern or not. Throws UsageError where there is none.
[[nodiscard]] const Writer& writer_for(const std::filesystem::path& output, bool pattern);

/// The functions of writers().
void write_models(Animation& animation);
void write_pictures(Animation& animation);
void write_gltf(Animation& animation);
/// A point cache and, where the model was refined or its file is none that programs import vertex by vertex,
/// mesh_beside(): the mesh that the cache moves.
void write_mdd(Animation& animation);
void write_pc2(Animation& animation);
void write_vertex_texture(Animation& animation);

[[nodiscard]] std::filesystem::path mesh_beside(const std::filesystem::path& cache);

/// How many frames may be in memory at a time beside the model: at most one per thread, and as many as the
/// limit of memory has room for; at least one.
[[nodiscard]] int frames_at_a_time(const BoundModel& model, const mesh::Limits& limits, int threads);

}  // namespace goffer::cli
