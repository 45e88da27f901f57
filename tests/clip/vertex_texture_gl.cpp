// SPDX-License-Identifier: MIT
#include "support/gl_buffer.hpp"
#include "support/models.hpp"
#include "textures.hpp"
#include "wide_image.hpp"

#include <goffer/draw/offscreen.hpp>
#include <goffer/draw/shader.hpp>

#include <doctest/doctest.h>

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

/// Vertex-animation textures, played by the shader that goes beside them.

using namespace goffer;
using namespace goffer::test;
using Api = draw::OffscreenContext::Api;

namespace {

struct Vertex {
    glm::vec3 position, normal;
};

/// With RGB16 in a sampler2D or, in ES 3.0, RGB16UI in a usampler2D.
std::string shader_text(Api api) {
    const bool es = api == Api::es30;
    const std::string sampler = es ? "uniform highp usampler2D " : "uniform sampler2D ";
    return std::string(es ? "#version 300 es\n" : "#version 330 core\n") +
           std::string(clip::vertex_texture_glsl()) + sampler + "positions;\n" + sampler + R"(normals;
uniform GofferClip clip;
uniform int frames;
uniform float frame;
uniform bool repeats;
out vec3 played_position;
out vec3 played_normal;
void main() {
    GofferFrames at = goffer_frames(frame, frames);
    if (repeats) at = goffer_frames_repeated(frame, frames);
    played_position = goffer_position(positions, gl_VertexID, at, clip);
    played_normal = goffer_normal(normals, gl_VertexID, at, clip);
    gl_Position = vec4(played_position, 1.0);
}
)";
}

GLuint program_for(Api api, const std::string& text) {
    const GLuint program = glCreateProgram();
    glAttachShader(program, draw::compile_shader(GL_VERTEX_SHADER, text));
    if (api == Api::es30)  // which has no program without one
        glAttachShader(program,
                       draw::compile_shader(GL_FRAGMENT_SHADER, "#version 300 es\nvoid main() {}\n"));
    const char* const outputs[] = {"played_position", "played_normal"};
    glTransformFeedbackVaryings(program, 2, outputs, GL_INTERLEAVED_ATTRIBS);
    draw::link_program(program);
    return program;
}

/// What a loader makes of an image that turns it upside down.
WideImage upside_down(WideImage image) {
    const auto row = static_cast<std::ptrdiff_t>(3 * image.width);
    for (auto top = image.rgb.begin(), bottom = image.rgb.end() - row; top < bottom;
         top += row, bottom -= row)
        std::swap_ranges(top, top + row, bottom);
    return image;
}

void upload(Api api, GLenum unit, const WideImage& image) {
    GLuint texture = 0;
    glGenTextures(1, &texture);
    glActiveTexture(unit);
    glBindTexture(GL_TEXTURE_2D, texture);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 2);
    const bool es = api == Api::es30;
    glTexImage2D(GL_TEXTURE_2D, 0, es ? GL_RGB16UI : GL_RGB16, static_cast<GLsizei>(image.width),
                 static_cast<GLsizei>(image.height), 0, es ? GL_RGB_INTEGER : GL_RGB, GL_UNSIGNED_SHORT,
                 image.rgb.data());
}

