// SPDX-License-Identifier: MIT
#include "animate/writers.hpp"
#include "picture.hpp"
#include "progress.hpp"
#include "textures.hpp"

#include <tbb/parallel_pipeline.h>
#include <tbb/task_arena.h>

/// A file for each frame.

namespace goffer::cli {
namespace {

/// Calls write(frame) for all frames, of `at_a_time` frames at once.
template <class Write>
void for_frames(std::size_t frames, int at_a_time, Write write) {
    std::size_t next = 0;
    const auto source = tbb::make_filter<void, std::size_t>(tbb::filter_mode::serial_in_order,
                                                            [&](tbb::flow_control& control) {
                                                                if (next == frames) control.stop();
                                                                return next == frames ? frames : next++;
                                                            });
    const auto sink = tbb::make_filter<std::size_t, void>(tbb::filter_mode::parallel, [&](std::size_t frame) {
        tbb::this_task_arena::isolate([&] { write(frame); });
    });
    tbb::parallel_pipeline(static_cast<std::size_t>(at_a_time), source & sink);
}

}  // namespace

void write_models(Animation& animation) {
    const MovingModel& frames = animation.frames;
    const BoundModel& model = frames.model();
    Progress progress("writing frames", frames.count());
    const int at_a_time = frames_at_a_time(model, animation.limits, animation.threads);
    tbb::task_arena(animation.threads).execute([&] {
        for_frames(frames.count(), at_a_time, [&](std::size_t frame) {
            const std::filesystem::path file = animation.pattern->file(frame);
            mesh::save(mesh::with_vertex_arrays(model.mesh, frames.records(frame)), file);
            progress.advance();
        });
    });
}

void write_pictures(Animation& animation) {
    const MovingModel& frames = animation.frames;
    const BoundModel& model = frames.model();
    const std::vector<glm::vec4> colors = vertex_colors(model.mesh, model.rest, plain_color(0));
    const Textures textures = textures_of(model.mesh, animation.limits);
    for (const std::string& warning : textures.warnings) animation.report.warn(warning);
    const PictureTextures pictured(textures);
    view::Camera camera = animation.survey.camera;
    camera.also_seen = animation.survey.seen;
    Progress progress("rendering frames", frames.count());
    tbb::task_arena(animation.threads).execute([&] {
        for (std::size_t frame = 0; frame < frames.count(); ++frame) {
            const mesh::VertexArrays records = frames.records(frame);
            const view::Model bent{.positions = records.positions,
                                   .triangles = records.triangles,
                                   .normals = records.normals,
                                   .colors = colors};
            const std::vector<view::Model> parts = part_models(model.mesh, bent, pictured, bent.color);
            const std::filesystem::path file = animation.pattern->file(frame);
            view::save_png(view::render(parts, camera, animation.picture), file);
            progress.advance();
        }
    });
}

}  // namespace goffer::cli
