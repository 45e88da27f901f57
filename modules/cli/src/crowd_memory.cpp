// SPDX-License-Identifier: MIT
#include "crowd_memory.hpp"

#include <goffer/engine/fill.hpp>
#include <goffer/engine/parallel.hpp>

#include <algorithm>
#include <cstring>
#include <span>

namespace goffer::cli {
namespace {

constexpr std::size_t position_floats = 3;
constexpr std::size_t normal_floats = 3;

Columns values_for(StreamLayout layout, bool normals, std::size_t vertices) {
    const std::size_t floats = CrowdMemory::vertex_bytes(layout, normals) / sizeof(float);
    return layout == StreamLayout::planar ? Columns(floats, vertices) : Columns(1, floats * vertices);
}

/// FNV-1a by words of eight bytes; the shift lets high bits reach low ones, which bytes do by themselves.
std::uint64_t mixed(std::uint64_t hash, std::uint64_t word) noexcept {
    constexpr std::uint64_t prime = 0x100000001b3;
    hash = (hash ^ word) * prime;
    return hash ^ (hash >> 32);
}

std::uint64_t mixed(std::uint64_t hash, std::span<const float> values) noexcept {
    constexpr std::size_t floats = sizeof(std::uint64_t) / sizeof(float);
    for (std::size_t i = 0; i < values.size(); i += floats) {
        std::uint64_t word = 0;
        std::memcpy(&word, &values[i], std::min(floats, values.size() - i) * sizeof(float));
        hash = mixed(hash, word);
    }
    return hash;
}

}  // namespace

CrowdMemory::CrowdMemory(StreamLayout layout, bool normals, std::size_t vertices)
    : layout_(layout), normals_(normals), values_(values_for(layout, normals, vertices)) {}

std::size_t CrowdMemory::vertex_bytes(StreamLayout layout, bool normals) noexcept {
    if (layout == StreamLayout::packed) return sizeof(bend::PackedVertex);
    return (position_floats + (normals ? normal_floats : 0)) * sizeof(float);
}

void CrowdMemory::point(bend::Batch& batch, std::size_t first) noexcept {
    batch.vertex_step = batch.body->vertex_count();
    const std::size_t count = batch.count * batch.vertex_step;
    const std::size_t stride = vertex_bytes(layout_, normals_);
    const auto plane = [&](std::size_t column) { return values_[column].subspan(first, count); };
    if (layout_ == StreamLayout::planar) {
        batch.positions = planar(plane(0), plane(1), plane(2));
        if (normals_) batch.normals = planar(plane(3), plane(4), plane(5));
        return;
    }
    float* const record = values_[0].data() + first * stride / sizeof(float);
    if (layout_ == StreamLayout::packed) {
        batch.packed = {reinterpret_cast<bend::PackedVertex*>(record), stride, count};
        return;
    }
    batch.positions = interleaved<position_floats>(record, count, stride);
    if (normals_) batch.normals = interleaved<normal_floats>(record + position_floats, count, stride);
}

void CrowdMemory::fill(float seed, bool parallel) {
    constexpr std::size_t block = 16384;  // floats: whole lines, and enough that handing it out costs nothing
    const std::size_t count = values_.count();
    const std::size_t blocks = (count + block - 1) / block;  // of a column
    const auto fill_blocks = [&](std::size_t first, std::size_t last) {
        while (first < last) {
            const std::size_t column = first / blocks;
            const std::size_t next = std::min(last, (column + 1) * blocks);
            const std::size_t begin = (first - column * blocks) * block;
            const std::size_t end = std::min((next - column * blocks) * block, count);
            goffer::fill(values_[column].subspan(begin, end - begin), seed, true);
            first = next;
        }
    };
    const std::size_t all = values_.columns() * blocks;
    if (parallel) {
        parallel_ranges(all, 4, fill_blocks);
    } else {
        fill_blocks(0, all);
    }
}

std::uint64_t CrowdMemory::hash() const noexcept {
    std::uint64_t hash = 0xcbf29ce484222325;
    for (std::size_t column = 0; column < values_.columns(); ++column) hash = mixed(hash, values_[column]);
    return hash;
}

}  // namespace goffer::cli
