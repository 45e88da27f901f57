// SPDX-License-Identifier: MIT
#include "body/body_data.hpp"

#include <cassert>
#include <utility>

namespace goffer::bend {

Body::Body() noexcept = default;
Body::Body(const BodyData* data) noexcept : data_(data) {}
Body::Body(Body&& other) noexcept : data_(std::exchange(other.data_, nullptr)) {}
Body& Body::operator=(Body&& other) noexcept {
    delete std::exchange(data_, std::exchange(other.data_, nullptr));
    return *this;
}
Body::~Body() {
    delete data_;
}

std::size_t Body::vertex_count() const noexcept {
    return data_ ? data_->vertex_count : 0;
}

bool Body::has_tangents() const noexcept {
    return data_ && data_->columns.tangent_sign != nullptr;
}

std::span<const Region> Body::regions() const noexcept {
    return data_ ? std::span<const Region>(data_->regions) : std::span<const Region>();
}

std::span<const RegionInput> Body::region_inputs() const noexcept {
    return data_ ? std::span<const RegionInput>(data_->inputs) : std::span<const RegionInput>();
}

double Body::length() const noexcept {
    return data_ ? data_->length : 0;
}

double Body::radius() const noexcept {
    return data_ ? data_->radius : 0;
}

float Body::max_angle(std::size_t region) const noexcept {
    assert(region < region_count());
    return data_->regions[region].max_angle;
}

Pose Body::rest_pose(std::size_t region) const noexcept {
    assert(region < region_count());
    return data_->regions[region].rest;
}

std::vector<Pose> Body::rest_poses() const {
    std::vector<Pose> poses;
    for (const Region& region : regions()) poses.push_back(region.rest);
    return poses;
}

glm::dvec3 Body::origin() const noexcept {
    return data_ ? data_->origin : glm::dvec3(0);
}

glm::dmat3 Body::axes() const noexcept {
    return data_ ? data_->axes : glm::dmat3(1);
}

std::size_t Body::bytes() const noexcept {
    if (!data_) return sizeof(Body);
    std::size_t bytes = sizeof(Body) + sizeof(BodyData) + data_->storage.bytes();
    for (const RegionInput& region : data_->inputs) {
        bytes += sizeof(RegionInput) + sizeof(Region) + sizeof(RegionData) +
                 region.table.rows.size() * sizeof(region.table.rows[0]) +
                 region.factors.rows.size() * sizeof(region.factors.rows[0]);
    }
    return bytes;
}

}  // namespace goffer::bend
