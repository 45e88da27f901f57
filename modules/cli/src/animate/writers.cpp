// SPDX-License-Identifier: MIT
#include "animate/writers.hpp"

#include "arguments.hpp"
#include "memory.hpp"

#include <goffer/io/ending.hpp>

#include <algorithm>

namespace goffer::cli {
const std::vector<Writer>& writers() {
    static const std::vector<Writer> all = {
        {{".obj", ".ply", ".stl", ".glb", ".gltf"}, true, "a model for each frame", write_models},
        {{".png"}, true, "a picture of each frame", write_pictures},
        {{".glb", ".gltf"}, false, "animated glTF", write_gltf},
        {{".mdd"}, false, "a point cache", write_mdd},
        {{".pc2"}, false, "a point cache", write_pc2},
        {{".json"}, false, "a vertex-animation texture", write_vertex_texture},
    };
    return all;
}

const Writer& writer_for(const std::filesystem::path& output, bool pattern) {
    const std::string ending = io::ending_of(output);
    const auto knows = [&](const Writer& writer) { return std::ranges::count(writer.endings, ending) != 0; };
    const auto fits = [&](const Writer& writer) { return knows(writer) && writer.sequence == pattern; };
    const auto found = std::ranges::find_if(writers(), fits);
    if (found != writers().end()) return *found;
    const std::string name = output.filename().string();
    if (std::ranges::none_of(writers(), knows)) {
        std::string known;
        for (const Writer& writer : writers()) {
            for (const std::string& other : writer.endings)
                known += (known.empty() ? "" : ", ") + (writer.sequence ? "%04d" + other : other);
        }
        throw UsageError("-o: '" + name + "' has no known ending; there are " + known);
    }
    if (pattern) throw UsageError("-o: " + ending + " holds all frames in one file; leave out the %d");
    throw UsageError("-o: '" + name + "' holds one frame; give a pattern, as in " + output.stem().string() +
                     "_%04d" + ending);
}

int frames_at_a_time(const BoundModel& model, const mesh::Limits& limits, int threads) {
    const std::uint64_t one = memory_for(model.rest.positions.size(), model.rest.triangles.size() / 3);
    const std::uint64_t room =
        limits.memory > one ? (limits.memory - one) / std::max<std::uint64_t>(one, 1) : 0;
    return static_cast<int>(std::clamp<std::uint64_t>(room, 1, static_cast<std::uint64_t>(threads)));
}

}  // namespace goffer::cli
