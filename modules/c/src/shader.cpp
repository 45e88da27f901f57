// SPDX-License-Identifier: MIT
#include "convert.hpp"

#include <goffer/bend/kernel_input.hpp>
#include <goffer/gpu/source.hpp>
#include <goffer/gpu/vertices.hpp>

#include <cstddef>
#include <cstdint>
#include <span>

using namespace goffer;
using namespace goffer::c;

static_assert(GOFFER_COEFFICIENTS * sizeof(float) == sizeof(bend::Coefficients));
static_assert(gpu::VertexLayout::none == SIZE_MAX);

namespace {

/// The caller's memory as C++ has it: rows of floats, whose alignment set-up wants.
template <class SetUp>
void set_up(const goffer_crowd* crowd, std::size_t index, float* result, const SetUp& work) {
    const bend::Batch* const batch = crowd != nullptr ? crowd->batch(index) : nullptr;
    if (batch == nullptr || batch->body == nullptr || batch->poses.empty()) return;
    const std::size_t count = batch->count * batch->body->region_count();
    work(*batch, std::span(reinterpret_cast<bend::Coefficients*>(result), count), crowd->isa);
}

}  // namespace

goffer_vertex_layout goffer_body_vertex_layout(const goffer_body* body) {
    if (body == nullptr) return {};
    const gpu::VertexLayout layout = gpu::vertex_layout(*body->body);
    return {layout.stride, layout.column,  layout.wrinkle, layout.normal,
            layout.shape,  layout.tangent, layout.joint};
}

void goffer_body_write_vertices(const goffer_body* body, void* result) {
    if (body == nullptr) return;
    const bend::Body& from = *body->body;
    gpu::write_vertices(
        from, {static_cast<std::byte*>(result), from.vertex_count() * gpu::vertex_layout(from).stride});
}

void goffer_crowd_set_up(const goffer_crowd* crowd, size_t index, float* result) {
    set_up(crowd, index, result, bend::set_up);
}

void goffer_crowd_set_up_previous(const goffer_crowd* crowd, size_t index, float* result) {
    const bend::Batch* const batch = crowd != nullptr ? crowd->batch(index) : nullptr;
    if (batch == nullptr || batch->previous_poses.empty()) return;
    set_up(crowd, index, result, bend::set_up_previous);
}

goffer_string goffer_deform_glsl(void) {
    return {gpu::deform_glsl().data(), gpu::deform_glsl().size()};
}
