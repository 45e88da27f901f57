// SPDX-License-Identifier: MIT
#include "moving.hpp"
#include "support/files.hpp"
#include "support/models.hpp"

#include <goffer/clip/point_cache.hpp>
#include <goffer/io/atomic_file.hpp>
#include <goffer/io/error.hpp>

#include <doctest/doctest.h>

#include <limits>
#include <random>
#include <string>
#include <vector>

using namespace goffer;
using namespace goffer::test;
using clip::CacheAxes;
using Format = clip::PointCacheHeader::Format;

namespace {

using Save = void (*)(clip::Frames&, std::size_t, const std::filesystem::path&, io::AtomicFiles&, CacheAxes);

std::filesystem::path saved_cache(Save save, clip::Frames& frames, std::size_t vertices,
                                  const std::filesystem::path& file, CacheAxes axes = CacheAxes::as_model) {
    io::AtomicFiles files;
    save(frames, vertices, file, files, axes);
    files.commit();
    return file;
}

std::string save_error(Save save, clip::Frames& frames, std::size_t vertices) {
    const Folder folder;
    std::string message =
        message_of<io::Error>([&] { saved_cache(save, frames, vertices, folder / "clip"); });
    CHECK(folder.files() == 0);
    return message;
}

/// Two frames of a vertex and one more, in numbers whose bytes are known.
class HandMade : public clip::Frames {
public:
    [[nodiscard]] std::size_t count() const noexcept override { return count_of; }
    [[nodiscard]] double rate() const noexcept override { return 2; }
    [[nodiscard]] std::size_t vertices() const noexcept override { return 2; }
    void read(std::size_t frame, std::span<glm::vec3> positions, std::span<glm::vec3>) override {
        positions[0] = frame == 0 ? glm::vec3(1, 2, 4) : glm::vec3(-1, far, 0.5f);
        positions[1] = glm::vec3(99);
    }
    [[nodiscard]] glm::mat4x3 placement(std::size_t frame) const override {
        glm::mat4x3 shift(1.0f);
        shift[3].x = frame == 0 ? 0.0f : -1.0f;
        return shift;
    }

    std::size_t count_of = 2;
    float far = 8;
};

const std::string mdd_bytes(
    "\0\0\0\2"      // frames
    "\0\0\0\1"      // points
    "\0\0\0\0"      // 0 s
    "\x3f\0\0\0"    // 0.5 s
    "\x3f\x80\0\0"  // 1
    "\x40\0\0\0"    // 2
    "\x40\x80\0\0"  // 4
    "\xc0\0\0\0"    // -2: -1, carried by -1
    "\x41\0\0\0"    // 8
    "\x3f\0\0\0",   // 0.5
    40);

const std::string pc2_bytes(
    "POINTCACHE2\0"
    "\1\0\0\0"      // version
    "\1\0\0\0"      // points
    "\0\0\0\0"      // first frame
    "\0\0\x80\x3f"  // frames between samples
    "\2\0\0\0"      // samples
    "\0\0\x80\x3f"  // 1
    "\0\0\0\x40"    // 2
    "\0\0\x80\x40"  // 4
    "\0\0\0\xc0"    // -2
    "\0\0\0\x41"    // 8
    "\0\0\0\x3f",   // 0.5
    56);

std::string read_error(const std::string& bytes) {
    const Folder folder;
    const auto file = folder.write("clip.mdd", bytes);
    return message_of<io::Error>([&] {
        clip::PointCache cache = clip::read_point_cache(file);
        std::vector<glm::vec3> positions(cache.header().points);
        for (std::size_t frame = 0; frame < cache.header().frames; ++frame) cache.read(frame, positions);
    });
}

std::string with(std::string bytes, std::size_t at, const std::string& other) {
    return bytes.replace(at, other.size(), other);
}

/// Whether a cache of `frames` gives back what they are, to the last bit of a float.
void check_round_trip(Save save, Format format, clip::Frames& frames, std::size_t vertices) {
    const Folder folder;
    clip::PointCache cache = clip::read_point_cache(saved_cache(save, frames, vertices, folder / "clip"));
    CHECK(cache.header().format == format);
    CHECK(cache.header().frames == frames.count());
    REQUIRE(cache.header().points == vertices);
    std::vector<glm::vec3> positions(vertices);
    int wrong = 0;
    for (const std::size_t frame : {frames.count() - 1, std::size_t{0}, frames.count() / 2}) {
        cache.read(frame, positions);
        const std::vector<glm::dvec3> exact = carried(frames, frame);
        for (std::size_t i = 0; i < vertices; ++i) wrong += positions[i] != glm::vec3(exact[i]) ? 1 : 0;
    }
    CHECK(wrong == 0);
}

}  // namespace

