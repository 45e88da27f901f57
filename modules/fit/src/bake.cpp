// SPDX-License-Identifier: MIT
#include "rest.hpp"

#include <goffer/fit/bake.hpp>

#include <string>

namespace goffer::fit {
namespace {

/// A level's mesh in the order of its body's vertices.
struct Sorted {
    std::vector<std::uint32_t> triangles, source;
    std::vector<glm::vec2> uvs;
};

template <class T>
std::vector<T> sorted(std::span<const T> values, const std::vector<std::uint32_t>& order) {
    std::vector<T> result;
    result.reserve(values.size());
    for (std::size_t i = 0; i < order.size() && !values.empty(); ++i) result.push_back(values[order[i]]);
    return result;
}

[[noreturn]] void refuse(std::size_t level, const std::string& what) {
    throw Error("levels[" + std::to_string(level) + "]." + what);
}

/// Refuses what could not even be put into another order; the rest is bend::save's to find.
void check_counts(const bend::DrawMesh& mesh, std::size_t vertices, std::size_t level) {
    const auto fits = [vertices](std::size_t count) { return count == 0 || count == vertices; };
    if (!fits(mesh.uvs.size())) refuse(level, "uvs: give none, or one for each vertex");
    if (!fits(mesh.source.size())) refuse(level, "source: give none, or one for each vertex");
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        if (mesh.triangles[i] >= vertices)
            refuse(level, "triangles[" + std::to_string(i / 3) + "]: vertex " +
                              std::to_string(mesh.triangles[i]) + " of " + std::to_string(vertices));
    }
}

/// `mesh` in the body's order, of which `memory` holds what had to be moved.
bend::DrawMesh in_body_order(const bend::DrawMesh& mesh, const std::vector<std::uint32_t>& order,
                             std::size_t vertices, std::size_t level, Sorted& memory) {
    if (order.empty()) return mesh;
    if (order.size() != vertices)
        refuse(level, "binding: its order has " + std::to_string(order.size()) + " vertices, and its body " +
                          std::to_string(vertices) + "; give what bind returned");
    const std::vector<std::uint32_t> place = [&] {
        try {
            return places_in_body(order);
        } catch (const Error& error) {
            refuse(level, std::string("binding: ") + error.what());
        }
    }();
    memory.triangles.reserve(mesh.triangles.size());
    for (const std::uint32_t vertex : mesh.triangles) memory.triangles.push_back(place[vertex]);
    memory.uvs = sorted(mesh.uvs, order);
    memory.source = mesh.source.empty() ? order : sorted(mesh.source, order);
    return {memory.triangles, memory.uvs, memory.source, mesh.parts};
}

}  // namespace

std::vector<std::byte> bake(const BakeInput& input) {
    std::vector<Sorted> memory(input.levels.size());
    std::vector<bend::LevelInput> levels;
    for (std::size_t i = 0; i < input.levels.size(); ++i) {
        const auto& [binding, mesh] = input.levels[i];
        if (binding == nullptr) refuse(i, "binding: null; give what bind returned");
        const std::size_t vertices = binding->body.vertex_count();
        check_counts(mesh, vertices, i);
        levels.push_back({&binding->body, in_body_order(mesh, binding->order, vertices, i, memory[i])});
    }
    bend::BodyFileFault fault;
    std::vector<std::byte> bytes = bend::save({levels, input.materials, input.sockets, input.notes}, &fault);
    if (!fault.none()) throw Error(bend::describe(fault).c_str());
    return bytes;
}

}  // namespace goffer::fit
