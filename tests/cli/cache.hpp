// SPDX-License-Identifier: MIT
#pragma once

#include "command.hpp"

#include <cstdint>
#include <map>
#include <string>

/// Scenes and caches for tests.

namespace goffer::test {

/// A scene of two bodies, of which one has two regions, 14 instances in three groups, and 9 frames, with all
/// files that it names, in `folder`.
inline nlohmann::json scene_in(const Folder& folder) {
    base(folder, "worm.ply", {"--columns", "8", "--rows", "17"});
    folder.write("keys.csv", "time,angle\n0,0\n1,50\n");
    return {{"version", 1},
            {"fps", 24},
            {"frames", 9},
            {"bodies",
             {{"worm", {{"file", "worm.ply"}, {"refine", "off"}}},
              {"snake", {{"file", "worm.ply"}, {"refine", "off"}, {"regions", {0.5, 0.5}}}}}},
            {"motions",
             {{"sway", {{"swing", 70}, {"seconds", 2}}},
              {"keys", "keys.csv"},
              {"wave", {{"swing", {60, -60}}, {"seconds", 2}, {"lag", 0.2}}}}},
            {"instances",
             {{{"body", "worm"},
               {"motion", {"sway", "keys"}},
               {"grid", {4, 3}},
               {"spacing", {3, 3}},
               {"scatter", 1}},
              {{"body", "snake"}, {"motion", "wave"}, {"translation", {0, -5, 0}}, {"weight", 0.5}},
              {{"body", "worm"}, {"rotation", {0, 0, 0.6, 0.8}}, {"scale", 2}}}}};
}

inline void write(const Folder& folder, const nlohmann::json& scene) {
    folder.write("scene.json", scene.dump());
}

/// Nine shards, of 4 frames and 5 instances at most.
inline const Words small_shards{"--shard-frames", "4", "--shard-instances", "5"};

inline Words cache_words(const std::string& folder, const Words& more = {}) {
    return Words{"cache", "scene.json", "-o", folder} + more;
}

/// All files below a folder, but for their times.
inline std::map<std::string, std::string> files_in(const std::filesystem::path& folder) {
    std::map<std::string, std::string> files;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
        if (entry.is_regular_file())
            files[entry.path().lexically_relative(folder).string()] = bytes_of(entry.path());
    }
    return files;
}

}  // namespace goffer::test