TEST_CASE("point cache: an MDD is these bytes") {
    const Folder folder;
    HandMade frames;
    CHECK(bytes_of(saved_cache(clip::save_mdd, frames, 1, folder / "clip.mdd")) == mdd_bytes);
}

TEST_CASE("point cache: a PC2 is these bytes") {
    const Folder folder;
    HandMade frames;
    CHECK(bytes_of(saved_cache(clip::save_pc2, frames, 1, folder / "clip.pc2")) == pc2_bytes);
}

TEST_CASE("point cache: with z up, y is what points back") {
    const Folder folder;
    HandMade frames;
    std::vector<glm::vec3> positions(1);
    for (const Save save : {clip::save_mdd, clip::save_pc2}) {
        clip::read_point_cache(saved_cache(save, frames, 1, folder / "clip", CacheAxes::z_up))
            .read(0, positions);
        CHECK(positions[0] == glm::vec3(1, -4, 2));
    }
}

TEST_CASE("point cache: what was written is read again, in any order") {
    MovingPoints points(501, 37, true);
    check_round_trip(clip::save_mdd, Format::mdd, points, 501);
    check_round_trip(clip::save_pc2, Format::pc2, points, 400);
    BendingModel model(test::model("insect_leg.glb"), 9);
    check_round_trip(clip::save_mdd, Format::mdd, model, model.model.positions.size());
    check_round_trip(clip::save_pc2, Format::pc2, model, model.model.positions.size());
}

TEST_CASE("point cache: headers are read as they are") {
    const Folder folder;
    const clip::PointCache mdd = clip::read_point_cache(folder.write("a", mdd_bytes));
    CHECK(mdd.header().times == std::vector<float>{0.0f, 0.5f});
    const std::string late = with(pc2_bytes, 20, {"\0\0\0\x41\0\0\0\x3f", 8});
    const clip::PointCache pc2 = clip::read_point_cache(folder.write("b", late));
    CHECK(pc2.header().start == 8.0f);
    CHECK(pc2.header().step == 0.5f);
    CHECK(pc2.header().times.empty());
}

TEST_CASE("point cache: what no cache can hold is refused before anything is written") {
    HandMade frames;
    for (const Save save : {clip::save_mdd, clip::save_pc2}) {
        CHECK(tells(save_error(save, frames, 0), "0 vertices"));
        CHECK(tells(save_error(save, frames, 3), "frames of 2"));
        HandMade many;
        many.count_of = std::size_t{1} << 31;
        CHECK(tells(save_error(save, many, 1), "2147483648 frames are more than"));
        MovingPoints wide(std::size_t{1} << 31, 1, false);
        CHECK(tells(save_error(save, wide, std::size_t{1} << 31), "2147483648 vertices are more than"));
        HandMade infinite;
        infinite.far = std::numeric_limits<float>::infinity();
        CHECK(tells(save_error(save, infinite, 1), "frame 1, vertex 0 (counted from 0) is not finite"));
    }
}

TEST_CASE("point cache: a disk that is full is told, and nothing is left") {
    MovingPoints points(1000, 50, false);
    const FullDisk full(4096);
    for (const Save save : {clip::save_mdd, clip::save_pc2})
        CHECK(tells(save_error(save, points, 1000), "cannot be written"));
}

