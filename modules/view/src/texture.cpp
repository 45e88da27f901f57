// SPDX-License-Identifier: MIT
#include "texture.hpp"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec4.hpp>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

namespace goffer::view {
namespace {

constexpr float most_probes = 8;  // along a footprint that is longer than wide

/// From linear light to bytes, tabled: images are large.
class Encoder {
public:
    Encoder() {
        for (std::size_t i = 0; i < bytes_.size(); ++i) {
            const float middle = (static_cast<float>(i) + 0.5f) / static_cast<float>(bytes_.size());
            bytes_[i] = static_cast<std::uint8_t>(std::lround(255 * encoded_of(middle)));
        }
    }
    std::uint8_t operator()(float linear) const {
        return bytes_[std::min(static_cast<std::size_t>(linear * static_cast<float>(bytes_.size())),
                               bytes_.size() - 1)];
    }

private:
    std::array<std::uint8_t, 4096> bytes_{};
};

const std::uint8_t* texel(const Image& image, int x, int y) {
    return &image.rgba[4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) +
                            static_cast<std::size_t>(x))];
}

/// The pixels that one of `small` along a side of `large` stands for, and how much of the outermost ones.
struct Share {
    int first, last;  // half-open
    float of_first, of_last;

    Share(int index, int small, int large) {
        const double low = static_cast<double>(index) * large / small,
                     high = static_cast<double>(index + 1) * large / small;
        first = static_cast<int>(low);
        last = std::min(static_cast<int>(std::ceil(high)), large);
        of_first = static_cast<float>(first + 1 - low);
        of_last = static_cast<float>(high - (last - 1));
    }
    [[nodiscard]] float of(int i) const { return i == first ? of_first : i == last - 1 ? of_last : 1; }
};

/// Red, green and blue, linear, and alpha.
glm::vec4 mean(const Image& image, const MipMap& mip_map, const Share& columns, const Share& rows) {
    glm::vec4 sum(0);
    float weights = 0;
    for (int row = rows.first; row < rows.last; ++row) {
        for (int column = columns.first; column < columns.last; ++column) {
            const float weight = rows.of(row) * columns.of(column);
            const std::uint8_t* in = texel(image, column, row);
            sum += weight * glm::vec4(mip_map.linear(in[0]), mip_map.linear(in[1]), mip_map.linear(in[2]),
                                      static_cast<float>(in[3]));
            weights += weight;
        }
    }
    return sum / weights;
}

Image halved(const Image& large, const MipMap& mip_map, const Encoder& encode) {
    Image small{std::max(large.width / 2, 1), std::max(large.height / 2, 1), {}};
    const std::size_t row_bytes = std::size_t{4} * static_cast<std::size_t>(small.width);
    small.rgba.resize(row_bytes * static_cast<std::size_t>(small.height));
    tbb::parallel_for(0, small.height, [&](int y) {
        const Share rows(y, small.height, large.height);
        std::uint8_t* out = &small.rgba[row_bytes * static_cast<std::size_t>(y)];
        for (int x = 0; x < small.width; ++x, out += 4) {
            const glm::vec4 color = mean(large, mip_map, Share(x, small.width, large.width), rows);
            for (int c = 0; c < 3; ++c) out[c] = encode(color[c]);
            out[3] = static_cast<std::uint8_t>(std::lround(color.a));
        }
    });
    return small;
}

/// A coordinate as one of the image's own, far from where integers end.
float brought_near(float value, Wrap wrap) {
    if (!std::isfinite(value)) return 0;
    switch (wrap) {
        case Wrap::repeat:
            return value - std::floor(value);
        case Wrap::mirror:
            return value - 2 * std::floor(value / 2);
        case Wrap::clamp:
            break;
    }
    return std::clamp(value, 0.0f, 1.0f);
}

/// The pixel, of `count`, that stands in the place of one up to two images away.
int wrapped(int index, int count, Wrap wrap) {
    if (index >= 0 && index < count) return index;
    if (wrap == Wrap::clamp) return std::clamp(index, 0, count - 1);
    const int period = wrap == Wrap::mirror ? 2 * count : count;
    const int within = ((index % period) + period) % period;
    return within < count ? within : period - 1 - within;
}

