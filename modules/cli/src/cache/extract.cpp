// SPDX-License-Identifier: MIT
#include "arguments.hpp"
#include "body_file.hpp"
#include "cache/cache.hpp"
#include "cache/members.hpp"
#include "deformed.hpp"
#include "packed_vertices.hpp"
#include "report.hpp"

#include <goffer/io/atomic_file.hpp>
#include <goffer/io/error.hpp>

#include <glm/geometric.hpp>

#include <algorithm>
#include <cstring>

namespace goffer::cli {
namespace {

namespace fs = std::filesystem;

/// An instance in a frame, as its shard has it.
struct Block {
    std::size_t body = 0;
    std::vector<std::byte> bytes;

    template <class T>
    [[nodiscard]] T at(std::uint64_t offset) const {
        T value;
        std::memcpy(&value, &bytes[static_cast<std::size_t>(offset)], sizeof value);
        return value;
    }
};

/// Reads a block out of a shard, all of which is looked at first: what is read is what was written.
Block read_block(const ExtractRequest& request, const Plan& plan) {
    const std::uint64_t index = plan.shard_of(request.frame, request.instance);
    const fs::path file = request.folder / shard_name(index);
    ShardHeader header = plan.header(index);
    std::error_code error;
    header.bytes = fs::file_size(file, error);
    if (!error && header.bytes >= header.data)
        header.frame_bytes = (header.bytes - header.data) / header.frame_count;
    if (const auto fault = fault_in_shard(file, header, nullptr)) throw InputError(io::about(file, *fault));
    const InputFile shard(file);
    ShardInstance instance;
    const std::uint64_t place = request.instance - header.first_instance;
    shard.read(sizeof header + place * sizeof instance, std::as_writable_bytes(std::span(&instance, 1)));
    const std::string damaged = "has an instance of a body that the plan does not have";
    if (instance.body >= plan.bodies.size()) throw InputError(io::about(file, damaged));
    const PlanBody& body = plan.bodies[instance.body];
    const std::uint64_t bytes = block_bytes(plan.format, body.vertices, body.regions);
    if (instance.vertices != body.vertices || bytes > header.frame_bytes ||
        instance.offset > header.frame_bytes - bytes)
        throw InputError(io::about(file, damaged));
    Block block{instance.body, std::vector<std::byte>(static_cast<std::size_t>(bytes))};
    const std::uint64_t frame = request.frame - header.first_frame;
    shard.read(header.data + frame * header.frame_bytes + instance.offset, block.bytes);
    return block;
}

BoundModel read_body(const ExtractRequest& request, const PlanBody& body) {
    BindWords words;
    words.load = request.load;
    words.level = static_cast<std::size_t>(body.level);
    const fs::path file = request.folder / body.file();
    ModelFile model(file, request.load.limits);
    if (!model.baked || hash_of_file(file) != body.checksum)
        throw InputError(
            io::about(file, "is not the body that the shards were made with; bake the cache again"));
    const std::vector<fit::RegionOptions> regions = baked_regions(model);
    return bind_model(std::move(model), BindRequest(words, regions));
}

void unpack(const Block& block, mesh::VertexArrays& records) {
    const auto low = block.at<glm::vec3>(0), high = block.at<glm::vec3>(sizeof(glm::vec3));
    unpack_vertices(block.bytes.data() + bounds_bytes, vertex_bytes, low, high, records.positions,
                    records.normals);
}

void deform(const Block& block, const BoundModel& model, Isa isa, mesh::VertexArrays& records) {
    std::vector<bend::Pose> poses(model.binding.body.region_count());
    for (std::size_t r = 0; r < poses.size(); ++r)
        poses[r] = block.at<bend::Pose>(placing_bytes + r * sizeof(bend::Pose));
    bend::DeformJob job = job_into(records, model, poses, runs_here(isa) ? isa : Isa::automatic);
    job.transform = block.at<glm::mat4x3>(0);
    job.wrinkle_weight = block.at<float>(sizeof(glm::mat4x3));
    bend::run(job);
}

/// A measure of the volume that the surface encloses, which is negative where it is inside out. Of one with
/// holes, as if each were closed toward the middle of the vertices.
double volume_of(const mesh::VertexArrays& shape) {
    glm::dvec3 middle(0);
    for (const glm::vec3& p : shape.positions)
        middle += glm::dvec3(p) / static_cast<double>(shape.positions.size());
    double volume = 0;
    for (std::size_t first = 0; first < shape.triangles.size(); first += 3) {
        const auto corner = [&](std::size_t i) {
            return glm::dvec3(shape.positions[shape.triangles[first + i]]) - middle;
        };
        volume += glm::dot(corner(0), glm::cross(corner(1), corner(2)));
    }
    return volume;
}

/// Turns all faces round: the transform of an instance may mirror it.
void turn_round(mesh::Mesh& mesh) {
    auto first = mesh.corners.begin();
    for (const std::uint32_t count : mesh.faces) {
        std::reverse(first, first + count);
        first += count;
    }
}

/// The model as the block has it. Positions alone say nothing of normals, which are then left out.
mesh::Mesh mesh_of_block(const Block& block, const BoundModel& model, const Plan& plan) {
    mesh::VertexArrays records = model.rest;
    records.normals.resize(records.positions.size());
    switch (plan.format) {
        case CacheFormat::positions:
            std::memcpy(records.positions.data(), block.bytes.data(),
                        records.positions.size() * sizeof(glm::vec3));
            records.normals.clear();
            break;
        case CacheFormat::packed:
            unpack(block, records);
            break;
        case CacheFormat::poses:
            deform(block, model, plan.isa, records);
            break;
    }
    mesh::Mesh bare = model.mesh;
    if (records.normals.empty()) bare.normals = {};
    bare.tangents = {};
    records.tangents.clear();
    if (volume_of(records) * volume_of(model.rest) < 0) turn_round(bare);
    return mesh::with_vertex_arrays(bare, records);
}

}  // namespace

void extract(const ExtractRequest& request) {
    check_model_output(request.output);
    Report report(request.json);
    check_cache(request.folder);
    const Plan plan = read_plan(request.folder / plan_name);
    if (request.frame >= plan.frames || request.instance >= plan.instances)
        throw InputError(io::about(
            request.folder, "has frames 0.." + std::to_string(plan.frames - 1) + " and instances 0.." +
                                std::to_string(plan.instances - 1) + ", and not " +
                                std::to_string(request.frame) + "," + std::to_string(request.instance)));
    const Block block = read_block(request, plan);
    const PlanBody& body = plan.bodies[block.body];
    const BoundModel model = read_body(request, body);
    if (model.rest.positions.size() != body.vertices)
        throw InputError(io::about(request.folder / body.file(),
                                   "does not have the vertices that the plan says; bake the cache again"));
    io::AtomicFiles outputs;
    mesh::save(mesh_of_block(block, model, plan), request.output, outputs);
    report.json["body"] = body.name;
    report.json["frame"] = request.frame;
    report.json["instance"] = request.instance;
    report.json["shard"] = shard_name(plan.shard_of(request.frame, request.instance));
    report.json["vertices"] = body.vertices;
    report.line("instance", std::to_string(request.instance) + " in frame " + std::to_string(request.frame) +
                                ": body " + body.name + ", " + std::to_string(body.vertices) + " vertices");
    report.line("written", request.output.string());
    report.finish(outputs);
}

}  // namespace goffer::cli
