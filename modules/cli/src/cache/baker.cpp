// SPDX-License-Identifier: MIT
#include "cache/baker.hpp"

#include "arguments.hpp"

#include <algorithm>
#include <cstring>
#include <future>

namespace goffer::cli {
namespace {

/// What is behind an instance's vertices, up to the next block, is zeros.
void clear_end(std::span<std::byte> block, std::uint64_t used) {
    std::ranges::fill(block.subspan(static_cast<std::size_t>(used)), std::byte{0});
}

}  // namespace

std::vector<ShardInstance> Baker::instances_of(const ShardRange& range) const {
    std::vector<ShardInstance> instances(static_cast<std::size_t>(range.instances));
    std::uint64_t offset = 0;
    for (std::size_t i = 0; i < instances.size(); ++i) {
        const std::size_t body = cast_.body_of(range.first_instance + i);
        const PlanBody& of = plan_.bodies[body];
        instances[i] = {static_cast<std::uint32_t>(body), static_cast<std::uint32_t>(of.vertices), offset};
        offset += block_bytes(plan_.format, of.vertices, of.regions);
    }
    return instances;
}

ShardHeader Baker::header(std::uint64_t index) const {
    const ShardRange range = plan_.range(index);
    ShardHeader header = plan_.header(index);
    for (std::uint64_t i = 0; i < range.instances; ++i) {
        const PlanBody& body = plan_.bodies[cast_.body_of(range.first_instance + i)];
        header.frame_bytes += block_bytes(plan_.format, body.vertices, body.regions);
    }
    header.bytes = header.data + range.frames * header.frame_bytes;
    return header;
}

ShardFile Baker::bake(std::uint64_t index, const std::filesystem::path& file,
                      const std::function<void(std::uint64_t)>& written) {
    const ShardRange range = plan_.range(index);
    const ShardHeader whole = header(index);
    const std::vector<ShardInstance> instances = instances_of(range);
    std::vector<Piece> pieces;
    std::uint64_t largest = 0;
    for (std::size_t i = 0; i < instances.size(); ++i) {
        const std::uint64_t end = i + 1 < instances.size() ? instances[i + 1].offset : whole.frame_bytes;
        const std::uint64_t own = end - instances[i].offset;
        if (pieces.empty() || pieces.back().bytes + own > piece_bytes) pieces.push_back({i, i, 0});
        pieces.back().last = i + 1;
        largest = std::max(largest, pieces.back().bytes += own);
    }
    for (Columns& memory : memory_) {
        if (memory.count() * sizeof(float) < largest) memory = Columns(1, largest / sizeof(float));
    }
    ShardWriter writer(file, whole, instances);
    std::future<void> writing;  // ends before the writer does
    std::size_t turn = 0;
    for (std::uint64_t frame = range.first_frame; frame < range.first_frame + range.frames; ++frame) {
        for (const Piece& piece : pieces) {
            const std::span<std::byte> blocks =
                std::as_writable_bytes(memory_[turn ^= 1][0]).first(piece.bytes);
            make_piece(range, frame, piece, instances, blocks);
            if (writing.valid()) writing.get();
            writing = std::async(std::launch::async, [&writer, blocks] { writer.add(blocks); });
            written(piece.bytes);
        }
    }
    writing.get();
    return {whole.bytes, writer.finish()};
}

void Baker::make_piece(const ShardRange& range, std::uint64_t frame, const Piece& piece,
                       std::span<const ShardInstance> instances, std::span<std::byte> blocks) {
    cast_.read(frame, range.first_instance + piece.first, piece.last - piece.first, moments_);
    result_.clamped += static_cast<std::size_t>(std::ranges::count(moments_.clamped, 1));
    if (plan_.format == CacheFormat::poses) {
        write_poses(piece, instances, blocks);
    } else {
        deform(piece, instances, blocks);
    }
}

void Baker::write_poses(const Piece& piece, std::span<const ShardInstance> instances,
                        std::span<std::byte> blocks) const {
    for (std::size_t i = piece.first; i < piece.last; ++i) {
        const std::size_t at = i - piece.first;
        const std::size_t regions = plan_.bodies[instances[i].body].regions;
        const std::size_t begin = instances[i].offset - instances[piece.first].offset;
        const auto block =
            blocks.subspan(begin, static_cast<std::size_t>(block_bytes(plan_.format, 0, regions)));
        clear_end(block, 0);
        std::memcpy(block.data(), &moments_.transforms[at], sizeof moments_.transforms[at]);
        std::memcpy(&block[sizeof(glm::mat4x3)], &moments_.weights[at], sizeof(float));
        std::memcpy(&block[placing_bytes], &moments_.poses[at * moments_.stride],
                    regions * sizeof(bend::Pose));
    }
}

void Baker::deform(const Piece& piece, std::span<const ShardInstance> instances,
                   std::span<std::byte> blocks) {
    const bool packed = plan_.format == CacheFormat::packed;
    const std::uint64_t skipped = packed ? bounds_bytes : 0;
    const std::span<const bend::Body> bodies = cast_.bodies();
    companies_.resize(bodies.size());
    for (Company& company : companies_) {
        company.poses.clear();
        company.transforms.clear();
        company.weights.clear();
        company.offsets.clear();
    }
    for (std::size_t i = piece.first; i < piece.last; ++i) {
        const std::size_t at = i - piece.first;
        const std::uint64_t begin = instances[i].offset - instances[piece.first].offset;
        Company& company = companies_[instances[i].body];
        const auto poses =
            std::span(moments_.poses).subspan(at * moments_.stride, bodies[instances[i].body].region_count());
        company.poses.insert(company.poses.end(), poses.begin(), poses.end());
        company.transforms.push_back(moments_.transforms[at]);
        company.weights.push_back(moments_.weights[at]);
        company.offsets.push_back(static_cast<std::uint32_t>((begin + skipped) / vertex_bytes));
        const std::uint64_t end =
            i + 1 < piece.last ? instances[i + 1].offset - instances[piece.first].offset : blocks.size();
        clear_end(blocks.subspan(begin, end - begin), skipped + instances[i].vertices * vertex_bytes);
    }
    std::vector<bend::Batch> batches;
    for (std::size_t b = 0; b < bodies.size(); ++b) {
        Company& company = companies_[b];
        if (company.offsets.empty()) continue;
        bend::Batch& batch = batches.emplace_back();
        batch.body = &bodies[b];
        batch.count = company.offsets.size();
        batch.poses = {company.poses.data(), batch.count,
                       static_cast<std::uint32_t>(bodies[b].region_count() * sizeof(bend::Pose))};
        batch.transforms = strided(std::span<const glm::mat4x3>(company.transforms));
        batch.wrinkle_weights = strided(std::span<const float>(company.weights));
        batch.vertex_offsets = strided(std::span<const std::uint32_t>(company.offsets));
        const std::size_t count = blocks.size() / vertex_bytes;
        if (packed) {
            company.bounds.resize(batch.count);
            batch.bounds = company.bounds;
            batch.packed = {reinterpret_cast<bend::PackedVertex*>(blocks.data()), vertex_bytes, count};
        } else {
            batch.positions = interleaved<3>(reinterpret_cast<float*>(blocks.data()), count);
        }
    }
    const bend::CrowdJob job{.batches = batches, .stores = bend::Stores::cached, .isa = plan_.isa};
    if (const bend::Fault fault = bend::validate(job); !fault.none())
        throw InputError("cannot deform: " + std::string(bend::describe(fault)));
    result_ += bend::run_parallel(job);
    if (!packed) return;
    for (Company& company : companies_) {
        for (std::size_t i = 0; i < company.offsets.size(); ++i)
            std::memcpy(&blocks[company.offsets[i] * vertex_bytes - bounds_bytes], &company.bounds[i],
                        sizeof company.bounds[i]);
    }
}

}  // namespace goffer::cli
