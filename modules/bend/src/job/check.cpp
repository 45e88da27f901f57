// SPDX-License-Identifier: MIT
#include "job/check.hpp"

#include "pose/matrix_layout.hpp"
#include "pose/posed_group.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>

namespace goffer::bend {
namespace {

/// A stream of any kind, as addresses of its components.
struct StreamMemory {
    Field field;
    float* const* component;
    std::size_t components;
    std::size_t stride;
    std::size_t count;

    [[nodiscard]] bool wanted() const noexcept {
        for (std::size_t c = 0; c < components; ++c) {
            if (component[c] != nullptr) return true;
        }
        return false;
    }
};

/// The streams of a batch; the packed one is taken as three words.
class Streams {
public:
    explicit Streams(const Batch& batch) noexcept
        : words_{reinterpret_cast<float*>(batch.packed.first), words_[0] == nullptr ? nullptr : words_[0] + 1,
                 words_[0] == nullptr ? nullptr : words_[0] + 2},
          all_{of(Field::positions, batch.positions),
               of(Field::normals, batch.normals),
               of(Field::tangents, batch.tangents),
               {Field::packed, words_, 3, batch.packed.stride, batch.packed.count},
               of(Field::previous_positions, batch.previous_positions)} {}

    [[nodiscard]] const StreamMemory* begin() const noexcept { return all_; }
    [[nodiscard]] const StreamMemory* end() const noexcept { return all_ + std::size(all_); }

private:
    template <std::size_t N>
    static StreamMemory of(Field field, const Stream<N>& stream) noexcept {
        return {field, stream.component, N, stream.stride, stream.count};
    }

