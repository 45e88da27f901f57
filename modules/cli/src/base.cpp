// SPDX-License-Identifier: MIT
#include "commands.hpp"
#include "memory.hpp"
#include "model.hpp"
#include "report.hpp"

#include <goffer/io/atomic_file.hpp>
#include <goffer/mesh/mesh.hpp>
#include <goffer/paper/base.hpp>

#include <CLI/CLI.hpp>

#include <cstdint>
#include <memory>

namespace goffer::cli {
namespace {

struct BaseOptions {
    double length = 10;
    double radius = 1;
    std::uint32_t columns = 64;
    std::uint32_t rows = 161;
    bool caps = false;
    std::filesystem::path output;
    std::filesystem::path json;
    mesh::Limits limits;
};

void check(const BaseOptions& options) {
    const std::uint64_t vertices = static_cast<std::uint64_t>(options.columns) * options.rows;
    if (memory_for(vertices, 2 * vertices) > options.limits.memory) {
        throw UsageError("--columns, --rows: " + std::to_string(vertices) + " vertices take more than the " +
                         io::size_text(options.limits.memory) +
                         " of memory that are allowed; use fewer, or allow more with --max-memory");
    }
}

void run_base(const BaseOptions& options) {
    check(options);
    check_places({}, {{"-o", options.output}, {"--json", options.json}});
    check_model_output(options.output);
    Report report(options.json);
    const paper::BaseMesh base =
        paper::base_mesh(options.length, options.radius, options.columns, options.rows, options.caps);
    const mesh::Mesh mesh = mesh_of(base);
    io::AtomicFiles outputs;
    mesh::save(mesh, options.output, outputs);

    report.json["file"] = options.output.string();
    report.json["vertices"] = mesh.positions.size();
    report.json["triangles"] = mesh.faces.size();
    report.line("written", options.output.string());
    report.line("mesh", std::to_string(mesh.positions.size()) + " vertices, " +
                            std::to_string(mesh.faces.size()) + " triangles");
    report.finish(outputs);
}

}  // namespace

void add_base(CLI::App& app, Action& action) {
    const auto options = std::make_shared<BaseOptions>();
    CLI::App* command = app.add_subcommand(
        "base", "Write the base model: a bare cylinder along z, its base end at the origin");
    const CLI::Validator size = number_within(1e-30, 1e30, "a size");  // what floats carry
    command->add_option("--length", options->length, "Make it this long")->check(size)->capture_default_str();
    command->add_option("--radius", options->radius, "Give it this radius")
        ->check(size)
        ->capture_default_str();
    command->add_option("--columns", options->columns, "Put this many vertices around it")
        ->check(CLI::Range(3u, 1000000u))
        ->capture_default_str();
    command
        ->add_option("--rows", options->rows, "Put this many rings of vertices along it, both ends included")
        ->check(CLI::Range(2u, 10000000u))
        ->capture_default_str();
    command->add_flag("--caps", options->caps, "Close both ends");
    command
        ->add_option("-o,--output", options->output, "Write the model here: .glb, .gltf, .obj, .ply or .stl")
        ->required();
    add_json_word(*command, options->json);
    add_memory_word(*command, options->limits);
    command->callback([options, &action] { action = [options] { run_base(*options); }; });
}

}  // namespace goffer::cli
