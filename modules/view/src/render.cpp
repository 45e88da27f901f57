// SPDX-License-Identifier: MIT
#include "shading.hpp"

#include <glm/common.hpp>
#include <tbb/blocked_range2d.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace goffer::view {
namespace {

constexpr int largest = 16384;  // pixels along a side
constexpr int tile = 16;

void check(const Settings& settings) {
    if (settings.width < 1 || settings.height < 1 || settings.width > largest || settings.height > largest)
        throw Error("a picture cannot be " + std::to_string(settings.width) + " x " +
                    std::to_string(settings.height) + " pixels; give 1 to " + std::to_string(largest) +
                    " each");
    if (settings.samples < 1 || settings.samples > largest)
        throw Error("a pixel cannot have " + std::to_string(settings.samples) + " samples; give 1 to " +
                    std::to_string(largest));
}

// `dither`, 0..1, decides where to round up, which hides the steps of faint gradients.
std::uint8_t to_srgb(float linear, float dither) {
    const float c = std::isfinite(linear) ? std::clamp(linear, 0.0f, 1.0f) : 0.0f;
    const float s = c <= 0.0031308f ? 12.92f * c : 1.055f * std::pow(c, 1 / 2.4f) - 0.055f;
    return static_cast<std::uint8_t>(std::min(255.0f, 255 * s + dither));
}

std::uint32_t pixel_index(const Settings& settings, int x, int y) {
    return static_cast<std::uint32_t>(y * settings.width + x);
}

glm::vec3 pixel(const Scene& scene, const View& view, const Settings& settings, int x, int y,
                std::vector<Hit>& hits) {
    const glm::vec2 size(settings.width, settings.height);
    glm::vec3 sum(0);
    for (int i = 0; i < settings.samples; ++i) {
        Sampler sampler(pixel_index(settings, x, y), static_cast<std::uint32_t>(i));
        const glm::vec2 at = (glm::vec2(x, y) + sampler.next()) / size;
        sum += shade(scene, view, glm::vec2(2 * at.x - 1, 1 - 2 * at.y), sampler, hits);
    }
    return sum / static_cast<float>(settings.samples);
}

void fill(const Scene& scene, const View& view, const Settings& settings, Picture& picture,
          const tbb::blocked_range2d<int>& range) {
    std::vector<Hit> hits;
    for (int y = range.rows().begin(); y < range.rows().end(); ++y)
        for (int x = range.cols().begin(); x < range.cols().end(); ++x) {
            const glm::vec3 color = pixel(scene, view, settings, x, y, hits);
            const std::size_t at = (static_cast<std::size_t>(y) * settings.width + x) * 3;
            const float dither = Sampler(pixel_index(settings, x, y), 0).next().x;
            for (int c = 0; c < 3; ++c) picture.rgb[at + c] = to_srgb(color[c], dither);
        }
}

}  // namespace

Picture render(std::span<const Model> models, const Camera& camera, const Settings& settings) {
    check(settings);
    const Scene scene(models);
    const View view = frame(camera, scene.points(), static_cast<float>(settings.width) / settings.height);

    Picture picture{settings.width, settings.height, {}};
    picture.rgb.resize(std::size_t{3} * settings.width * settings.height);
    tbb::this_task_arena::isolate([&] {
        tbb::parallel_for(tbb::blocked_range2d<int>(0, settings.height, tile, 0, settings.width, tile),
                          [&](const auto& range) { fill(scene, view, settings, picture, range); });
    });
    return picture;
}

}  // namespace goffer::view
