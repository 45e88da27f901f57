// SPDX-License-Identifier: MIT
#include "cache/cache_run.hpp"

#include "arguments.hpp"
#include "cache/bodies.hpp"
#include "cache/manifest.hpp"

#include <goffer/bend/body_file.hpp>
#include <goffer/io/atomic_file.hpp>
#include <goffer/io/error.hpp>
#include <goffer/io/read_file.hpp>

#include <algorithm>
#include <system_error>

namespace goffer::cli {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t usual_size = std::uint64_t{256} << 20;

/// Whether a cache has such a file. Links lead elsewhere, where nothing is to be written.
bool ours(const fs::directory_entry& entry) {
    const std::string name = entry.path().filename().string();
    const bool known = name == plan_name || name == manifest_name || name == "bodies" ||
                       name.starts_with(".goffer-") || name.ends_with(".goffer") || shard_number(name);
    return known && !entry.is_symlink();
}

/// Refuses a folder that has files which are no cache's.
void check_folder(const fs::path& folder) {
    std::error_code error;
    const fs::file_status status = fs::status(folder, error);
    if (!fs::exists(status)) return;
    if (!fs::is_directory(status))
        throw InputError(io::about(folder, "is not a folder; give another name to -o"));
    for (const fs::path& place : {folder, folder / "bodies"}) {
        if (!fs::exists(place, error)) continue;
        for (fs::directory_iterator entry(place, error), end; !error && entry != end;
             entry.increment(error)) {
            if (!ours(*entry))
                throw InputError(io::about(
                    entry->path(), "is not a file of a cache; give a new folder to -o, or move it away"));
        }
        if (error) throw InputError(io::about(place, "cannot be read: " + error.message()));
    }
}

/// The plan that a folder has, if it has one. One that cannot be read holds what was chosen for the cache, so
/// that it is not replaced by another behind the user's back.
std::optional<Plan> plan_in(const fs::path& folder) {
    std::error_code error;
    const auto is_there = [&](const char* name) {
        return fs::status(folder / name, error).type() != fs::file_type::not_found;
    };
    try {
        if (is_there(plan_name)) return read_plan(folder / plan_name);
        if (is_there(manifest_name)) return read_manifest(folder).plan;
        return std::nullopt;
    } catch (const std::runtime_error& fault) {
        throw InputError(std::string(fault.what()) +
                         "; to plan the cache anew, remove that file, and give --format and the like again");
    }
}

std::string text_of(std::string_view word) {
    return std::string(word);
}
std::string text_of(std::uint64_t number) {
    return std::to_string(number);
}

/// Refuses to guess what shards were to be like.
void refuse_planless(const fs::path& folder) {
    std::error_code error;
    for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
        if (shard_number(entry->path().filename().string()))
            throw InputError(io::about(folder,
                                       "has shards, and neither a plan nor a manifest; say --format, or "
                                       "give a new folder to -o"));
    }
}

/// Refuses a cache in whose folder lies what it is made from.
void check_sources(const CacheRequest& request, const Scene& scene) {
    for (const fs::path& file : scene.files) {
        if (lies_in(file, request.folder))
            throw InputError(
                io::about(file, "lies in the folder of the cache; put it, or the cache, elsewhere"));
    }
}

/// Refuses a report that would replace what the cache is made from.
void check_report(const CacheRequest& request, const Scene& scene) {
    std::vector<NamedFile> inputs = {{"SCENE", request.scene}};
    for (const fs::path& file : scene.files) inputs.push_back({"the scene", file});
    check_places(inputs, {{"--json", request.json}}, request.load.limits);
}

bend::BodyFile loaded(const fs::path& file, const std::string& bytes) {
    bend::BodyFileFault fault;
    std::optional<bend::BodyFile> body = bend::load_copy(std::as_bytes(std::span(bytes)), &fault);
    if (!body) throw InputError(io::about(file, bend::describe(fault).c_str()));
    return std::move(*body);
}

/// The bytes of a body's file in the cache, where they are still those of `before`.
std::optional<std::string> kept_bytes(const fs::path& folder, const PlanBody& before) {
    std::error_code error;
    const fs::path file = folder / before.file();
    if (fs::file_size(file, error) != before.bytes || error) return std::nullopt;
    std::string bytes = io::read_file(file);
    return hash_of(bytes) == before.checksum ? std::optional(std::move(bytes)) : std::nullopt;
}

}  // namespace

