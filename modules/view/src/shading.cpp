// SPDX-License-Identifier: MIT
#include "shading.hpp"

#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace goffer::view {
namespace {

// Light is in units of what a white wall reflects. The scene is 2 long.
constexpr glm::vec3 key_color{0.94f, 0.90f, 0.83f};
constexpr float key_spread = 0.20f;  // tangent of the light's angular radius: how soft shadows are
constexpr glm::vec3 zenith{0.34f, 0.37f, 0.42f};
constexpr glm::vec3 nadir{0.16f, 0.13f, 0.12f};
constexpr float sky_reach = 1.0f;   // what is farther away does not darken
constexpr float bounce = 0.45f;     // share of its own color that a surface gets where the sky is hidden
constexpr float glow = 0.30f;       // light that comes through the material rather than off it
constexpr float ghost_fade = 0.5f;  // how far a ghost must be in front of a solid to be seen over it

struct Frame {
    glm::vec3 a, b;
};

// Two vectors at right angles to the unit vector n, without a branch cut through the picture (Duff et al.
// 2017).
Frame around(const glm::vec3& n) {
    const float sign = std::copysign(1.0f, n.z);
    const float a = -1 / (sign + n.z);
    const float b = n.x * n.y * a;
    return {{1 + sign * n.x * n.x * a, sign * b, -sign * n.x}, {b, sign + n.y * n.y * a, -n.y}};
}

glm::vec2 on_disc(const glm::vec2& u) {
    const float angle = 2 * std::numbers::pi_v<float> * u.y;
    return std::sqrt(u.x) * glm::vec2(std::cos(angle), std::sin(angle));
}

glm::vec3 key_direction(const View& view) {
    return glm::normalize(-0.60f * view.right + 0.75f * view.up - 0.55f * view.forward);
}

glm::vec3 sky(const glm::vec3& direction, const View& view) {
    return glm::mix(nadir, zenith, 0.5f + 0.5f * glm::dot(direction, view.up));
}

// The mean of sky() over the hemisphere about `normal`, cosine-weighted.
glm::vec3 open_sky(const glm::vec3& normal, const View& view) {
    return sky(2.0f / 3 * normal, view);
}

// The mean cosine over the key light's disc, whose middle has `cosine`, of what is above the horizon.
float mean_cosine(float cosine) {
    if (cosine <= -key_spread) return 0;
    if (cosine >= key_spread) return cosine;
    return (cosine + key_spread) * (cosine + key_spread) / (4 * key_spread);
}

// The shading normal, tilted toward the eye where interpolation has turned it away.
glm::vec3 toward_eye(const Surface& s, const glm::vec3& to_eye) {
    const float cosine = glm::dot(s.normal, to_eye);
    return cosine > 0.01f ? s.normal : glm::normalize(s.normal + (0.01f - cosine) * to_eye);
}

// How much of the key light's disc reaches the surface, as a share of the part above its horizon.
float key_share(const Scene& scene, const View& view, const Surface& s, const glm::vec3& normal,
                Sampler& sampler, std::uint32_t rays) {
    const glm::vec3 axis = key_direction(view);
    const Frame frame = around(axis);
    std::uint32_t above = 0, seen = 0;
    for (std::uint32_t i = 0; i < rays; ++i) {
        const glm::vec2 disc = key_spread * on_disc(sampler.next(i, rays));
        const glm::vec3 direction = glm::normalize(axis + disc.x * frame.a + disc.y * frame.b);
        if (glm::dot(normal, direction) <= 0) continue;
        ++above;
        seen += scene.occluded({s.outside, direction}) ? 0 : 1;
    }
    return above == 0 ? 1.0f : static_cast<float>(seen) / static_cast<float>(above);
}

// Share of the hemisphere, cosine-weighted, that no near surface hides.
float sky_share(const Scene& scene, const Surface& s, const glm::vec3& normal, Sampler& sampler,
                std::uint32_t rays) {
    const Frame frame = around(normal);
    std::uint32_t seen = 0;
    for (std::uint32_t i = 0; i < rays; ++i) {
        const glm::vec2 disc = on_disc(sampler.next(i, rays));
        const float height = std::sqrt(std::max(0.0f, 1 - glm::dot(disc, disc)));
        const glm::vec3 direction = disc.x * frame.a + disc.y * frame.b + height * normal;
        const bool hidden =
            glm::dot(direction, s.face) <= 0 || scene.occluded({s.outside, direction, sky_reach});
        seen += hidden ? 0 : 1;
    }
    return static_cast<float>(seen) / static_cast<float>(rays);
}

// A broad, dull highlight (Blinn-Phong), as on clay or soft rubber.
float sheen(const glm::vec3& normal, const glm::vec3& to_eye, const glm::vec3& key) {
    return 0.16f * std::pow(std::max(0.0f, glm::dot(normal, glm::normalize(to_eye + key))), 22.0f);
}

// A brighter edge.
float rim(const glm::vec3& normal, const glm::vec3& to_eye, const View& view) {
    const float edge = 1 - std::max(0.0f, glm::dot(normal, to_eye));
    return 0.22f * edge * edge * edge * (0.6f + 0.4f * glm::dot(normal, view.up));
}

// Light that enters on the side of the key light, in shadow or not, and leaves with more of the material's
// color.
glm::vec3 through(const glm::vec3& color, const glm::vec3& normal, const glm::vec3& key) {
    const float wrapped = std::max(0.0f, 0.4f + 0.6f * glm::dot(normal, key));
    return glow * wrapped * color * color;
}

// A ghost neither casts nor catches shadows. Its outline is denser than its middle, as that of a bubble.
glm::vec4 ghost(const View& view, const Surface& s, const glm::vec3& to_eye) {
    const glm::vec3 normal = toward_eye(s, to_eye);
    const float lit = 0.5f + 0.5f * glm::dot(normal, key_direction(view));
    const float edge = std::pow(1 - std::max(0.0f, glm::dot(normal, to_eye)), 2.0f);
    return {glm::vec3(s.color) * (lit * key_color + sky(normal, view)),
            glm::mix(0.75f, 1.5f, edge) * s.color.a};
}

// Tone mapping: keeps most of the range as it is and compresses what is too bright, half by the brightest
// channel, which keeps the hue, and half by each channel alone, which lets it fade to white.
glm::vec3 exposed(const glm::vec3& light) {
    constexpr float knee = 0.75f;
    const glm::vec3 above = glm::max(light - knee, glm::vec3(0)) / (1 - knee);
    const glm::vec3 bent = glm::min(light, glm::vec3(knee)) + (1 - knee) * (above / (1.0f + above));
    const float brightest = std::max({light.r, light.g, light.b, 1e-6f});
    return 0.5f * (bent + light * (std::max({bent.r, bent.g, bent.b}) / brightest));
}

}  // namespace

