// SPDX-License-Identifier: MIT
#include "cache/manifest.hpp"

#include "arguments.hpp"
#include "cache/members.hpp"
#include "report.hpp"

#include <goffer/io/atomic_file.hpp>
#include <goffer/io/error.hpp>
#include <goffer/io/read_file.hpp>

#include <algorithm>
#include <limits>

namespace goffer::cli {

namespace fs = std::filesystem;

namespace {

/// Returns the checksum of what a manifest says, whatever the order of its members.
std::uint64_t checksum_of(const nlohmann::json& said) {
    return hash_of(said.dump());
}

}  // namespace

void write_manifest(const fs::path& folder, const Manifest& manifest) {
    nlohmann::ordered_json json = json_of(manifest.plan);
    json["shards"] = nlohmann::ordered_json::array();
    for (std::size_t i = 0; i < manifest.shards.size(); ++i)
        json["shards"].push_back({{"file", shard_name(i)},
                                  {"bytes", manifest.shards[i].bytes},
                                  {"checksum", hex(manifest.shards[i].checksum)}});
    json["checksum"] = hex(checksum_of(json));
    const std::string text = json.dump(1) + "\n";
    const fs::path file = folder / manifest_name;
    std::error_code error;
    if (fs::file_size(file, error) == text.size() && !error && io::read_file(file) == text) return;
    io::write_file(file, text);
}

Manifest read_manifest(const fs::path& folder) {
    const fs::path file = folder / manifest_name;
    std::error_code error;
    check_cache(folder);
    if (!fs::exists(file, error))
        throw InputError(io::about(file, "is missing: the cache is not whole; 'goffer cache SCENE.json -o " +
                                             io::escaped(folder.string()) + "' bakes what it lacks"));
    const nlohmann::json document = read_document(file, most_plan_bytes);
    const Members fields(document, io::escaped(file.string()));
    Manifest manifest{plan_of(fields), {}};
    nlohmann::json said = document;
    said.erase("checksum");
    if (fields.hash("checksum") != checksum_of(said))
        throw InputError(io::about(file,
                                   "is damaged: its checksum is not that of what it says; remove it, and "
                                   "bake the cache again"));
    const nlohmann::json& shards = fields.at("shards");
    if (!shards.is_array() || shards.size() != manifest.plan.shards())
        fields.refuse("shards", "is not a list of " + std::to_string(manifest.plan.shards()));
    manifest.shards.reserve(shards.size());
    for (const nlohmann::json& shard : shards) {
        const Members one(shard, fields.where("shards[" + std::to_string(manifest.shards.size()) + "]"));
        if (one.text("file") != shard_name(manifest.shards.size()))
            one.refuse("file", "is not " + shard_name(manifest.shards.size()));
        manifest.shards.push_back(
            {one.whole("bytes", 1, std::numeric_limits<std::int64_t>::max()), one.hash("checksum")});
    }
    return manifest;
}

std::vector<std::string> strays_in(const fs::path& folder, const Plan& plan) {
    std::vector<std::string> strays;
    std::error_code error;
    for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
        const std::string name = entry->path().filename().string();
        const auto number = shard_number(name);
        if (number && *number >= plan.shards()) strays.push_back(name);
    }
    for (fs::directory_iterator entry(folder / "bodies", error), end; !error && entry != end;
         entry.increment(error)) {
        const std::string name = "bodies/" + entry->path().filename().string();
        if (name.ends_with(".goffer") &&
            std::ranges::find(plan.bodies, name, &PlanBody::file) == plan.bodies.end())
            strays.push_back(name);
    }
    std::ranges::sort(strays);
    return strays;
}

}  // namespace goffer::cli
