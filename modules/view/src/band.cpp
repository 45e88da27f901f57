// SPDX-License-Identifier: MIT
#include "band.hpp"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace goffer::view {
namespace {

constexpr int steps[] = {1, 2, 4};  // between the pixels that are smoothed over, pass after pass
static_assert(steps[0] + steps[1] + steps[2] + 1 == Band::reach);  // and a neighbor of the last
constexpr float edge_cosine = 0.9f;  // of the angle between normals, below which there is an edge
constexpr float edge_offset = 2;     // of a surface from its neighbor's plane, in pixels
constexpr float seam = 3;            // steps of texture coordinates to a neighbor, beyond which there is one

// `dither`, 0..1, decides where to round up, which hides the steps of faint gradients.
std::uint8_t to_srgb(float linear, float dither) {
    const float c = std::isfinite(linear) ? std::clamp(linear, 0.0f, 1.0f) : 0.0f;
    return static_cast<std::uint8_t>(std::min(255.0f, 255 * encoded_of(c) + dither));
}

float to_eighth(float x) {
    x *= x;
    x *= x;
    return x * x;
}

}  // namespace

Band::Band(const Scene& scene, const View& view, const Settings& settings, int first, int last)
    : scene_(scene),
      view_(view),
      settings_(settings),
      first_(first),
      last_(last),
      top_(std::max(first - reach, 0)),
      bottom_(std::min(last + reach, settings.height)),
      rays_(static_cast<std::uint32_t>(std::max(settings.samples / 8, 1))),
      seen_(static_cast<std::size_t>(bottom_ - top_) * static_cast<std::size_t>(settings.width)),
      lights_(seen_.size()),
      smooth_(seen_.size()) {}

glm::vec2 Band::place_of(const glm::vec2& pixel) const {
    const glm::vec2 at = pixel / glm::vec2(settings_.width, settings_.height);
    return {2 * at.x - 1, 1 - 2 * at.y};
}

void Band::look(int x, int y, std::vector<Hit>& hits) {
    Seen& seen = seen_[index(x, y)];
    Ray ray = view_.ray(place_of(glm::vec2(x, y) + 0.5f));
    if (const auto hit = scene_.solid(ray)) {
        const Surface surface = scene_.surface(*hit, ray);
        Sampler sampler(number_of(x, y), 0);
        seen.solid = true;
        seen.hit = *hit;
        seen.position = surface.position;
        seen.normal = surface.normal;
        seen.uv = surface.uv;
        seen.uv_step = surface.uv_step;
        lights_[index(x, y)] = light_at(scene_, view_, surface, -ray.direction, sampler, rays_);
        ray.length = hit->distance;
    }
    scene_.ghosts(ray, hits);
    seen.ghosts = static_cast<std::uint32_t>(hits.size());
}

/// How far a point is from the plane of what was seen, in pixels there.
float Band::off_plane(const Seen& of, const glm::vec3& position) const {
    const float pixel =
        glm::dot(of.position - view_.eye, view_.forward) * 2 * view_.tangent.y / settings_.height;
    return std::abs(glm::dot(of.normal, position - of.position)) / std::max(pixel, 1e-9f);
}

/// Whether a point with that normal is on the surface that was seen.
bool Band::same_surface(const Seen& of, const glm::vec3& normal, const glm::vec3& position) const {
    return glm::dot(of.normal, normal) >= edge_cosine && off_plane(of, position) <= edge_offset;
}

/// Light of the pixel and of those around it that show the same surface (an "a-trous" pass, Dammertz et al.
/// 2010).
Light Band::smoothed(int x, int y, int step) const {
    const Seen& own = seen_[index(x, y)];
    if (!own.solid) return {};
    float sum = 0;
    Light light{0, 0};
    for (int dy = -step; dy <= step; dy += step) {
        for (int dx = -step; dx <= step; dx += step) {
            if (!inside(x + dx, y + dy)) continue;
            const Seen& other = seen_[index(x + dx, y + dy)];
            if (!other.solid) continue;
            const float off = off_plane(own, other.position) / static_cast<float>(step);
            const float alike = to_eighth(std::max(0.0f, glm::dot(own.normal, other.normal)));
            const float weight = (dx == 0 ? 2.0f : 1.0f) * (dy == 0 ? 2.0f : 1.0f) * alike / (1 + off * off);
            const Light& its = lights_[index(x + dx, y + dy)];
            light.key += weight * its.key;
            light.sky += weight * its.sky;
            sum += weight;
        }
    }
    return sum > 0 ? Light{light.key / sum, light.sky / sum} : lights_[index(x, y)];
}