    float* words_[3];
    StreamMemory all_[5];
};

Fault fault_of(Field field, Reason reason) noexcept {
    return {.field = field, .reason = reason};
}

Fault fault_of_size(Field field, Reason reason, std::size_t has, std::size_t needs) noexcept {
    return {.field = field, .reason = reason, .has = has, .needs = needs};
}

/// Whether a component's last element, by its count and stride, lies at an address that there is.
bool ends_in_memory(const StreamMemory& stream, std::size_t component) noexcept {
    const auto first = reinterpret_cast<std::uintptr_t>(stream.component[component]);
    const std::uintptr_t room = std::numeric_limits<std::uintptr_t>::max() - first;
    return room >= sizeof(float) &&
           (stream.count == 0 || stream.count - 1 <= (room - sizeof(float)) / stream.stride);
}

/// Checks a stream by itself, except for its length.
Reason check(const StreamMemory& stream) noexcept {
    for (std::size_t c = 0; c < stream.components; ++c) {
        if (stream.component[c] == nullptr) return Reason::null;
        if (reinterpret_cast<std::uintptr_t>(stream.component[c]) % alignof(float) != 0)
            return Reason::alignment;
    }
    if (stream.stride < sizeof(float) || stream.stride % sizeof(float) != 0) return Reason::stride;
    for (std::size_t c = 0; c < stream.components; ++c)
        if (!ends_in_memory(stream, c)) return Reason::out_of_range;
    return Reason::none;
}

struct Bytes {
    std::uintptr_t first, last;
};

Bytes bytes_of(const StreamMemory& stream, std::size_t component) noexcept {
    const auto first = reinterpret_cast<std::uintptr_t>(stream.component[component]);
    return {first, first + (stream.count - 1) * stream.stride + sizeof(float)};
}

/// Whether two components write to the same bytes. Exact if their strides are equal; otherwise true if their
/// ranges meet.
bool overlap(const StreamMemory& a, std::size_t component_a, const StreamMemory& b,
             std::size_t component_b) noexcept {
    const Bytes of_a = bytes_of(a, component_a), of_b = bytes_of(b, component_b);
    if (of_a.last <= of_b.first || of_b.last <= of_a.first) return false;
    if (a.stride != b.stride) return true;
    const std::uintptr_t apart =
        (of_a.first > of_b.first ? of_a.first - of_b.first : of_b.first - of_a.first) % a.stride;
    return apart < sizeof(float) || apart > a.stride - sizeof(float);
}

bool overlap(const StreamMemory& a, const StreamMemory& b) noexcept {
    for (std::size_t i = 0; i < a.components; ++i) {
        for (std::size_t j = &a == &b ? i + 1 : 0; j < b.components; ++j) {
            if (overlap(a, i, b, j)) return true;
        }
    }
    return false;
}

/// How many vertices every stream must have room for, or Fault::nowhere where that is beyond all numbers.
/// With vertex_offsets, which are not read here, it may be more.
std::size_t needed_vertices(const Batch& batch) noexcept {
    const std::size_t vertices = batch.body->vertex_count(), steps = batch.count - 1;
    if (!batch.vertex_offsets.empty() || steps == 0) return vertices;
    const bool fits = batch.vertex_step <= (Fault::nowhere - vertices) / steps;
    return fits ? steps * batch.vertex_step + vertices : Fault::nowhere;
}

Fault check(const Streams& streams, const Batch& batch) noexcept {
    for (const StreamMemory& stream : streams) {
        if (!stream.wanted()) continue;
        const Reason reason = check(stream);
        if (reason != Reason::none) return fault_of(stream.field, reason);
        if (stream.count == 0)
            return fault_of_size(stream.field, Reason::too_short, 0, needed_vertices(batch));
    }
    for (const StreamMemory& a : streams) {
        for (const StreamMemory& b : streams) {
            if (&b < &a || !a.wanted() || !b.wanted() || !overlap(a, b)) continue;
            // Components of one stream meet if its stride is too small for them.
            if (&a == &b) return fault_of(a.field, Reason::stride);
            return {.field = b.field, .reason = Reason::overlap, .other = a.field};
        }
    }
    return {};
}

/// Checks the memory of bounds, which lie side by side, like that of a stream.
Fault check_bounds(const Batch& batch, const Streams& streams) noexcept {
    if (batch.bounds.empty()) return {};
    const auto first = reinterpret_cast<std::uintptr_t>(batch.bounds.data());
    const std::uintptr_t last = first + batch.count * sizeof(Bounds);
    if (first % alignof(Bounds) != 0) return fault_of(Field::bounds, Reason::alignment);
    for (const StreamMemory& stream : streams) {
        for (std::size_t c = 0; stream.wanted() && c < stream.components; ++c) {
            const Bytes bytes = bytes_of(stream, c);
            if (first < bytes.last && bytes.first < last)
                return {.field = Field::bounds, .reason = Reason::overlap, .other = stream.field};
        }
    }
    return {};
}

/// Checks that each instance ends within every stream.
Fault check_places(const Batch& batch, const Streams& streams) noexcept {
    std::size_t room = std::numeric_limits<std::size_t>::max();
    Field shortest = Field::none;
    for (const StreamMemory& stream : streams) {
        if (stream.wanted() && (shortest == Field::none || stream.count < room))
            room = stream.count, shortest = stream.field;
    }
    const std::size_t vertices = batch.body->vertex_count(), needed = needed_vertices(batch);
    if (batch.vertex_offsets.empty() && batch.count > 1 && batch.vertex_step < vertices)
        return fault_of_size(Field::vertex_step, Reason::overlap, batch.vertex_step, vertices);
    if (room < needed || needed == Fault::nowhere)
        return fault_of_size(shortest, Reason::too_short, room, needed);
    for (std::size_t i = 0; !batch.vertex_offsets.empty() && i < batch.count; ++i) {
        const std::size_t element = element_of(batch, i);
        if (batch.vertex_offsets[element] > room - vertices)
            return {.field = Field::vertex_offsets, .reason = Reason::out_of_range, .instance = i};
    }
    return {};
}

/// Checks where a column's first `elements` lie: each of its pages, if it has these.
template <class T>
Reason check_addresses(const StridedView<T>& view, std::size_t elements) noexcept {
    const auto check_array = [&](const void* array) {
        if (array == nullptr) return Reason::null;
        const std::uintptr_t first = reinterpret_cast<std::uintptr_t>(array) + view.offset;
        return first % alignof(T) != 0 ? Reason::alignment : Reason::none;
    };
    if (view.stride % alignof(T) != 0) return Reason::alignment;
    if (view.page_shift == StridedView<T>::unpaged) return check_array(view.data);
    if (view.page_shift > StridedView<T>::unpaged) return Reason::out_of_range;
    const std::size_t pages = elements == 0 ? 0 : ((elements - 1) >> view.page_shift) + 1;
    for (std::size_t i = 0; i < pages; ++i) {
        const void* page = nullptr;
        std::memcpy(&page, static_cast<const std::byte*>(view.data) + i * sizeof page, sizeof page);
        if (const Reason reason = check_array(page); reason != Reason::none) return reason;
    }
    return Reason::none;
}

/// Checks that columns hold as many elements as are read, and that each has room for what is read of it.
struct ColumnCheck {
    std::size_t elements = 0;
    Fault fault;

