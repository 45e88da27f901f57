// SPDX-License-Identifier: MIT
#include "output/output_plan.hpp"

#include "body/body_data.hpp"
#include "output/processor.hpp"

#include <algorithm>
#include <functional>
#include <numeric>
#include <optional>

namespace goffer::bend {
namespace {

std::size_t values_of(StreamSet streams) noexcept {
    switch (streams) {
        case StreamSet::positions:
        case StreamSet::packed:
            return 3;
        case StreamSet::positions_normals:
            return 6;
        case StreamSet::positions_normals_tangents:
            return 10;
    }
    return 0;
}

Stream3 words_of(const PackedStream& packed) noexcept {
    return interleaved<3>(reinterpret_cast<float*>(packed.first), packed.count, packed.stride);
}

/// Whether a kernel can write planes past the cache side by side. They must begin their cache lines at the
/// same vertices and, where that matters, must not lie near a multiple of a kilobyte apart: see
/// planes_compete(). Such planes are written faster one after the other.
bool side_by_side(std::span<float* const> planes, bool compete) noexcept {
    constexpr std::uintptr_t line = line_floats * sizeof(float), way = 1024, near = 2 * line;
    for (std::size_t i = 1; i < planes.size(); ++i) {
        const auto start = reinterpret_cast<std::uintptr_t>(planes[i]);
        if ((start - reinterpret_cast<std::uintptr_t>(planes[0])) % line != 0) return false;
        for (std::size_t j = 0; compete && j < i; ++j) {
            const std::uintptr_t apart = (start - reinterpret_cast<std::uintptr_t>(planes[j])) % way;
            if (apart < near || apart > way - near) return false;
        }
    }
    return true;
}

/// Collects the planes that a kernel writes.
class Planes {
public:
    /// Whether `stream` is planar. If so, sets `out` to its planes.
    template <std::size_t N>
    bool take(const Stream<N>& stream, float* (&out)[N]) noexcept {
        if (stream.empty() || !stream.planar()) return false;
        for (std::size_t c = 0; c < N; ++c) all_[count_++] = out[c] = stream.component[c];
        return true;
    }
    [[nodiscard]] std::span<float* const> all() const noexcept { return {all_, count_}; }

private:
    float* all_[10];
    std::size_t count_ = 0;
};

/// A squeeze that has the kernels that a body needs.
Squeeze squeeze_of(const BodyData& body) noexcept {
    return body.columns.scale == nullptr ? Squeeze::plain : Squeeze::shaped;
}

/// Whether all that a record holds are the values from `first` on, as vectors whose begins are `step` floats
/// apart.
bool has_vectors(std::span<const Component> components, std::size_t first, std::size_t values,
                 std::size_t step) noexcept {
    if (components.size() != values) return false;
    for (std::size_t i = 0; i < values; ++i) {
        const std::size_t place = i / 3 * step + i % 3;
        if (components[i].value != first + i || components[i].first != components[0].first + place)
            return false;
    }
    return true;
}

const Stream3& positions_of(const PassPlan& pass, const Batch& batch) noexcept {
    return pass.pass == Pass::previous ? batch.previous_positions : batch.positions;
}

bool writes_normals(const PassPlan& pass) noexcept {
    return pass.streams == StreamSet::positions_normals ||
           pass.streams == StreamSet::positions_normals_tangents;
}

bool writes_tangents(const PassPlan& pass) noexcept {
    return pass.streams == StreamSet::positions_normals_tangents;
}

/// The gaps of records that kernels write, if these are such: `stride` floats, of which `components` hold
/// values.
std::optional<RecordGaps> gaps_of(const PassPlan& pass, std::size_t stride,
                                  std::span<const Component> components) noexcept {
    const std::size_t values = values_of(pass.streams), gaps = stride - components.size();
    const auto has = [&](std::size_t step) { return has_vectors(components, pass.value, values, step); };
    if (gaps == 0 && has(3)) return RecordGaps::none;
    if (pass.pass == Pass::packed) return std::nullopt;
    if (gaps == values / 3 && has(4)) return RecordGaps::one_behind_each;
    if (values == 6 && gaps == 2 && has(3)) return RecordGaps::two_behind_all;
    return std::nullopt;
}

/// The order of a previous position, a current one, and a normal if there are 9 values, if the components are
/// these in whole vectors.
std::optional<PairOrder> order_of(std::span<const Component> components, std::size_t values) noexcept {
    if (components.size() != values) return std::nullopt;
    for (std::size_t i = 0; i < values; ++i) {
        if (components[i].value != components[i / 3 * 3].value / 3 * 3 + i % 3) return std::nullopt;
    }
    const std::size_t first = components[0].value / 3, second = components[3].value / 3;
    const std::size_t lower = first == 0 ? 1 : 0;  // of the vectors that are not the first
    return static_cast<PairOrder>(2 * first + (second == lower ? 0 : 1));
}

}  // namespace

std::size_t Record::record_to_line(std::size_t vertex) const noexcept {
    const float* at = first - lead + vertex * stride_floats();
    for (std::size_t peeled = 0; peeled < line_floats; ++peeled, at += stride_floats())
        if (floats_to_line<Record>(at) == 0) return peeled;
    return line_floats;
}

template <std::size_t N>
void OutputPlan::add(Pass pass, StreamSet streams, std::size_t value, const Stream<N>& stream) noexcept {
    if (pass_count_ == 0 || passes_[pass_count_ - 1].pass != pass) {
        passes_[pass_count_++] = {.pass = pass, .streams = streams, .value = value_count_};
        value_count_ += values_of(streams);
    }
    if (stream.empty()) return;
    const std::size_t first = passes_[pass_count_ - 1].value + value;
    for (std::size_t c = 0; c < N; ++c)
        components_[component_count_++] = {stream.component[c], stream.stride, first + c};
}

OutputPlan::OutputPlan(const Batch& batch, const KernelSet& kernels, bool non_temporal,
                       std::optional<bool> compete) noexcept
    : non_temporal_(non_temporal), compete_(compete) {
    if (!batch.previous_positions.empty())
        add(Pass::previous, StreamSet::positions, 0, batch.previous_positions);
    if (!batch.positions.empty() || !batch.normals.empty() || !batch.tangents.empty()) {
        const StreamSet streams = !batch.tangents.empty()  ? StreamSet::positions_normals_tangents
                                  : !batch.normals.empty() ? StreamSet::positions_normals
                                                           : StreamSet::positions;
        add(Pass::current, streams, 0, batch.positions);
        add(Pass::current, streams, 3, batch.normals);
        add(Pass::current, streams, 6, batch.tangents);
    }
    if (!batch.packed.empty()) add(Pass::packed, StreamSet::packed, 0, words_of(batch.packed));
    find_records(batch.scratch_gaps && non_temporal);
    const Squeeze squeeze = squeeze_of(*batch.body->data());
    bool staged = false;
    for (PassPlan& pass : std::span(passes_, pass_count_)) {
        pass.mode = set_planes(pass, batch) ? WriteMode::planes
                    : kernels.weaving_kernel(squeeze, pass.streams) != nullptr && set_record(pass)
                        ? WriteMode::records
                        : WriteMode::staged;
        staged |= pass.mode == WriteMode::staged;
    }
    if (staged) set_all_modes(set_pair(kernels, squeeze) ? WriteMode::pairs : WriteMode::staged);
    for (const PassPlan& pass : passes()) has_[static_cast<std::size_t>(pass.mode)] = true;
    for (Record& record : std::span(records_, record_count_)) {
        record.mode = mode_of(record);
        in_lines_[static_cast<std::size_t>(record.mode)] |= record.in_lines;
    }
    const auto lines = std::ranges::find_if(records(), &Record::in_lines);
    if (lines != records().end()) lines_ = &*lines;
}

void OutputPlan::set_all_modes(WriteMode mode) noexcept {
    for (PassPlan& pass : std::span(passes_, pass_count_)) pass.mode = mode;
}

/// Sets what `pass` has for WriteMode::records, if its own kernels can write its record: it holds the vectors
/// of the pass, in their order, and nothing else but gaps that kernels know. All other records are written
/// from the stage.
bool OutputPlan::set_record(PassPlan& pass) const noexcept {
    for (const Record& record : records()) {
        const bool begins_lines = record.lead == 0 && (!record.in_lines || record.to_line(0) != line_floats);
        if (!begins_lines) continue;
        const std::optional<RecordGaps> gaps = gaps_of(pass, record.stride_floats(), components(record));
        if (!gaps) continue;
        pass.gaps = *gaps;
        pass.record = &record;
        return true;
    }
    return false;
}

/// Sets what there is for WriteMode::pairs, if kernels of two poses can write all passes: a record of their
/// vectors, without gaps.
bool OutputPlan::set_pair(const KernelSet& kernels, Squeeze squeeze) noexcept {
    if (pass_count_ != 2 || passes_[0].pass != Pass::previous || record_count_ != 1) return false;
    if (kernels.pair_kernel(squeeze, passes_[1].streams) == nullptr) return false;
    const Record& record = records_[0];
    const std::optional<PairOrder> order = order_of(components(record), value_count_);
    if (!order || record.has_gaps() || (record.in_lines && record.to_line(0) == line_floats)) return false;
    for (PassPlan& pass : std::span(passes_, pass_count_)) pass.record = &record;
    pair_order_ = *order;
    return true;
}

/// Passes that share a record have the same mode.
WriteMode OutputPlan::mode_of(const Record& record) const noexcept {
    WriteMode mode = WriteMode::staged;
    for (const PassPlan& pass : passes()) {
        if (pass.value <= components_[record.component].value) mode = pass.mode;
    }
    return mode;
}

/// Sorts the components by stride and address. Neighbors within a stride make a record.
void OutputPlan::find_records(bool scratch_gaps) noexcept {
    const std::span components(components_, component_count_);
    std::ranges::sort(components, [](const Component& a, const Component& b) {
        return a.stride != b.stride ? a.stride < b.stride : std::less<>()(a.first, b.first);
    });
    for (std::size_t from = 0, to = 0; from < components.size(); from = to) {
        const Component& first = components[from];
        const auto offset = [&](std::size_t i) {
            return static_cast<std::size_t>(components[i].first - first.first);
        };
        const auto same_stride = [&](std::size_t i) {
            return i < components.size() && components[i].stride == first.stride;
        };
        for (to = from + 1; same_stride(to) && offset(to) * sizeof(float) < first.stride;) ++to;
        Record& record = records_[record_count_++];
        record = {};
        record.first = first.first;
        record.stride = first.stride;
        record.component = from;
        record.component_end = to;
        record.floats = offset(to - 1) + 1;
        // Components of one struct may end up in several records; each writes in the gaps of the others.
        const bool alone = !same_stride(to) && (from == 0 || components[from - 1].stride != first.stride);
        if (!record.has_gaps() || (scratch_gaps && alone)) set_woven(record);
        record.in_lines = non_temporal_ && (record.plane() || record.woven);
    }
}

/// Has a record woven, if there is a kernel for it. Finds where woven records begin, so that some of them
/// begin cache lines: in the gap before a vertex's own first float, or, where values straddle two of them, in
/// the vertex before it.
void OutputPlan::set_woven(Record& record) const noexcept {
    const std::size_t floats = record.stride_floats();
    record.woven = floats >= min_woven && floats <= max_woven;
    if (!record.woven || !record.has_gaps()) return;
    record.lead = (line_floats - floats_to_line<Record>(record.first)) % std::gcd(floats, line_floats);
}

/// Sets pass.planes, if all values of the pass go to planes that kernels can write directly.
bool OutputPlan::set_planes(PassPlan& pass, const Batch& batch) const noexcept {
    if (pass.pass == Pass::packed) return false;
    Planes planes;
    if (!planes.take(positions_of(pass, batch), pass.planes.position)) return false;
    if (writes_normals(pass) && !planes.take(batch.normals, pass.planes.normal)) return false;
    if (writes_tangents(pass) && !planes.take(batch.tangents, pass.planes.tangent)) return false;
    return !non_temporal_ || side_by_side(planes.all(), compete_ ? *compete_ : planes_compete());
}

std::size_t vertex_bytes(const Batch& batch) noexcept {
    constexpr std::size_t vector = 3 * sizeof(float);
    return (batch.positions.empty() ? 0 : vector) + (batch.normals.empty() ? 0 : vector) +
           (batch.tangents.empty() ? 0 : 4 * sizeof(float)) +
           (batch.packed.empty() ? 0 : sizeof(PackedVertex)) +
           (batch.previous_positions.empty() ? 0 : vector);
}

}  // namespace goffer::bend
