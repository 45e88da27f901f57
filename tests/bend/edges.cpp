// SPDX-License-Identifier: MIT
#include "support/bodies.hpp"
#include "support/guarded.hpp"
#include "support/rounds.hpp"

#include <goffer/bend/crowd.hpp>

#include <doctest/doctest.h>
#include <glm/mat4x3.hpp>

#include <cstddef>
#include <cstring>
#include <span>
#include <utility>
#include <vector>

/// Memory of the caller's that ends, or begins, at a page that may be neither read nor written: columns of a
/// batch and streams in every layout, with counts about the widths of registers, lines and blocks.

namespace goffer::test {
namespace {

/// How the outputs lie: `record` floats from one vertex to the next, 0 for planes, of which the last record
/// has no gap behind it.
struct Layout {
    std::size_t record;
    bool normals, tangents, previous, packed;
};

constexpr Layout layouts[] = {
    {0, false, false, false, false}, {0, true, false, false, false}, {0, true, true, true, true},
    {3, false, false, false, false}, {6, false, false, true, false}, {6, true, false, false, false},
    {8, true, false, false, false},  {9, true, false, true, false},  {10, true, true, false, false},
    {12, true, true, false, false},  {16, true, true, true, false},  {25, true, true, true, false},
    {4, false, false, false, false}, {0, false, false, false, true}};

/// A batch's outputs in guarded memory.
class GuardedOutputs {
public:
    GuardedOutputs(const Layout& layout, std::size_t vertices, Edge edge, bend::Batch& batch) : edge_(edge) {
        if (layout.record != 0) {
            std::size_t used = 3;
            if (layout.normals) used += 3;
            if (layout.tangents) used += 4;
            if (layout.previous) used += 3;
            float* at = add((vertices - 1) * layout.record + used);
            const auto next = [&](std::size_t floats) { return std::exchange(at, at + floats); };
            const std::size_t stride = layout.record * sizeof(float);
            batch.positions = interleaved<3>(next(3), vertices, stride);
            if (layout.normals) batch.normals = interleaved<3>(next(3), vertices, stride);
            if (layout.tangents) batch.tangents = interleaved<4>(next(4), vertices, stride);
            if (layout.previous) batch.previous_positions = interleaved<3>(next(3), vertices, stride);
            return;
        }
        if (!layout.packed || layout.normals) batch.positions = planes<3>(vertices);
        if (layout.normals) batch.normals = planes<3>(vertices);
        if (layout.tangents) batch.tangents = planes<4>(vertices);
        if (layout.previous) batch.previous_positions = planes<3>(vertices);
        if (layout.packed) {
            auto* const first = reinterpret_cast<bend::PackedVertex*>(add((vertices - 1) * 4 + 3));
            batch.packed = {first, 16, vertices};
        }
    }

    /// All values, one after the other.
    [[nodiscard]] std::vector<float> values() const {
        std::vector<float> all;
        for (const Guarded<float>& memory : memory_)
            all.insert(all.end(), memory.values().begin(), memory.values().end());
        return all;
    }

private:
    float* add(std::size_t floats) { return memory_.emplace_back(floats, edge_).data(); }

    template <std::size_t N>
    Stream<N> planes(std::size_t vertices) {
        Stream<N> stream;
        for (std::size_t c = 0; c < N; ++c) stream.component[c] = add(vertices);
        stream.stride = sizeof(float);
        stream.count = vertices;
        return stream;
    }

