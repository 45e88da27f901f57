// SPDX-License-Identifier: MIT
#include "output/outputs.hpp"

#include "job/streams_wanted.hpp"

#include <goffer/simd/four.hpp>

#include <algorithm>
#include <functional>

namespace goffer::bend {
namespace {

constexpr std::size_t line_bytes = line_floats * sizeof(float);

template <std::size_t N>
Output output(const Stream<N>& stream) noexcept {
    Output out;
    if (stream.empty()) return out;
    out.floats = N;
    out.stride = stream.stride;
    for (std::size_t c = 0; c < N; ++c) out.component[c] = stream.component[c];
    return out;
}

Output output(const PackedStream& stream) noexcept {
    float* const first = reinterpret_cast<float*>(stream.first);
    return {{first, first + 1, first + 2, nullptr}, stream.stride, 3};
}

float* at(float* first, std::size_t stride, std::size_t i) noexcept {
    return reinterpret_cast<float*>(reinterpret_cast<std::byte*>(first) + i * stride);
}

/// Vertices from `first` to where a record begins a cache line; line_floats where none does.
std::size_t to_line(const Output& out, std::size_t first) noexcept {
    for (std::size_t head = 0; head < line_floats; ++head) {
        if (reinterpret_cast<std::uintptr_t>(at(out.component[0], out.stride, first + head)) % line_bytes ==
            0) {
            return head;
        }
    }
    return line_floats;
}

/// Four consecutive planes at most, to `count` records. Reads planes in fours of vertices.
template <std::size_t floats>
void write_rows(const float* planes, std::size_t count, float* to, std::size_t stride) noexcept {
    for (std::size_t i = 0; i < count; i += 4) {
        simd::Four rows[4] = {};
        for (std::size_t c = 0; c < floats; ++c)
            rows[c] = simd::load_four(planes + c * RecordWriter::plane_stride + i);
        simd::transpose(rows);
        const std::size_t vertices = std::min<std::size_t>(count - i, 4);
        for (std::size_t v = 0; v < vertices; ++v) simd::store_first(at(to, stride, i + v), rows[v], floats);
    }
}

}  // namespace

bool Output::record() const noexcept {
    for (std::size_t c = 1; c < floats; ++c) {
        if (component[c] != component[0] + c) return false;
    }
    return stride != sizeof(float);
}

bool Outputs::planar() const noexcept {
    return exact && std::ranges::all_of(
                        std::initializer_list<const Output*>{&positions, &normals, &tangents},
                        [](const Output* out) { return out->floats == 0 || out->stride == sizeof(float); });
}

bool Outputs::dense() const noexcept {
    if (records == nullptr || tangents.floats != 0 || !positions.record()) return false;
    if (normals.floats == 0) return positions.stride == 3 * sizeof(float);
    return positions.stride == 6 * sizeof(float) && normals.stride == positions.stride && normals.record() &&
           normals.component[0] == positions.component[0] + 3;
}

std::size_t Outputs::head(std::size_t first) const noexcept {
    for (const Output* out : {&positions, &normals, &tangents}) {
        if (out->floats != 0) return to_line(*out, first);
    }
    return line_floats;
}

bool Outputs::side_by_side() const noexcept {
    std::uintptr_t starts[9];
    std::size_t count = 0;
    for (const Output* out : {&positions, &normals, &tangents}) {
        for (std::size_t c = 0; c < std::min<std::size_t>(out->floats, 3); ++c) {
            starts[count++] = reinterpret_cast<std::uintptr_t>(out->component[c]);
        }
    }
    constexpr std::uintptr_t way = 1024, near = 2 * line_bytes;
    for (std::size_t i = 1; i < count; ++i) {
        if (starts[i] % line_bytes != starts[0] % line_bytes) return false;
        for (std::size_t j = 0; j < i; ++j) {
            const std::uintptr_t apart = (starts[i] - starts[j]) % way;
            if (apart < near || apart > way - near) return false;
        }
    }
    return true;
}

Outputs outputs_of(const PreparedPass& prepared, const KernelSet& set) noexcept {
    const DeformJob& job = *prepared.job;
    const Pass pass = prepared.pass;
    Outputs outputs;
    std::size_t streams = 1;
    if (pass == Pass::packed) {
        outputs.positions = output(job.packed);
        streams = packed_streams;
    } else if (pass == Pass::previous) {
        outputs.positions = output(job.previous_positions);
    } else {
        outputs.positions = output(job.positions);
        outputs.normals = output(job.normals);
        outputs.tangents = output(job.tangents);
        streams = streams_wanted(job);
    }
    const Squeeze squeeze = prepared.coefficients.wrinkling;
    const Kernel(&planes)[9] = set.planes[static_cast<std::size_t>(squeeze)];
    outputs.exact = planes[streams] != nullptr;
    outputs.planes = planes[outputs.exact ? streams : streams == 2 ? 3 : 7];
    outputs.records = squeeze == Squeeze::plain ? set.records[streams] : nullptr;
    return outputs;
}

RecordWriter::RecordWriter(const Outputs& outputs, const KernelSet& set) noexcept : set_(set) {
    // In the order of their addresses, so that neighbours in memory are neighbours among the planes.
    const Output* const all[3] = {&outputs.positions, &outputs.normals, &outputs.tangents};
    std::size_t order[3];  // indices into `all`
    std::size_t count = 0;
    for (std::size_t stream = 0; stream < 3; ++stream) {
        if (all[stream]->floats == 0) continue;
        std::size_t at = count++;
        for (; at > 0 && std::less<>()(all[stream]->component[0], all[order[at - 1]]->component[0]); --at) {
            order[at] = order[at - 1];
        }
        order[at] = stream;
    }
    std::size_t plane = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const Output& out = *all[order[i]];
        first_plane_[order[i]] = plane;
        if (!out.record()) {
            for (std::size_t c = 0; c < out.floats; ++c) {
                records_[record_count_++] = {{{out.component[c]}, out.stride, 1}, plane + c, 1};
            }
            plane += out.floats;
            continue;
        }
        Record* last = record_count_ != 0 ? &records_[record_count_ - 1] : nullptr;
        const bool joins = last != nullptr && last->floats > 1 && out.stride == last->out.stride &&
                           out.component[0] == last->out.component[0] + last->floats;
        if (joins) {
            last->floats += out.floats;
        } else {
            records_[record_count_++] = {out, plane, out.floats};
        }
        plane += out.floats;
    }
    for (std::size_t stream = 0; stream < 3; ++stream) {
        if (all[stream]->floats != 0) continue;
        first_plane_[stream] = plane;  // where kernels leave what is not wanted
        plane += 3;
    }
}

