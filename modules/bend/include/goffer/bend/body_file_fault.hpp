// SPDX-License-Identifier: MIT
#pragma once

#include <goffer/bend/body_fault.hpp>
#include <goffer/bend/fault.hpp>

#include <cstddef>
#include <cstdint>

/// What can be wrong with a body file (see goffer/bend/body_file.hpp).

namespace goffer::bend {

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
    /// A section or a part does not lie where it must, or a flag or a byte has a value that it cannot have.
    layout,
    count,       ///< a section has too few entries, too many, or not as many as another one
    number,      ///< a number is not finite, or out of its range
    index,       ///< an entry refers to what is not there
    rig,         ///< a level does not have the regions, tables or frame of the first one
    empty,       ///< a level has no body
    missing,     ///< load_file() finds no file of that name
    unreadable,  ///< load_file() cannot open or read it
};

/// The first fault of a file. A plain value; a default-constructed one is none.
struct BodyFileFault {
    static constexpr std::size_t nowhere = Fault::nowhere;

    FileReason reason = FileReason::none;
    FileSection section = FileSection::header;
    std::size_t level = nowhere;  ///< `nowhere`: a section that all levels share
    std::size_t index = nowhere;  ///< entry of the section (of columns the vertex, of triangles the
                                  ///< triangle), or its version; `nowhere`: all of it
    BodyFault body = {};          ///< more of it, where the fault is a body's or a socket's number

    [[nodiscard]] bool none() const noexcept { return reason == FileReason::none; }
};

/// Says in one line what is wrong and where, as in "levels[1].triangles[7]: refers to what is not there".
/// Returns "no fault" if there is none. Does not allocate. Thread-safe.
[[nodiscard]] FaultText describe(const BodyFileFault& fault) noexcept;

}  // namespace goffer::bend
