// SPDX-License-Identifier: MIT
#include "support/models.hpp"
#include "textures.hpp"
#include "wide_image.hpp"

#include <doctest/doctest.h>

#include <vector>

/// The shader for HLSL, whose text is C++ too where it has HLSL's names.

using namespace goffer;
using namespace goffer::test;

namespace {

namespace hlsl {

using namespace glm;
using float3 = vec3;
using float4 = vec4;
using int3 = ivec3;

float3 lerp(const float3& a, const float3& b, float share) {
    return a + share * (b - a);
}

struct Texel {
    float3 xyz;
};

/// An image as R16G16B16A16_UNORM.
template <class Value>
class Texture2D {
public:
    explicit Texture2D(const WideImage& image) : image_(&image) {}

    [[nodiscard]] Texel Load(const int3& at) const {
        REQUIRE(at.z == 0);
        const glm::dvec3 steps =
            image_->texel(static_cast<std::size_t>(at.x), static_cast<std::size_t>(at.y));
        return {float3(steps) / 65535.0f};
    }

private:
    const WideImage* image_;
};

#include <goffer/clip/vertex_texture.hlsl>

}  // namespace hlsl

/// Plays a texture frame by frame, and in between: how far what is played is from a blend in double.
void check_played_by_hlsl(clip::Frames& frames, const mesh::Mesh& model, const mesh::VertexArrays& arrays) {
    const Folder folder;
    const clip::VertexTexture texture = saved_texture(frames, model, arrays, folder / "clip.json");
    const WideImage stored = read_wide_image(texture.files[1]), turned = read_wide_image(texture.files[2]);
    const hlsl::Texture2D<hlsl::float4> positions(stored), normals(turned);
    const hlsl::GofferClip clip{static_cast<int>(texture.layout.width),
                                static_cast<int>(texture.layout.rows_per_frame), texture.low, texture.high,
                                0};
    const auto count = static_cast<int>(frames.count());
    double position = 0, normal = 0;
    for (int half = 0; half < 2 * count; ++half) {
        const auto first = static_cast<std::size_t>(half / 2), second = (first + 1) % frames.count();
        const double share = 0.5 * (half % 2);
        const std::vector<glm::dvec3> a = carried(frames, first), b = carried(frames, second),
                                      m = carried_normals(frames, first), n = carried_normals(frames, second);
        const auto at = hlsl::goffer_frames_repeated(0.5f * static_cast<float>(half), count);
        for (std::size_t i = 0; i < a.size(); ++i) {
            const int vertex = hlsl::goffer_vertex(static_cast<float>(i));
            const glm::dvec3 p(hlsl::goffer_position(positions, vertex, at, clip)),
                q(hlsl::goffer_normal(normals, vertex, at, clip)), blend = glm::mix(m[i], n[i], share);
            position = std::max(position, farthest(p, glm::mix(a[i], b[i], share)));
            normal = std::max(normal, angle_between(q, blend) * glm::length(blend));
        }
    }
    CHECK(position <= texture.half_step + 2 * float_rounding(texture));
    CHECK(normal <= normal_half_step + 1e-4);
}

}  // namespace

TEST_CASE("vertex texture: the shader for HLSL, as C++, plays the clip within its error") {
    MovingPoints points(5000, 7, true);  // three rows a frame
    const mesh::Mesh flat = strip(5000);
    check_played_by_hlsl(points, flat, mesh::vertex_arrays(flat));
    BendingModel bending(model("insect_leg.glb"), 12);
    check_played_by_hlsl(bending, bending.model, bending.arrays);
}

TEST_CASE("vertex texture: the shader for HLSL stands still before and after the clip, and turns images") {
    for (const float frame : {-3.0f, 0.0f, 2.25f, 5.5f, 6.0f, 9.0f}) {
        const auto at = hlsl::goffer_frames(frame, 7);
        const float within = std::clamp(frame, 0.0f, 6.0f);
        CHECK(static_cast<float>(at.first) + at.share == within);
        CHECK(at.second == at.first + 1);
    }
    CHECK(hlsl::goffer_frames(0.5f, 1).second == 0);
    const hlsl::GofferClip clip{10, 2, {}, {}, 14}, upright{10, 2, {}, {}, 0};
    CHECK(hlsl::goffer_texel(13, 3, upright) == glm::ivec3(3, 7, 0));
    CHECK(hlsl::goffer_texel(13, 3, clip) == glm::ivec3(3, 14 - 1 - 7, 0));
}

TEST_CASE("vertex texture: the shader for HLSL knows all numbers that vertices have") {
    for (const int number : {0, 1, (1 << 23) - 1, 1 << 23, (1 << 23) + 1, (1 << 24) - 1})
        CHECK(hlsl::goffer_vertex(static_cast<float>(number)) == number);
}