bool RecordWriter::dense(const Record& record) const noexcept {
    return record.floats * sizeof(float) == record.out.stride && set_.interleave[record.floats] != nullptr;
}

std::size_t RecordWriter::first_block(std::size_t first, bool streaming) const noexcept {
    if (!streaming || !dense(records_[0])) return most_vertices;
    const std::size_t head = to_line(records_[0].out, first);
    return head == line_floats ? most_vertices : head + most_vertices;
}

void RecordWriter::write(std::size_t first, std::size_t count, bool streaming) const noexcept {
    for (std::size_t r = 0; r < record_count_; ++r) write(records_[r], first, count, streaming);
}

void RecordWriter::write(const Record& record, std::size_t first, std::size_t count,
                         bool streaming) const noexcept {
    const Output& out = record.out;
    const auto rows = [&](std::size_t begin, std::size_t end) {
        for (std::size_t c = 0; c < record.floats; c += 4) {
            const float* from = plane(record.plane + c) + begin;
            float* to = at(out.component[0], out.stride, first + begin) + c;
            switch (record.floats - c) {
                case 1:
                    write_rows<1>(from, end - begin, to, out.stride);
                    break;
                case 2:
                    write_rows<2>(from, end - begin, to, out.stride);
                    break;
                case 3:
                    write_rows<3>(from, end - begin, to, out.stride);
                    break;
                default:
                    write_rows<4>(from, end - begin, to, out.stride);
            }
        }
    };
    if (!dense(record)) return rows(0, count);
    std::size_t head = streaming ? to_line(out, first) : 0;
    const bool past = streaming && head != line_floats;
    head = past ? std::min(head, count) : 0;
    const std::size_t lines = (count - head) / line_floats;
    rows(0, head);
    set_.interleave[record.floats](plane(record.plane) + head, plane_stride, lines,
                                   at(out.component[0], out.stride, first + head), past);
    rows(head + lines * line_floats, count);
}

}  // namespace goffer::bend
