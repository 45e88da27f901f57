// SPDX-License-Identifier: MIT
#pragma once

#include <goffer/bend/body.hpp>
#include <goffer/bend/body_file_fault.hpp>
#include <goffer/bend/file_memory.hpp>
#include <goffer/bend/job.hpp>
#include <goffer/bend/socket.hpp>

#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

/// The body file: bodies, and what is drawn of them, as one block of bytes. Columns, triangles, texture
/// coordinates and names are used where they lie in it; regions and tables are copied, for each level. A
/// pipeline makes it (goffer bake, or fit::bake), a game reads it, or maps it and calls load():
///
///     bend::BodyFileFault fault;
///     const std::optional<bend::BodyFile> file = bend::load_file("worm.goffer", &fault);
///     if (!file) return report(bend::describe(fault).c_str());
///     job.body = &file->levels[0].body;
///
/// A body that was saved and loaded deforms to the same bits. The format is in modules/bend/README.md. All
/// functions are thread-safe; all but is_body_file() allocate, and may throw std::bad_alloc, which leaks what
/// they have allocated.

namespace goffer::bend {

/// The version that save() writes. load() takes it and version 1.
inline constexpr std::uint32_t body_file_version = 2;

/// The most levels of detail that a file can have.
inline constexpr std::size_t max_levels = 16;

/// Triangles that are drawn together. Names, and notes, are bytes as they were given. They should be UTF-8;
/// this is not checked.
struct DrawPart {
    std::string_view name;  ///< may be empty
    std::uint32_t first_triangle = 0;
    std::uint32_t triangle_count = 0;
    std::int32_t material = -1;  ///< index into the file's materials, or -1 for none
};

/// A material, by the name that an engine knows it by.
struct DrawMaterial {
    std::string_view name;    ///< may be empty
    glm::vec4 base_color{1};  ///< linear RGBA
};

/// What is drawn of a body, beside the streams that a run writes. Owns nothing.
struct DrawMesh {
    std::span<const std::uint32_t> triangles;  ///< 3 vertices of the body each; counterclockwise from outside
    std::span<const glm::vec2> uvs;            ///< none, or one per vertex; v points up
    /// None, or for each vertex of the body which vertex it is in the model that it was made from: to find
    /// what else the model says of it (colors, weights). Nothing checks that the model has that many.
    std::span<const std::uint32_t> source;
    std::span<const DrawPart> parts;  ///< none, or covering all triangles, in order
};

/// A level of detail to be saved.
struct LevelInput {
    const Body* body = nullptr;  ///< neither null nor empty
    DrawMesh mesh = {};
};

/// What a file is made from. Nothing of it is needed once it is saved.
struct BodyFileInput {
    /// From fine to coarse, 1 to max_levels. All have the regions, tables and frame of the first one, as
    /// fit::bind_level leaves them, so that one array of poses serves them all.
    std::span<const LevelInput> levels;
    std::span<const DrawMaterial> materials;
    std::span<const NamedSocket> sockets;
    std::string_view notes;  ///< for people and tools; goffer's libraries do not read it
};

/// A level of detail as it was loaded.
struct BodyFileLevel {
    Body body;
    DrawMesh mesh;
    Bounds rest_bounds;  ///< the tight box of all vertices at rest, model space; as the file has it
};

/// What a file holds; move-only. Spans and names refer to its bytes, and are good for as long as this object.
/// Its bodies may be moved out of it, and outlive it; one that was loaded by load_file() or load_copy() keeps
/// all bytes of the file.
struct BodyFile {
    std::vector<BodyFileLevel> levels;  ///< from fine to coarse, at least one
    std::vector<DrawMaterial> materials;
    std::vector<NamedSocket> sockets;
    std::string_view notes;

    /// For goffer's own sources: load() makes files.
    explicit BodyFile(FileMemory memory) noexcept;
    BodyFile(BodyFile&& other) noexcept;
    BodyFile& operator=(BodyFile&& other) noexcept;
    ~BodyFile();

private:
    FileMemory memory_;
};

/// How much of a file is looked at before it is used.
enum class Verify : std::uint8_t {
    /// All of it: the checksum, and each number, so that a file from anywhere does no harm. Runs of its
    /// bodies are as safe as those of bodies from Body::make, and triangles, parts and sockets refer to what
    /// is there. Two things are not verified: rest_bounds, beyond that they are finite and in order, and what
    /// DrawMesh::source refers to. Do not cull by the one, nor index by the other without a check. To be
    /// called in the default floating-point environment, or with subnormal numbers taken as 0.
    everything,
    /// The checksum, and what Verify::layout looks at: for files from a source that is trusted.
    checksum,
    /// What takes no time in proportion to vertices and triangles: loading does not touch columns, triangles
    /// or texture coordinates, which a mapped file then reads when they are first used. For files that were
    /// verified once, by whoever installed them. In one that was changed since then, these are any bits: a
    /// run stays within its memory and writes numbers that mean nothing, but an index of a triangle may be
    /// that of no vertex.
    layout,
};

/// Whether `bytes` begin as a body file does: to tell it from other files by its content.
[[nodiscard]] bool is_body_file(std::span<const std::byte> bytes) noexcept;

/// Returns what `bytes` hold, which is used where it lies: the memory belongs to the caller, must begin at a
/// multiple of 64 bytes (mapped files do) and must outlive the file and its bodies, unchanged. Returns
/// nothing where there is a fault, and sets *fault to it, or to none, if `fault` is not null.
[[nodiscard]] std::optional<BodyFile> load(std::span<const std::byte> bytes, BodyFileFault* fault = nullptr,
                                           Verify verify = Verify::everything);

/// The same with a copy of `bytes`, which may lie anywhere and are not needed afterward.
[[nodiscard]] std::optional<BodyFile> load_copy(std::span<const std::byte> bytes,
                                                BodyFileFault* fault = nullptr,
                                                Verify verify = Verify::everything);

/// The same of the file called `name` (as std::fopen takes it), which is read into memory.
[[nodiscard]] std::optional<BodyFile> load_file(const char* name, BodyFileFault* fault = nullptr,
                                                Verify verify = Verify::everything);

/// Returns the bytes of a file, or none where load() would find a fault in them; *fault as above. The same
/// input gives the same bytes.
[[nodiscard]] std::vector<std::byte> save(const BodyFileInput& input, BodyFileFault* fault = nullptr);

}  // namespace goffer::bend
