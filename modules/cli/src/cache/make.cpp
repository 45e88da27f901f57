// SPDX-License-Identifier: MIT
#include "arguments.hpp"
#include "cache/baker.hpp"
#include "cache/cache.hpp"
#include "cache/cache_run.hpp"
#include "cache/manifest.hpp"
#include "cache/members.hpp"
#include "progress.hpp"
#include "report.hpp"

#include <goffer/io/atomic_file.hpp>

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <chrono>
#include <system_error>

namespace goffer::cli {
namespace {

namespace fs = std::filesystem;

/// What is there of the shards that are asked for, and what was done.
struct Work {
    std::vector<std::uint64_t> shards;  ///< those asked for
    std::vector<ShardFile> files;       ///< of each of them
    std::vector<std::size_t> missing;   ///< places among them
    std::size_t wrong = 0;              ///< of the missing, those that were there, but damaged or others
    std::uint64_t bytes = 0;            ///< that were written
    double frames = 0;                  ///< that were baked, counted as whole frames
    double seconds = 0;
};

/// Looks at all shards that are asked for, several at a time.
Work look(const CacheRequest& request, const Plan& plan, const Baker& baker) {
    Work work;
    for (std::uint64_t shard = request.share - 1; shard < plan.shards(); shard += request.shares)
        work.shards.push_back(shard);
    work.files.resize(work.shards.size());
    std::vector<std::uint8_t> good(work.shards.size()), there(work.shards.size());
    Progress progress("looking at what is there", work.shards.size());
    tbb::parallel_for(std::size_t{0}, work.shards.size(), [&](std::size_t i) {
        const fs::path file = request.folder / shard_name(work.shards[i]);
        const ShardHeader header = baker.header(work.shards[i]);
        std::error_code error;
        there[i] = fs::exists(file, error);
        good[i] = there[i] && !fault_in_shard(file, header, &work.files[i].checksum);
        work.files[i].bytes = header.bytes;
        progress.advance();
    });
    for (std::size_t i = 0; i < good.size(); ++i) {
        if (good[i]) continue;
        work.missing.push_back(i);
        work.wrong += there[i];
    }
    return work;
}

/// Bakes what is missing.
void bake(const CacheRequest& request, const CacheRun& run, Baker& baker, Work& work) {
    const Plan& plan = run.plan();
    const auto start = std::chrono::steady_clock::now();
    std::uint64_t frames = 0;
    for (const std::size_t i : work.missing) frames += plan.range(work.shards[i]).frames;
    Progress progress("baking " + counted(work.missing.size(), "shard"), frames);
    for (const std::size_t i : work.missing) {
        work.files[i] = baker.bake(work.shards[i], request.folder / shard_name(work.shards[i]), [&] {
            run.check_unchanged();  // before the shard takes its place
            progress.advance();
        });
        const ShardRange range = plan.range(work.shards[i]);
        work.bytes += work.files[i].bytes;
        work.frames += static_cast<double>(range.frames) * static_cast<double>(range.instances) /
                       static_cast<double>(plan.instances);
    }
    work.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Removes what an earlier plan had and this one has not.
void remove_strays(const fs::path& folder, const Plan& plan) {
    std::error_code ignored;
    for (const std::string& stray : strays_in(folder, plan)) fs::remove(folder / stray, ignored);
}

void report_plan(Report& report, const CacheRequest& request, const Plan& plan, const Baker& baker) {
    const std::uint64_t parts = plan.firsts.size(), blocks = plan.shards() / parts;
    std::uint64_t bytes = 0;
    for (std::uint64_t part = 0; part < parts; ++part) {
        const ShardHeader header = baker.header(part);
        bytes += blocks * header.data + plan.frames * header.frame_bytes;
    }
    nlohmann::ordered_json& json = report.json;
    json["scene"] = request.scene.string();
    json["folder"] = request.folder.string();
    json["checksum"] = hex(plan.scene);
    json["format"] = name_of(plan.format);
    json["isa"] = name(plan.isa);
    json["frames"] = plan.frames;
    json["instances"] = plan.instances;
    json["shards"] = plan.shards();
    json["bytes"] = bytes;
    report.line("scene", request.scene.string() + ", " + counted(plan.frames, "frame") + " of " +
                             counted(plan.instances, "instance"));
    report.line("cache", std::string(name_of(plan.format)) + ", " +
                             number(static_cast<double>(bytes) * 1e-6) + " MB in " +
                             counted(plan.shards(), "shard"));
    report.line("kernels", std::string(name(plan.isa)) + ", threads: " + std::to_string(request.threads));
}

void report_work(Report& report, const Work& work, const bend::CrowdResult& result) {
    const std::size_t kept = work.shards.size() - work.missing.size();
    report.json["asked"] = work.shards.size();
    report.json["kept"] = kept;
    report.json["baked"] = work.missing.size();
    report.json["wrong"] = work.wrong;
    report.json["bytes_written"] = work.bytes;
    report.json["seconds"] = work.seconds;
    const std::string replaced =
        work.wrong == 0 ? "" : " (" + std::to_string(work.wrong) + " in the place of others or damaged ones)";
    report.line("shards",
                std::to_string(kept) + " kept, " + std::to_string(work.missing.size()) + " baked" + replaced);
    if (work.seconds > 0 && work.bytes > 0) {
        report.json["frames_per_second"] = work.frames / work.seconds;
        report.json["mb_per_second"] = static_cast<double>(work.bytes) / work.seconds * 1e-6;
        report.line("rate", number(work.frames / work.seconds) + " frames per second, " +
                                number(static_cast<double>(work.bytes) / work.seconds * 1e-6) + " MB/s");
    }
    if (result.clamped > 0)
        report.warn(
            std::to_string(result.clamped) +
            " times an instance was to be bent further than its body can; it is bent as far as it can");
}

}  // namespace

void make_cache(const CacheRequest& request) {
    Report report(request.json);
    io::AtomicFiles outputs;
    tbb::task_arena(request.threads).execute([&] {
        const CacheRun run(request);
        for (const std::string& change : run.changes()) report.warn("the cache is made anew: " + change);
        run.set_up();
        const Plan& plan = run.plan();
        Baker baker(plan, run.cast());
        report_plan(report, request, plan, baker);
        if (request.prepare) return;
        Work work = look(request, plan, baker);
        std::error_code none;
        if (!work.missing.empty()) fs::remove(request.folder / manifest_name, none);
        bake(request, run, baker, work);
        report_work(report, work, baker.result());
        if (!request.whole) return;
        remove_strays(request.folder, plan);
        write_manifest(request.folder, {plan, work.files});
        report.line("manifest", (request.folder / manifest_name).string());
    });
    report.finish(outputs);
}

}  // namespace goffer::cli
