// SPDX-License-Identifier: MIT

// How do I use a body file where it is mapped, without a copy? mapped_file FILE.goffer

#include <goffer/bend/body_file.hpp>
#include <goffer/bend/job.hpp>

#include <algorithm>
#include <cstdio>
#include <optional>
#include <span>
#include <vector>

#if __has_include(<sys/mman.h>)
#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>
#endif

using namespace goffer;

// The bytes of a file, which begin a page, as load() wants; none where there is no mmap or no such file.
static std::span<const std::byte> map([[maybe_unused]] const char* name) {
#if __has_include(<sys/mman.h>)
    const int file = open(name, O_RDONLY | O_CLOEXEC);
    struct stat status {};
    if (file < 0) return {};
    const bool known = fstat(file, &status) == 0;
    const auto size = static_cast<std::size_t>(status.st_size);
    void* const at = known ? mmap(nullptr, size, PROT_READ, MAP_PRIVATE, file, 0) : MAP_FAILED;
    close(file);  // the mapping stays, until munmap or the end of the program
    if (at != MAP_FAILED) return {static_cast<const std::byte*>(at), size};
#endif
    return {};
}

int main(int argc, char** argv) {
    if (argc != 2) return std::puts("usage: mapped_file FILE.goffer"), 2;
    const std::span<const std::byte> bytes = map(argv[1]);
    bend::BodyFileFault fault;
    // A file that was verified when it was installed needs Verify::layout alone, which looks at no vertex.
    // Nobody may write to a file that is mapped: replace it by another of its name, as goffer bake does.
    const auto file = bytes.empty() ? bend::load_file(argv[1], &fault) : bend::load(bytes, &fault);
    if (!file) return std::printf("%s: %s\n", argv[1], bend::describe(fault).c_str()), 1;
    const auto& [body, mesh, rest] = file->levels[0];
    const std::vector<bend::Pose> poses(body.region_count(), {.angle = 0.5f});
    std::vector<glm::vec3> vertices(body.vertex_count());
    bend::DeformJob job{.body = &body, .poses = poses};
    job.positions = interleaved<3>(&vertices[0].x, vertices.size());
    bend::run(job);
    float top = rest.low.z;
    for (const glm::vec3& vertex : vertices) top = std::max(top, vertex.z);
    if (!bytes.empty())
        std::printf("%zu bytes mapped, triangles at byte %td of them\n", bytes.size(),
                    std::as_bytes(mesh.triangles).data() - bytes.data());
    std::printf("bent from %.2f to %.2f high\n", static_cast<double>(rest.high.z), static_cast<double>(top));
}