/// What the program in use makes of vertices 0, 1, ..
std::vector<Vertex> drawn(std::size_t vertices) {
    GLuint array = 0;
    glGenVertexArrays(1, &array);
    glBindVertexArray(array);
    const auto bytes = static_cast<GLsizeiptr>(vertices * sizeof(Vertex));
    const GLuint fed = buffer(GL_TRANSFORM_FEEDBACK_BUFFER, vertices * sizeof(Vertex), nullptr);
    glBindBufferBase(GL_TRANSFORM_FEEDBACK_BUFFER, 0, fed);
    const draw::OffscreenTarget target_pixel(1, 1);
    glEnable(GL_RASTERIZER_DISCARD);
    glBeginTransformFeedback(GL_POINTS);
    glDrawArrays(GL_POINTS, 0, static_cast<GLsizei>(vertices));
    glEndTransformFeedback();
    std::vector<Vertex> result(vertices);
    const void* const mapped = glMapBufferRange(GL_TRANSFORM_FEEDBACK_BUFFER, 0, bytes, GL_MAP_READ_BIT);
    check(mapped != nullptr, "the results cannot be mapped");
    std::copy_n(static_cast<const Vertex*>(mapped), vertices, result.begin());
    glUnmapBuffer(GL_TRANSFORM_FEEDBACK_BUFFER);
    glDeleteBuffers(1, &fed);
    glDeleteVertexArrays(1, &array);
    check(glGetError() == GL_NO_ERROR, "OpenGL reports an error");
    return result;
}

/// Plays the files of a texture. Its context must be current.
class TexturePlayer {
public:
    TexturePlayer(Api api, const clip::VertexTexture& texture, std::size_t vertices, std::size_t frames,
                  bool turned = false)
        : program_(program_for(api, shader_text(api))), vertices_(vertices) {
        glUseProgram(program_);
        for (const GLenum image : {0u, 1u}) {
            const WideImage stored = read_wide_image(texture.files[1 + image]);
            upload(api, GL_TEXTURE0 + image, turned ? upside_down(stored) : stored);
        }
        glUniform1i(at("positions"), 0);
        glUniform1i(at("normals"), 1);
        glUniform1i(at("clip.width"), static_cast<GLint>(texture.layout.width));
        glUniform1i(at("clip.rows_per_frame"), static_cast<GLint>(texture.layout.rows_per_frame));
        glUniform1i(at("clip.flipped_height"), turned ? static_cast<GLint>(texture.layout.height) : 0);
        glUniform3fv(at("clip.low"), 1, &texture.low.x);
        glUniform3fv(at("clip.high"), 1, &texture.high.x);
        glUniform1i(at("frames"), static_cast<GLint>(frames));
    }

    std::vector<Vertex> play(float frame, bool repeats) {
        glUniform1f(at("frame"), frame);
        glUniform1i(at("repeats"), repeats ? 1 : 0);
        return drawn(vertices_);
    }

private:
    [[nodiscard]] GLint at(const char* name) const { return glGetUniformLocation(program_, name); }

    GLuint program_;
    std::size_t vertices_;
};

/// A moment of a clip: `share` of the way from one frame to another.
struct Moment {
    float frame;
    bool repeats;
    std::size_t first, second;
    double share;
};

/// How far what is played is from a blend of two frames in double.
void check_moment(TexturePlayer& player, clip::Frames& frames, const clip::VertexTexture& texture,
                  const Moment& moment) {
    INFO("frame ", moment.frame, std::string(moment.repeats ? ", repeated" : ""));
    const std::vector<Vertex> played = player.play(moment.frame, moment.repeats);
    const std::vector<glm::dvec3> a = carried(frames, moment.first), b = carried(frames, moment.second),
                                  m = carried_normals(frames, moment.first),
                                  n = carried_normals(frames, moment.second);
    double position = 0, normal = 0;
    for (std::size_t i = 0; i < played.size(); ++i) {
        const glm::dvec3 exact = glm::mix(a[i], b[i], moment.share),
                         blend = glm::mix(m[i], n[i], moment.share);
        position = std::max(position, farthest(glm::dvec3(played[i].position), exact));
        CHECK(static_cast<double>(glm::length(played[i].normal)) == doctest::Approx(1).epsilon(1e-5));
        // A blend of two normals is shorter than these, and what rounding turns it by grows by as much.
        normal = std::max(normal, angle_between(glm::dvec3(played[i].normal), blend) * glm::length(blend));
    }
    CHECK(position <= texture.half_step + 2 * float_rounding(texture));
    CHECK(normal <= normal_half_step + 1e-4);
}

