// SPDX-License-Identifier: MIT
#include "placed.hpp"

#include <goffer/clip/point_cache.hpp>
#include <goffer/io/bytes.hpp>
#include <goffer/io/read_file.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <string_view>

namespace goffer::clip {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t mdd_header = 8, pc2_header = 32;
constexpr std::string_view pc2_signature("POINTCACHE2\0", 12);

std::string read_bytes(std::ifstream& in, std::uint64_t count, const fs::path& file) {
    std::string bytes(count, '\0');
    if (!in.read(bytes.data(), static_cast<std::streamsize>(count)))
        fail(file, "cannot be read; check its permissions");
    return bytes;
}

/// Takes counts over, if the file has just the bytes for them: `each` bytes for each frame, and 12 more for
/// each of its points, behind a header. Nothing overflows: both counts are below 2^31.
void take_counts(PointCacheHeader& header, std::int32_t frames, std::int32_t points, std::uint64_t each,
                 std::uint64_t behind_header, const fs::path& file) {
    if (frames < 1 || points < 1)
        fail(file, "is no MDD or PC2 point cache with frames and points; export it again");
    const std::uint64_t frame_bytes = each + sizeof(glm::vec3) * static_cast<std::uint64_t>(points);
    if (behind_header % frame_bytes != 0 || behind_header / frame_bytes != static_cast<std::uint64_t>(frames))
        fail(file, "is cut off or no point cache: it is not of the size of " + std::to_string(frames) +
                       " frames of " + std::to_string(points) + " points; export it again");
    header.frames = static_cast<std::size_t>(frames);
    header.points = static_cast<std::size_t>(points);
}

PointCacheHeader pc2_of(std::string_view bytes, std::uint64_t size, const fs::path& file) {
    const auto number = [&]<class T>(std::size_t at, T) { return io::from_bytes<T>(bytes.substr(at)); };
    if (const auto version = number(12, std::int32_t{}); version != 1)
        fail(file, "is a PC2 of version " + std::to_string(version) +
                       ", of which nothing is known; export version 1");
    PointCacheHeader header;
    header.format = PointCacheHeader::Format::pc2;
    take_counts(header, number(28, std::int32_t{}), number(16, std::int32_t{}), 0, size - pc2_header, file);
    header.start = number(20, float{});
    header.step = number(24, float{});
    if (!std::isfinite(header.start) || !std::isfinite(header.step))
        fail(file, "its first frame, or the step between frames, is not finite; export it again");
    return header;
}

PointCacheHeader mdd_of(std::ifstream& in, std::uint64_t size, const fs::path& file) {
    const std::string counts = read_bytes(in, mdd_header, file);
    const auto number = [&](std::size_t at) {
        return io::from_bytes<std::int32_t>(std::string_view(counts).substr(at), std::endian::big);
    };
    PointCacheHeader header;
    take_counts(header, number(0), number(4), sizeof(float), size - mdd_header, file);
    const std::string times = read_bytes(in, sizeof(float) * header.frames, file);
    header.times.reserve(header.frames);
    for (std::size_t i = 0; i < header.frames; ++i) {
        const std::string_view at = std::string_view(times).substr(sizeof(float) * i);
        header.times.push_back(io::from_bytes<float>(at, std::endian::big));
        if (!std::isfinite(header.times.back()))
            fail(file, "the time of frame " + std::to_string(i) +
                           " (counted from 0) is not finite; export it again");
    }
    return header;
}

}  // namespace

PointCache read_point_cache(const fs::path& file) {
    const std::uint64_t size = io::size_of_file(file);
    PointCache cache;
    cache.file_ = file;
    cache.in_.open(file, std::ios::binary);
    if (size < mdd_header) fail(file, "is too short for an MDD or PC2 point cache; export it again");
    const std::string first = read_bytes(cache.in_, std::min(size, pc2_header), file);
    const bool is_pc2 = first.starts_with(pc2_signature);
    if (is_pc2 && size < pc2_header) fail(file, "is a PC2 that is cut off; export it again");
    cache.in_.seekg(0);
    cache.header_ = is_pc2 ? pc2_of(first, size, file) : mdd_of(cache.in_, size, file);
    cache.first_byte_ = is_pc2 ? pc2_header : mdd_header + sizeof(float) * cache.header_.frames;
    return cache;
}

void PointCache::read(std::size_t frame, std::span<glm::vec3> positions) {
    constexpr std::size_t point = sizeof(glm::vec3);
    bytes_.resize(header_.points * point);
    in_.clear();
    in_.seekg(static_cast<std::streamoff>(first_byte_ + std::uint64_t{frame} * bytes_.size()));
    if (!in_.read(bytes_.data(), static_cast<std::streamsize>(bytes_.size())))
        fail(file_, "frame " + std::to_string(frame) + " cannot be read; was the file changed?");
    const bool is_mdd = header_.format == PointCacheHeader::Format::mdd;
    const std::endian order = is_mdd ? std::endian::big : std::endian::little;
    for (std::size_t i = 0; i < header_.points; ++i)
        for (std::size_t axis = 0; axis < 3; ++axis)
            positions[i][static_cast<glm::length_t>(axis)] = io::from_bytes<float>(
                std::string_view(bytes_).substr(point * i + sizeof(float) * axis), order);
    check_finite(positions.first(header_.points), "vertex", frame, file_, "export it again");
}

}  // namespace goffer::clip
