// SPDX-License-Identifier: MIT

// What a game does: bends a body with goffer::bend alone. Its one vertex is the tip of the outer line, which
// lies at (L / alpha - r, 0, L / alpha) after a quarter turn.

#include <goffer/bend/body_input.hpp>
#include <goffer/bend/crowd.hpp>
#include <goffer/gpu/source.hpp>
#include <goffer/gpu/vertices.hpp>

#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>
#include <string_view>

int main() {
#ifdef CONSUMER_AVX2_ALONE
    if (goffer::runs_here(goffer::Isa::avx2) != (__builtin_cpu_supports("avx2") != 0)) return 1;
#endif
    constexpr double length = 10;
    constexpr double radius = 1;
    constexpr double quarter = std::numbers::pi / 2;
    const goffer::bend::RestVertex tip{.beta = std::numbers::pi, .z = length, .rho = radius};
    const goffer::bend::RestVector outward{.rho = 1};

    const goffer::bend::RegionInput whole{.length = length, .max_angle = 3, .vertex_count = 1};
    goffer::bend::BodyInput input;
    input.radius = radius;
    input.regions = {&whole, 1};
    input.vertices = {&tip, 1};
    input.normals = {&outward, 1};
    const auto body = goffer::bend::Body::make(input);
    if (!body) {
        const std::string fault{std::string_view(describe(goffer::bend::Body::check(input)))};
        return std::puts(fault.c_str()), 1;
    }

    float position[3] = {};
    goffer::bend::DeformJob job{.body = &*body, .pose = {.angle = static_cast<float>(quarter)}};
    job.positions = goffer::interleaved<3>(position, 1);
    if (const auto fault = validate(job); !fault.none()) return std::puts(describe(fault).c_str()), 1;
    run(job);
    const goffer::bend::Batch batch = batch_of(job);  // and as a crowd, the same again
    if (run_parallel(goffer::bend::CrowdJob{.batches = {&batch, 1}}).deformed != 1) return 1;

    if (goffer::gpu::vertex_layout(*body) != goffer::gpu::VertexLayout()) return 1;  // and for shaders
    if (goffer::gpu::deform_glsl().empty()) return 1;

    std::printf("the tip is at %g %g %g\n", position[0], position[1], position[2]);
    const double away =
        std::hypot(position[0] - (length / quarter - radius), position[1], position[2] - length / quarter);
    return away <= 5e-6 * length ? 0 : 1;
}
