// SPDX-License-Identifier: MIT
#pragma once

#include "shading.hpp"

#include <goffer/view/picture.hpp>

#include <glm/vec3.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace goffer::view {

/// Some rows of a picture. Each pixel is seen once, at its middle, with a few rays to the lights, whose
/// result is then smoothed over neighbors on the same surface. Only where neighbors differ is a pixel seen
/// again, in several places. A pixel depends on none that is more than `reach` away, so that bands meet
/// without a seam.
class Band {
public:
    static constexpr int reach = 8;

    /// Rows [first, last) of the picture, and `reach` more at both sides.
    Band(const Scene& scene, const View& view, const Settings& settings, int first, int last);

    /// Renders the rows into `picture`. Runs in parallel in the caller's arena.
    void render(Picture& picture);

private:
    /// What is seen at the middle of a pixel.
    struct Seen {
        glm::vec3 position{0}, normal{0};
        glm::vec2 uv{0};
        float uv_step = 0;
        Hit hit{};
        std::uint32_t ghosts = 0;  ///< surfaces in front
        bool solid = false;
    };

    [[nodiscard]] std::size_t index(int x, int y) const {
        return static_cast<std::size_t>(y - top_) * static_cast<std::size_t>(settings_.width) +
               static_cast<std::size_t>(x);
    }
    [[nodiscard]] bool inside(int x, int y) const {
        return x >= 0 && x < settings_.width && y >= top_ && y < bottom_;
    }
    /// The pixel's place in the picture, counted row by row.
    [[nodiscard]] std::uint32_t number_of(int x, int y) const {
        return static_cast<std::uint32_t>(y * settings_.width + x);
    }
    void look(int x, int y, std::vector<Hit>& hits);
    [[nodiscard]] float off_plane(const Seen& of, const glm::vec3& position) const;
    [[nodiscard]] bool same_surface(const Seen& of, const glm::vec3& normal, const glm::vec3& position) const;
    [[nodiscard]] Light smoothed(int x, int y, int step) const;
    void smooth(int step);
    [[nodiscard]] bool at_edge(int x, int y) const;
    [[nodiscard]] Light light_near(int x, int y, const Surface& surface, const glm::vec3& to_eye,
                                   Sampler& sampler) const;
    [[nodiscard]] glm::vec3 through_ghosts(const Ray& ray, const glm::vec3& color,
                                           std::vector<Hit>& hits) const;
    [[nodiscard]] glm::vec3 color_in_middle(int x, int y, std::vector<Hit>& hits) const;
    [[nodiscard]] glm::vec3 color_at(int x, int y, const glm::vec2& within, Sampler& sampler,
                                     std::vector<Hit>& hits) const;
    [[nodiscard]] glm::vec3 color(int x, int y, std::vector<Hit>& hits) const;
    [[nodiscard]] glm::vec2 place_of(const glm::vec2& pixel) const;

    const Scene& scene_;
    const View& view_;
    const Settings& settings_;
    int first_, last_;    // rows to render
    int top_, bottom_;    // rows looked at
    std::uint32_t rays_;  // to each light
    std::vector<Seen> seen_;
    std::vector<Light> lights_;  // that reach what was seen
    std::vector<Light> smooth_;  // those of the next pass
};

}  // namespace goffer::view
