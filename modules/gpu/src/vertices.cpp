// SPDX-License-Identifier: MIT
#include <goffer/bend/body.hpp>
#include <goffer/bend/kernel_input.hpp>
#include <goffer/gpu/vertices.hpp>

#include <algorithm>
#include <cassert>
#include <cstring>
#include <initializer_list>

namespace goffer::gpu {
namespace {

/// Writes floats one behind the other.
class Writer {
public:
    explicit Writer(std::byte* to) : to_(to) {}

    void write(std::initializer_list<float> values) noexcept {
        std::memcpy(to_, values.begin(), values.size() * sizeof(float));
        to_ += values.size() * sizeof(float);
    }

private:
    std::byte* to_;
};

float value_or(const float* column, std::size_t i, float otherwise) noexcept {
    return column != nullptr ? column[i] : otherwise;
}

}  // namespace

VertexLayout vertex_layout(const bend::Body& body) noexcept {
    const bend::RestColumns columns = bend::rest_columns(body);
    VertexLayout layout;
    const auto add = [&](std::size_t& attribute) {
        attribute = layout.stride;
        layout.stride += 4 * sizeof(float);
    };
    if (columns.scale != nullptr || columns.per_rest_scale != nullptr) add(layout.shape);
    if (columns.tangent_sign != nullptr) add(layout.tangent);
    const auto blends = [](const bend::RegionInput& region) { return region.blend != 0; };
    if (std::ranges::any_of(body.region_inputs(), blends)) add(layout.joint);
    return layout;
}

void write_vertices(const bend::Body& body, std::span<std::byte> result) noexcept {
    const VertexLayout layout = vertex_layout(body);
    assert(result.size() >= body.vertex_count() * layout.stride);
    const bend::RestColumns from = bend::rest_columns(body);
    Writer to(result.data());
    for (std::size_t r = 0; r < body.region_count(); ++r) {
        const bend::Region& region = body.regions()[r];
        for (std::size_t i = region.first; i < region.last; ++i) {
            to.write({from.cos_half_beta[i], from.sin_half_beta[i], from.rho[i], from.height[i]});
            to.write({from.radial_offset[i], from.wrinkle[i], from.slope[i], static_cast<float>(r)});
            to.write({from.normal[0][i], from.normal[1][i], from.normal[2][i]});
            if (layout.shape != VertexLayout::none)
                to.write({value_or(from.drift, i, 0), value_or(from.taper, i, 0),
                          value_or(from.per_rest_scale, i, 0), value_or(from.scale, i, 1)});
            if (layout.tangent != VertexLayout::none)
                to.write({from.tangent[0][i], from.tangent[1][i], from.tangent[2][i], from.tangent_sign[i]});
            if (layout.joint == VertexLayout::none) continue;
            const bend::NeighborShare beyond = bend::neighbor_share(body, r, from.height[i]);
            to.write({static_cast<float>(beyond.neighbor) * beyond.share, beyond.slope, beyond.gain,
                      beyond.radius_ratio});
        }
    }
}

}  // namespace goffer::gpu
