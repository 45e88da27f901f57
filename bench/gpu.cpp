// SPDX-License-Identifier: MIT
#include "fixture.hpp"

#include <goffer/bend/crowd.hpp>
#include <goffer/bend/kernel_input.hpp>
#include <goffer/draw/mesh.hpp>
#include <goffer/draw/offscreen.hpp>
#include <goffer/draw/shader.hpp>
#include <goffer/gpu/source.hpp>
#include <goffer/gpu/vertices.hpp>

#include <benchmark/benchmark.h>
#include <epoxy/gl.h>

#include <array>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <functional>
#include <span>
#include <string>
#include <vector>

/// gpu/<stage>/<outputs>/<crowd>: what a crowd costs on the GPU of this machine, in OpenGL 4.3 without a
/// display.

namespace goffer::bench {
namespace {

/// What happens to deformed vertices.
enum class Stage {
    draw,     ///< a vertex shader: each vertex once, as a point beyond the view, so that no pixel is drawn
    compute,  ///< a compute shader writes them into a buffer, one stream behind the other
};

/// What a vertex gives: so many of position, normal, tangent.
enum class Outputs { rest, positions, normals, tangents };

struct GpuCase {
    Stage stage;
    Outputs outputs;
    std::size_t instances, vertices;
    Shape shape;
};

constexpr std::size_t floats_of(Outputs outputs) {
    return outputs == Outputs::positions ? 3 : outputs == Outputs::tangents ? 10 : 6;
}

std::size_t result_bytes(const GpuCase& what) {
    return what.instances * what.vertices * floats_of(what.outputs) * sizeof(float);
}

/// What both stages do with a vertex. `rest`, the floor, passes on as many floats as they are.
constexpr const char* deform_vertex = R"(
layout(std430, binding = 1) readonly buffer Rows { vec4 rows[]; };
uniform int rows_per_instance;
vec4 goffer_row(int row) { return rows[row]; }
GofferBent deformed(GofferVertex vertex, int instance) {
#if OUTPUTS == 0
    return GofferBent(vertex.column.xyz, vertex.normal, vertex.tangent);
#else
    return goffer_deform(vertex, instance * rows_per_instance);
#endif
}
)";

constexpr const char* draw_main = R"(
#if OUTPUTS != 1
out vec3 bent_normal;
#endif
#if OUTPUTS == 3
out vec4 bent_tangent;
#endif
void main() {
    GofferVertex vertex = GofferVertex(column, wrinkle, normal, shape, tangent, joint);
    GofferBent bent = deformed(vertex, gl_InstanceID);
    gl_Position = vec4(bent.position + 1e4, 1.0);
#if OUTPUTS != 1
    bent_normal = bent.normal;
#endif
#if OUTPUTS == 3
    bent_tangent = bent.tangent;
#endif
}
)";

constexpr const char* pixel_main = R"(
#if OUTPUTS != 1
in vec3 bent_normal;
#endif
#if OUTPUTS == 3
in vec4 bent_tangent;
#endif
out vec4 color;
void main() {
    color = vec4(1.0);
#if OUTPUTS != 1
    color.xyz += bent_normal;
#endif
#if OUTPUTS == 3
    color += bent_tangent;
#endif
}
)";

constexpr const char* compute_main = R"(
layout(local_size_x = 64) in;
layout(std430, binding = 0) readonly buffer Vertices { float vertices[]; };
layout(std430, binding = 2) writeonly buffer Results { float results[]; };
uniform int vertex_count, floats, shape_at, tangent_at, joint_at;
vec4 four(int at) { return vec4(vertices[at], vertices[at + 1], vertices[at + 2], vertices[at + 3]); }
vec4 four_or_none(int at, int offset) { return offset < 0 ? vec4(0.0, 0.0, 0.0, 1.0) : four(at + offset); }
void main() {
    int i = int(gl_GlobalInvocationID.x), instance = int(gl_GlobalInvocationID.y), at = i * floats;
    if (i >= vertex_count) return;
    GofferVertex vertex = GofferVertex(four(at), four(at + 4),
                                       vec3(vertices[at + 8], vertices[at + 9], vertices[at + 10]),
                                       four_or_none(at, shape_at), four_or_none(at, tangent_at),
                                       four_or_none(at, joint_at));
    GofferBent bent = deformed(vertex, instance);
    int to = instance * vertex_count + i, all = vertex_count * int(gl_NumWorkGroups.y);
    for (int c = 0; c < 3; ++c) results[3 * to + c] = bent.position[c];
#if OUTPUTS != 1
    for (int c = 0; c < 3; ++c) results[3 * (all + to) + c] = bent.normal[c];
#endif
#if OUTPUTS == 3
    for (int c = 0; c < 4; ++c) results[6 * all + 4 * to + c] = bent.tangent[c];
#endif
}
)";

