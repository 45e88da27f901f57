// SPDX-License-Identifier: MIT
#include "not_finite.hpp"
#include "support/bodies.hpp"
#include "support/faults.hpp"

#include <goffer/bend/crowd.hpp>

#include <doctest/doctest.h>

#include <array>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

/// P7 of crowds: validate() names the batch, the instance and the field at fault, whatever masks say.

namespace goffer::test {
namespace {

using bend::Batch;
using bend::Field;
using bend::Reason;

constexpr std::size_t instances = 10;
constexpr std::size_t vertices = 12;

struct ShortWorm {
    bend::Pose poses[2] = {{0.5f, 1}, {1, 2}};
    bend::Pose previous_poses[2] = {};
    float weight = 0.5f;
    glm::mat4x3 model{1}, previous_model{1};
    std::uint8_t visible = 1, changed = 1, interval = 2;
    std::uint32_t place = 0;
};

/// A crowd of two good batches of a body of two regions, the second of which tests spoil.
struct SpoiledCrowd {
    Random random{111};
    bend::Body body = two_regions(random);
    std::vector<ShortWorm> worms{instances};
    std::vector<std::uint32_t> indices;
    std::vector<float> memory = std::vector<float>(2 * instances * vertices * 6);
    std::vector<bend::Bounds> boxes{instances};
    Batch batches[2];

    SpoiledCrowd() {
        for (std::size_t i = 0; i < instances; ++i) {
            worms[i].place = static_cast<std::uint32_t>(i * vertices);
            indices.push_back(static_cast<std::uint32_t>(instances - 1 - i));
        }
        const std::size_t half = instances * vertices;
        for (std::size_t i = 0; i < 2; ++i) {
            Batch& batch = batches[i];
            batch.body = &body;
            batch.count = instances;
            batch.poses = strided(std::span(worms), &ShortWorm::poses);
            batch.positions = interleaved<3>(&memory[i * half * 6], half, 24);
            batch.vertex_step = vertices;
        }
        Batch& batch = batches[1];
        batch.indices = indices;
        batch.transforms = strided(std::span(worms), &ShortWorm::model);
        batch.wrinkle_weights = strided(std::span(worms), &ShortWorm::weight);
        batch.previous_poses = strided(std::span(worms), &ShortWorm::previous_poses);
        batch.previous_transforms = strided(std::span(worms), &ShortWorm::previous_model);
        batch.visible = strided(std::span(worms), &ShortWorm::visible);
        batch.changed = strided(std::span(worms), &ShortWorm::changed);
        batch.update_intervals = strided(std::span(worms), &ShortWorm::interval);
        batch.previous_positions = interleaved<3>(&memory[half * 6 + 3], half, 24);
        batch.bounds = boxes;
        batch.vertex_offsets = strided(std::span(worms), &ShortWorm::place);
        batch.vertex_step = 0;
    }

    [[nodiscard]] bend::Fault fault() const { return bend::validate(bend::CrowdJob{.batches = batches}); }

