// SPDX-License-Identifier: MIT
#include "cache/plan.hpp"

#include "arguments.hpp"
#include "cache/members.hpp"
#include "report.hpp"

#include <goffer/io/error.hpp>

#include <algorithm>
#include <charconv>
#include <cstdio>

namespace goffer::cli {
namespace {

constexpr std::string_view shard_begin = "shard-", shard_end = ".gofferc";

/// Files that are so large are remembered by their size and time.
constexpr std::uint64_t large = std::uint64_t{64} << 20;

}  // namespace

std::string shard_name(std::uint64_t index) {
    char digits[24];
    std::snprintf(digits, sizeof digits, "%06llu", static_cast<unsigned long long>(index));
    return std::string(shard_begin).append(digits).append(shard_end);
}

std::optional<std::uint64_t> shard_number(const std::string& name) {
    if (!name.starts_with(shard_begin) || !name.ends_with(shard_end)) return std::nullopt;
    const std::string_view digits = std::string_view(name).substr(
        shard_begin.size(), name.size() - shard_begin.size() - shard_end.size());
    std::uint64_t number = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
    if (error != std::errc() || shard_name(number) != name) return std::nullopt;
    return number;
}

ShardRange Plan::range(std::uint64_t index) const noexcept {
    const std::uint64_t part = index % firsts.size(), first = index / firsts.size() * frames_per_shard;
    const std::uint64_t last = part + 1 < firsts.size() ? firsts[part + 1] : instances;
    return {first, std::min(frames_per_shard, frames - first), firsts[part], last - firsts[part]};
}

std::uint64_t Plan::shard_of(std::uint64_t frame, std::uint64_t instance) const noexcept {
    const auto part = static_cast<std::uint64_t>(std::ranges::upper_bound(firsts, instance) - firsts.begin());
    return frame / frames_per_shard * firsts.size() + part - 1;
}

std::uint64_t Plan::bodies_checksum() const {
    std::vector<std::uint64_t> sums;
    for (const PlanBody& body : bodies) sums.insert(sums.end(), {body.checksum, body.level});
    return hash_of(std::as_bytes(std::span(sums)));
}

ShardHeader Plan::header(std::uint64_t index) const {
    const ShardRange of = range(index);
    ShardHeader header;
    header.scene = scene;
    header.bodies = bodies_checksum();
    header.format = static_cast<std::uint32_t>(format);
    header.isa = static_cast<std::uint32_t>(isa);
    header.first_frame = of.first_frame;
    header.frame_count = of.frames;
    header.first_instance = of.first_instance;
    header.instance_count = of.instances;
    header.data = data_offset(of.instances);
    return header;
}

void cut(Plan& plan, const std::function<std::uint64_t(std::uint64_t)>& block) {
    const ShardShape& shape = plan.shape;
    std::uint64_t wide = 0;  // bytes of a frame of as many instances as a shard may have
    for (std::uint64_t i = 0; i < plan.instances && (shape.instances == 0 || i < shape.instances); ++i)
        wide += block(i);
    const std::uint64_t fitting = std::max<std::uint64_t>(shape.bytes / wide, 1);
    plan.frames_per_shard = std::min(shape.frames == 0 ? fitting : shape.frames, plan.frames);
    plan.firsts = {0};
    std::uint64_t bytes = 0;
    for (std::uint64_t i = 0; i < plan.instances; ++i) {
        const std::uint64_t own = block(i) * plan.frames_per_shard, begun = i - plan.firsts.back();
        const bool full = bytes + own > shape.bytes || (shape.instances != 0 && begun >= shape.instances);
        if (full && begun > 0) {
            plan.firsts.push_back(i);
            bytes = 0;
        }
        bytes += own;
    }
    if (plan.shards() > most_shards)
        throw InputError("--shard-size: there would be " + std::to_string(plan.shards()) +
                         " shards, and a cache has " + std::to_string(most_shards) +
                         " at most; make them larger");
}

std::uint64_t checksum_of(const Scene& scene, const std::vector<PlanFile>& before,
                          std::vector<PlanFile>& files) {
    std::string all = "goffer cache 1 " + hex(hash_of_file(scene.file));
    for (const std::filesystem::path& path : scene.files) {
        std::error_code no_time;
        const std::filesystem::path relative = path.lexically_relative(scene.file.parent_path());
        // There is no way from a relative folder to an absolute name.
        PlanFile file{(relative.empty() ? path : relative).generic_string()};
        file.bytes = InputFile(path).size();
        file.modified = static_cast<std::int64_t>(
            std::filesystem::last_write_time(path, no_time).time_since_epoch().count());
        const auto same = std::ranges::find_if(before, [&](const PlanFile& other) {
            return other.file == file.file && other.bytes == file.bytes && other.modified == file.modified;
        });
        file.checksum = same != before.end() && !no_time ? same->checksum : hash_of_file(path);
        all.append(" ").append(hex(file.checksum));
        if (file.bytes >= large) files.push_back(file);
    }
    return hash_of(all);
}

}  // namespace goffer::cli
