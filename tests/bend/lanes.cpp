// SPDX-License-Identifier: MIT
#include "every_way.hpp"
#include "job/lane_runner.hpp"
#include "kernel/kernels.hpp"
#include "support/faults.hpp"
#include "support/rounds.hpp"

#include <doctest/doctest.h>

#include <iterator>
#include <string_view>
#include <vector>

/// P5 of bodies whose instances are deformed many at a time: those with few vertices per region.

namespace goffer::test {
namespace {

using Matrix = bend::TransformColumn::MatrixLayout;

/// What batches write that are deformed so: no packed vertices.
constexpr std::string_view pictures[] = {
    "x y z", "x y z u v w", "xyz",          "xyzuvw", "xyzuvwabcd",  "xyz uvw abcd", "xyz.uvw.",
    "xyz.",  "zyx wvu",     "xyzuvw......", "..xyz",  "x y z p q r", "xyzuvwpqr",    "xyz.pqr. uvw"};

/// A chain of regions with a shape. They have radii of their own, or some of them are bent at rest.
bend::Body shaped_chain(Random& random, std::span<const std::size_t> counts) {
    std::vector<bend::RegionInput> regions;
    std::size_t sum = 0;
    const bool straight = random() % 2 == 0;
    const double rest_angle = uniform(random, 0.1, 2), onset = random() % 2 == 0 ? 0 : 0.02;
    for (const std::size_t count : counts) {
        bend::RegionInput& region = regions.emplace_back(loose_shaped_region(count));
        region.onset = onset;
        region.max_angle = 3.2;  // of the thickest, too
        if (straight) region.radius = 0.1 * uniform(random, 0.9, 1.1);
        if (!straight && random() % 4 != 0) region.rest_angle = rest_angle;
        sum += count;
    }
    LooseVertices loose(random, sum, 0.11);
    loose.add_shape(random);
    for (bend::RestVertex& v : loose.vertices) v.scale *= 0.8;  // for tables of neighbors that are thinner
    blend_some(random, regions, loose.vertices);
    return loose.body(regions);
}

/// Some of its regions have no vertices, some one or two. One chain in eight is nearly as large as such
/// bodies may be.
bend::Body small_chain(Random& random) {
    if (random() % 8 == 0) return loose_chain(random, std::vector<std::size_t>(20, 55));
    std::vector<std::size_t> counts(3 + random() % (random() % 4 == 0 ? 22 : 9));
    for (std::size_t& count : counts) count = random() % 4 == 0 ? random() % 3 : random() % 30;
    counts[1] = 20;
    return random() % 3 == 0 ? shaped_chain(random, counts) : loose_chain(random, counts);
}

BatchStyle any_style(Random& random) {
    BatchStyle style;
    style.storage = all_storages[random() % std::size(all_storages)];
    style.transforms = static_cast<Matrix>(random() % 3);
    style.indices = random() % 2 == 0;
    style.places = random() % 2 == 0;
    style.masks = random() % 3 == 0;
    style.defaults = random() % 4 == 0;
    style.scratch_gaps = random() % 2 == 0;
    style.bounds = random() % 8 == 0;
    style.picture = pictures[random() % std::size(pictures)];
    return style;
}

}  // namespace

TEST_CASE("P5: small bodies that are deformed many at a time have the bits of single jobs") {
    Random random(171);
    for (const Isa isa : isas_here()) {
        CAPTURE(name(isa));
        const int trials = rounds(200, 60);
        int together = 0;  // batches
        for (int trial = 0; trial < trials; ++trial) {
            std::vector<bend::Body> bodies;
            for (int i = 0; i < 2; ++i) bodies.push_back(small_chain(random));
            TestBatches tested;
            const bool hostile = random() % 6 == 0;
            for (const bend::Body& body : bodies) {
                BatchStyle style = any_style(random);
                style.hostile = hostile;
                tested.add(random, body, 8 + random() % 40, style);
                together += bend::LaneRunner::suits(tested.batches.back(), 8, bend::kernels(isa)) ? 1 : 0;
            }
            CAPTURE(trial);
            bend::CrowdJob crowd{.batches = tested.batches, .frame = static_cast<std::uint32_t>(trial)};
            crowd.stores = random() % 2 == 0 ? bend::Stores::cached : bend::Stores::non_temporal;
            crowd.isa = isa;
            if (!hostile) REQUIRE(told(bend::validate(crowd)) == "none");
            check_every_way(tested, crowd, 1 + random() % 9);
        }
        const bool has_lanes = bend::kernels(isa).lane_setup != nullptr;
        CHECK((together > trials) == has_lanes);
    }
}

}  // namespace goffer::test
