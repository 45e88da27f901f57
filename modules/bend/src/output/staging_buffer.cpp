// SPDX-License-Identifier: MIT
#include "output/staging_buffer.hpp"

#include <algorithm>
#include <numeric>

namespace goffer::bend {
namespace {

/// The plane of a gap.
alignas(64) constexpr float zeros[StagedPlanes::max_stride] = {};

}  // namespace

StagingBuffer::StagingBuffer(const OutputPlan& plan) noexcept {
    const std::size_t room = max_floats / plan.value_count() - spare;
    capacity_ = std::min(max_vertices, room / line_floats * line_floats);
    stride_ = capacity_ + spare;
    if (!plan.stages()) return;
    for (const PassPlan& pass : plan.passes())
        outputs_[static_cast<std::size_t>(pass.pass)] = output_of(pass);
}

PlaneOutput StagingBuffer::output_of(const PassPlan& pass) noexcept {
    PlaneOutput out = {};
    const auto plane = [&](std::size_t value) { return planes_ + (pass.value + value) * stride_; };
    for (std::size_t c = 0; c < 3; ++c) out.position[c] = plane(c);
    if (pass.streams == StreamSet::positions_normals || pass.streams == StreamSet::positions_normals_tangents)
        for (std::size_t c = 0; c < 3; ++c) out.normal[c] = plane(3 + c);
    if (pass.streams == StreamSet::positions_normals_tangents)
        for (std::size_t c = 0; c < 4; ++c) out.tangent[c] = plane(6 + c);
    return out;
}

void StagedPlanes::write(const OutputPlan& plan, const KernelSet& kernels, WriteMode mode, std::size_t vertex,
                         std::size_t count, bool ends) const noexcept {
    for (const Record& record : plan.records()) {
        if (record.mode != mode) continue;
        const std::span<const Component> components = plan.components(record);
        if (record.plane()) {
            kernels.copy_lines(planes_ + components[0].value * stride_, components[0].first + vertex, count,
                               plan.non_temporal());
        } else if (record.woven) {
            weave(record, components, kernels, vertex, count, ends);
        } else {
            write_rows(record, components, kernels, vertex, count);
        }
    }
}

/// Components that follow each other are rows, as many at a time as there is a kernel for.
void StagedPlanes::write_rows(const Record& record, std::span<const Component> components,
                              const KernelSet& kernels, std::size_t vertex,
                              std::size_t count) const noexcept {
    while (!components.empty()) {
        std::size_t run = 1;
        while (run < components.size() && components[run].first == components[0].first + run) ++run;
        while (run > 1 && kernels.write_rows[run] == nullptr) --run;
        if (run == 1) {
            write_values(record, components.first(1), vertex, 0, count);
        } else {
            const float* planes[max_values];
            for (std::size_t c = 0; c < run; ++c) planes[c] = planes_ + components[c].value * stride_;
            kernels.write_rows[run](planes, count, components[0].first + vertex * record.stride_floats(),
                                    record.stride);
        }
        components = components.subspan(run);
    }
}

void StagedPlanes::write_values(const Record& record, std::span<const Component> components,
                                std::size_t vertex, std::size_t first, std::size_t last) const noexcept {
    const std::size_t step = record.stride_floats();
    for (const Component& component : components) {
        const float* const from = planes_ + component.value * stride_;
        float* const to = component.first + vertex * step;
        for (std::size_t i = first; i < last; ++i) to[i * step] = from[i];
    }
}

void StagedPlanes::weave(const Record& record, std::span<const Component> components,
                         const KernelSet& kernels, std::size_t vertex, std::size_t count,
                         bool ends) const noexcept {
    const std::size_t floats = record.stride_floats();
    bool non_temporal = record.in_lines;
    std::size_t peeled = 0;  // vertices before the first that begins a line
    if (non_temporal) {
        peeled = record.to_line(vertex);
        if (peeled == line_floats) non_temporal = false, peeled = 0;
    }
    // The gap before the first vertex may belong to another range; the one behind an instance's last vertex
    // must stay.
    if (record.lead > 0 && peeled == 0) peeled = line_floats / std::gcd(floats, line_floats);
    const bool keeps_last = ends && record.lead + record.floats < floats;
    const std::size_t most = count - (keeps_last ? 1 : 0);
    peeled = std::min(peeled, most);
    const float* planes[max_woven];
    std::fill_n(planes, floats, zeros);
    for (const Component& component : components) {
        const std::size_t place = record.lead + static_cast<std::size_t>(component.first - record.first);
        const std::size_t first = component.value * stride_ + peeled;
        // The last values of a vertex may lie in the next woven record.
        planes[place % floats] = planes_ + (place < floats ? first : first - 1);
    }
    const std::size_t lines = (most - peeled) / line_floats;
    const std::size_t left = lines > 0 && record.lead + record.floats > floats ? 1 : 0;
    float* const to = record.first - record.lead + (vertex + peeled) * floats;
    kernels.weave[floats](planes, lines, to, non_temporal);
    write_values(record, components, vertex, 0, peeled);
    std::size_t written = peeled + lines * line_floats - left;
    if (record.lead == 0 && written < most) {
        // What is left fills lines too, which would be read first if they were written value by value.
        alignas(64) float rest[line_floats * max_woven];
        for (std::size_t c = 0; c < floats; ++c)
            if (planes[c] != zeros) planes[c] += lines * line_floats;
        kernels.weave[floats](planes, 1, rest, false);
        kernels.copy_lines(rest, to + lines * line_floats * floats, (most - written) * floats, non_temporal);
        written = most;
    }
    write_values(record, components, vertex, written, count);
}

}  // namespace goffer::bend
