// SPDX-License-Identifier: MIT
#include "band.hpp"

#include <tbb/task_arena.h>

#include <algorithm>
#include <string>

namespace goffer::view {
namespace {

constexpr int band_rows = 256;  // what is held of a picture, beside its pixels

void check(const Settings& settings) {
    if (settings.width < 1 || settings.height < 1 || settings.width > largest_side ||
        settings.height > largest_side)
        throw Error("a picture cannot be " + std::to_string(settings.width) + " x " +
                    std::to_string(settings.height) + " pixels; give 1 to " + std::to_string(largest_side) +
                    " each");
    if (settings.samples < 1 || settings.samples > most_samples)
        throw Error("a pixel cannot have " + std::to_string(settings.samples) + " samples; give 1 to " +
                    std::to_string(most_samples));
}

}  // namespace

Picture render(std::span<const Model> models, const Camera& camera, const Settings& settings) {
    check(settings);
    const Scene scene(models, camera.also_seen);
    View view = frame(camera, scene.points(), static_cast<float>(settings.width) / settings.height);
    view.pixel = {2.0f / settings.width, 2.0f / settings.height};

    Picture picture{settings.width, settings.height, {}};
    picture.rgb.resize(std::size_t{3} * settings.width * settings.height);
    tbb::this_task_arena::isolate([&] {
        for (int first = 0; first < settings.height; first += band_rows) {
            const int last = std::min(first + band_rows, settings.height);
            Band(scene, view, settings, first, last).render(picture);
            if (settings.progress) settings.progress(static_cast<double>(last) / settings.height);
        }
    });
    return picture;
}

std::vector<glm::vec3> deciding_points(const Camera& camera, std::span<const glm::vec3> points,
                                       const Settings& settings) {
    check(settings);
    return deciding_points(camera, points, static_cast<float>(settings.width) / settings.height);
}

}  // namespace goffer::view
