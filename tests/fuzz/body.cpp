// SPDX-License-Identifier: MIT
#include "require.hpp"
#include "support/body_bytes.hpp"

#include <goffer/bend/body_file.hpp>
#include <goffer/bend/bounds.hpp>
#include <goffer/bend/capsules.hpp>
#include <goffer/bend/sockets.hpp>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <vector>

/// A body file, signed anew, so that what is in it counts. What loads is deformed, and gives numbers that are
/// finite; what is loaded without a look at its numbers is deformed too, and stays within its memory.

using namespace goffer;
using namespace goffer::test;

namespace {

/// All streams of a body at poses that follow from `seed`.
void run_all(const bend::Body& body, std::uint8_t seed, bool finite) {
    const std::size_t count = body.vertex_count();
    if (count > 100'000) return;
    std::vector<bend::Pose> poses;
    for (std::size_t r = 0; r < body.region_count(); ++r) {
        const float most = body.max_angle(r), turn = static_cast<float>(seed % 7 + r);
        poses.push_back({most * (turn / 6 - 0.5f) * 2, turn});
    }
    std::vector<float> out(10 * count + 1);
    bend::DeformJob job{.body = &body, .poses = poses};
    job.positions = interleaved<3>(out.data(), count);
    job.normals = interleaved<3>(&out[3 * count], count);
    if (body.has_tangents()) job.tangents = interleaved<4>(&out[6 * count], count);
    require(bend::validate(job).none(), "a loaded body makes a good job");
    bend::run(job);
    (void)bend::bounds(job);
    std::vector<bend::Capsule> capsules(2 * body.region_count());
    bend::capsules(job, capsules.size() / body.region_count(), capsules);
    require(!finite || std::ranges::all_of(out, [](float x) { return std::isfinite(x); }),
            "what is written is finite");
}

void load_and_run(std::span<const std::byte> bytes, std::uint8_t seed, bend::Verify verify) {
    bend::BodyFileFault fault;
    const std::optional<bend::BodyFile> file = bend::load(bytes, &fault, verify);
    require(file.has_value() == fault.none(), "there is a file or a fault");
    require_one_line(bend::describe(fault).c_str());
    if (!file) return;
    const bool everything = verify == bend::Verify::everything;
    std::vector<bend::LevelInput> levels;
    for (const auto& [body, mesh, box] : file->levels) {
        run_all(body, seed, everything);
        levels.push_back({&body, mesh});
        for (const std::uint32_t vertex : mesh.triangles)
            require(!everything || vertex < body.vertex_count(), "triangles are of vertices that are there");
    }
    require(file->sockets.empty() || bend::Sockets::make(file->levels[0].body, file->sockets).has_value(),
            "sockets are sound");
    if (!everything) return;
    const bend::BodyFileInput input{levels, file->materials, file->sockets, file->notes};
    const std::vector<std::byte> again = bend::save(input, &fault);
    require(!again.empty(), "what was loaded can be saved");
    const std::optional<bend::BodyFile> copy = bend::load_copy(again);
    require(copy.has_value() && copy->levels.size() == levels.size(), "what was saved can be loaded");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::uint8_t seed = size > 0 ? data[size - 1] : 0;
    const std::size_t whole = size / column_alignment * column_alignment;
    const AlignedBytes file(std::as_bytes(std::span(data, whole)));
    sign(file.bytes());
    load_and_run(file.bytes(), seed, bend::Verify::everything);
    load_and_run(file.bytes(), seed, bend::Verify::layout);
    return 0;
}