void attach(GLuint program, GLenum stage, Outputs outputs, const std::string& text) {
    const GLuint shader =
        draw::compile_shader(stage, "#version 430 core\n#define OUTPUTS " +
                                        std::to_string(static_cast<int>(outputs)) + "\n" + text);
    glAttachShader(program, shader);
    glDeleteShader(shader);  // it goes with the program
}

GLuint make_program(Stage stage, Outputs outputs) {
    const std::string deform = std::string(gpu::deform_glsl()) + deform_vertex;
    const GLuint program = glCreateProgram();
    if (stage == Stage::compute) {
        attach(program, GL_COMPUTE_SHADER, outputs, deform + compute_main);
    } else {
        attach(program, GL_VERTEX_SHADER, outputs, deform + draw::vertex_inputs + draw_main);
        attach(program, GL_FRAGMENT_SHADER, outputs, pixel_main);
    }
    draw::link_program(program);
    return program;
}

/// A crowd on the GPU, in poses of its own, with a program that deforms it.
class GpuCrowd {
public:
    GpuCrowd(const bend::Body& body, const GpuCase& what)
        : what_(what), layout_(gpu::vertex_layout(body)), program_(make_program(what.stage, what.outputs)) {
        glGenVertexArrays(1, &vertex_array_);
        glBindVertexArray(vertex_array_);
        glGenBuffers(3, buffers_.data());
        std::vector<std::byte> vertices(body.vertex_count() * layout_.stride);
        gpu::write_vertices(body, vertices);
        upload(GL_ARRAY_BUFFER, 0, std::span<const std::byte>(vertices));
        const std::vector<bend::Coefficients> rows = coefficients(body);
        upload(GL_SHADER_STORAGE_BUFFER, 1, std::as_bytes(std::span(rows)));
        glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 1, buffers_[1]);
        glUseProgram(program_);
        set("rows_per_instance", body.region_count() * bend::coefficient_rows);
        what.stage == Stage::draw ? draw::read_vertices(layout_) : set_storage();
    }
    GpuCrowd(const GpuCrowd&) = delete;
    GpuCrowd& operator=(const GpuCrowd&) = delete;
    ~GpuCrowd() {
        glDeleteProgram(program_);
        glDeleteBuffers(3, buffers_.data());
        glDeleteVertexArrays(1, &vertex_array_);
    }

    void frame() const {
        const auto vertices = static_cast<GLuint>(what_.vertices),
                   instances = static_cast<GLuint>(what_.instances);
        if (what_.stage == Stage::compute) {
            glDispatchCompute((vertices + 63) / 64, instances, 1);
            glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
        } else {
            glDrawArraysInstanced(GL_POINTS, 0, static_cast<GLsizei>(vertices),
                                  static_cast<GLsizei>(instances));
        }
    }

private:
    [[nodiscard]] std::vector<bend::Coefficients> coefficients(const bend::Body& body) const {
        std::vector<bend::Pose> poses(what_.instances * body.region_count());
        for (std::size_t i = 0; i < poses.size(); ++i) {
            const auto at = static_cast<float>(i);
            poses[i] = {(1.0f + 0.5f * std::sin(at)) / static_cast<float>(body.region_count()), at};
        }
        bend::Batch batch{.body = &body, .count = what_.instances};
        batch.poses = {.data = poses.data(),
                       .count = what_.instances,
                       .stride = static_cast<std::uint32_t>(body.region_count() * sizeof(bend::Pose))};
        std::vector<bend::Coefficients> rows(poses.size());
        bend::set_up(batch, rows);
        return rows;
    }

    void upload(GLenum target, std::size_t index, std::span<const std::byte> data) const {
        glBindBuffer(target, buffers_[index]);
        glBufferData(target, static_cast<GLsizeiptr>(data.size()), data.data(), GL_STATIC_DRAW);
    }

    void set(const char* uniform, std::size_t value) const {
        glUniform1i(glGetUniformLocation(program_, uniform), static_cast<GLint>(value));
    }

    void set_storage() const {
        const auto floats = [](std::size_t offset) {
            return offset == gpu::VertexLayout::none ? offset : offset / sizeof(float);
        };
        set("vertex_count", what_.vertices);
        set("floats", layout_.stride / sizeof(float));
        set("shape_at", floats(layout_.shape));
        set("tangent_at", floats(layout_.tangent));
        set("joint_at", floats(layout_.joint));
        glBindBuffer(GL_SHADER_STORAGE_BUFFER, buffers_[2]);
        glBufferData(GL_SHADER_STORAGE_BUFFER, static_cast<GLsizeiptr>(result_bytes(what_)), nullptr,
                     GL_STREAM_COPY);
        glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, buffers_[0]);
        glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 2, buffers_[2]);
    }

    GpuCase what_;
    gpu::VertexLayout layout_;
    GLuint program_, vertex_array_ = 0;
    std::array<GLuint, 3> buffers_{};
};