/// Blends the four pixels about a place, or takes the one there.
glm::vec3 sample(const Image& image, const Texture& texture, const glm::vec2& uv, bool nearest) {
    // Rows count from the top, and v from the bottom.
    const glm::vec2 place(brought_near(uv.x, texture.wrap_u) * static_cast<float>(image.width),
                          (1 - brought_near(uv.y, texture.wrap_v)) * static_cast<float>(image.height));
    const glm::vec2 first = glm::floor(nearest ? place : place - 0.5f), share = place - 0.5f - first;
    const auto column = [&](int further) {
        return wrapped(static_cast<int>(first.x) + further, image.width, texture.wrap_u);
    };
    const auto row = [&](int further) {
        return wrapped(static_cast<int>(first.y) + further, image.height, texture.wrap_v);
    };
    const auto color = [&](int x, int y) {
        const std::uint8_t* in = texel(image, x, y);
        const MipMap& mip_map = *texture.image;
        return glm::vec3(mip_map.linear(in[0]), mip_map.linear(in[1]), mip_map.linear(in[2]));
    };
    const int left = column(0), top = row(0);
    if (nearest) return color(left, top);
    const int right = column(1), bottom = row(1);
    return glm::mix(glm::mix(color(left, top), color(right, top), share.x),
                    glm::mix(color(left, bottom), color(right, bottom), share.x), share.y);
}

/// The mean over a square of 2^level pixels.
glm::vec3 sample(const Texture& texture, const glm::vec2& uv, float level) {
    const std::span<const Image> levels = texture.image->levels();
    if (level <= 0) return sample(levels[0], texture, uv, texture.nearest);
    const float last = static_cast<float>(levels.size() - 1), at = std::min(level, last);
    const auto fine = static_cast<std::size_t>(at), coarse = std::min(fine + 1, levels.size() - 1);
    return glm::mix(sample(levels[fine], texture, uv, false), sample(levels[coarse], texture, uv, false),
                    at - std::floor(at));
}

bool finite(const glm::vec2& v) {
    return std::isfinite(v.x) && std::isfinite(v.y);
}

}  // namespace

MipMap::MipMap(Image image) {
    if (image.width < 1 || image.height < 1 ||
        image.rgba.size() !=
            std::size_t{4} * static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height))
        throw Error("an image is empty, or not width x height x 4 bytes; give it all of its pixels");
    for (std::size_t i = 0; i < linear_.size(); ++i) linear_[i] = linear_of(static_cast<float>(i) / 255);
    levels_.push_back(std::move(image));
    const Encoder encode;
    while (levels_.back().width > 1 || levels_.back().height > 1)
        levels_.push_back(halved(levels_.back(), *this, encode));
}

// As hardware does: squares in a row along the longer side of the footprint, each as wide as the shorter one.
glm::vec3 texture_color(const Texture& texture, Footprint over) {
    for (glm::vec2* const vector : {&over.uv, &over.across, &over.up})
        if (!finite(*vector)) *vector = glm::vec2(0);
    const Image& image = texture.image->levels()[0];
    const glm::vec2 size(image.width, image.height);
    for (glm::vec2* const vector : {&over.across, &over.up})
        if (!std::isfinite(glm::length(size * *vector))) *vector = glm::vec2(0);
    if (glm::length(size * over.across) < glm::length(size * over.up)) std::swap(over.across, over.up);
    const float longer = glm::length(size * over.across), shorter = glm::length(size * over.up);
    const float probes = std::clamp(std::ceil(longer / std::max(shorter, 1.0f)), 1.0f, most_probes);
    const float level = std::log2(std::max(longer / probes, shorter));
    glm::vec3 sum(0);
    for (float i = 0; i < probes; ++i)
        sum += sample(texture, over.uv + ((i + 0.5f) / probes - 0.5f) * over.across, level);
    return sum / probes;
}

}  // namespace goffer::view