    static bend::Body two_regions(Random& random) {
        const std::size_t counts[] = {5, 7};
        return loose_chain(random, counts);
    }
};

/// The fault of a good crowd after `change`.
template <class Change>
bend::Fault crowd_fault_after(Change change) {
    SpoiledCrowd crowd;
    change(crowd, crowd.batches[1]);
    return crowd.fault();
}

template <class T>
StridedView<T> shorter(StridedView<T> view) {
    --view.count;
    return view;
}

template <class T>
StridedView<T> view_one_byte_on(StridedView<T> view) {
    ++view.offset;
    return view;
}

}  // namespace

TEST_CASE("P7: a crowd's fault names batch, instance and region") {
    CHECK(told(SpoiledCrowd().fault()) == "none");
    // Instance i reads element 9 - i.
    CHECK(told(crowd_fault_after([](SpoiledCrowd& c, Batch&) {
              c.worms[2].poses[1].angle = nan;
              c.batches[0].count = 2;
          })) == "poses not_finite, batch 1, instance 7, region 1");
    CHECK(told(crowd_fault_after([](SpoiledCrowd& c, Batch&) { c.worms[2].poses[1].angle = nan; })) ==
          "poses not_finite, batch 0, instance 2, region 1");
    CHECK(told(crowd_fault_after([](SpoiledCrowd& c, Batch&) {
              c.worms[9].previous_poses[0].direction = -nan;
          })) == "previous_poses not_finite, batch 1, instance 0, region 0");
    CHECK(told(crowd_fault_after([](SpoiledCrowd& c, Batch&) { c.worms[0].weight = nan; })) ==
          "wrinkle_weight not_finite, batch 1, instance 9");
    CHECK(told(crowd_fault_after([](SpoiledCrowd& c, Batch&) { c.worms[4].weight = -0.5f; })) ==
          "wrinkle_weight out_of_range, batch 1, instance 5");
    CHECK(told(crowd_fault_after([](SpoiledCrowd& c, Batch&) { c.worms[4].model[3].y = nan; })) ==
          "transform not_finite, batch 1, instance 5");
    CHECK(told(crowd_fault_after([](SpoiledCrowd& c, Batch&) { c.worms[4].model[0].z = 2e18f; })) ==
          "transform too_large, batch 1, instance 5");
    CHECK(told(crowd_fault_after([](SpoiledCrowd& c, Batch&) { c.worms[4].previous_model[2].x = nan; })) ==
          "previous_transform not_finite, batch 1, instance 5");
    // Nobody's elements need not make sense.
    CHECK(told(crowd_fault_after([](SpoiledCrowd& c, Batch& b) {
              c.batches[0].count = 2;
              b.count = 7;
              b.indices = b.indices.first(7);
              c.worms[2].place = 0xffffffffu;
              c.worms[2].weight = nan;
          })) == "none");
}

TEST_CASE("P7: masks hide nothing from validate") {
    const auto asleep = [](SpoiledCrowd& c) {
        for (ShortWorm& worm : c.worms) worm.visible = worm.changed = 0, worm.interval = 255;
    };
    CHECK(told(crowd_fault_after([&](SpoiledCrowd& c, Batch&) { asleep(c); })) == "none");
    CHECK(told(crowd_fault_after([&](SpoiledCrowd& c, Batch&) { asleep(c), c.worms[9].weight = 2; })) ==
          "wrinkle_weight out_of_range, batch 1, instance 0");
    CHECK(told(crowd_fault_after([&](SpoiledCrowd& c, Batch&) {
              asleep(c), c.worms[3].place = 0xffffffffu;
          })) == told(crowd_fault_after([&](SpoiledCrowd& c, Batch&) { c.worms[3].place = 0xffffffffu; })));
    CHECK(told(crowd_fault_after([&](SpoiledCrowd& c, Batch& b) { asleep(c), b.body = nullptr; })) ==
          "body null, batch 1");
}

TEST_CASE("P7: what a batch has for all its instances is named without an instance") {
    CHECK(told(crowd_fault_after([](SpoiledCrowd&, Batch& b) { b.body = nullptr; })) == "body null, batch 1");
    const bend::Body empty;
    CHECK(told(crowd_fault_after([&](SpoiledCrowd&, Batch& b) { b.body = &empty; })) ==
          "body empty, batch 1");
    CHECK(told(crowd_fault_after([](SpoiledCrowd&, Batch& b) {
              b.positions = {}, b.previous_positions = {};
          })) == "outputs empty, batch 1");
    CHECK(told(crowd_fault_after([](SpoiledCrowd&, Batch& b) { b.positions.stride = 10; })) ==
          "positions stride, batch 1");
    CHECK(told(crowd_fault_after([](SpoiledCrowd&, Batch& b) { b.positions.component[0] = nullptr; })) ==
          "positions null, batch 1");
    CHECK(told(crowd_fault_after([](SpoiledCrowd&, Batch& b) {
              b.previous_positions.component[2] = nullptr;
          })) == "previous_positions null, batch 1");
    const bend::Fault overlap =
        crowd_fault_after([](SpoiledCrowd&, Batch& b) { --b.previous_positions.component[0]; });
    CHECK(is_overlap(overlap, Field::positions, Field::previous_positions));
    CHECK(overlap.batch == 1);
    SpoiledCrowd crowd;
    const bend::CrowdJob job{.batches = crowd.batches, .isa = static_cast<Isa>(77)};
    CHECK(told(bend::validate(job)) == "isa not_supported");
    CHECK(told(crowd_fault_after([](SpoiledCrowd& c, Batch&) { c.batches[0].poses = {}; })) ==
          "poses null, batch 0");
    CHECK(told(crowd_fault_after([](SpoiledCrowd&, Batch& b) { b.poses = {}; })) == "poses null, batch 1");
    CHECK(told(crowd_fault_after([](SpoiledCrowd&, Batch& b) { b.previous_poses = {}; })) ==
          "previous_poses null, batch 1");
    CHECK(told(crowd_fault_after(
              [](SpoiledCrowd&, Batch& b) { b.previous_poses = {}, b.previous_positions = {}; })) == "none");
}

TEST_CASE("P7: columns that end too soon are named") {
    const auto spoilt = [](auto column) {
        return crowd_fault_after([&](SpoiledCrowd&, Batch& b) { b.*column = shorter(b.*column); });
    };
    // Instance 0 reads the last element.
    CHECK(told(spoilt(&Batch::poses)) == "indices out_of_range, batch 1, instance 0");
    CHECK(told(spoilt(&Batch::wrinkle_weights)) == "wrinkle_weight count, batch 1");
    CHECK(told(spoilt(&Batch::previous_poses)) == "previous_poses count, batch 1");
    CHECK(told(spoilt(&Batch::visible)) == "visible count, batch 1");
    CHECK(told(spoilt(&Batch::changed)) == "changed count, batch 1");
    CHECK(told(spoilt(&Batch::update_intervals)) == "update_intervals count, batch 1");
    CHECK(told(spoilt(&Batch::vertex_offsets)) == "vertex_offsets count, batch 1");
    CHECK(told(crowd_fault_after([](SpoiledCrowd&, Batch& b) { --b.transforms.first.count; })) ==
          "transform count, batch 1");
    CHECK(told(crowd_fault_after([](SpoiledCrowd&, Batch& b) { --b.previous_transforms.first.count; })) ==
          "previous_transform count, batch 1");
    CHECK(told(crowd_fault_after([](SpoiledCrowd&, Batch& b) { b.bounds = b.bounds.first(9); })) ==
          "bounds count, batch 1");
    CHECK(told(crowd_fault_after([](SpoiledCrowd&, Batch& b) { b.indices = b.indices.first(9); })) ==
          "indices count, batch 1");
    // The first batch has no indices.
    CHECK(told(crowd_fault_after([](SpoiledCrowd& c, Batch&) { c.batches[0].poses.count = 9; })) ==
          "poses count, batch 0");
}

TEST_CASE("P7: indices, places and steps that lead out of the buffers are named") {
    CHECK(told(crowd_fault_after([](SpoiledCrowd& c, Batch&) { c.indices[5] = instances; })) ==
          "indices out_of_range, batch 1, instance 5");
    CHECK(told(crowd_fault_after([](SpoiledCrowd& c, Batch&) { c.indices[5] = 0xffffffffu; })) ==
          "indices out_of_range, batch 1, instance 5");
    const auto with_place = [](std::uint32_t place) {
        return crowd_fault_after([&](SpoiledCrowd& c, Batch&) { c.worms[3].place = place; });
    };
    constexpr std::uint32_t last = (instances - 1) * vertices;
    CHECK(told(with_place(last + 1)) == "vertex_offsets out_of_range, batch 1, instance 6");
    CHECK(told(with_place(0xffffffffu)) == "vertex_offsets out_of_range, batch 1, instance 6");
    CHECK(told(with_place(0xfffffff4u)) == "vertex_offsets out_of_range, batch 1, instance 6");  // + 12 is 0
    const auto with_step = [](std::size_t step) {
        return crowd_fault_after([&](SpoiledCrowd& c, Batch&) { c.batches[0].vertex_step = step; });
    };
    CHECK(told(with_step(vertices)) == "none");
    CHECK(told(with_step(vertices - 1)) == "vertex_step overlap, batch 0");
    CHECK(told(with_step(0)) == "vertex_step overlap, batch 0");
    CHECK(told(with_step(vertices + 1)) == "positions too_short, batch 0");
    for (int bits = 4; bits < 64; ++bits)
        CHECK(told(with_step(std::size_t{1} << bits)) == "positions too_short, batch 0");
    CHECK(told(with_step(~std::size_t{0})) == "positions too_short, batch 0");
    // A stream that is too short for the last instance, though not for a single one.
    CHECK(told(crowd_fault_after([](SpoiledCrowd& c, Batch&) { --c.batches[0].positions.count; })) ==
          "positions too_short, batch 0");
    CHECK(told(crowd_fault_after([](SpoiledCrowd&, Batch& b) { --b.previous_positions.count; })) ==
          "vertex_offsets out_of_range, batch 1, instance 0");
    CHECK(told(crowd_fault_after([](SpoiledCrowd&, Batch& b) {
              b.previous_positions.count = vertices - 1;
          })) == "previous_positions too_short, batch 1");
    CHECK(told(crowd_fault_after([](SpoiledCrowd& c, Batch&) {
              c.batches[0].count = 1, c.batches[0].vertex_step = ~std::size_t{0};
          })) == "none");
}

TEST_CASE("P7: columns whose elements are too near to each other are named") {
    // A flat array of poses, for a body of two regions: the last instance would read behind its end.
    const auto after_poses = [](std::uint32_t stride) {
        return crowd_fault_after([&](SpoiledCrowd&, Batch& b) { b.poses.stride = stride; });
    };
    CHECK(told(after_poses(sizeof(bend::Pose))) == "poses stride, batch 1");
    CHECK(told(after_poses(2 * sizeof(bend::Pose) - 4)) == "poses stride, batch 1");
    CHECK(told(after_poses(2 * sizeof(bend::Pose))) == "none");
    CHECK(told(after_poses(0)) == "none");  // the same poses for all
    // A member of a struct that is large enough, but something else follows it.
    const auto after_values = [](std::uint32_t values) {
        return crowd_fault_after([&](SpoiledCrowd&, Batch& b) { b.poses.values = values; });
    };
    CHECK(told(after_values(1)) == "poses stride, batch 1");
    CHECK(told(after_values(2)) == "none");
    struct ShortWorm {
        bend::Pose pose;
        std::array<bend::Pose, 3> poses;
        bend::Pose plain[4];
    };
    const std::array<ShortWorm, 2> worms{};
    CHECK(strided(std::span(worms), &ShortWorm::pose).values == 1);
    CHECK(strided(std::span(worms), &ShortWorm::poses).values == 3);
    CHECK(strided(std::span(worms), &ShortWorm::plain).values == 4);
    const ShortWorm* const pages[] = {worms.data()};
    CHECK(paged(pages, 2, 2, &ShortWorm::pose).values == 1);
    CHECK(paged(pages, 2, 2, &ShortWorm::plain).values == 4);
    CHECK(told(crowd_fault_after([](SpoiledCrowd&, Batch& b) {
              b.previous_poses.stride = sizeof(bend::Pose);
          })) == "previous_poses stride, batch 1");
    CHECK(told(crowd_fault_after([](SpoiledCrowd&, Batch& b) {
              b.transforms.first.stride = sizeof(float);
          })) == "transform stride, batch 1");
    CHECK(told(crowd_fault_after([](SpoiledCrowd&, Batch& b) { b.previous_transforms.first.stride = 44; })) ==
          "previous_transform stride, batch 1");
    CHECK(told(crowd_fault_after([](SpoiledCrowd&, Batch& b) { b.transforms.first.stride = 48; })) == "none");
    const auto after_layout = [](bend::TransformColumn::MatrixLayout layout, std::uint32_t stride) {
        return told(crowd_fault_after([&](SpoiledCrowd&, Batch& b) {
            b.transforms.layout = layout;
            b.transforms.first.stride = stride;
        }));
    };
    using enum bend::TransformColumn::MatrixLayout;
    CHECK(after_layout(columns4, 48) == "transform stride, batch 1");  // the last one would be read beyond
    CHECK(after_layout(columns4, 56) == "transform stride, batch 1");
    CHECK(after_layout(columns4, 60) == "none");
    CHECK(after_layout(rows4, 44) == "transform stride, batch 1");
    CHECK(after_layout(rows4, 48) == "none");
    static_assert(sizeof(bend::Pose) == 8 && sizeof(glm::mat4x3) == 48, "as the words say");
    const auto words = [](const bend::Fault& fault) { return std::string(bend::describe(fault).c_str()); };
    CHECK(words(crowd_fault_after([](SpoiledCrowd&, Batch& b) { b.poses.stride = sizeof(bend::Pose); })) ==
          "batches[1].poses: an element is smaller than a pose (8 bytes) for each region of the body, which "
          "lie one after the other");
    CHECK(words(crowd_fault_after([](SpoiledCrowd&, Batch& b) { b.transforms.first.stride = 44; })) ==
          "batches[1].transforms: an element is smaller than its matrix: 48 bytes, or 60 in the layout "
          "columns4");
}

TEST_CASE("P7: columns that are not aligned to what they hold are named") {
    const auto spoilt = [](auto column) {
        return crowd_fault_after([&](SpoiledCrowd&, Batch& b) { b.*column = view_one_byte_on(b.*column); });
    };
    CHECK(told(spoilt(&Batch::poses)) == "poses alignment, batch 1");
    CHECK(told(spoilt(&Batch::previous_poses)) == "previous_poses alignment, batch 1");
    CHECK(told(spoilt(&Batch::wrinkle_weights)) == "wrinkle_weight alignment, batch 1");
    CHECK(told(spoilt(&Batch::vertex_offsets)) == "vertex_offsets alignment, batch 1");
    CHECK(told(crowd_fault_after([](SpoiledCrowd&, Batch& b) { ++b.transforms.first.offset; })) ==
          "transform alignment, batch 1");
    CHECK(told(crowd_fault_after([](SpoiledCrowd&, Batch& b) { b.poses.stride += 2; })) ==
          "poses alignment, batch 1");
}

TEST_CASE("P7: it is the sum of address and offset that has to be aligned") {
    const std::vector<bend::Pose> poses(10'000);
    CHECK(told(crowd_fault_after([&](SpoiledCrowd&, Batch& b) {
              b.poses.data = reinterpret_cast<const char*>(&poses[0]) + 1;
              b.poses.offset = sizeof(bend::Pose) - 1;
              b.poses.count = b.count;
          })) == "none");
}

TEST_CASE("P7: pages that are null or not aligned are named, and layouts that there are not") {
    const std::array<bend::Pose, 64> poses{};
    std::array<const void*, 2> pages{&poses[0], &poses[32]};
    const auto fault_of_pages = [&](std::uint32_t shift = 5) {
        return crowd_fault_after([&](SpoiledCrowd&, Batch& b) {
            b.poses = {pages.data(), b.count,
                       static_cast<std::uint32_t>(sizeof(bend::Pose) * b.body->region_count()), 0, shift};
        });
    };
    pages[0] = reinterpret_cast<const char*>(&poses[0]) + 1;
    CHECK(told(fault_of_pages()) == "poses alignment, batch 1");
    pages[0] = nullptr;
    CHECK(told(fault_of_pages()) == "poses null, batch 1");
    for (const std::uint32_t shift : {64u, 200u})
        CHECK(told(fault_of_pages(shift)) == "poses out_of_range, batch 1");
    CHECK(told(crowd_fault_after([](SpoiledCrowd&, Batch& b) {
              b.transforms.layout = static_cast<bend::TransformColumn::MatrixLayout>(7);
          })) == "transform out_of_range, batch 1");
}

TEST_CASE("P7: a fault of a batch's numbers says how many there are, and how many it takes") {
    const auto numbers = [](auto spoil) {
        SpoiledCrowd crowd;
        spoil(crowd.batches[1]);
        const bend::Fault fault = crowd.fault();
        CHECK(fault.batch == 1);
        return std::pair(fault.has, fault.needs);
    };
    using Numbers = std::pair<std::size_t, std::size_t>;
    constexpr std::size_t all = instances * vertices, nowhere = bend::Fault::nowhere;
    CHECK(numbers([](Batch& b) { b.positions.count = vertices - 1; }) == Numbers{vertices - 1, vertices});
    CHECK(numbers([](Batch& b) { --b.poses.count; }).second == nowhere);  // an index is at fault
    CHECK(numbers([](Batch& b) { --b.transforms.first.count; }) == Numbers{instances - 1, instances});
    CHECK(numbers([](Batch& b) { b.indices = b.indices.first(3); }) == Numbers{3, instances});
    CHECK(numbers([](Batch& b) { b.bounds = b.bounds.first(4); }) == Numbers{4, instances});
    const auto by_step = [](Batch& b, std::size_t step) { b.vertex_offsets = {}, b.vertex_step = step; };
    CHECK(numbers([&](Batch& b) { by_step(b, vertices), b.positions.count = 3; }) == Numbers{3, all});
    CHECK(numbers([&](Batch& b) { by_step(b, vertices), b.positions.count = 0; }) == Numbers{0, all});
    CHECK(numbers([&](Batch& b) { by_step(b, vertices), --b.positions.count; }) == Numbers{all - 1, all});
    CHECK(numbers([&](Batch& b) { by_step(b, vertices + 1); }) == Numbers{all, all + instances - 1});
    CHECK(numbers([&](Batch& b) { by_step(b, vertices - 1); }) == Numbers{vertices - 1, vertices});
    CHECK(numbers([&](Batch& b) { by_step(b, nowhere / 2); }) == Numbers{all, nowhere});
}

}  // namespace goffer::test
