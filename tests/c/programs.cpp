// SPDX-License-Identifier: MIT
#include "support/bodies.hpp"
#include "support/commands.hpp"
#include "support/files.hpp"

#include <goffer/bend/body_file.hpp>
#include <goffer/bend/crowd.hpp>
#include <goffer/fit/bake.hpp>

#include <doctest/doctest.h>
#include <fcntl.h>
#include <goffer.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cmath>
#include <cstddef>
#include <cstring>
#include <filesystem>
#include <regex>
#include <set>
#include <span>
#include <string>
#include <vector>

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

constexpr std::size_t instances = 100;

/// As samples/crowd.c has it.
struct Worm {
    bend::Pose poses[bend::max_regions];
    glm::mat4x3 model{1};
};
struct Vertex {
    glm::vec3 position, normal;
};

template <class MaxAngle>
std::vector<Worm> worms_of(double length, std::size_t regions, const MaxAngle& max_angle) {
    std::vector<Worm> worms(instances);
    for (std::size_t i = 0; i < instances; ++i) {
        for (std::size_t r = 0; r < regions; ++r) {
            const auto limit = static_cast<double>(max_angle(r));
            worms[i].poses[r] = {static_cast<float>(limit * std::sin(2.4 * static_cast<double>(i))),
                                 static_cast<float>(0.5 * static_cast<double>(i))};
        }
        worms[i].model[3] = {static_cast<float>(1.5 * length * static_cast<double>(i % 10)), 0,
                             static_cast<float>(1.5 * length * static_cast<double>(i / 10))};
    }
    return worms;
}

/// What the samples print of the vertices of a crowd.
std::string line_of(std::span<const Vertex> vertices) {
    std::vector<std::uint32_t> words(vertices.size() * sizeof(Vertex) / 4);
    std::memcpy(words.data(), vertices.data(), 4 * words.size());
    std::uint64_t sum = 0;
    for (std::size_t i = 0; i < words.size(); ++i) sum += std::uint64_t{words[i]} * (i + 1);
    char line[100];
    std::snprintf(line, sizeof line, "%zu instances of %zu vertices: %016llx\n", instances,
                  vertices.size() / instances, static_cast<unsigned long long>(sum));
    return line;
}

/// What C++ would print of a body.
std::string line_in_cpp(const bend::Body& body) {
    const std::vector<Worm> worms =
        worms_of(body.length(), body.region_count(), [&](std::size_t r) { return body.max_angle(r); });
    std::vector<Vertex> vertices(instances * body.vertex_count());
    bend::Batch batch{.body = &body, .count = instances};
    batch.poses = strided(std::span(worms), &Worm::poses);
    batch.transforms = strided(std::span(worms), &Worm::model);
    batch.positions = interleaved<3>(&vertices[0].position.x, vertices.size(), sizeof(Vertex));
    batch.normals = interleaved<3>(&vertices[0].normal.x, vertices.size(), sizeof(Vertex));
    batch.vertex_step = body.vertex_count();
    const bend::CrowdJob crowd{.batches = {&batch, 1}};
    REQUIRE(bend::validate(crowd).none());
    bend::run_parallel(crowd);
    return line_of(vertices);
}

/// The same by the functions of C.
std::string line_in_c(const goffer_body* body) {
    const std::size_t count = goffer_body_vertex_count(body);
    const std::vector<Worm> worms = worms_of(goffer_body_length(body), goffer_body_region_count(body),
                                             [&](std::size_t r) { return goffer_body_max_angle(body, r); });
    std::vector<Vertex> vertices(instances * count);
    const auto column = [&](std::size_t offset) {
        return goffer_column{worms.data(), instances, sizeof(Worm), static_cast<std::uint32_t>(offset), 0};
    };
    const auto stream = [&](glm::vec3& first) {
        return goffer_stream{{&first.x, &first.y, &first.z, nullptr}, sizeof(Vertex), vertices.size()};
    };
    goffer_batch batch = {};
    batch.body = body;
    batch.count = instances;
    batch.poses = column(offsetof(Worm, poses));
    batch.transforms = column(offsetof(Worm, model));
    batch.positions = stream(vertices[0].position);
    batch.normals = stream(vertices[0].normal);
    batch.vertex_step = count;
    goffer_crowd* const crowd = goffer_crowd_create(1, nullptr);
    REQUIRE(goffer_crowd_set(crowd, 0, &batch, nullptr) == 1);
    REQUIRE(goffer_crowd_validate(crowd, nullptr) == 1);
    goffer_crowd_run_parallel(crowd);
    goffer_crowd_free(crowd);
    return line_of(vertices);
}

