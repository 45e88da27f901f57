// SPDX-License-Identifier: MIT
#include "arguments.hpp"
#include "model.hpp"
#include "poses.hpp"
#include "require.hpp"
#include "support/files.hpp"

#include <goffer/bend/job.hpp>
#include <goffer/fit/refine.hpp>
#include <goffer/paper/base.hpp>

#include <CLI/CLI.hpp>
#include <glm/geometric.hpp>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <sstream>

/// What `goffer bend --fit` reads: the first line of the bytes is words of the command line, with spaces
/// between them; the rest is the JSON of a fit. A small mesh is bound to it as the words say, and bent.

using namespace goffer;
using namespace goffer::test;

namespace {

/// Words, read as `goffer bend` does; the defaults where they are wrong usage.
struct Words {
    cli::PoseWords pose;
    cli::BindWords bind;

    static Words read(const std::string& line) {
        Words words;
        CLI::App app;
        cli::add_pose_words(app, words.pose);
        cli::add_bind_words(app, words.bind);
        std::istringstream stream(line);
        std::vector<std::string> list;
        for (std::string word; stream >> word;)
            list.insert(list.begin(), word);  // the parser takes the last first
        try {
            app.parse(list);
            return words;
        } catch (const CLI::ParseError& error) {
            require(*error.what() != 0, "an error says what is wrong");
            return {};
        }
    }
};

/// The base cylinder itself, as floats hold it.
struct BaseMesh {
    std::vector<glm::vec3> positions;
    std::vector<std::uint32_t> triangles;

    explicit BaseMesh(const fit::Cylinder& cylinder) {
        const paper::BaseMesh base = paper::base_mesh(cylinder.length, cylinder.radius, 5, 9, true);
        const glm::dvec3 across = glm::cross(cylinder.axis, cylinder.zero);
        for (const glm::dvec3& p : base.positions)
            positions.emplace_back(cylinder.origin + p.x * cylinder.zero + p.y * across +
                                   p.z * cylinder.axis);
        triangles = base.triangles;
    }
    [[nodiscard]] fit::Geometry geometry() const { return {positions, triangles}; }
};

void deform(const bend::Body& body, const cli::PoseRequest& request) {
    const std::vector<bend::Pose> poses = cli::poses_of(cli::targets_on(body, request));
    std::vector<glm::vec3> out(body.vertex_count());
    bend::DeformJob job{.body = &body, .poses = poses};
    job.positions = interleaved<3>(&out[0].x, out.size());
    require(bend::validate(job).none(), "words that were taken make poses that are");
    bend::run(job);
    for (const glm::vec3& p : out)
        require(std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z), "positions are finite");
}

void bind_and_bend(const fit::Cylinder& cylinder, const cli::BindRequest& bind,
                   const cli::PoseRequest& pose) {
    const BaseMesh base(cylinder);
    fit::BindOptions options = bind.options;
    // What is solved for each row, for areas and for many folds takes longer than all the rest.
    options.table_rows = 3;
    if (bind.words.folds == std::nullopt) options.folds = 2;
    if (bind.words.amplitude == "mesh" && !pose.from_rest) options.amplitude = fit::Amplitude::paper;
    fit::check(base.geometry());
    (void)fit::stretches_of(cylinder, options);
    (void)fit::folds_capacity(base.geometry(), cylinder);
    const fit::Binding binding = fit::bind(base.geometry(), cylinder, options);
    deform(binding.body, pose);
}

void run(const std::string& line, const std::string& json) {
    static const Folder folder;
    const Words words = Words::read(line);
    const cli::PoseRequest pose(words.pose);
    const cli::BindRequest bind(words.bind, pose.regions);
    for (const cli::Target& target : cli::targets_from_straight(pose))
        require(std::isfinite(target.pose.angle) && std::isfinite(target.pose.direction), "poses are finite");
    bind_and_bend(cli::read_fit(folder.write("fit.json", json)), bind, pose);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static tbb::task_arena one_thread(1);
    const std::string bytes(reinterpret_cast<const char*>(data), size);
    const std::size_t line = std::min(bytes.find('\n'), bytes.size());
    try {
        one_thread.execute(
            [&] { run(bytes.substr(0, line), bytes.substr(std::min(line + 1, bytes.size()))); });
    } catch (const cli::UsageError& error) {
        require(*error.what() != 0, "an error says what is wrong");
    } catch (const cli::InputError& error) {
        require_one_line(error.what());
    } catch (const fit::Error& error) {
        require_one_line(error.what());
    }
    return 0;
}