TEST_CASE("point cache: files that are cut off or lie about their counts are refused") {
    for (const std::string& good : {mdd_bytes, pc2_bytes}) {
        CHECK(read_error(good).empty());
        for (std::size_t size = 0; size < good.size(); ++size) {
            INFO("of the first bytes: ", size);
            CHECK(tells(read_error(good.substr(0, size)), "export it again"));
        }
        CHECK(tells(read_error(good + '\0'), "export it again"));
        CHECK(tells(read_error(good + std::string(12, '\0')), "export it again"));
    }
    const std::string most("\x7f\xff\xff\xff", 4), most_little("\xff\xff\xff\x7f", 4),
        less("\xff\xff\xff\xff", 4), none(4, '\0');
    for (const std::string& count : {most, less, none}) {
        CHECK(tells(read_error(with(mdd_bytes, 0, count)), "export it again"));
        CHECK(tells(read_error(with(mdd_bytes, 4, count)), "export it again"));
        CHECK(tells(read_error(with(mdd_bytes, 0, count + count)), "export it again"));
    }
    for (const std::string& count : {most_little, less, none}) {
        CHECK(tells(read_error(with(pc2_bytes, 16, count)), "export it again"));
        CHECK(tells(read_error(with(pc2_bytes, 28, count)), "export it again"));
        CHECK(tells(read_error(with(with(pc2_bytes, 16, count), 28, count)), "export it again"));
    }
}

TEST_CASE("point cache: whatever bytes are wrong, a cache is read or refused in one line") {
    const Folder folder(quick_place());
    std::mt19937 random(4);
    int read = 0, refused = 0;
    for (int round = 0; round < 4000; ++round) {
        std::string bytes = random() % 2 == 0 ? mdd_bytes : pc2_bytes;
        for (std::size_t i = random() % 3 + 1; i > 0; --i)
            bytes[random() % bytes.size()] = static_cast<char>(random() % 4 == 0 ? random() : random() % 4);
        if (random() % 4 == 0) bytes.resize(random() % (2 * bytes.size()), static_cast<char>(random()));
        const auto file = folder.write("clip", bytes);
        const std::string message = message_of<io::Error>([&] {
            clip::PointCache cache = clip::read_point_cache(file);
            std::vector<glm::vec3> positions(cache.header().points);
            for (std::size_t frame = 0; frame < cache.header().frames; ++frame) cache.read(frame, positions);
        });
        if (!message.empty() && !tells(message, "export")) FAIL_CHECK(message);
        ++(message.empty() ? read : refused);
    }
    CHECK(read > 500);
    CHECK(refused > 500);
}

TEST_CASE("point cache: numbers that are none are refused") {
    const std::string nan("\x7f\xc0\0\0", 4), little_nan("\0\0\xc0\x7f", 4);
    CHECK(tells(read_error(with(mdd_bytes, 12, nan)), "the time of frame 1"));
    CHECK(tells(read_error(with(mdd_bytes, 32, nan)), "frame 1, vertex 0"));
    CHECK(tells(read_error(with(pc2_bytes, 20, little_nan)), "first frame"));
    CHECK(tells(read_error(with(pc2_bytes, 24, little_nan)), "first frame"));
    CHECK(tells(read_error(with(pc2_bytes, 40, little_nan)), "frame 0, vertex 0"));
    CHECK(tells(read_error(with(pc2_bytes, 12, {"\2\0\0\0", 4})), "version 2"));
}

TEST_CASE("point cache: a file that shrinks while it is open is told") {
    const Folder folder;
    const auto file = folder.write("clip.mdd", mdd_bytes);
    clip::PointCache cache = clip::read_point_cache(file);
    std::filesystem::resize_file(file, 30);
    std::vector<glm::vec3> positions(1);
    CHECK(tells(message_of<io::Error>([&] { cache.read(1, positions); }), "was the file changed?"));
    CHECK(
        tells(message_of<io::Error>([&] { (void)clip::read_point_cache(folder / "none"); }), "no such file"));
}
