// SPDX-License-Identifier: MIT
#include "cache/baker.hpp"

#include "arguments.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <future>

namespace goffer::cli {
namespace {

/// What is behind an instance's vertices, up to the next block, is zeros.
void clear_end(std::span<std::byte> block, std::uint64_t used) {
    std::ranges::fill(block.subspan(static_cast<std::size_t>(used)), std::byte{0});
}

/// Whether poses ask for more than the body can.
bool beyond(const bend::Body& body, std::span<const bend::Pose> poses) {
    for (std::size_t r = 0; r < poses.size(); ++r) {
        if (std::fabs(poses[r].angle) > body.max_angle(r)) return true;
    }
    return false;
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

std::vector<Baker::Piece> Baker::pieces_of(std::span<const ShardInstance> instances,
                                           std::uint64_t frame_bytes) {
    std::vector<Piece> pieces;
    for (std::size_t i = 0; i < instances.size(); ++i) {
        const std::uint64_t end = i + 1 < instances.size() ? instances[i + 1].offset : frame_bytes;
        const std::uint64_t own = end - instances[i].offset;
        if (pieces.empty() || pieces.back().bytes + own > piece_bytes) pieces.push_back({i, i, 0});
        pieces.back().last = i + 1;
        pieces.back().bytes += own;
    }
    return pieces;
}

ShardFile Baker::bake(std::uint64_t index, const std::filesystem::path& file,
                      const std::function<void()>& frame_done) {
    const ShardRange range = plan_.range(index);
    const ShardHeader whole = header(index);
    const std::vector<ShardInstance> instances = instances_of(range);
    const std::vector<Piece> pieces = pieces_of(instances, whole.frame_bytes);
    const std::uint64_t largest = std::ranges::max(pieces, {}, &Piece::bytes).bytes;
    for (Columns& memory : memory_) {
        if (memory.count() * sizeof(float) < largest) memory = Columns(1, largest / sizeof(float));
    }
    ShardWriter writer(file, whole, instances);
    std::future<void> writing;  // ends before the writer does
    std::size_t turn = 0;
    for (std::uint64_t frame = range.first_frame; frame < range.first_frame + range.frames; ++frame) {
        for (const Piece& piece : pieces) {
            turn = 1 - turn;
            const auto blocks = std::as_writable_bytes(memory_[turn][0]).first(piece.bytes);
            make_piece(range, frame, piece, instances, blocks);
            if (writing.valid()) writing.get();
            writing = std::async(std::launch::async, [&writer, blocks] { writer.add(blocks); });
        }
        frame_done();
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
        gather(piece, instances, blocks);
        deform(blocks);
    }
}

void Baker::write_poses(const Piece& piece, std::span<const ShardInstance> instances,
                        std::span<std::byte> blocks) {
    for (std::size_t i = piece.first; i < piece.last; ++i) {
        const std::size_t at = i - piece.first;
        const std::size_t regions = plan_.bodies[instances[i].body].regions;
        const std::size_t begin = instances[i].offset - instances[piece.first].offset;
        const auto block =
            blocks.subspan(begin, static_cast<std::size_t>(block_bytes(plan_.format, 0, regions)));
        const auto poses = std::span(moments_.poses).subspan(at * moments_.stride, regions);
        if (moments_.clamped[at] == 0 && beyond(cast_.bodies()[instances[i].body], poses)) ++result_.clamped;
        clear_end(block, 0);
        std::memcpy(block.data(), &moments_.transforms[at], sizeof moments_.transforms[at]);
        std::memcpy(&block[sizeof(glm::mat4x3)], &moments_.weights[at], sizeof(float));
        std::memcpy(&block[placing_bytes], poses.data(), poses.size_bytes());
    }
}

void Baker::gather(const Piece& piece, std::span<const ShardInstance> instances,
                   std::span<std::byte> blocks) {
    const std::span<const bend::Body> bodies = cast_.bodies();
    const std::uint64_t skipped = plan_.format == CacheFormat::packed ? bounds_bytes : 0;
    companies_.resize(bodies.size());
    for (Company& company : companies_) {
        company.poses.clear();
        company.transforms.clear();
        company.weights.clear();
        company.offsets.clear();
    }
    const std::uint64_t start = instances[piece.first].offset;
    for (std::size_t i = piece.first; i < piece.last; ++i) {
        const std::size_t at = i - piece.first, regions = bodies[instances[i].body].region_count();
        const std::uint64_t begin = instances[i].offset - start;
        const std::uint64_t end = i + 1 < piece.last ? instances[i + 1].offset - start : blocks.size();
        const auto poses = std::span(moments_.poses).subspan(at * moments_.stride, regions);
        Company& company = companies_[instances[i].body];
        company.poses.insert(company.poses.end(), poses.begin(), poses.end());
        company.transforms.push_back(moments_.transforms[at]);
        company.weights.push_back(moments_.weights[at]);
        company.offsets.push_back(static_cast<std::uint32_t>((begin + skipped) / vertex_bytes));
        clear_end(blocks.subspan(begin, end - begin), skipped + instances[i].vertices * vertex_bytes);
    }
}

std::vector<bend::Batch> Baker::batches_into(std::span<std::byte> blocks) {
    const std::size_t count = blocks.size() / vertex_bytes;
    std::vector<bend::Batch> batches;
    for (std::size_t b = 0; b < companies_.size(); ++b) {
        Company& company = companies_[b];
        if (company.offsets.empty()) continue;
        const bend::Body& body = cast_.bodies()[b];
        bend::Batch& batch = batches.emplace_back();
        batch.body = &body;
        batch.count = company.offsets.size();
        batch.poses = {company.poses.data(), batch.count,
                       static_cast<std::uint32_t>(body.region_count() * sizeof(bend::Pose))};
        batch.transforms = strided(std::span<const glm::mat4x3>(company.transforms));
        batch.wrinkle_weights = strided(std::span<const float>(company.weights));
        batch.vertex_offsets = strided(std::span<const std::uint32_t>(company.offsets));
        if (plan_.format == CacheFormat::packed) {
            company.bounds.resize(batch.count);
            batch.bounds = company.bounds;
            batch.packed = {reinterpret_cast<bend::PackedVertex*>(blocks.data()), vertex_bytes, count};
        } else {
            batch.positions = interleaved<3>(reinterpret_cast<float*>(blocks.data()), count);
        }
    }
    return batches;
}

void Baker::deform(std::span<std::byte> blocks) {
    const std::vector<bend::Batch> batches = batches_into(blocks);
    const bend::CrowdJob job{
        .batches = batches, .frame = 0, .stores = bend::Stores::cached, .isa = plan_.isa};
    if (const bend::Fault fault = bend::validate(job); !fault.none())
        throw InputError("cannot deform: " + std::string(bend::describe(fault)));
    result_ += bend::run_parallel(job);
    if (plan_.format != CacheFormat::packed) return;
    for (const Company& company : companies_) {
        for (std::size_t i = 0; i < company.offsets.size(); ++i)
            std::memcpy(&blocks[company.offsets[i] * vertex_bytes - bounds_bytes], &company.bounds[i],
                        sizeof company.bounds[i]);
    }
}

}  // namespace goffer::cli
