// SPDX-License-Identifier: MIT
#pragma once

#include "command_line.hpp"

#include <goffer/mesh/mesh.hpp>

#include <cstdint>
#include <optional>
#include <string>

namespace goffer::cli {

/// Bytes that a program can still use without pushing others out, or nothing where the system does not say
/// (it does on Linux). Asking for more often succeeds, and using it ends the program.
[[nodiscard]] std::optional<std::uint64_t> free_memory();

/// Takes a size as 500M or 8G, and makes a number of bytes of it.
[[nodiscard]] CLI::Validator size_word();

/// Adds --max-memory, the one limit that the command has: numbers of vertices and triangles follow from it.
/// `limits` must outlive `command`.
void add_memory_word(CLI::App& command, mesh::Limits& limits);

/// What a command takes with a mesh of so many vertices and triangles, in bytes: an estimate from above.
[[nodiscard]] std::uint64_t memory_for(std::uint64_t vertices, std::uint64_t triangles);

/// How many triangles a mesh may have, with half as many vertices, as closed surfaces do.
[[nodiscard]] std::size_t most_triangles(const mesh::Limits& limits);

/// Refuses (InputError that begins with `what`) a mesh that would take more than is allowed.
void check_memory(const std::string& what, const mesh::Mesh& mesh, const mesh::Limits& limits);

}  // namespace goffer::cli
