// SPDX-License-Identifier: MIT
#pragma once

#include "kernel/args.hpp"
#include "kernel/lines.hpp"

#include <goffer/bend/crowd.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

/// What a batch writes and where, found once for all its instances: which passes of kernels compute it, where
/// the values go in the caller's memory, and how they get there.

namespace goffer::bend {

/// A run of kernels over an instance's vertices, named by the coefficients that it uses.
enum class Pass : std::uint8_t { current, previous, packed };
constexpr std::size_t pass_count = 3;

/// The most values per vertex: position, normal, tangent; previous position; three packed words.
constexpr std::size_t max_values = 16;

/// How the values of a pass get to the caller's memory.
enum class WriteMode : std::uint8_t {
    planes,   ///< kernels write the caller's planes
    records,  ///< kernels write the caller's records, which hold this pass alone
    pairs,    ///< kernels of both poses write the caller's records, which hold both passes
    staged,   ///< kernels write planes of a stage, which is then copied to the caller's memory
};
constexpr std::size_t write_mode_count = 4;

/// Where one value of each vertex goes. (Has no initial values, nor has Record: plans hold more than they
/// use.)
struct Component {
    float* first;        ///< vertex 0's
    std::size_t stride;  ///< bytes
    std::size_t value;   ///< its index among the values of all passes
};

/// Components with the same stride that lie within one stride of each other: members of a struct, or a single
/// plane.
struct Record {
    float* first;           ///< vertex 0's first value
    std::size_t stride;     ///< bytes
    std::size_t floats;     ///< from the first value to the end of the last
    std::size_t lead;       ///< floats from the start of a woven record to `first`
    bool woven;             ///< written whole, gaps included, by a kernel for its stride
    bool in_lines;          ///< a plane, or woven, and goes past the cache
    WriteMode mode;         ///< that of the passes that write it
    std::size_t component;  ///< its components are [component, component_end)
    std::size_t component_end;

    [[nodiscard]] bool plane() const noexcept { return stride == sizeof(float); }
    [[nodiscard]] bool has_gaps() const noexcept {
        return (component_end - component) * sizeof(float) != stride;
    }
    [[nodiscard]] std::size_t stride_floats() const noexcept { return stride / sizeof(float); }
    /// The number of vertices from `vertex` to the first one that begins a cache line; line_floats if none
    /// does.
    [[nodiscard]] std::size_t to_line(std::size_t vertex) const noexcept {
        return plane() ? floats_to_line<Record>(first + vertex) : record_to_line(vertex);
    }

private:
    [[nodiscard]] std::size_t record_to_line(std::size_t vertex) const noexcept;
};

struct PassPlan {
    Pass pass = Pass::current;
    StreamSet streams = StreamSet::positions;
    std::size_t value = 0;               ///< index of its first value among those of all passes
    PlaneOutput planes = {};             ///< for WriteMode::planes, from vertex 0 on
    const Record* record = nullptr;      ///< for WriteMode::records and pairs
    RecordGaps gaps = RecordGaps::none;  ///< the record's
    WriteMode mode = WriteMode::staged;
};

class OutputPlan {
public:
    /// For writes by `kernels`. `non_temporal`: past the cache. `compete`: in the place of planes_compete().
    OutputPlan(const Batch& batch, const KernelSet& kernels, bool non_temporal,
               std::optional<bool> compete = {}) noexcept;
    OutputPlan(const OutputPlan&) = delete;
    OutputPlan& operator=(const OutputPlan&) = delete;

    [[nodiscard]] std::span<const PassPlan> passes() const noexcept { return {passes_, pass_count_}; }
    [[nodiscard]] std::span<const Record> records() const noexcept { return {records_, record_count_}; }
    [[nodiscard]] std::span<const Component> components(const Record& record) const noexcept {
        return {components_ + record.component, record.component_end - record.component};
    }
    /// The order of vectors where passes are written in WriteMode::pairs, all in one record.
    [[nodiscard]] PairOrder pair_order() const noexcept { return pair_order_; }
    /// The number of values per vertex that all passes compute.
    [[nodiscard]] std::size_t value_count() const noexcept { return value_count_; }
    [[nodiscard]] bool non_temporal() const noexcept { return non_temporal_; }
    /// Whether a pass is written in that mode. If one is staged, all are.
    [[nodiscard]] bool has(WriteMode mode) const noexcept { return has_[static_cast<std::size_t>(mode)]; }
    /// Whether anything that is written in that mode goes past the cache, as whole lines.
    [[nodiscard]] bool in_lines(WriteMode mode) const noexcept {
        return in_lines_[static_cast<std::size_t>(mode)];
    }
    /// Whether anything may go through a stage: a pass, vertices near joints, or lines that regions share.
    [[nodiscard]] bool stages() const noexcept {
        return has(WriteMode::staged) || has(WriteMode::pairs) || in_lines(WriteMode::planes) ||
               in_lines(WriteMode::records);
    }
    /// The number of vertices from vertex `vertex` of the buffer to the first one that begins a cache line,
    /// in the first plane or record that is written as whole lines. 0 if there is no such plane, record or
    /// vertex.
    [[nodiscard]] std::size_t peeled(std::size_t vertex) const noexcept {
        const std::size_t peeled = lines_ == nullptr ? line_floats : lines_->to_line(vertex);
        return peeled == line_floats ? 0 : peeled;
    }

private:
    template <std::size_t N>
    void add(Pass pass, StreamSet streams, std::size_t value, const Stream<N>& stream) noexcept;
    void find_records(bool scratch_gaps) noexcept;
    void set_woven(Record& record) const noexcept;
    void set_all_modes(WriteMode mode) noexcept;
    [[nodiscard]] bool set_planes(PassPlan& pass, const Batch& batch) const noexcept;
    [[nodiscard]] bool set_record(PassPlan& pass) const noexcept;
    [[nodiscard]] bool set_pair(const KernelSet& kernels, Squeeze squeeze) noexcept;
    [[nodiscard]] WriteMode mode_of(const Record& record) const noexcept;

    PassPlan passes_[pass_count];
    std::size_t pass_count_ = 0;
    Component components_[max_values];
    std::size_t component_count_ = 0;
    Record records_[max_values];
    std::size_t record_count_ = 0;
    std::size_t value_count_ = 0;
    PairOrder pair_order_ = {};
    bool non_temporal_ = false;
    std::optional<bool> compete_;
    bool has_[write_mode_count] = {};
    bool in_lines_[write_mode_count] = {};
    const Record* lines_ = nullptr;  // the first record that is written as whole lines
};

/// The number of bytes that `batch` writes per vertex, without gaps.
[[nodiscard]] std::size_t vertex_bytes(const Batch& batch) noexcept;

}  // namespace goffer::bend
