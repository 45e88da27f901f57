// SPDX-License-Identifier: MIT
#include <goffer/measure/stream_layout.hpp>

#include <algorithm>

namespace goffer::measure {
namespace {

constexpr StreamLayout all[] = {
    {.name = "positions"},
    {.name = "positions+normals", .floats = 6, .normals = true},
    {.name = "positions+normals+tangents", .floats = 10, .normals = true, .tangents = true},
    {.name = "interleaved-positions", .record = 3},
    {.name = "interleaved-positions+normals", .floats = 6, .record = 6, .normals = true},
    {.name = "interleaved-positions+normals+tangents",
     .floats = 10,
     .record = 10,
     .normals = true,
     .tangents = true},
    {.name = "interleaved-previous", .floats = 6, .record = 6, .previous = true},
    {.name = "interleaved-previous+normals", .floats = 9, .record = 9, .normals = true, .previous = true},
    {.name = "record16-positions", .record = 4},
    {.name = "record16-packed", .record = 4, .packed = true},
    {.name = "record32-positions+normals", .floats = 6, .record = 8, .normals = true},
    {.name = "scratch16-positions", .record = 4, .scratch = true},
    {.name = "scratch16-packed", .record = 4, .packed = true, .scratch = true},
    {.name = "scratch32-positions+normals", .floats = 6, .record = 8, .normals = true, .scratch = true},
    {.name = "paged-positions+normals", .floats = 6, .normals = true, .paged = true},
    {.name = "packed", .record = 3, .packed = true},
    {.name = "previous", .floats = 6, .previous = true},
    {.name = "previous+normals", .floats = 9, .normals = true, .previous = true},
};

/// Hands out the streams of an instance, one after the other: planes, or places in a record.
class Cursor {
public:
    Cursor(const StreamLayout& layout, std::span<float> memory, std::size_t first, std::size_t count)
        : step_(layout.record == 0 ? memory.size() / layout.floats : 1),
          stride_(layout.record == 0 ? sizeof(float) : layout.record * sizeof(float)),
          count_(count),
          next_(memory.data() + first * std::max<std::size_t>(layout.record, 1)) {}

    template <std::size_t N>
    [[nodiscard]] Stream<N> take() {
        Stream<N> stream;
        for (float*& component : stream.component) {
            component = next_;
            next_ += step_;
        }
        stream.stride = stride_;
        stream.count = count_;
        return stream;
    }

private:
    std::size_t step_;    // floats from one component to the next
    std::size_t stride_;  // bytes from one vertex to the next
    std::size_t count_;
    float* next_;
};

/// `to`: a job or a batch.
template <class To>
void set_all(To& to, const StreamLayout& layout, std::span<float> memory, std::size_t first,
             std::size_t count) noexcept {
    to.scratch_gaps = layout.scratch;
    if (layout.packed) {
        float* const record = memory.data() + first * layout.record;
        to.packed = {reinterpret_cast<bend::PackedVertex*>(record), layout.record * sizeof(float), count};
        return;
    }
    Cursor cursor(layout, memory, first, count);
    to.positions = cursor.take<3>();
    if (layout.normals) to.normals = cursor.take<3>();
    if (layout.tangents) to.tangents = cursor.take<4>();
    if (layout.previous) to.previous_positions = cursor.take<3>();
}

}  // namespace

std::size_t StreamLayout::memory_floats(std::size_t vertices) const noexcept {
    if (record != 0) return vertices * record;
    constexpr std::size_t page = 4096 / sizeof(float);
    const std::size_t past = paged ? 0 : page * 3 / 32;  // ten planes so far apart are all over the page
    return (vertices + (past + page - vertices % page) % page) * floats;
}

std::span<const StreamLayout> stream_layouts() noexcept {
    return all;
}

const StreamLayout& stream_layout(std::string_view name) noexcept {
    return *std::ranges::find(all, name, &StreamLayout::name);
}

void set_streams(bend::DeformJob& job, const StreamLayout& layout, std::span<float> memory, std::size_t first,
                 std::size_t count) noexcept {
    set_all(job, layout, memory, first, count);
}

void set_streams(bend::Batch& batch, const StreamLayout& layout, std::span<float> memory, std::size_t first,
                 std::size_t count) noexcept {
    set_all(batch, layout, memory, first, count);
}

}  // namespace goffer::measure
