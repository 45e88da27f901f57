// SPDX-License-Identifier: MIT
#include "output/staging_buffer.hpp"

#include <algorithm>

namespace goffer::bend {

StagingBuffer::StagingBuffer(const OutputPlan& plan) noexcept {
    const std::size_t room = max_floats / std::max<std::size_t>(plan.value_count(), 1) - spare;
    capacity_ = std::min(max_vertices, room / line_floats * line_floats);
    stride_ = capacity_ + spare;
}

PlaneOutput StagingBuffer::output(const PassPlan& pass, std::size_t vertex) noexcept {
    PlaneOutput out = {};
    const auto plane = [&](std::size_t value) { return planes_ + (pass.value + value) * stride_ + vertex; };
    for (std::size_t c = 0; c < 3; ++c) out.position[c] = plane(c);
    if (pass.streams == StreamSet::positions_normals || pass.streams == StreamSet::positions_normals_tangents)
        for (std::size_t c = 0; c < 3; ++c) out.normal[c] = plane(3 + c);
    if (pass.streams == StreamSet::positions_normals_tangents)
        for (std::size_t c = 0; c < 4; ++c) out.tangent[c] = plane(6 + c);
    return out;
}

void StagingBuffer::write(const OutputPlan& plan, const KernelSet& kernels, WriteMode mode,
                          std::size_t vertex, std::size_t count) const noexcept {
    for (const Record& record : plan.records()) {
        if (record.mode != mode) continue;
        const std::span<const Component> components = plan.components(record);
        if (record.plane()) {
            kernels.copy_lines(planes_ + components[0].value * stride_, components[0].first + vertex, count,
                               plan.non_temporal());
        } else if (!record.has_gaps() && components.size() <= max_woven &&
                   kernels.weave[components.size()] != nullptr) {
            weave(record, components, kernels, vertex, count, plan.non_temporal());
        } else {
            write_values(record, components, vertex, 0, count);
        }
    }
}

void StagingBuffer::write_values(const Record& record, std::span<const Component> components,
                                 std::size_t vertex, std::size_t first, std::size_t last) const noexcept {
    const std::size_t step = record.stride_floats();
    for (const Component& component : components) {
        const float* const from = planes_ + component.value * stride_;
        float* const to = component.first + vertex * step;
        for (std::size_t i = first; i < last; ++i) to[i * step] = from[i];
    }
}

void StagingBuffer::weave(const Record& record, std::span<const Component> components,
                          const KernelSet& kernels, std::size_t vertex, std::size_t count,
                          bool non_temporal) const noexcept {
    float* const to = record.first + vertex * record.stride_floats();
    std::size_t peeled = 0;  // vertices before the first that begins a line
    if (non_temporal) {
        peeled = record.to_line(vertex);
        if (peeled == line_floats) non_temporal = false, peeled = 0;
        peeled = std::min(peeled, count);
    }
    const float* planes[max_woven];
    for (std::size_t c = 0; c < components.size(); ++c)
        planes[c] = planes_ + components[c].value * stride_ + peeled;
    const std::size_t lines = (count - peeled) / line_floats;
    kernels.weave[components.size()](planes, lines, to + peeled * record.stride_floats(), non_temporal);
    write_values(record, components, vertex, 0, peeled);
    write_values(record, components, vertex, peeled + lines * line_floats, count);
}

}  // namespace goffer::bend
