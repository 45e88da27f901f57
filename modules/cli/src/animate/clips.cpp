// SPDX-License-Identifier: MIT
#include "animate/writers.hpp"
#include "arguments.hpp"
#include "progress.hpp"

#include <goffer/clip/gltf.hpp>
#include <goffer/clip/point_cache.hpp>
#include <goffer/clip/vertex_texture.hpp>
#include <goffer/io/ending.hpp>

#include <system_error>

/// All frames in one file.

namespace goffer::cli {
namespace {

/// Counts frames as a writer reads them. Each of `passes` over all of them counts.
class CountedFrames final : public clip::Frames {
public:
    CountedFrames(clip::Frames& frames, const std::string& stage, std::size_t passes)
        : frames_(frames), progress_(stage, passes * frames.count()) {}

    [[nodiscard]] std::size_t count() const noexcept override { return frames_.count(); }
    [[nodiscard]] double rate() const noexcept override { return frames_.rate(); }
    [[nodiscard]] std::size_t vertices() const noexcept override { return frames_.vertices(); }
    [[nodiscard]] glm::mat4x3 placement(std::size_t frame) const override { return frames_.placement(frame); }
    void read(std::size_t frame, std::span<glm::vec3> positions, std::span<glm::vec3> normals) override {
        frames_.read(frame, positions, normals);
        progress_.advance();
    }

private:
    clip::Frames& frames_;
    Progress progress_;
};

/// Whether a program that imports the model's own file gets the vertices that the cache has, in their order.
bool fits_its_file(const BoundModel& model) {
    const std::string ending = io::ending_of(model.file);
    return !model.growth && (ending == ".obj" || ending == ".ply");
}

/// Writes a point cache and, unless the model's own file serves, the mesh that it moves.
template <class Save>
void write_point_cache(Animation& animation, const Save& save) {
    const BoundModel& model = animation.frames.model();
    {
        CountedFrames frames(animation.frames, "writing " + animation.output.string(), 1);
        save(frames, model.mesh.positions.size());
    }
    if (fits_its_file(model)) return;
    const std::filesystem::path mesh = mesh_beside(animation.output);
    mesh::save(model.mesh, mesh, animation.outputs);
    animation.report.json["mesh"] = mesh.string();
    animation.report.line("mesh", mesh.string() + " has the vertices that the cache moves");
}

/// What to do where frames are off by more than was asked.
const char* way_to_less(clip::GltfLimit limit) {
    switch (limit) {
        case clip::GltfLimit::targets:
            return "allow more --targets";
        case clip::GltfLimit::memory:
            return "allow more with --max-memory";
        case clip::GltfLimit::samples:
            return "shapes are sought in 1024 of the frames; make fewer frames, or several files";
        case clip::GltfLimit::rounding:
        case clip::GltfLimit::none:
            break;
    }
    return "the rest is the rounding of floats; give a larger one";
}

}  // namespace

void write_gltf(Animation& animation) {
    CountedFrames frames(animation.frames, "writing " + animation.output.string(), 0);
    clip::GltfOptions options = animation.gltf;
    options.memory = animation.limits.memory / 2;
    const clip::GltfReport done =
        clip::save_gltf(animation.frames.model().mesh, frames, options, animation.output, animation.outputs);
    for (const std::string& warning : done.warnings) animation.report.warn(warning);
    animation.report.json["gltf"] = {{"targets", done.targets},
                                     {"max_error", done.max_error},
                                     {"rms_error", done.rms_error},
                                     {"max_normal_error", degrees(done.max_angle)},
                                     {"within", done.within()}};
    animation.report.line("targets", counted(done.targets, "shape") +
                                         " that frames are blended of; off by at most " +
                                         number(done.max_error) + ", " +
                                         number(100 * done.max_error / done.size) + " % of the size");
    if (!done.within() && animation.max_error_asked)
        animation.report.warn("frames are off by up to " + number(100 * done.max_error / done.size) +
                              " % of the size, more than --max-error " + number(100 * options.max_error) +
                              ": " + way_to_less(done.limit));
}

std::filesystem::path mesh_beside(const std::filesystem::path& cache) {
    return std::filesystem::path(cache).replace_extension(".mesh.ply");
}

void write_mdd(Animation& animation) {
    write_point_cache(animation, [&](clip::Frames& frames, std::size_t vertices) {
        clip::save_mdd(frames, vertices, animation.output, animation.outputs);
    });
}

void write_pc2(Animation& animation) {
    write_point_cache(animation, [&](clip::Frames& frames, std::size_t vertices) {
        clip::save_pc2(frames, vertices, animation.output, animation.outputs);
    });
}

void write_vertex_texture(Animation& animation) {
    CountedFrames frames(animation.frames, "writing " + animation.output.string(), 2);
    const BoundModel& model = animation.frames.model();
    const clip::VertexTexture done =
        clip::save_vertex_texture(frames, model.mesh, model.rest, animation.output, animation.outputs);
    nlohmann::ordered_json files;
    std::string names;
    for (const std::filesystem::path& file : done.files) {
        files.push_back(file.string());
        names += (names.empty() ? "" : ", ") + file.filename().string();
    }
    animation.report.json["texture"] = {{"width", done.layout.width},
                                        {"height", done.layout.height},
                                        {"position_error", done.position_error},
                                        {"normal_error", degrees(done.normal_error)},
                                        {"files", files}};
    animation.report.line("texture", std::to_string(done.layout.width) + " x " +
                                         std::to_string(done.layout.height) + " pixels: " + names +
                                         "; positions within " + number(done.position_error));
}

}  // namespace goffer::cli
