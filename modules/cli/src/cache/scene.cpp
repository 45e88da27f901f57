// SPDX-License-Identifier: MIT
#include "cache/scene.hpp"

#include "arguments.hpp"
#include "body_file.hpp"
#include "cache/group.hpp"
#include "motion/document.hpp"
#include "motion/motion.hpp"

#include <goffer/io/error.hpp>

#include <algorithm>
#include <set>

namespace goffer::cli {
namespace {

constexpr std::uint64_t most_text = std::uint64_t{16} << 20;  // bytes

/// Names become names of files.
void check_name(const Members& fields, const std::string& name) {
    constexpr std::size_t longest = 64;
    const auto plain = [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
               c == '-';
    };
    if (name.empty() || name.size() > longest || !std::ranges::all_of(name, plain))
        fields.refuse(io::escaped(name.substr(0, longest)),
                      "a name has 1 to " + std::to_string(longest) + " letters, digits, - and _");
}

std::string where_in(const Scene& scene, const std::string& what) {
    return io::about(scene.file, what);
}

/// Returns the buffers that a model names, if it is there; where it is not, binding it says so.
std::vector<std::filesystem::path> buffers_of(const std::filesystem::path& file,
                                              const mesh::LoadOptions& options) {
    std::error_code no_file;
    if (!std::filesystem::is_regular_file(file, no_file)) return {};
    return mesh::named_buffers(file, options);
}

void read_bodies(Scene& scene, const nlohmann::json& list, const io::NamedFiles& files,
                 const mesh::LoadOptions& options) {
    const Members names(list, where_in(scene, "bodies"));
    for (const auto& [name, value] : list.items()) {
        check_name(names, name);
        const Members fields(value, names.where(name));
        SceneBody body{name, named_file(fields, "file", files)};
        if (fields.has("level")) body.level = fields.whole("level", 0, bend::max_levels - 1);
        body.options = value;
        body.options.erase("file");
        body.options.erase("level");
        scene.files.push_back(body.file);
        for (std::filesystem::path& buffer : buffers_of(body.file, options))
            scene.files.push_back(std::move(buffer));
        scene.bodies.push_back(std::move(body));
    }
    if (scene.bodies.empty())
        throw InputError(where_in(scene, "bodies") + ": there is none; give one or more");
}

void read_motions(Scene& scene, const nlohmann::json& list, const io::NamedFiles& files) {
    const Members names(list, where_in(scene, "motions"));
    for (const auto& [name, value] : list.items()) {
        check_name(names, name);
        SceneMotion motion{name, value, names.where(name)};
        if (value.is_string()) {
            const std::filesystem::path file = named_file(names, name.c_str(), files);
            scene.files.push_back(file);
            motion.document = read_keys_file(file);
            motion.where = io::escaped(file.string());
        }
        scene.motions.push_back(std::move(motion));
    }
}

void read_groups(Scene& scene, const nlohmann::json& list, const io::NamedFiles& files) {
    if (!list.is_array() || list.empty())
        throw InputError(where_in(scene, "instances") +
                         ": is not a list of one or more; give groups of instances");
    for (std::size_t i = 0; i < list.size(); ++i) {
        const Members fields(list[i], where_in(scene, "instances[" + std::to_string(i) + "]"));
        SceneGroup group = read_group(fields, scene, files);
        group.first = scene.instances;
        scene.instances += group.count;
        if (scene.instances > most_instances)
            throw InputError(where_in(scene, "has more than " + std::to_string(most_instances) +
                                                 " instances; cut it into several"));
        for (const std::filesystem::path& file : {group.poses, group.transforms}) {
            if (!file.empty()) scene.files.push_back(file);
        }
        scene.groups.push_back(std::move(group));
    }
}

/// Keeps the order in which the scene names them, whichever way that leads to their folder.
void keep_once(std::vector<std::filesystem::path>& files) {
    std::set<std::filesystem::path> known;
    std::erase_if(files, [&](const std::filesystem::path& file) {
        std::error_code error;
        const std::filesystem::path place = std::filesystem::weakly_canonical(file, error);
        return !known.insert(error ? file : place).second;
    });
}

}  // namespace

Scene read_scene(const std::filesystem::path& file, const mesh::LoadOptions& options) {
    Scene scene;
    scene.file = file;
    const nlohmann::json document = read_document(file, most_text);
    const Members fields(document, io::escaped(file.string()));
    fields.allow({"version", "fps", "frames", "bodies", "motions", "instances"});
    (void)fields.whole("version", 1, 1);
    constexpr double slowest = 1e-3, fastest = 1e6;
    scene.fps = fields.number("fps", slowest, fastest);
    scene.frames = fields.whole("frames", 1, most_frames);
    const io::NamedFiles files(file, options.allow_outside);
    read_bodies(scene, fields.at("bodies"), files, options);
    if (fields.has("motions")) read_motions(scene, fields.at("motions"), files);
    read_groups(scene, fields.at("instances"), files);
    keep_once(scene.files);
    return scene;
}

const SceneGroup& group_of(const Scene& scene, std::uint64_t index) {
    const auto next = std::ranges::upper_bound(scene.groups, index, {}, &SceneGroup::first);
    return *std::prev(next);
}

}  // namespace goffer::cli
