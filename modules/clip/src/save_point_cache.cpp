// SPDX-License-Identifier: MIT
#include "placed.hpp"

#include <goffer/clip/frames.hpp>
#include <goffer/clip/point_cache.hpp>
#include <goffer/io/atomic_file.hpp>
#include <goffer/io/bytes.hpp>

#include <bit>
#include <limits>
#include <string_view>

// No library is used: Debian 12 has none for either format, and each is a header and floats.

namespace goffer::clip {
namespace {

/// Readers take counts as signed.
constexpr std::size_t most_in_cache = std::numeric_limits<std::int32_t>::max();

void check(const Frames& frames, std::size_t vertices, const std::filesystem::path& file) {
    const auto too_many = [&](const char* what, std::size_t count) {
        fail(file, std::to_string(count) + " " + what + " are more than a point cache can hold, which is " +
                       std::to_string(most_in_cache) + "; give it fewer");
    };
    if (vertices == 0 || vertices > frames.vertices())
        fail(file, "a point cache of " + std::to_string(vertices) + " vertices cannot be made of frames of " +
                       std::to_string(frames.vertices()) + "; give it 1 or more of them");
    if (vertices > most_in_cache) too_many("vertices", vertices);
    if (frames.count() > most_in_cache) too_many("frames", frames.count());
}

glm::vec3 turned(const glm::vec3& p, CacheAxes axes) {
    return axes == CacheAxes::z_up ? glm::vec3(p.x, -p.z, p.y) : p;
}

/// Writes the floats of all frames, one after the other.
void write_frames(Frames& frames, std::size_t vertices, const std::filesystem::path& file, CacheAxes axes,
                  std::endian order, io::AtomicFile& out) {
    std::vector<glm::vec3> positions(frames.vertices());
    std::string bytes;
    bytes.reserve(vertices * sizeof(glm::vec3));
    for (std::size_t frame = 0; frame < frames.count(); ++frame) {
        frames.read(frame, positions, {});
        const std::span<glm::vec3> own = std::span(positions).first(vertices);
        place(frames.placement(frame), own, {});
        check_finite(own, "vertex", frame, file, use_smaller_numbers);
        bytes.clear();
        for (const glm::vec3& p : own) {
            const glm::vec3 at = turned(p, axes);
            io::append_bytes(bytes, order, at.x, at.y, at.z);
        }
        out.write(bytes);
    }
}

}  // namespace

void save_mdd(Frames& frames, std::size_t vertices, const std::filesystem::path& file, io::AtomicFiles& files,
              CacheAxes axes) {
    check(frames, vertices, file);
    io::AtomicFile& out = files.add(file);
    std::string header;
    io::append_bytes(header, std::endian::big, static_cast<std::int32_t>(frames.count()),
                     static_cast<std::int32_t>(vertices));
    for (std::size_t frame = 0; frame < frames.count(); ++frame)
        io::append_bytes(header, std::endian::big,
                         static_cast<float>(static_cast<double>(frame) / frames.rate()));
    out.write(header);
    write_frames(frames, vertices, file, axes, std::endian::big, out);
}

void save_pc2(Frames& frames, std::size_t vertices, const std::filesystem::path& file, io::AtomicFiles& files,
              CacheAxes axes) {
    check(frames, vertices, file);
    io::AtomicFile& out = files.add(file);
    std::string header("POINTCACHE2\0", 12);
    io::append_bytes(header, std::endian::little, std::int32_t{1}, static_cast<std::int32_t>(vertices), 0.0f,
                     1.0f, static_cast<std::int32_t>(frames.count()));
    out.write(header);
    write_frames(frames, vertices, file, axes, std::endian::little, out);
}

}  // namespace goffer::clip
