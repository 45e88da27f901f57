// SPDX-License-Identifier: MIT
#pragma once

#include "arguments.hpp"
#include "command_line.hpp"
#include "refine.hpp"
#include "report.hpp"

#include <goffer/bend/socket.hpp>
#include <goffer/fit/bind.hpp>
#include <goffer/mesh/mesh.hpp>
#include <goffer/paper/base.hpp>

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

/// From a file to a body: what every command does with its models first.

namespace goffer::cli {

/// Words on how models are fitted.
struct FitWords {
    std::string axis = "auto";
    std::string rest = "auto";
    std::size_t arcs = 0;  ///< of the chain that the body is bent along at rest; 0: nobody says
};

/// Words on how models are read, fitted and bound.
struct BindWords {
    mesh::LoadOptions load = {};
    std::optional<std::string> folds = {};
    std::optional<double> fold_length = {};
    std::string amplitude = "mesh";
    std::string profile = "even";
    std::optional<double> roundness = {};  ///< of the crests of the profile `even` alone
    std::string shape = "auto";
    std::string joints = "over";
    bool paper = false;  ///< as the paper has it
    std::optional<std::string> wrinkle_range = {};
    std::optional<std::string> wrinkle_mask = {};  ///< a channel of the vertex colors
    FitWords fit = {};
    std::optional<double> onset = {};
    std::string refine = "off";  ///< split edges until the mesh carries the folds: auto, on, off
    std::size_t level = 0;       ///< of a body file
    /// The options of all these but `load` and `level`: a body file has no use for one that is said.
    std::vector<const CLI::Option*> choices = {};
};

/// Adds --level, for a body file in the place of a model. `level` must outlive `command`.
void add_level_word(CLI::App& command, std::size_t& level);

/// Adds --allow-outside and --max-memory: what is read of a model. `options` must outlive `command`.
void add_load_words(CLI::App& command, mesh::LoadOptions& options);

/// Adds --axis, --rest and --arcs: how a model is fitted. `words` must outlive `command`.
void add_fit_words(CLI::App& command, FitWords& words);

/// Adds --folds, --fold-length, --amplitude, --profile, --roundness, --shape, --joints, --paper,
/// --wrinkle-range, --wrinkle-mask, --onset, and those of add_fit_words() and add_load_words(). `words` must
/// outlive `command`.
void add_bind_words(CLI::App& command, BindWords& words);

/// Adds --refine, which is `usual` where nobody says. `words` must outlive `command`.
void add_refine_word(CLI::App& command, BindWords& words, const std::string& usual);

/// Such words, understood. Throws UsageError.
struct BindRequest {
    BindWords words;  ///< with those that --paper stands for
    std::optional<glm::dvec3> axis;
    fit::RestPose rest;
    fit::BindOptions options;
    std::string refine;
    std::optional<int> mask_channel;  ///< of the vertex colors, 0..3: Geometry::wrinkle_mask
    bool with_uvs = false;            ///< a vertex of the body for each texture coordinate of a vertex

    /// `regions`: as PoseRequest's; none for a body of one region, or of as many as it has arcs at rest.
    explicit BindRequest(const BindWords& said, std::vector<fit::RegionOptions> regions = {});

    /// For commands that pose one region where none are said: a body is not bent along a chain of arcs unless
    /// it is said of how many.
    [[nodiscard]] BindRequest with_one_arc() const {
        BindRequest request = *this;
        if (request.rest == fit::RestPose::chain && words.fit.arcs == 0)
            request.rest = fit::RestPose::automatic;
        return request;
    }
};

/// A socket of a body file.
struct FileSocket {
    std::string name;
    bend::Socket socket;
};

/// A model read, fitted, refined where that was asked for, and bound. Vertex i of the body is record
/// binding.order[i], or i where that is empty.
struct BoundModel {
    std::filesystem::path file;
    mesh::Mesh mesh;
    mesh::VertexArrays rest;
    std::vector<float> wrinkle_mask = {};  ///< as fit::Geometry's, of the entries of `rest`
    fit::Cylinder cylinder;                ///< the base that it is bound to
    fit::Binding binding;
    std::optional<Growth> growth = {};  ///< where the mesh was refined, or was to be with --refine on
    /// It comes from a body file: of its binding only the body, its cylinder without radii, and the regions'
    /// lengths and folds are there; of its mesh what is drawn.
    bool baked = false;
    std::vector<FileSocket> sockets = {};
};

/// The arrays as fit reads them, without a mask. They must outlive the geometry.
[[nodiscard]] fit::Geometry geometry_of(const mesh::VertexArrays& arrays);

/// The model at rest, with its mask. It must outlive the geometry.
[[nodiscard]] fit::Geometry geometry_of(const BoundModel& model);

/// Reads `file`, with neither cylinder nor binding; says so on a terminal where that takes long. Throws an
/// error that names it.
[[nodiscard]] BoundModel read_model(const std::filesystem::path& file, const BindRequest& request);

/// Reads, fits, refines and binds `file`; says so on a terminal where that takes long. `fit`: a report that
/// the cylinder is taken from, or empty. Throws an error that names the file at fault.
[[nodiscard]] BoundModel bind_model(const std::filesystem::path& file, const BindRequest& request,
                                    const std::filesystem::path& fit = {});

/// The same of a model that read_model() returned, or that was made in memory.
[[nodiscard]] BoundModel bind_mesh(BoundModel model, const BindRequest& request,
                                   const std::filesystem::path& fit = {});

/// The base model as a mesh of one part.
[[nodiscard]] mesh::Mesh mesh_of(const paper::BaseMesh& base);

/// Values in the body's order, put into the model's.
template <class T>
void put_in_model_order(std::vector<T>& values, const fit::Binding& binding) {
    if (binding.order.empty() || values.empty()) return;
    std::vector<T> sorted(values.size());
    for (std::size_t i = 0; i < binding.order.size(); ++i) sorted[binding.order[i]] = values[i];
    values = std::move(sorted);
}

/// Warns of a mask that is the same everywhere, of folds that the mesh cannot carry, of those that are
/// missing for want of rows, and of those that reach past the axis when regions are bent by `angles`
/// (radians, >= 0; one per region). `where` begins each warning: empty, or which of several models is meant.
/// Returns whether a region has too few folds to keep the area.
bool warn_of_folds(Report& report, const BindRequest& request, const BoundModel& model,
                   std::span<const double> angles, const std::string& where = {});

}  // namespace goffer::cli