    Edge edge_;
    std::vector<Guarded<float>> memory_;
};

/// A column with random values, or empty.
template <class T, class Make>
Guarded<T> column(std::size_t count, Edge edge, const Make& make) {
    Guarded<T> values(count, edge);
    for (T& value : values.values()) value = make();
    return values;
}

std::size_t any_count(Random& random) {
    constexpr std::size_t about[] = {4, 8, 16, 32, 48, 64, 128, 256, 512, 1024};
    if (random() % 2 == 0) return 1 + random() % 70;
    return about[random() % std::size(about)] + random() % 3 - 1;
}

}  // namespace

TEST_CASE("edges: no column is read and no stream is written beyond its memory") {
    Random random(17);
    for (int round = 0; round < rounds(6000, 600); ++round) {
        const std::size_t regions = random() % 3 == 0 ? 1 + random() % 4 : 1;
        std::vector<std::size_t> counts(regions);
        for (std::size_t& count : counts) count = any_count(random);
        const bend::Body body = random() % 4 == 0 && regions == 1 ? loose_shaped_body(random, counts[0])
                                                                  : loose_chain(random, counts);
        constexpr std::size_t instance_counts[] = {1, 1, 2, 5, 15, 16, 17, 33};
        const std::size_t instances = instance_counts[random() % std::size(instance_counts)];
        const std::size_t vertices = instances * body.vertex_count();
        const Edge edge = random() % 3 == 0 ? Edge::begin : Edge::end;
        const std::vector<Isa> isas = isas_here();
        const Isa isa = isas[random() % isas.size()];
        const Layout& layout = layouts[random() % std::size(layouts)];
        INFO("round ", round, ", ", vertices, " vertices, record of ", layout.record, ", ", name(isa));

        const auto byte = [&] { return static_cast<std::uint8_t>(random() % 4 != 0); };
        const auto pose = [&] {
            return bend::Pose{static_cast<float>(uniform(random, -3, 3)),
                              static_cast<float>(uniform(random, -4, 4))};
        };
        const auto poses = column<bend::Pose>(instances * regions, edge, pose);
        const auto previous = column<bend::Pose>(instances * regions, edge, pose);
        const auto transforms =
            column<glm::mat4x3>(instances, edge, [&] { return random_transform(random, 1); });
        const auto weights = column<float>(instances, edge, [&] {
            return random() % 3 == 0 ? 0 : static_cast<float>(uniform(random, 0, 1));
        });
        const auto visible = column<std::uint8_t>(instances, edge, byte);
        const auto intervals = column<std::uint8_t>(instances, edge, byte);
        const Guarded<bend::Bounds> boxes(instances, edge);

        const auto pose_bytes = static_cast<std::uint32_t>(regions * sizeof(bend::Pose));
        bend::Batch batch{.body = &body, .count = instances, .vertex_step = body.vertex_count()};
        batch.poses = {.data = poses.data(), .count = instances, .stride = pose_bytes};
        batch.transforms = strided(std::span<const glm::mat4x3>(transforms.values()));
        if (random() % 2 == 0) batch.wrinkle_weights = strided(std::span<const float>(weights.values()));
        if (random() % 2 == 0) batch.visible = strided(std::span<const std::uint8_t>(visible.values()));
        if (random() % 2 == 0)
            batch.update_intervals = strided(std::span<const std::uint8_t>(intervals.values()));
        if (random() % 2 == 0) batch.bounds = boxes.values();
        batch.scratch_gaps = random() % 2 == 0;
        if (layout.previous)
            batch.previous_poses = {.data = previous.data(), .count = instances, .stride = pose_bytes};
        const GuardedOutputs outputs(layout, vertices, edge, batch);
        bend::CrowdJob crowd{.batches = {&batch, 1}, .isa = isa};
        INFO(std::string_view(bend::describe(bend::validate(crowd))));
        REQUIRE(bend::validate(crowd).none());
        crowd.stores = bend::Stores::cached;
        bend::run(crowd);
        const std::vector<float> cached = outputs.values();
        crowd.stores = bend::Stores::non_temporal;
        bend::run(crowd);
        if (!batch.scratch_gaps) {
            const std::vector<float> streamed = outputs.values();
            CHECK(std::memcmp(cached.data(), streamed.data(), cached.size() * sizeof(float)) == 0);
        }
    }
}

}  // namespace goffer::test
