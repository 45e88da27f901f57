// SPDX-License-Identifier: MIT
#include "arguments.hpp"
#include "cache/cache.hpp"
#include "cache/manifest.hpp"
#include "cache/members.hpp"
#include "progress.hpp"
#include "report.hpp"

#include <goffer/io/atomic_file.hpp>
#include <goffer/io/error.hpp>
#include <goffer/io/read_file.hpp>

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <limits>

namespace goffer::cli {
namespace {

namespace fs = std::filesystem;

std::string fault_in_body(const fs::path& file, const PlanBody& body) {
    std::error_code error;
    if (!fs::is_regular_file(file, error)) return "is missing";
    if (fs::file_size(file, error) != body.bytes || hash_of_file(file) != body.checksum)
        return "is not the body that the shards were made with";
    return {};
}

std::string fault_in(const fs::path& file, const Manifest& manifest, std::uint64_t index) {
    const ShardFile& listed = manifest.shards[index];
    ShardHeader header = manifest.plan.header(index);
    if (listed.bytes < header.data) return "cannot have so few bytes as the manifest says";
    header.bytes = listed.bytes;
    header.frame_bytes = (listed.bytes - header.data) / header.frame_count;
    std::uint64_t checksum = 0;
    if (auto fault = fault_in_shard(file, header, &checksum)) return *fault;
    return checksum == listed.checksum ? "" : "is whole, but not the one that the manifest lists";
}

/// Faults by the names of files, those of shards first.
std::vector<std::string> faults_in(const fs::path& folder, const Manifest& manifest) {
    const std::size_t shards = manifest.shards.size();
    std::vector<std::string> found(shards), faults;
    Progress progress("verifying " + counted(shards, "shard"), shards);
    tbb::parallel_for(std::size_t{0}, shards, [&](std::size_t i) {
        found[i] = fault_in(folder / shard_name(i), manifest, i);
        progress.advance();
    });
    for (std::size_t i = 0; i < shards; ++i) {
        if (!found[i].empty()) faults.push_back(shard_name(i) + ": " + found[i]);
    }
    for (const PlanBody& body : manifest.plan.bodies) {
        const std::string fault = fault_in_body(folder / body.file(), body);
        if (!fault.empty()) faults.push_back(body.file() + ": " + fault);
    }
    std::vector<std::string> strays;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
        const std::string name = entry.path().filename().string();
        const auto number = shard_number(name);
        if (number && *number >= shards) strays.push_back(name + ": is not in the manifest");
    }
    std::ranges::sort(strays);
    faults.insert(faults.end(), strays.begin(), strays.end());
    return faults;
}

}  // namespace

void write_manifest(const fs::path& folder, const Manifest& manifest) {
    nlohmann::ordered_json json = json_of(manifest.plan);
    json["shards"] = nlohmann::ordered_json::array();
    for (std::size_t i = 0; i < manifest.shards.size(); ++i)
        json["shards"].push_back({{"file", shard_name(i)},
                                  {"bytes", manifest.shards[i].bytes},
                                  {"checksum", hex(manifest.shards[i].checksum)}});
    const std::string text = json.dump(1) + "\n";
    const fs::path file = folder / manifest_name;
    std::error_code error;
    if (fs::file_size(file, error) == text.size() && !error && io::read_file(file) == text) return;
    io::write_file(file, text);
}

Manifest read_manifest(const fs::path& folder) {
    const fs::path file = folder / manifest_name;
    std::error_code error;
    if (!fs::exists(file, error))
        throw InputError(io::about(file, "is missing: the cache is not whole; 'goffer cache SCENE.json -o " +
                                             io::escaped(folder.string()) + "' bakes what it lacks"));
    Manifest manifest{read_plan(file), {}};
    const nlohmann::json document = read_document(file, std::numeric_limits<std::uint32_t>::max());
    const Members fields(document, io::escaped(file.string()));
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

void verify_cache(const fs::path& folder, const fs::path& json, int threads) {
    Report report(json);
    const Manifest manifest = read_manifest(folder);
    std::vector<std::string> faults;
    tbb::task_arena(threads).execute([&] { faults = faults_in(folder, manifest); });
    double bytes = 0;
    for (const ShardFile& shard : manifest.shards) bytes += static_cast<double>(shard.bytes);
    report.json["folder"] = folder.string();
    report.json["checksum"] = hex(manifest.plan.scene);
    report.json["shards"] = manifest.shards.size();
    report.json["bytes"] = bytes;
    report.json["faults"] = faults;
    for (const std::string& fault : faults) report.line("fault", fault);
    if (faults.empty())
        report.line("verified",
                    counted(manifest.shards.size(), "shard") + ", " + number(bytes * 1e-6) + " MB");
    io::AtomicFiles outputs;
    report.finish(outputs);
    if (!faults.empty())
        throw InputError(io::about(folder, "has " + counted(faults.size(), "fault") +
                                               "; 'goffer cache SCENE.json -o " +
                                               io::escaped(folder.string()) + "' bakes what is wrong anew"));
}

}  // namespace goffer::cli