glm::vec3 background(const glm::vec2& place) {
    const glm::vec2 from_center = place - glm::vec2(0, 0.25f);
    return glm::mix(glm::vec3(0.915f, 0.920f, 0.925f), glm::vec3(0.70f, 0.715f, 0.735f),
                    std::min(1.0f, 0.36f * glm::dot(from_center, from_center)));
}

Light light_at(const Scene& scene, const View& view, const Surface& s, const glm::vec3& to_eye,
               Sampler& sampler, std::uint32_t rays) {
    const glm::vec3 normal = toward_eye(s, to_eye);
    const float key = key_share(scene, view, s, normal, sampler, rays);
    return {key, sky_share(scene, s, normal, sampler, rays)};
}

glm::vec3 shade(const View& view, const Surface& s, const glm::vec3& to_eye, const Light& light) {
    const glm::vec3 normal = toward_eye(s, to_eye), key = key_direction(view), color(s.color);
    const float lit = light.key * mean_cosine(glm::dot(normal, key));
    // Near surfaces that hide the sky give a little of their own color.
    const glm::vec3 ambient = open_sky(normal, view) * glm::mix(bounce * color, glm::vec3(1), light.sky);
    const float edge = rim(normal, to_eye, view);
    const float highlight = std::min(1.0f, 2 * lit) * sheen(normal, to_eye, key);
    return exposed(color * (lit * key_color + ambient * (1 + 2 * edge)) + through(color, normal, key) +
                   highlight * key_color + edge * ambient);
}

glm::vec3 under_ghosts(const Scene& scene, const View& view, const Ray& ray, std::span<const Hit> ghosts,
                       glm::vec3 color) {
    for (const Hit& hit : ghosts) {
        const glm::vec4 over = ghost(view, scene.surface(hit, ray), -ray.direction);
        const float seen = std::min(1.0f, (ray.length - hit.distance) / ghost_fade);
        color = glm::mix(color, exposed(glm::vec3(over)), glm::clamp(seen * over.a, 0.0f, 1.0f));
    }
    return color;
}

}  // namespace goffer::view
