// SPDX-License-Identifier: MIT
#pragma once

#include "animate/survey.hpp"
#include "animate/writers.hpp"
#include "body_file.hpp"
#include "command_line.hpp"
#include "model.hpp"
#include "motion/motion.hpp"
#include "motion/path_words.hpp"
#include "poses.hpp"

#include <memory>
#include <optional>
#include <string>

namespace goffer::cli {

/// Shapes of animated glTF where nobody says: as many as it takes for vertices to be off by no more than
/// this, a share of the model's size, but not more than these.
constexpr double usual_max_error = 5e-4;   // folds of a body that should be straight are not seen
constexpr std::size_t usual_targets = 12;  // whose folds still look right, in files of a handy size

struct AnimateOptions {
    std::filesystem::path model;
    std::filesystem::path output;
    std::filesystem::path keys;
    std::optional<std::string> swing;
    PathOptions path;
    std::optional<std::string> interpolation;
    std::optional<double> direction;
    double lag = 0;
    bool from_rest = false;
    std::optional<std::size_t> frames;
    double fps = 24;
    PoseWords pose;  ///< of these only the regions
    BindWords bind;
    std::string isa = "auto";
    int threads = 0;
    std::optional<std::string> size, camera;
    std::optional<double> max_error;  ///< of animated glTF, per cent of the size
    std::optional<std::size_t> targets;
    std::filesystem::path json;
};

/// Adds what says how a body moves. `options` must outlive `command`.
void add_motion_words(CLI::App& command, AnimateOptions& options);

/// Such words, understood, and the files of keys and paths. Throws before any work is done.
struct AnimateRequest {
    nlohmann::json document;  ///< of the motion, but for the seconds of a swing or a walk
    std::vector<fit::RegionOptions> regions;
    std::unique_ptr<const Motion> motion;
    std::size_t frames = 0;
    std::optional<Pattern> pattern;
    const Writer* writer = nullptr;
    std::optional<SurveyView> pictures;
    view::Settings picture;
    clip::GltfOptions gltf;
    bool gltf_wanted = false;
    bool with_uvs = false;  ///< see BindRequest: engines draw vertex-animation textures with them

    AnimateRequest(const AnimateOptions& options, const ModelFile& file);

private:
    void read_outputs(const AnimateOptions& options);
    void check_files(const AnimateOptions& options) const;
    void read_document(const AnimateOptions& options);
    void read_motion_of(const AnimateOptions& options);
    /// 1 where the first frame is wanted again at the end: players of glTF begin anew at the last key.
    [[nodiscard]] std::size_t closing_frame() const { return gltf_wanted && motion->repeats() ? 1 : 0; }
};

}  // namespace goffer::cli
