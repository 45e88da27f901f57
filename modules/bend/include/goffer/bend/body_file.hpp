// SPDX-License-Identifier: MIT
#pragma once

#include <goffer/bend/body.hpp>
#include <goffer/bend/fault.hpp>
#include <goffer/bend/file_memory.hpp>
#include <goffer/bend/job.hpp>
#include <goffer/bend/sockets.hpp>

#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

/// The body file: bodies, and what is drawn of them, as one block of bytes that is used where it lies. A
/// pipeline makes it (goffer bake, or fit::bake), a game maps it:
///
///     bend::BodyFileFault fault;
///     const std::optional<bend::BodyFile> file = bend::load(bytes, &fault);
///     if (!file) return report(bend::describe(fault).c_str());
///     job.body = &file->levels[0].body;
///
/// A body that was saved and loaded deforms to the same bits. The format is in modules/bend/README.md. All
/// functions are thread-safe; they allocate, and may throw std::bad_alloc, which leaks what they have
/// allocated.

namespace goffer::bend {

/// The version that save() writes. load() also takes all older ones.
inline constexpr std::uint32_t body_file_version = 1;

/// The most levels of detail that a file can have.
inline constexpr std::size_t max_levels = 16;

/// Triangles that are drawn together. Names, and notes, are bytes as they were given: UTF-8 is meant, but not
/// looked for.
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
    /// what else the model says of it (colors, weights). Nothing looks whether the model has that many.
    std::span<const std::uint32_t> source;
    std::span<const DrawPart> parts;  ///< none, or covering all triangles, in order
};

/// A socket with a name. Sockets::make takes the sockets of any level.
struct NamedSocket {
    std::string_view name;  ///< may be empty
    Socket socket;
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
/// Its bodies may be moved out of it, and outlive it.
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

/// A part of a file. From `level` on there is one for each level.
enum class FileSection : std::uint8_t {
    header,
    directory,
    rig,
    regions,
    wrinkle_rows,
    factor_rows,
    materials,
    sockets,
    names,
    notes,
    level,
    bands,
    columns,
    triangles,
    uvs,
    source,
    parts,
};

/// What is wrong with a file, or with what one is to be made from.
enum class FileReason : std::uint8_t {
    none,
    not_a_body_file,  ///< too short, or begins with other bytes
    byte_order,       ///< made on a machine whose numbers have their bytes in the other order
    version,          ///< newer than this library, or 0
    truncated,        ///< has fewer bytes than it says
    too_long,         ///< has more bytes than it says
    alignment,        ///< lies at no multiple of 64 bytes in memory: load_copy() takes it
    checksum,         ///< some byte is not what was written
    layout,           ///< a section does not lie where it must, or has bytes that must be 0 and are not
    count,            ///< a section has too few entries, too many, or not as many as another one
    number,           ///< a number is not finite, or out of its range
    index,            ///< an entry refers to what is not there
    rig,              ///< a level has not the regions, tables or frame of the first one
    empty,            ///< a level has no body
};

/// The first fault of a file. A plain value; a default-made one is none.
struct BodyFileFault {
    static constexpr std::size_t nowhere = Fault::nowhere;

    FileReason reason = FileReason::none;
    FileSection section = FileSection::header;
    std::size_t level = nowhere;  ///< `nowhere`: a section that all levels share
    std::size_t index = nowhere;  ///< entry of the section; `nowhere`: all of it
    BodyFault body = {};          ///< more of it, where the fault is a body's or a socket's number

    [[nodiscard]] bool none() const noexcept { return reason == FileReason::none; }
};

/// Says in one line what is wrong and where, as in "levels[1].triangles[7]: refers to what is not there".
/// Says "no fault" of none. Does not allocate.
[[nodiscard]] FaultText describe(const BodyFileFault& fault) noexcept;

/// How much of a file is looked at before it is used.
enum class Verify : std::uint8_t {
    /// All of it: the checksum, and each number, so that a file from anywhere does no harm. The runs of its
    /// bodies are as safe as those of Body::make's, and triangles, parts and sockets refer to what is there.
    /// In the default floating-point environment, or with subnormal numbers taken as 0.
    everything,
    /// That no byte has changed since it was written, and what takes no time: for files that come from where
    /// nobody means harm.
    checksum,
    /// What takes no time in proportion to the vertices: loading does not touch columns, triangles or texture
    /// coordinates, which a mapped
    /// file then reads when they are first used. For files that were verified once, by whoever installed
    /// them. In one that was changed since then, these are any bits: a run stays within its memory and writes
    /// numbers that mean nothing, but an index of a triangle may be that of no vertex.
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

/// Returns the bytes of a file, or none where load() would find a fault in them; *fault as above. The same
/// input gives the same bytes.
[[nodiscard]] std::vector<std::byte> save(const BodyFileInput& input, BodyFileFault* fault = nullptr);

}  // namespace goffer::bend