CacheRun::CacheRun(const CacheRequest& request) : folder_(request.folder) {
    check_folder(folder_);
    scene_ = read_scene(request.scene, request.load);
    check_sources(request, scene_);
    check_report(request, scene_);
    before_ = plan_in(folder_);
    if (!before_ && !request.format) refuse_planless(folder_);
    for (const fs::path& file : scene_.files) stamps_.push_back(stamp_of(file));
    stamps_.push_back(stamp_of(scene_.file));
    plan_.scene = checksum_of(scene_, before_ ? before_->files : std::vector<PlanFile>(), plan_.files);
    choose(request);
    load_bodies(request);
    cast_ = std::make_unique<Cast>(scene_, bodies_, request.load.limits.memory);
    cut(plan_, [&](std::uint64_t instance) {
        const PlanBody& body = plan_.bodies[cast_->body_of(instance)];
        return block_bytes(plan_.format, body.vertices, body.regions);
    });
    // One of many shares, which may each have read another scene.
    if (const std::vector<std::string> changed = changes(); !request.whole && !changed.empty())
        throw InputError(io::about(folder_, "holds another cache: " + changed.front() +
                                                "; bake a share after --prepare, or into another folder"));
}

CacheRun::Stamp CacheRun::stamp_of(const fs::path& file) {
    std::error_code none;
    return {file, fs::file_size(file, none), fs::last_write_time(file, none)};
}

void CacheRun::check_unchanged() const {
    for (const Stamp& before : stamps_) {
        const Stamp after = stamp_of(before.file);
        if (after.bytes != before.bytes || after.modified != before.modified)
            throw InputError(io::about(before.file, "has changed while the cache was baked; bake it again"));
    }
}

void CacheRun::choose(const CacheRequest& request) {
    plan_.fps = scene_.fps;
    plan_.frames = scene_.frames;
    plan_.instances = scene_.instances;
    plan_.format = request.format.value_or(before_ ? before_->format : CacheFormat::positions);
    plan_.isa = resolve(request.isa.value_or(before_ ? before_->isa : Isa::automatic));
    const ShardShape usual = before_ ? before_->shape : ShardShape{usual_size, 0, 0};
    plan_.shape = {request.shard_size.value_or(usual.bytes), request.shard_frames.value_or(usual.frames),
                   request.shard_instances.value_or(usual.instances)};
    if (!runs_here(plan_.isa))
        throw InputError(io::about(folder_ / plan_name, "was made for " + std::string(name(plan_.isa)) +
                                                            ", which this machine lacks; make the cache "
                                                            "anew with --isa scalar"));
}

void CacheRun::load_bodies(const CacheRequest& request) {
    for (std::size_t i = 0; i < scene_.bodies.size(); ++i) {
        const SceneBody& own = scene_.bodies[i];
        PlanBody body{own.name, own.level};
        const bool same = before_ && before_->scene == plan_.scene && i < before_->bodies.size() &&
                          before_->bodies[i].name == own.name;
        std::optional<std::string> bytes = same ? kept_bytes(folder_, before_->bodies[i]) : std::nullopt;
        if (!bytes) {
            bytes = body_bytes(scene_, own, request.load);
            new_files_.push_back({body.file(), *bytes});
        }
        bend::BodyFile file = loaded(own.file, *bytes);
        if (own.level >= file.levels.size())
            throw InputError(io::about(
                own.file, "has no level " + std::to_string(own.level) + " of detail; they count from 0"));
        bodies_.push_back(std::move(file.levels[own.level].body));
        body.vertices = bodies_.back().vertex_count();
        body.regions = bodies_.back().region_count();
        body.bytes = bytes->size();
        body.checksum = hash_of(*bytes);
        plan_.bodies.push_back(body);
    }
}

std::vector<std::string> CacheRun::changes() const {
    std::vector<std::string> changed;
    if (!before_) return changed;
    const auto compare = [&](const std::string& what, const auto& before, const auto& now) {
        if (before != now) changed.push_back(what + " was " + text_of(before) + ", and is " + text_of(now));
    };
    compare("its format", name_of(before_->format), name_of(plan_.format));
    compare("its instruction set", name(before_->isa), name(plan_.isa));
    compare("--shard-size", before_->shape.bytes, plan_.shape.bytes);
    compare("--shard-frames", before_->shape.frames, plan_.shape.frames);
    compare("--shard-instances", before_->shape.instances, plan_.shape.instances);
    if (before_->scene != plan_.scene || before_->bodies_checksum() != plan_.bodies_checksum())
        changed.emplace_back("its scene, or a file that the scene names, is another");
    return changed;
}

void CacheRun::set_up() const {
    std::error_code error;
    fs::create_directories(folder_ / "bodies", error);
    if (error) throw InputError(io::about(folder_, "cannot be made: " + error.message()));
    for (const NewFile& file : new_files_) io::write_file(folder_ / file.name, file.bytes);
    if (before_ != plan_) fs::remove(folder_ / manifest_name, error);
    if (before_ != plan_ || !fs::exists(folder_ / plan_name, error)) {
        io::write_file(folder_ / plan_name, json_of(plan_).dump(2) + "\n");
    }
}

}  // namespace goffer::cli
