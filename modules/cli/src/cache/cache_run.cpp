// SPDX-License-Identifier: MIT
#include "cache/cache_run.hpp"

#include "arguments.hpp"
#include "cache/bodies.hpp"

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
        throw InputError(io::about(folder, "is no folder; give another name to -o"));
    for (const fs::path& place : {folder, folder / "bodies"}) {
        if (!fs::exists(place, error)) continue;
        for (const fs::directory_entry& entry : fs::directory_iterator(place, error)) {
            if (!ours(entry))
                throw InputError(io::about(
                    entry.path(), "is no file of a cache; give a new folder to -o, or take it away"));
        }
        if (error) throw InputError(io::about(place, "cannot be read: " + error.message()));
    }
}

/// The plan that a folder has; nothing where it has none that can be read, so that it gets a new one.
std::optional<Plan> plan_in(const fs::path& folder) {
    try {
        return read_plan(folder / plan_name);
    } catch (const std::runtime_error&) {
        return std::nullopt;
    }
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
    before_ = plan_in(folder_);
    plan_.scene = checksum_of(scene_, before_ ? before_->files : std::vector<PlanFile>(), plan_.files);
    choose(request);
    load_bodies(request);
    cast_ = std::make_unique<Cast>(scene_, bodies_, request.load.limits.memory);
    cut(plan_, [&](std::uint64_t instance) {
        const PlanBody& body = plan_.bodies[cast_->body_of(instance)];
        return block_bytes(plan_.format, body.vertices, body.regions);
    });
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

void CacheRun::set_up() const {
    std::error_code error;
    fs::create_directories(folder_ / "bodies", error);
    if (error) throw InputError(io::about(folder_, "cannot be made: " + error.message()));
    for (const NewFile& file : new_files_) io::write_file(folder_ / file.name, file.bytes);
    if (before_ != plan_) {
        fs::remove(folder_ / manifest_name, error);
        io::write_file(folder_ / plan_name, json_of(plan_).dump(2) + "\n");
    }
}

}  // namespace goffer::cli
