// SPDX-License-Identifier: MIT
#include "file/format.hpp"

#include <goffer/bend/checksum.hpp>

#include <algorithm>
#include <cstring>

namespace goffer::bend {

FirstBandsRecord record_of(const Bands& bands, std::size_t vertex_count) noexcept {
    FirstBandsRecord record = {};
    record.vertex_count = vertex_count;
    record.lowest = bands.lowest;
    record.highest = bands.highest;
    record.drift_error = bands.drift_error;
    record.max_drift_step = bands.max_drift_step;
    record.max_scale = bands.max_scale;
    record.shaped = bands.shaped ? 1 : 0;
    std::ranges::copy(bands.rho, record.rho);
    std::ranges::copy(bands.outward, record.outward);
    std::ranges::copy(bands.inward, record.inward);
    std::ranges::copy(bands.drift, record.drift);
    return record;
}

BandsRecord record_of(const Bands& bands, const Joints& joints, std::size_t first,
                      std::size_t vertex_count) noexcept {
    return {record_of(bands, vertex_count), joints.below.last - first, joints.above.first - first,
            joints.below.max_scale, joints.above.max_scale};
}

std::uint64_t checksum_of(std::span<const std::byte> bytes) noexcept {
    FileHeader header;
    std::memcpy(&header, bytes.data(), sizeof header);
    header.checksum = 0;
    Checksum checksum;
    checksum.add(std::as_bytes(std::span(&header, 1)));
    checksum.add(bytes.subspan(sizeof header));
    return checksum.value();
}

}  // namespace goffer::bend