void Band::smooth(int step) {
    tbb::parallel_for(top_, bottom_, [&](int y) {
        for (int x = 0; x < settings_.width; ++x) smooth_[index(x, y)] = smoothed(x, y, step);
    });
    lights_.swap(smooth_);
}

bool Band::at_edge(int x, int y) const {
    const Seen& own = seen_[index(x, y)];
    constexpr int around[4][2] = {{1, 0}, {-1, 0}, {0, 1}, {0, -1}};
    return std::ranges::any_of(around, [&](const int(&step)[2]) {
        if (!inside(x + step[0], y + step[1])) return false;
        const Seen& other = seen_[index(x + step[0], y + step[1])];
        if (own.solid != other.solid || own.ghosts != other.ghosts) return true;
        return own.solid &&
               (own.hit.model != other.hit.model || !same_surface(own, other.normal, other.position) ||
                glm::distance(own.uv, other.uv) > seam * (own.uv_step + other.uv_step));
    });
}

/// The light of the pixel nearby that shows the same surface; where none does, new rays find it.
Light Band::light_near(int x, int y, const Surface& surface, const glm::vec3& to_eye,
                       Sampler& sampler) const {
    const Light* best = nullptr;
    float least = std::numeric_limits<float>::infinity();
    for (int dy = -1; dy <= 1; ++dy) {
        for (int dx = -1; dx <= 1; ++dx) {
            if (!inside(x + dx, y + dy)) continue;
            const Seen& other = seen_[index(x + dx, y + dy)];
            if (!other.solid || !same_surface(other, surface.normal, surface.position)) continue;
            const float off = off_plane(other, surface.position) - glm::dot(other.normal, surface.normal);
            if (off < least) least = off, best = &lights_[index(x + dx, y + dy)];
        }
    }
    return best != nullptr ? *best : light_at(scene_, view_, surface, to_eye, sampler, rays_);
}

glm::vec3 Band::through_ghosts(const Ray& ray, const glm::vec3& color, std::vector<Hit>& hits) const {
    scene_.ghosts(ray, hits);
    return under_ghosts(scene_, view_, ray, hits, color);
}

/// What look() has found, in color.
glm::vec3 Band::color_in_middle(int x, int y, std::vector<Hit>& hits) const {
    const Seen& seen = seen_[index(x, y)];
    const glm::vec2 place = place_of(glm::vec2(x, y) + 0.5f);
    glm::vec3 color = background(place);
    if (!seen.solid && seen.ghosts == 0) return color;
    Ray ray = view_.ray(place);
    if (seen.solid) {
        color = shade(view_, scene_.surface(seen.hit, ray), -ray.direction, lights_[index(x, y)]);
        ray.length = seen.hit.distance;
    }
    return seen.ghosts == 0 ? color : through_ghosts(ray, color, hits);
}

/// The same of another place in the pixel.
glm::vec3 Band::color_at(int x, int y, const glm::vec2& within, Sampler& sampler,
                         std::vector<Hit>& hits) const {
    const glm::vec2 place = place_of(glm::vec2(x, y) + within);
    Ray ray = view_.ray(place);
    glm::vec3 color = background(place);
    if (const auto hit = scene_.solid(ray)) {
        const Surface surface = scene_.surface(*hit, ray);
        color = shade(view_, surface, -ray.direction, light_near(x, y, surface, -ray.direction, sampler));
        ray.length = hit->distance;
    }
    return through_ghosts(ray, color, hits);
}

glm::vec3 Band::color(int x, int y, std::vector<Hit>& hits) const {
    if (settings_.samples == 1 || !at_edge(x, y)) return color_in_middle(x, y, hits);
    glm::vec3 sum(0);
    for (int i = 0; i < settings_.samples; ++i) {
        Sampler sampler(number_of(x, y), static_cast<std::uint32_t>(i));
        const glm::vec2 within = sampler.next();
        sum += color_at(x, y, within, sampler, hits);
    }
    return sum / static_cast<float>(settings_.samples);
}

void Band::render(Picture& picture) {
    tbb::parallel_for(top_, bottom_, [&](int y) {
        std::vector<Hit> hits;
        for (int x = 0; x < settings_.width; ++x) look(x, y, hits);
    });
    for (const int step : steps) smooth(step);
    tbb::parallel_for(first_, last_, [&](int y) {
        std::vector<Hit> hits;
        for (int x = 0; x < settings_.width; ++x) {
            const glm::vec3 light = color(x, y, hits);
            const std::uint32_t pixel = number_of(x, y);
            const float dither = Sampler(pixel, 0).next().x;
            for (int c = 0; c < 3; ++c)
                picture.rgb[std::size_t{3} * pixel + static_cast<std::size_t>(c)] = to_srgb(light[c], dither);
        }
    });
}

}  // namespace goffer::view
