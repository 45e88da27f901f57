// SPDX-License-Identifier: MIT
#pragma once

#include "kernel/args.hpp"

#include <goffer/bend/crowd.hpp>

#include <cstddef>
#include <cstdint>
#include <span>

/// What a batch writes and where, found once for all its instances: which passes over the vertices make it,
/// how their values lie in the caller's memory, and on which way they get there.

namespace goffer::bend {

/// A run of kernels over an instance's vertices, by what it is posed with.
enum class Pass : std::uint8_t { current, previous, packed };
constexpr std::size_t pass_count = 3;

/// What passes make at most: position, normal, tangent; previous position; three packed words.
constexpr std::size_t most_values = 16;

/// One value of each vertex. (Without initial values, as Record: plans have room for more than they use.)
struct Component {
    float* first;        ///< vertex 0's
    std::size_t stride;  ///< bytes
    std::size_t value;   ///< which of all that passes make
};

/// Components of one stride that are nearer to each other than it: members of one struct, or a plane alone.
struct Record {
    float* first;           ///< vertex 0's first value
    std::size_t stride;     ///< bytes
    std::size_t floats;     ///< from the first value to behind the last
    bool in_lines;          ///< written past the cache: it has no gaps, or gaps that may be written
    bool in_strip;          ///< in_lines, and put together in a strip
    std::size_t strip;      ///< in_strip: where its strip begins among all of them, floats
    std::size_t component;  ///< its components are [component, component_end)
    std::size_t component_end;

    [[nodiscard]] bool plane() const noexcept { return stride == sizeof(float); }
    [[nodiscard]] bool has_gaps() const noexcept {
        return (component_end - component) * sizeof(float) != stride;
    }
    [[nodiscard]] std::size_t stride_floats() const noexcept { return stride / sizeof(float); }
    /// Vertices from `vertex` to the first one that begins a line; line_floats where none does.
    [[nodiscard]] std::size_t to_line(std::size_t vertex) const noexcept;
};

/// How a pass' values get to the caller's memory.
enum class Way : std::uint8_t {
    planes,   ///< its kernels write the caller's planes
    records,  ///< its kernels write the caller's records, which hold nothing else and have no gaps
    rows,     ///< its kernels write rows: the caller's, or those of a strip
    staged,   ///< its kernels write planes of a stage, from which the caller's memory is written
};
constexpr std::size_t way_count = 4;

/// A vector stream of a pass, as rows.
struct RowStream {
    float* first = nullptr;  ///< vertex 0's; null: the pass has no such stream
    std::size_t record = 0;  ///< that it is a part of
};

struct PassPlan {
    Pass pass = Pass::current;
    StreamSet streams = StreamSet::positions;
    std::size_t value = 0;    ///< of all that passes make, its first
    PlaneOutput planes = {};  ///< Way::planes: those of vertex 0
    RowStream rows[3] = {};   ///< Way::rows: positions or packed words, normals, tangents
    Way way = Way::staged;
};

class OutputPlan {
public:
    /// Of all of the batch's streams; `non_temporal`: for writes past the cache.
    OutputPlan(const Batch& batch, bool non_temporal) noexcept;
    OutputPlan(const OutputPlan&) = delete;
    OutputPlan& operator=(const OutputPlan&) = delete;

    [[nodiscard]] std::span<const PassPlan> passes() const noexcept { return {passes_, pass_count_}; }
    [[nodiscard]] std::span<const Record> records() const noexcept { return {records_, record_count_}; }
    [[nodiscard]] std::span<const Component> components(const Record& record) const noexcept {
        return {components_ + record.component, record.component_end - record.component};
    }
    /// How many values a vertex all passes make.
    [[nodiscard]] std::size_t value_count() const noexcept { return value_count_; }
    [[nodiscard]] bool non_temporal() const noexcept { return non_temporal_; }
    /// Whether some pass goes that way. If one is staged, all are.
    [[nodiscard]] bool has(Way way) const noexcept { return has_[static_cast<std::size_t>(way)]; }
    /// Vertices from vertex `vertex` of the buffer to the first one that begins a line, in the first plane or
    /// record that is written as whole lines; 0 where none is, or no vertex does.
    [[nodiscard]] std::size_t peeled(std::size_t vertex) const noexcept;

private:
    template <std::size_t N>
    void add(Pass pass, StreamSet streams, std::size_t value, const Stream<N>& stream) noexcept;
    void find_records(bool scratch_gaps) noexcept;
    void find_strips() noexcept;
    void stage_all() noexcept;
    [[nodiscard]] bool set_planes(PassPlan& pass, const Batch& batch) const noexcept;
    template <std::size_t N>
    [[nodiscard]] bool set_rows(RowStream& rows, const Stream<N>& stream) const noexcept;
    [[nodiscard]] bool set_rows(PassPlan& pass, const Batch& batch) const noexcept;
    [[nodiscard]] Way way_of_rows(const PassPlan& pass) const noexcept;

    PassPlan passes_[pass_count];
    std::size_t pass_count_ = 0;
    Component components_[most_values];
    std::size_t component_count_ = 0;
    Record records_[most_values];
    std::size_t record_count_ = 0;
    std::size_t value_count_ = 0;
    bool non_temporal_ = false;
    bool has_[way_count] = {};
    const Record* lines_ = nullptr;  // the first record that is written as whole lines
};

/// Bytes that a vertex takes in the streams that `batch` asks for.
[[nodiscard]] std::size_t vertex_bytes(const Batch& batch) noexcept;

}  // namespace goffer::bend
