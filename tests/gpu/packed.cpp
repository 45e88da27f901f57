// SPDX-License-Identifier: MIT
#include "gl_vertex.hpp"
#include "support/accuracy.hpp"
#include "support/bodies.hpp"
#include "support/files.hpp"
#include "support/unpacked.hpp"

#include <goffer/bend/bounds.hpp>

#include <doctest/doctest.h>
#include <glm/gtc/type_ptr.hpp>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

/// The packed stream, decoded by OpenGL as engines do, by attributes and by words, against the CPU.

namespace goffer::test {
namespace {

using Api = draw::OffscreenContext::Api;

/// What a shader makes of a packed vertex on each way.
struct Decoded {
    glm::vec3 position, normal, position_of_words, normal_of_words;
};

const std::string decoding_main = R"(
layout(location = 0) in vec4 position;
layout(location = 1) in vec2 octant;
layout(location = 2) in uvec3 words;
uniform vec3 low, high;
out vec3 decoded_position, decoded_normal, position_of_words, normal_of_words;
void main() {
    decoded_position = goffer_position(position.xyz, low, high);
    decoded_normal = goffer_normal(octant);
    position_of_words = goffer_position(words, low, high);
    normal_of_words = goffer_normal(words);
    gl_Position = vec4(decoded_position, 1.0);
}
)";

/// The vertices as attributes of the formats that packed.glsl names.
void set_packed_attributes(std::span<const bend::PackedVertex> vertices) {
    GLuint array = 0;
    glGenVertexArrays(1, &array);
    glBindVertexArray(array);
    buffer(GL_ARRAY_BUFFER, vertices.size_bytes(), vertices.data());
    constexpr GLsizei stride = sizeof(bend::PackedVertex);
    const auto at = [](std::size_t offset) { return reinterpret_cast<const void*>(offset); };
    glVertexAttribPointer(0, 4, GL_UNSIGNED_SHORT, GL_TRUE, stride, nullptr);
    glVertexAttribPointer(1, 2, GL_SHORT, GL_TRUE, stride, at(offsetof(bend::PackedVertex, normal)));
    glVertexAttribIPointer(2, 3, GL_UNSIGNED_INT, stride, nullptr);
    for (GLuint location = 0; location < 3; ++location) glEnableVertexAttribArray(location);
}

/// In the context that is current.
std::vector<Decoded> decoded(Api api, std::span<const bend::PackedVertex> vertices, const bend::Bounds& box) {
    const bool embedded = api == Api::es30;
    const std::string text = (embedded ? "#version 300 es\n" : "#version 330 core\n") +
                             bytes_of(GOFFER_SOURCE_DIR "/modules/bend/include/goffer/bend/packed.glsl") +
                             decoding_main;
    const GLuint program = vertex_program(
        text, embedded, {"decoded_position", "decoded_normal", "position_of_words", "normal_of_words"});
    glUseProgram(program);
    glUniform3fv(glGetUniformLocation(program, "low"), 1, glm::value_ptr(box.low));
    glUniform3fv(glGetUniformLocation(program, "high"), 1, glm::value_ptr(box.high));
    set_packed_attributes(vertices);
    std::vector<Decoded> result(vertices.size());
    capture(result.size() * sizeof(Decoded), result.size(), 1);
    read_back(GL_TRANSFORM_FEEDBACK_BUFFER, std::span(result));
    return result;
}

/// Makes vertices of any bits, and one for each pair of extreme normals.
std::vector<bend::PackedVertex> random_vertices(Random& random) {
    constexpr std::array<std::int16_t, 8> steps{-32768, -32767, -32766, -1, 0, 1, 32766, 32767};
    constexpr std::array<std::uint16_t, 5> places{0, 1, 32767, 65534, 65535};
    std::vector<bend::PackedVertex> vertices(4000);
    std::size_t number = 0;
    for (bend::PackedVertex& vertex : vertices) {
        const std::size_t i = number++;
        const bool extreme = i < steps.size() * steps.size();
        for (std::size_t axis = 0; axis < 3; ++axis)
            vertex.position[axis] =
                extreme ? places[(i + axis) % places.size()] : static_cast<std::uint16_t>(random());
        vertex.normal[0] = extreme ? steps[i / steps.size()] : static_cast<std::int16_t>(random());
        vertex.normal[1] = extreme ? steps[i % steps.size()] : static_cast<std::int16_t>(random());
        vertex.unused = static_cast<std::uint16_t>(random());  // means nothing
    }
    return vertices;
}

/// The largest distance along an axis, in steps of the box.
double steps_between(const glm::vec3& a, const glm::vec3& b, const bend::Bounds& box) {
    const glm::dvec3 steps =
        glm::abs(glm::dvec3(a) - glm::dvec3(b)) / glm::dvec3(box.high - box.low) * 65535.0;
    return glm::max(steps.x, glm::max(steps.y, steps.z));
}

void decoders_agree(Api api, unsigned seed) {
    std::string why;
    const draw::OffscreenContext context(api, why);
    if (!context) {
        MESSAGE("skipped: ", why);
        return;
    }
    Random random(seed);
    const std::vector<bend::PackedVertex> vertices = random_vertices(random);
    const bend::Bounds box{{-3, 0.5f, -100}, {5, 0.75f, 20}};
    const std::vector<Decoded> is = decoded(api, vertices, box);
    double position = 0, normal = 0, of_words = 0;
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        const glm::vec3 expected = shader::goffer_position(words(vertices[i]), box.low, box.high);
        const glm::vec3 direction = shader::goffer_normal(words(vertices[i]));
        take_worst(position, steps_between(is[i].position, expected, box));
        take_worst(position, steps_between(is[i].position_of_words, expected, box));
        take_worst(normal, angle_between(glm::dvec3(is[i].normal), glm::dvec3(direction)));
        take_worst(of_words, angle_between(glm::dvec3(is[i].normal_of_words), glm::dvec3(direction)));
    }
    CHECK(position <= 0.5);
    // Half a step of both numbers of an octant, which OpenGL before 4.2 may be off by, turns a normal by
    // 0.0037 degrees at most: where it is shortest, in the middle of a face.
    CHECK(normal <= 0.0038);
    CHECK(of_words <= 1e-4);
    MESSAGE("position ", position, " steps, normal ", normal, " deg by attributes, ", of_words,
            " deg by words");
}

}  // namespace

TEST_CASE("shader: OpenGL 3.3 decodes packed vertices as the CPU does") {
    decoders_agree(Api::core33, 98);
}

TEST_CASE("shader: OpenGL ES 3.0 decodes packed vertices as the CPU does") {
    decoders_agree(Api::es30, 99);
}

}  // namespace goffer::test