    /// `bytes` are read of each element. A stride of 0 is the same element for all.
    template <class T>
    void take(Field field, const StridedView<T>& view, std::size_t bytes = sizeof(T)) noexcept {
        if (!fault.none() || view.empty()) return;
        const bool others_follow = view.values != 0 && view.values * sizeof(T) < bytes;
        if ((view.stride != 0 && view.stride < bytes) || others_follow) {
            fault = fault_of(field, Reason::stride);
        } else if (view.count < elements) {
            fault = fault_of_size(field, Reason::count, view.count, elements);
        } else if (const Reason reason = check_addresses(view, elements); reason != Reason::none) {
            fault = fault_of(field, reason);
        }
    }
};

Fault check_columns(const Batch& batch) noexcept {
    if (batch.poses.empty()) return fault_of(Field::poses, Reason::null);
    if (!batch.indices.empty() && batch.indices.size() != batch.count)
        return fault_of_size(Field::indices, Reason::count, batch.indices.size(), batch.count);
    ColumnCheck columns;
    columns.elements = batch.count;
    for (std::size_t i = 0; i < batch.indices.size(); ++i) {
        const std::size_t index = batch.indices[i];
        if (index >= batch.poses.count)
            return {.field = Field::indices, .reason = Reason::out_of_range, .instance = i};
        columns.elements = i == 0 ? index + 1 : index >= columns.elements ? index + 1 : columns.elements;
    }
    const bool previous = !batch.previous_positions.empty();
    if (previous && batch.previous_poses.empty()) return fault_of(Field::previous_poses, Reason::null);
    const std::size_t poses = batch.body->region_count() * sizeof(Pose);
    const auto take_matrices = [&](Field field, const TransformColumn& column) {
        if (columns.fault.none() && !column.empty() && column.layout > TransformColumn::MatrixLayout::rows4)
            columns.fault = fault_of(field, Reason::out_of_range);
        const auto floats = static_cast<std::size_t>(steps_of(column.layout).floats());
        columns.take(field, column.first, floats * sizeof(float));
    };
    columns.take(Field::poses, batch.poses, poses);
    take_matrices(Field::transform, batch.transforms);
    columns.take(Field::wrinkle_weight, batch.wrinkle_weights);
    if (previous) columns.take(Field::previous_poses, batch.previous_poses, poses);
    if (previous) take_matrices(Field::previous_transform, batch.previous_transforms);
    columns.take(Field::visible, batch.visible);
    columns.take(Field::changed, batch.changed);
    columns.take(Field::update_intervals, batch.update_intervals);
    columns.take(Field::vertex_offsets, batch.vertex_offsets);
    if (columns.fault.none() && !batch.bounds.empty() && batch.bounds.size() < batch.count)
        return fault_of_size(Field::bounds, Reason::count, batch.bounds.size(), batch.count);
    return columns.fault;
}

/// Within 1e18, squares of a matrix' numbers and sums of squares stay in float's range.
Reason check(const glm::mat4x3& matrix) noexcept {
    for (int c = 0; c < 4; ++c) {
        for (int row = 0; row < 3; ++row) {
            if (!std::isfinite(matrix[c][row])) return Reason::not_finite;
            if (!(std::fabs(matrix[c][row]) <= 1e18f)) return Reason::too_large;
        }
    }
    return Reason::none;
}

Fault check_poses(Field field, const Pose* poses, std::size_t regions) noexcept {
    for (std::size_t r = 0; r < regions; ++r) {
        if (!std::isfinite(poses[r].angle) || !std::isfinite(poses[r].direction))
            return {.field = field, .reason = Reason::not_finite, .region = r};
    }
    return {};
}

/// Checks the numbers of an instance: its poses, transforms and weight.
Fault check_instance(const Batch& batch, std::size_t element) noexcept {
    const std::size_t regions = batch.body->region_count();
    Fault fault = check_poses(Field::poses, batch.poses.at(element), regions);
    if (!fault.none()) return fault;
    if (!batch.transforms.empty()) fault = fault_of(Field::transform, check(batch.transforms[element]));
    if (!fault.none()) return fault;
    if (!batch.wrinkle_weights.empty()) {
        const float weight = batch.wrinkle_weights[element];
        if (!std::isfinite(weight)) return fault_of(Field::wrinkle_weight, Reason::not_finite);
        if (weight < 0 || weight > 1) return fault_of(Field::wrinkle_weight, Reason::out_of_range);
    }
    if (batch.previous_positions.empty()) return {};
    fault = check_poses(Field::previous_poses, batch.previous_poses.at(element), regions);
    if (fault.none() && !batch.previous_transforms.empty())
        fault = fault_of(Field::previous_transform, check(batch.previous_transforms[element]));
    return fault.none() ? Fault{} : fault;
}

}  // namespace

Fault check_memory(const Batch& batch) noexcept {
    if (batch.body == nullptr) return fault_of(Field::body, Reason::null);
    if (batch.body->empty()) return fault_of(Field::body, Reason::empty);
    if (batch.count == 0) return {};  // the last instance may have gone, and the buffer with it
    const Streams streams(batch);
    bool wanted = false;
    for (const StreamMemory& stream : streams) wanted |= stream.wanted();
    if (!wanted) return fault_of(Field::outputs, Reason::empty);
    if (Fault fault = check(streams, batch); !fault.none()) return fault;
    if (!batch.tangents.empty() && !batch.body->has_tangents())
        return fault_of(Field::tangents, Reason::not_supported);
    if (Fault fault = check_columns(batch); !fault.none()) return fault;
    if (Fault fault = check_bounds(batch, streams); !fault.none()) return fault;
    return check_places(batch, streams);
}

Fault check(const Batch& batch) noexcept {
    if (Fault fault = check_memory(batch); !fault.none()) return fault;
    for (std::size_t i = 0; i < batch.count; ++i) {
        Fault fault = check_instance(batch, element_of(batch, i));
        if (fault.none()) continue;
        fault.instance = i;
        return fault;
    }
    return {};
}

}  // namespace goffer::bend
