// SPDX-License-Identifier: MIT
#include "support/bodies.hpp"
#include "support/commands.hpp"
#include "support/files.hpp"

#include <goffer/bend/crowd.hpp>
#include <goffer/fit/bake.hpp>

#include <doctest/doctest.h>

#include <cmath>
#include <cstring>
#include <fstream>
#include <regex>
#include <set>
#include <string>

/// The library as programs in other languages see it: one crowd has one sum of bits in C++, C and Python, and
/// nothing is exported but what the header declares.

namespace goffer::test {
namespace {

/// The first python3 of the path may not be the system's, whose packages are installed. Empty: there is none.
std::string python_with_numpy() {
    for (const std::string python : {"python3", "/usr/bin/python3"}) {
        if (output_of(python + " -c 'import numpy; print(1)' 2>&1") == "1\n") return python;
    }
    return {};
}

/// As samples/crowd.c has it.
struct Worm {
    bend::Pose pose;
    glm::mat4x3 model{1};
};
struct Vertex {
    glm::vec3 position, normal;
};

/// What the samples print of a body of one region.
std::string line_for(const bend::Body& body) {
    constexpr std::size_t instances = 100;
    std::vector<Worm> worms(instances);
    const double step = 1.5 * body.length();
    for (std::size_t i = 0; i < instances; ++i) {
        const double limit = static_cast<double>(body.max_angle());
        worms[i].pose = {static_cast<float>(limit * std::sin(2.4 * static_cast<double>(i))),
                         static_cast<float>(0.5 * static_cast<double>(i))};
        worms[i].model[3] = {static_cast<float>(step * static_cast<double>(i % 10)), 0,
                             static_cast<float>(step * static_cast<double>(i / 10))};
    }
    std::vector<Vertex> vertices(instances * body.vertex_count());
    bend::Batch batch{.body = &body, .count = instances};
    batch.poses = strided(std::span(worms), &Worm::pose);
    batch.transforms = strided(std::span(worms), &Worm::model);
    batch.positions = interleaved<3>(&vertices[0].position.x, vertices.size(), sizeof(Vertex));
    batch.normals = interleaved<3>(&vertices[0].normal.x, vertices.size(), sizeof(Vertex));
    batch.vertex_step = body.vertex_count();
    bend::run_parallel(bend::CrowdJob{.batches = {&batch, 1}});
    std::vector<std::uint32_t> words(vertices.size() * sizeof(Vertex) / 4);
    std::memcpy(words.data(), vertices.data(), 4 * words.size());
    std::uint64_t sum = 0;
    for (std::size_t i = 0; i < words.size(); ++i) sum += std::uint64_t{words[i]} * (i + 1);
    char line[100];
    std::snprintf(line, sizeof line, "100 instances of %zu vertices: %016llx\n", body.vertex_count(),
                  static_cast<unsigned long long>(sum));
    return line;
}

}  // namespace

TEST_CASE("C: one crowd from C++, from C, and from Python by a mapped file has one sum") {
    Random random(75);
    const TestMesh mesh = random_mesh(random, 12, 2, 24, 65);
    const fit::Binding binding = fit::bind(mesh.geometry(), mesh.cylinder);
    const fit::BakeLevel level{&binding, {mesh.triangles, {}, {}, {}}};
    const std::vector<std::byte> bytes = fit::bake({{&level, 1}});
    const Folder folder;
    const std::string file = (folder / "worm.goffer").string();
    std::ofstream(file, std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));

    const std::string line = line_for(binding.body);
    CHECK(output_of("'" GOFFER_C_SAMPLE "' '" + file + "'") == line);
    CHECK(output_of("'" GOFFER_C_SAMPLE "' /dev/null 2>&1").starts_with("goffer_c_sample: /dev/null: "));
    const std::string python = python_with_numpy();
    if (python.empty()) {
        MESSAGE("skipped: there is no NumPy here");
        return;
    }
    CHECK(output_of(python + " '" GOFFER_PYTHON_SAMPLE "' '" GOFFER_C_LIBRARY "' '" + file + "' 2>&1") ==
          line);
}

TEST_CASE("C: the library exports the functions of its header, and no others") {
    std::set<std::string> declared, exported;
    const std::string header = bytes_of(GOFFER_C_HEADER);
    const std::regex function(R"(GOFFER_API [^;(]*?(goffer_\w+)\()");
    for (std::sregex_iterator found(header.begin(), header.end(), function), end; found != end; ++found)
        declared.insert((*found)[1]);
    const std::string names = output_of("nm -D --defined-only '" GOFFER_C_LIBRARY "'");
    const std::regex symbol(R"([0-9a-f]+ \w (\S+))");
    for (std::sregex_iterator found(names.begin(), names.end(), symbol), end; found != end; ++found)
        exported.insert((*found)[1]);
    CHECK(declared.size() > 40);
    CHECK(exported == declared);
}

}  // namespace goffer::test