/// A file as the system maps it.
class Mapped {
public:
    explicit Mapped(const std::string& name) : size_(std::filesystem::file_size(name)) {
        const int file = open(name.c_str(), O_RDONLY);
        memory_ = mmap(nullptr, size_, PROT_READ, MAP_PRIVATE, file, 0);
        close(file);
        REQUIRE(memory_ != MAP_FAILED);
    }
    Mapped(const Mapped&) = delete;
    Mapped& operator=(const Mapped&) = delete;
    ~Mapped() { munmap(memory_, size_); }

    [[nodiscard]] std::span<const std::byte> bytes() const {
        return {static_cast<const std::byte*>(memory_), size_};
    }

private:
    std::size_t size_;
    void* memory_;
};

/// A body of so many regions, and a file of it.
struct Baked {
    Folder folder;
    std::string file = (folder / "worm.goffer").string();
    fit::Binding binding;

    explicit Baked(std::size_t regions) {
        Random random(75);
        const TestMesh mesh = random_mesh(random, 12, 2, 24, 65);
        fit::BindOptions options;
        options.regions.assign(regions, {1.0 / static_cast<double>(regions), {}});
        binding = fit::bind(mesh.geometry(), mesh.cylinder, options);
        const fit::BakeLevel level{&binding, {mesh.triangles, {}, {}, {}}};
        const std::vector<std::byte> bytes = fit::bake({{&level, 1}});
        folder.write("worm.goffer", {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
    }
};

}  // namespace

TEST_CASE("C: one crowd from C++ and C, of a body that is bound, read or mapped, has one sum") {
    for (const std::size_t regions : {1, 3}) {
        const Baked baked(regions);
        const std::string line = line_in_cpp(baked.binding.body);
        const Mapped mapped(baked.file);
        CHECK(line_in_cpp(bend::load(mapped.bytes()).value().levels[0].body) == line);
        goffer_file* const loaded = goffer_file_load(mapped.bytes().data(), mapped.bytes().size(),
                                                     GOFFER_VERIFY_EVERYTHING, 0, nullptr);
        REQUIRE(loaded != nullptr);
        CHECK(line_in_c(goffer_file_body(loaded, 0)) == line);
        goffer_file_free(loaded);
        CHECK(output_of("'" GOFFER_C_SAMPLE "' '" + baked.file + "'") == line);
    }
    CHECK(output_of("'" GOFFER_C_SAMPLE "' /dev/null 2>&1").starts_with("goffer_c_sample: /dev/null: "));
}

TEST_CASE("C: one crowd from C++, and from Python by a mapped file, has one sum") {
    const std::string python = python_with_numpy();
    if (python.empty()) {
        MESSAGE("skipped: there is no NumPy here");
        return;
    }
    for (const std::size_t regions : {1, 3}) {
        const Baked baked(regions);
        CHECK(output_of(python + " '" GOFFER_PYTHON_SAMPLE "' '" GOFFER_C_LIBRARY "' '" + baked.file +
                        "' 2>&1") == line_in_cpp(baked.binding.body));
    }
}

TEST_CASE("C: programs ask for the library of one minor version") {
    const std::string version = GOFFER_PROJECT_VERSION;
    const std::string headers = output_of("readelf -d '" GOFFER_C_LIBRARY "'");
    CHECK(headers.find("[libgoffer.so." + version.substr(0, version.rfind('.')) + "]") != headers.npos);
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
