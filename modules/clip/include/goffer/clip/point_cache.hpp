// SPDX-License-Identifier: MIT
#pragma once

#include <glm/vec3.hpp>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <span>
#include <string>
#include <vector>

/// Point caches: the places of a mesh's vertices, frame after frame, for programs that have the mesh itself
/// from another file. MDD and PC2 are the two that most of them read.
///
/// A cache knows vertices by their numbers alone, so a program must have kept those of the model's file.
/// modules/clip/README.md, "Point caches", says which importers of Blender do, and how to get there.

namespace goffer::io {
class AtomicFiles;
}

namespace goffer::clip {

class Frames;

/// Which way is up in a cache.
enum class CacheAxes : std::uint8_t {
    as_model,  ///< the coordinates of the model's own file
    z_up,      ///< (x, y, z) becomes (x, -z, y): as Blender's glTF importer turns the mesh that it makes
};

/// Writes `frames` as an MDD: big-endian; the counts of frames and points, 32 bits each; each frame's time in
/// seconds, from 0; then three floats a point. Points are the first `vertices` of each frame, carried to
/// where its placement says. One frame is in memory at a time; the file is `files`' to put in its place.
///
/// Throws io::Error if the file cannot be written, there are no vertices or fewer than `vertices`, there are
/// more than 2^31 - 1 frames or points, or a coordinate is not finite.
void save_mdd(Frames& frames, std::size_t vertices, const std::filesystem::path& file, io::AtomicFiles& files,
              CacheAxes axes = CacheAxes::as_model);

/// Writes `frames` as a PC2 likewise: little-endian; "POINTCACHE2" and a 0; version 1; the count of points;
/// the first frame, 0, and the frames between two samples, 1, as floats; the count of samples; then three
/// floats a point. It does not say how long a frame is.
void save_pc2(Frames& frames, std::size_t vertices, const std::filesystem::path& file, io::AtomicFiles& files,
              CacheAxes axes = CacheAxes::as_model);

/// What a point cache says of itself.
struct PointCacheHeader {
    enum class Format : std::uint8_t { mdd, pc2 };

    Format format = Format::mdd;
    std::size_t frames = 0, points = 0;  ///< 1 or more
    std::vector<float> times;            ///< MDD: of each frame, in seconds; PC2: empty
    float start = 0, step = 1;           ///< PC2: the first frame, and frames between samples; MDD: 0, 1
};

/// A point cache in a file, which stays open. Its frames are read when they are asked for. Not thread-safe.
class PointCache {
public:
    [[nodiscard]] const PointCacheHeader& header() const noexcept { return header_; }

    /// Reads frame `frame` < header().frames. `positions` has header().points entries. Throws io::Error if
    /// the file has become shorter, or a coordinate is not finite.
    void read(std::size_t frame, std::span<glm::vec3> positions);

private:
    friend PointCache read_point_cache(const std::filesystem::path& file);
    PointCache() = default;

    std::filesystem::path file_;
    std::ifstream in_;
    PointCacheHeader header_;
    std::uint64_t first_byte_ = 0;  ///< of frame 0
    std::string bytes_;             ///< of a frame
};

/// Opens an MDD or a PC2, told apart by content, which may be untrusted: nothing is allocated that the file's
/// size does not account for. Throws io::Error if the file cannot be read, is neither, is a PC2 of another
/// version than 1, has another size than its counts ask for, no frames or no points, or a time, a start or a
/// step that is not finite.
[[nodiscard]] PointCache read_point_cache(const std::filesystem::path& file);

}  // namespace goffer::clip
