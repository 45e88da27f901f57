// SPDX-License-Identifier: MIT
#include "convert.hpp"

#include <goffer/bend/bounds.hpp>

#include <bit>
#include <memory>
#include <stdexcept>

using namespace goffer;
using namespace goffer::c;

namespace {

template <class T>
StridedView<T> view_of(const goffer_column& column) {
    StridedView<T> view;
    view.data = column.data;
    view.count = column.data != nullptr ? column.count : 0;
    view.stride = column.stride;
    view.offset = column.offset;
    if (column.page_size == 0) return view;
    if (!std::has_single_bit(column.page_size) || column.page_size > std::size_t{1} << 32)
        throw std::invalid_argument("page_size: not a power of two up to 2^32");
    view.page_shift = static_cast<std::uint32_t>(std::countr_zero(column.page_size));
    return view;
}

bend::TransformColumn transforms_of(const goffer_column& column, int layout) {
    using Layout = bend::TransformColumn::MatrixLayout;
    constexpr Layout layouts[] = {Layout::columns3, Layout::columns4, Layout::rows4};
    if (layout < GOFFER_COLUMNS3 || layout > GOFFER_ROWS4)
        throw std::invalid_argument(
            "transform_layout: there is no such layout; use GOFFER_COLUMNS3, GOFFER_COLUMNS4 or "
            "GOFFER_ROWS4");
    return column.data == nullptr ? bend::TransformColumn()
                                  : bend::TransformColumn(view_of<float>(column), layouts[layout]);
}

bend::Batch batch_of(const goffer_batch& from) {
    bend::Batch batch;
    batch.body = body_of(from.body);
    batch.count = from.count;
    if (from.indices != nullptr) batch.indices = {from.indices, from.count};
    batch.poses = view_of<bend::Pose>(from.poses);
    batch.transforms = transforms_of(from.transforms, from.transform_layout);
    batch.wrinkle_weights = view_of<float>(from.wrinkle_weights);
    batch.previous_poses = view_of<bend::Pose>(from.previous_poses);
    batch.previous_transforms = transforms_of(from.previous_transforms, from.transform_layout);
    batch.visible = view_of<std::uint8_t>(from.visible);
    batch.changed = view_of<std::uint8_t>(from.changed);
    batch.update_intervals = view_of<std::uint8_t>(from.update_intervals);
    batch.positions = stream3(from.positions);
    batch.normals = stream3(from.normals);
    batch.tangents = stream4(from.tangents);
    batch.packed = packed_of(from.packed);
    batch.previous_positions = stream3(from.previous_positions);
    if (from.bounds != nullptr) batch.bounds = {reinterpret_cast<bend::Bounds*>(from.bounds), from.count};
    batch.vertex_offsets = view_of<std::uint32_t>(from.vertex_offsets);
    batch.vertex_step = from.vertex_step;
    batch.scratch_gaps = from.scratch_gaps != 0;
    return batch;
}

goffer_crowd_result result_of(const bend::CrowdResult& result) noexcept {
    return {result.deformed, result.clamped, result.at_rest};
}

}  // namespace

goffer_crowd* goffer_crowd_create(size_t batch_count, goffer_error* error) {
    return guarded(error, [&]() -> goffer_crowd* {
        auto crowd = std::make_unique<goffer_crowd>();
        crowd->batches.resize(batch_count);
        return crowd.release();
    });
}

void goffer_crowd_free(goffer_crowd* crowd) {
    delete crowd;
}

int goffer_crowd_set(goffer_crowd* crowd, size_t index, const goffer_batch* batch, goffer_error* error) {
    return guarded(error, [&]() -> int {
        if (crowd == nullptr) throw std::invalid_argument("crowd: null");
        if (index >= crowd->batches.size()) throw std::out_of_range("index: the crowd has no such batch");
        if (batch == nullptr) throw std::invalid_argument("batch: null");
        crowd->batches[index] = batch_of(*batch);
        return 1;
    });
}

void goffer_crowd_set_frame(goffer_crowd* crowd, uint32_t frame) {
    if (crowd != nullptr) crowd->frame = frame;
}

void goffer_crowd_set_stores(goffer_crowd* crowd, int stores) {
    if (crowd == nullptr) return;
    crowd->stores = stores == GOFFER_STORES_CACHED         ? bend::Stores::cached
                    : stores == GOFFER_STORES_NON_TEMPORAL ? bend::Stores::non_temporal
                                                           : bend::Stores::automatic;
}

void goffer_crowd_set_isa(goffer_crowd* crowd, int isa) {
    if (crowd != nullptr) crowd->isa = isa_of(isa);
}

int goffer_crowd_validate(const goffer_crowd* crowd, goffer_error* error) {
    if (crowd == nullptr) return say(error, GOFFER_ERROR_ARGUMENT, "crowd: null"), 0;
    return say_fault(error, bend::validate(crowd->job()));
}

goffer_crowd_result goffer_crowd_run(const goffer_crowd* crowd) {
    return result_of(bend::run(crowd->job()));
}

goffer_crowd_result goffer_crowd_run_parallel(const goffer_crowd* crowd) {
    try {
        return result_of(bend::run_parallel(crowd->job()));
    } catch (...) {  // the scheduler has no memory
        return goffer_crowd_run(crowd);
    }
}

goffer_crowd_result goffer_crowd_run_piece(const goffer_crowd* crowd, size_t piece, size_t pieces) {
    if (piece >= pieces) return {};
    return result_of(bend::run_piece(crowd->job(), piece, pieces));
}

void goffer_crowd_bounds(const goffer_crowd* crowd, size_t index, goffer_bounds* result) {
    const bend::Batch* const batch = posed_batch(crowd, index);
    if (batch == nullptr) return;
    bend::bounds(*batch, {reinterpret_cast<bend::Bounds*>(result), batch->count}, crowd->isa);
}