/// What keeps a case, of which a frame has run, from being timed; empty: nothing. A shader may leave out what
/// lies beyond the largest block.
std::string fault_of(const GpuCase& what) {
    GLenum error = GL_NO_ERROR;
    for (GLenum next = glGetError(); next != GL_NO_ERROR; next = glGetError()) error = next;
    if (error == GL_OUT_OF_MEMORY) return "the GPU has no room for it";
    if (error != GL_NO_ERROR) return "OpenGL reports error " + std::to_string(error);
    GLint64 largest = 0;
    glGetInteger64v(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &largest);
    const bool fits = what.stage == Stage::draw || result_bytes(what) <= static_cast<std::size_t>(largest);
    return fits ? "" : "its results are more than a storage block holds";
}

/// Times frames, several in a row, from an idle GPU to an idle one.
void time_frames(benchmark::State& state, Fixture& fixture, const GpuCase& what) {
    using Clock = std::chrono::steady_clock;
    constexpr int frames = 10;
    const GpuCrowd crowd(fixture.body(what.vertices, what.shape), what);
    crowd.frame();
    glFinish();
    if (const std::string fault = fault_of(what); !fault.empty()) {
        state.SkipWithError(fault.c_str());
        return;
    }
    std::chrono::duration<double> time{};
    std::size_t iterations = 0;
    for (auto _ : state) {
        const Clock::time_point start = Clock::now();
        for (int i = 0; i < frames; ++i) crowd.frame();
        glFinish();
        const std::chrono::duration<double> each = (Clock::now() - start) / frames;
        state.SetIterationTime(each.count());
        time += each;
        ++iterations;
    }
    const double vertices = static_cast<double>(what.instances * what.vertices * iterations);
    state.counters["ns_per_vertex"] = 1e9 * time.count() / vertices;
}

void register_cases(Fixture& fixture) {
    struct Named {
        const char* name;
        GpuCase what;
    };
    using enum Outputs;
    const Named crowds[] = {{"1000x10000", {{}, {}, 1000, 10'000, Shape::plain}},
                            {"10000x200", {{}, {}, 10'000, 200, Shape::plain}},
                            {"1000x10000-regions8", {{}, {}, 1000, 10'000, Shape::regions}},
                            {"1000x10000-joints8", {{}, {}, 1000, 10'000, Shape::joints}},
                            {"1000x10000-arc", {{}, {}, 1000, 10'000, Shape::arc}}};
    constexpr std::array<const char*, 4> outputs = {"rest", "positions", "positions+normals",
                                                    "positions+normals+tangents"};
    for (const Stage stage : {Stage::draw, Stage::compute})
        for (const Named& crowd : crowds)
            for (const Outputs one : {rest, positions, normals, tangents}) {
                GpuCase what = crowd.what;
                what.stage = stage;
                what.outputs = one;
                const std::string name = std::string(stage == Stage::draw ? "gpu/draw/" : "gpu/compute/") +
                                         outputs[static_cast<std::size_t>(one)] + "/" + crowd.name;
                benchmark::RegisterBenchmark(name.c_str(), time_frames, std::ref(fixture), what)
                    ->UseManualTime()
                    ->Unit(benchmark::kMillisecond);
            }
}

}  // namespace
}  // namespace goffer::bench

int main(int count, char** words) {
    using namespace goffer;
    benchmark::Initialize(&count, words);
    if (benchmark::ReportUnrecognizedArguments(count, words)) return 2;
    std::string why;
    const draw::OffscreenContext context(draw::OffscreenContext::Api::core43, why);
    if (!context) {
        std::fprintf(stderr, "goffer_bench_gpu: there is no OpenGL 4.3: %s\n", why.c_str());
        return 1;
    }
    const draw::OffscreenTarget target(64, 64);
    benchmark::AddCustomContext("gpu", reinterpret_cast<const char*>(glGetString(GL_RENDERER)));
    bench::Fixture fixture;
    bench::register_cases(fixture);
    try {
        benchmark::RunSpecifiedBenchmarks();
    } catch (const draw::Error& error) {
        std::fprintf(stderr, "goffer_bench_gpu: %s\n", error.what());
        return 1;
    }
}
