// SPDX-License-Identifier: MIT

// Prints a sum of the bits that kernels of one instruction set write: bits FILE.goffer ISA. Built against the
// library, and against the two files that engine/packaging/amalgamate makes.

#if __has_include("goffer.hpp")
#include "goffer.hpp"
#else
#include <goffer/bend/body_file.hpp>
#include <goffer/bend/crowd.hpp>
#endif

#include <cstdio>
#include <cstring>
#include <vector>

int main(int argc, char** argv) {
    using namespace goffer;
    if (argc != 3) return 2;
    const auto isa = parse_isa(argv[2]);
    if (!isa || !runs_here(*isa)) return std::printf("%s does not run here\n", argv[2]), 1;
    bend::BodyFileFault fault;
    const auto file = bend::load_file(argv[1], &fault);
    if (!file) return std::puts(bend::describe(fault).c_str()), 1;
    std::uint64_t sum = 0;
    for (const bend::BodyFileLevel& level : file->levels) {
        const std::size_t count = level.body.vertex_count();
        std::vector<float> outputs(6 * count);
        for (int i = -9; i <= 9; ++i) {
            const float turn = 0.1f * static_cast<float>(i);
            const std::vector<bend::Pose> poses(level.body.region_count(), {turn, 3 * turn});
            bend::DeformJob job{.body = &level.body, .poses = poses, .wrinkle_weight = 0.9f, .isa = *isa};
            job.positions = interleaved<3>(outputs.data(), count);
            job.normals = interleaved<3>(outputs.data() + 3 * count, count);
            bend::run(job);
            for (const float& output : outputs) {
                std::uint32_t bits;
                std::memcpy(&bits, &output, sizeof bits);
                sum = (sum ^ bits) * 0x9e3779b97f4a7c15 + (sum >> 29);
            }
        }
    }
    std::printf("%016llx\n", static_cast<unsigned long long>(sum));
}
