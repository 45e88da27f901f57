// SPDX-License-Identifier: MIT
#include "memory.hpp"

#include "arguments.hpp"

#include <goffer/io/error.hpp>

#include <CLI/CLI.hpp>

#include <algorithm>
#include <fstream>
#include <limits>
#include <string>

namespace goffer::cli {
namespace {

/// The machine's, in kB in the line "MemAvailable:".
std::optional<std::uint64_t> machine() {
    std::ifstream file("/proc/meminfo");
    std::string name, line;
    for (std::uint64_t kilobytes = 0; file >> name >> kilobytes; std::getline(file, line)) {
        if (name == "MemAvailable:") return 1024 * kilobytes;
    }
    return std::nullopt;
}

std::optional<std::uint64_t> number_in(const char* name) {
    std::ifstream file(name);
    std::uint64_t bytes = 0;
    return file >> bytes ? std::optional(bytes) : std::nullopt;
}

/// What a container takes of its memory for copies of files, which it gives back.
std::uint64_t files_of_container() {
    std::ifstream file("/sys/fs/cgroup/memory.stat");
    std::string name;
    for (std::uint64_t bytes = 0; file >> name >> bytes;) {
        if (name == "inactive_file") return bytes;
    }
    return 0;
}

/// What a container's limit leaves. The limit is "max", no number, where there is none.
std::optional<std::uint64_t> container() {
    const std::optional<std::uint64_t> limit = number_in("/sys/fs/cgroup/memory.max");
    if (!limit) return std::nullopt;
    const std::uint64_t taken = number_in("/sys/fs/cgroup/memory.current").value_or(0);
    const std::uint64_t in_use = taken - std::min(taken, files_of_container());
    return *limit - std::min(*limit, in_use);
}

// For a bare cylinder of 1 million vertices and 2 million triangles, `goffer bend` takes 0.61 GB as PLY and
// GLB, 0.66 GB as OBJ, and 0.85 GB with --png and --ghost (x86-64).
constexpr std::uint64_t bytes_per_vertex = 300, bytes_per_triangle = 300;

}  // namespace

// CLI11 alone takes -1 for the largest number.
CLI::Validator size_word() {
    constexpr std::size_t most_digits = 15;
    const auto read = [](std::string& word) {
        const std::size_t digits = word.find_first_not_of("0123456789.");
        std::string refused = "'" + word + "' is not a size, such as 500M or 8G";
        if (word.empty() || digits == 0 || std::min(digits, word.size()) > most_digits) return refused;
        try {
            return CLI::AsSizeValue(false)(word).empty() ? std::string() : refused;
        } catch (const CLI::ValidationError&) {
            return refused;
        }
    };
    return {read, "SIZE"};
}

std::optional<std::uint64_t> free_memory() {
    const std::optional<std::uint64_t> free = machine();
    const std::optional<std::uint64_t> limit = container();
    return free && limit ? std::min(*free, *limit) : (free ? free : limit);
}

void add_memory_word(CLI::App& command, mesh::Limits& limits) {
    limits.vertices = limits.triangles = std::numeric_limits<std::uint32_t>::max();
    command
        .add_option("--max-memory", limits.memory,
                    "Refuse a model that would take more memory than this, as 500M or 8G (default: " +
                        io::size_text(limits.memory) + ")")
        ->transform(size_word())
        ->type_name("SIZE");
}

std::uint64_t memory_for(std::uint64_t vertices, std::uint64_t triangles) {
    return vertices * bytes_per_vertex + triangles * bytes_per_triangle;
}

std::size_t most_triangles(const mesh::Limits& limits) {
    return static_cast<std::size_t>(limits.memory / (bytes_per_triangle + bytes_per_vertex / 2));
}

void check_memory(const std::string& what, const mesh::Mesh& mesh, const mesh::Limits& limits) {
    // A vertex with several normals is several for the deformer.
    const std::size_t vertices =
        std::max({mesh.positions.size(), mesh.normals.values.size(), mesh.tangents.values.size()});
    const std::size_t triangles = mesh::triangle_count(mesh);
    if (memory_for(vertices, triangles) <= limits.memory) return;
    throw InputError(what + ": " + std::to_string(vertices) + " vertices and " + std::to_string(triangles) +
                     " triangles take more than the " + io::size_text(limits.memory) +
                     " of memory that are allowed; use a smaller mesh, or allow more with --max-memory");
}

}  // namespace goffer::cli
