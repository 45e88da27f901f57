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

std::string fault_in_plan(const fs::path& file, const Plan& wanted) {
    std::error_code error;
    if (!fs::is_regular_file(file, error)) return "is missing";
    try {
        return read_plan(file) == wanted ? "" : "is not the plan that the manifest has";
    } catch (const std::runtime_error& fault) {
        return fault.what();
    }
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
    const std::string plan = fault_in_plan(folder / plan_name, manifest.plan);
    if (!plan.empty()) faults.push_back(std::string(plan_name) + ": " + plan);
    for (const std::string& stray : strays_in(folder, manifest.plan))
        faults.push_back(stray + ": is not in the manifest");
    return faults;
}

}  // namespace

void verify_cache(const fs::path& folder, const fs::path& json, int threads) {
    Report report(json);
    const Manifest manifest = read_manifest(folder);
    std::vector<std::string> faults;
    tbb::task_arena(threads).execute([&] { faults = faults_in(folder, manifest); });
    std::uint64_t bytes = 0;
    for (const ShardFile& shard : manifest.shards) bytes += shard.bytes;
    report.json["folder"] = folder.string();
    report.json["checksum"] = hex(manifest.plan.scene);
    report.json["shards"] = manifest.shards.size();
    report.json["bytes"] = bytes;
    report.json["faults"] = faults;
    for (const std::string& fault : faults) report.line("fault", fault);
    if (faults.empty())
        report.line("verified", counted(manifest.shards.size(), "shard") + ", " +
                                    number(static_cast<double>(bytes) * 1e-6) + " MB");
    io::AtomicFiles outputs;
    report.finish(outputs);
    if (!faults.empty())
        throw InputError(io::about(folder, "has " + counted(faults.size(), "fault") +
                                               "; 'goffer cache SCENE.json -o " +
                                               io::escaped(folder.string()) + "' bakes what is wrong anew"));
}

}  // namespace goffer::cli