void check_played_by_gl(Api api, clip::Frames& frames, const mesh::Mesh& model,
                        const mesh::VertexArrays& arrays, bool turned) {
    std::string why;
    const draw::OffscreenContext context(api, why);
    if (!context) {
        MESSAGE("skipped: ", why);
        return;
    }
    const Folder folder;
    const clip::VertexTexture texture = saved_texture(frames, model, arrays, folder / "clip.json");
    TexturePlayer player(api, texture, frames.vertices(), frames.count(), turned);
    const std::size_t last = frames.count() - 1;
    const auto end = static_cast<float>(last);
    for (const Moment& moment :
         {Moment{0, false, 0, 0, 0}, Moment{3, false, 3, 3, 0}, Moment{end, false, last, last, 0},
          Moment{2.25f, false, 2, 3, 0.25}, Moment{end - 0.5f, false, last - 1, last, 0.5},
          Moment{-3, false, 0, 0, 0}, Moment{end + 9, false, last, last, 0}, Moment{1.75f, true, 1, 2, 0.75},
          Moment{end + 0.5f, true, last, 0, 0.5}, Moment{end + 2.25f, true, 1, 2, 0.25},
          Moment{-0.75f, true, last, 0, 0.25}})
        check_moment(player, frames, texture, moment);
}

void check_both(Api api, bool turned = false) {
    MovingPoints points(5000, 7, true);  // three rows a frame
    const mesh::Mesh model = strip(5000);
    check_played_by_gl(api, points, model, mesh::vertex_arrays(model), turned);
    BendingModel bending(test::model("insect_leg.glb"), 12);
    check_played_by_gl(api, bending, bending.model, bending.arrays, turned);
}

}  // namespace

TEST_CASE("vertex texture: OpenGL 3.3 plays the clip within its error, between frames too") {
    check_both(Api::core33);
}

TEST_CASE("vertex texture: OpenGL ES 3.0 plays the clip within its error, between frames too") {
    check_both(Api::es30);
}

TEST_CASE("vertex texture: images that a loader turned upside down are played by their height") {
    check_both(Api::core33, true);
    check_both(Api::es30, true);
}

TEST_CASE("vertex texture: a clip of one frame stands still") {
    std::string why;
    const draw::OffscreenContext context(Api::core33, why);
    if (!context) {
        MESSAGE("skipped: ", why);
        return;
    }
    const Folder folder;
    const mesh::Mesh model = strip(50);
    MovingPoints points(50, 1, true);
    const clip::VertexTexture texture =
        saved_texture(points, model, mesh::vertex_arrays(model), folder / "clip.json");
    TexturePlayer player(Api::core33, texture, 50, 1);
    for (const bool repeats : {false, true})
        for (const float frame : {0.0f, 0.5f, 7.0f})
            check_moment(player, points, texture, {frame, repeats, 0, 0, 0});
}

TEST_CASE("vertex texture: a vertex's number is found in TEXCOORD_1, however large it is") {
    std::string why;
    const draw::OffscreenContext context(Api::core33, why);
    if (!context) {
        MESSAGE("skipped: ", why);
        return;
    }
    const std::string text = "#version 330 core\n" + std::string(clip::vertex_texture_glsl()) +
                             R"(uniform int number;
out vec3 played_position;
out vec3 played_normal;
void main() {
    played_position = vec3(float(goffer_vertex(float(number)) - number));
    played_normal = vec3(1.0);
    gl_Position = vec4(0.0);
}
)";
    const GLuint program = program_for(Api::core33, text);
    glUseProgram(program);
    for (const int number : {0, 1, (1 << 23) - 1, 1 << 23, (1 << 23) + 1, (1 << 24) - 1}) {
        glUniform1i(glGetUniformLocation(program, "number"), number);
        const Vertex vertex = drawn(1)[0];
        CHECK(vertex.position == glm::vec3(0));
        CHECK(vertex.normal == glm::vec3(1));
    }
}
