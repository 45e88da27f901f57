// SPDX-License-Identifier: MIT
#include "arguments.hpp"
#include "cache/members.hpp"
#include "cache/plan.hpp"
#include "motion/motion.hpp"
#include "report.hpp"

#include <goffer/bend/region.hpp>
#include <goffer/io/error.hpp>

#include <algorithm>
#include <limits>

namespace goffer::cli {
namespace {

constexpr const char* kind = "goffer cache";
constexpr std::uint64_t any = std::numeric_limits<std::int64_t>::max();

PlanBody read_plan_body(const Members& fields) {
    PlanBody body;
    body.name = fields.text("name");
    // It becomes the name of a file.
    if (body.name.find_first_of("/\\.") != std::string::npos)
        fields.refuse("name", "is not a name of a body");
    body.level = fields.whole("level", 0, any);
    body.vertices = fields.whole("vertices", 1, std::numeric_limits<std::uint32_t>::max());
    body.regions = fields.whole("regions", 1, bend::max_regions);
    body.bytes = fields.whole("bytes", 1, any);
    body.checksum = fields.hash("checksum");
    return body;
}

PlanFile read_file_of(const Members& fields) {
    PlanFile file{fields.text("file"), fields.whole("bytes", 0, any), fields.hash("checksum")};
    const nlohmann::json& modified = fields.at("modified");
    if (!modified.is_number_integer()) fields.refuse("modified", "is not a whole number");
    file.modified = modified.get<std::int64_t>();
    return file;
}

template <class T, class Read>
std::vector<T> read_list(const Members& fields, const char* name, Read read) {
    const nlohmann::json& list = fields.at(name);
    if (!list.is_array()) fields.refuse(name, "is not a list");
    std::vector<T> all;
    all.reserve(list.size());
    for (const nlohmann::json& value : list) all.push_back(read(Members(value, fields.where(name))));
    return all;
}

void read_firsts(const Members& fields, Plan& plan) {
    const nlohmann::json& firsts = fields.at("first_instances");
    if (!firsts.is_array() || firsts.empty() || firsts[0] != 0)
        fields.refuse("first_instances", "is not a list that begins with 0");
    plan.firsts.reserve(firsts.size());
    for (const nlohmann::json& first : firsts) {
        const bool later = first.is_number_unsigned() && first.get<std::uint64_t>() < plan.instances &&
                           (plan.firsts.empty() || first.get<std::uint64_t>() > plan.firsts.back());
        if (!later) fields.refuse("first_instances", "is not a list of instances in their order");
        plan.firsts.push_back(first.get<std::uint64_t>());
    }
}

}  // namespace

nlohmann::ordered_json json_of(const Plan& plan) {
    nlohmann::ordered_json json;
    json["kind"] = kind;
    json["version"] = 1;
    json["scene"] = hex(plan.scene);
    json["format"] = name_of(plan.format);
    json["isa"] = name(plan.isa);
    json["fps"] = plan.fps;
    json["frames"] = plan.frames;
    json["instances"] = plan.instances;
    json["bodies"] = nlohmann::ordered_json::array();
    for (const PlanBody& body : plan.bodies)
        json["bodies"].push_back({{"name", body.name},
                                  {"file", body.file()},
                                  {"level", body.level},
                                  {"vertices", body.vertices},
                                  {"regions", body.regions},
                                  {"bytes", body.bytes},
                                  {"checksum", hex(body.checksum)}});
    json["shard_size"] = plan.shape.bytes;
    json["shard_frames"] = plan.shape.frames;
    json["shard_instances"] = plan.shape.instances;
    json["frames_per_shard"] = plan.frames_per_shard;
    json["first_instances"] = plan.firsts;
    json["files"] = nlohmann::ordered_json::array();
    for (const PlanFile& file : plan.files)
        json["files"].push_back({{"file", file.file},
                                 {"bytes", file.bytes},
                                 {"checksum", hex(file.checksum)},
                                 {"modified", file.modified}});
    return json;
}

Plan plan_of(const Members& fields) {
    if (fields.text("kind") != kind) fields.refuse("kind", std::string("is not '") + kind + "'");
    (void)fields.whole("version", 1, 1);
    Plan plan;
    plan.scene = fields.hash("scene");
    const auto format = parse_format(fields.text("format"));
    if (!format) fields.refuse("format", "is none of positions, packed, poses");
    plan.format = *format;
    const auto isa = parse_isa(fields.text("isa"));
    if (!isa || *isa == Isa::automatic) fields.refuse("isa", "is not an instruction set");
    plan.isa = *isa;
    plan.fps = fields.number("fps", 0, std::numeric_limits<double>::max());
    plan.frames = fields.whole("frames", 1, most_frames);
    plan.instances = fields.whole("instances", 1, most_instances);
    plan.bodies = read_list<PlanBody>(fields, "bodies", read_plan_body);
    plan.shape = {fields.whole("shard_size", 1, most_shard_bytes), fields.whole("shard_frames", 0, any),
                  fields.whole("shard_instances", 0, any)};
    plan.frames_per_shard = fields.whole("frames_per_shard", 1, plan.frames);
    read_firsts(fields, plan);
    plan.files = read_list<PlanFile>(fields, "files", read_file_of);
    if (plan.bodies.empty()) fields.refuse("bodies", "is an empty list");
    if (plan.shards() > most_shards) fields.refuse("first_instances", "makes too many shards");
    return plan;
}

void check_cache(const std::filesystem::path& folder) {
    std::error_code error;
    const std::filesystem::file_status status = std::filesystem::status(folder, error);
    if (!std::filesystem::exists(status))
        throw InputError(io::about(folder, "there is no such folder; check the name"));
    if (!std::filesystem::is_directory(status))
        throw InputError(io::about(folder, "is not a folder; give the folder of a cache"));
}

Plan read_plan(const std::filesystem::path& file) {
    const nlohmann::json document = read_document(file, most_plan_bytes);
    return plan_of(Members(document, io::escaped(file.string())));
}

}  // namespace goffer::cli
