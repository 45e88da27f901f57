// SPDX-License-Identifier: MIT
#include "convert.hpp"

#include <goffer/bend/kernel_input.hpp>
#include <goffer/gpu/source.hpp>
#include <goffer/gpu/vertices.hpp>

#include <cstddef>
#include <span>

using namespace goffer;
using namespace goffer::c;

static_assert(GOFFER_COEFFICIENTS * sizeof(float) == sizeof(bend::Coefficients));
static_assert(gpu::VertexLayout::none == SIZE_MAX);

namespace {

/// The caller's memory as C++ has it: rows of floats, whose alignment set-up wants.
template <class SetUp>
void set_up(const bend::Batch* batch, const goffer_crowd* crowd, float* result, const SetUp& work) {
    if (batch == nullptr) return;
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
    set_up(posed_batch(crowd, index), crowd, result, bend::set_up);
}

void goffer_crowd_set_up_previous(const goffer_crowd* crowd, size_t index, float* result) {
    set_up(posed_batch(crowd, index, &bend::Batch::previous_poses), crowd, result, bend::set_up_previous);
}

goffer_string goffer_deform_glsl(void) {
    return {gpu::deform_glsl().data(), gpu::deform_glsl().size()};
}
