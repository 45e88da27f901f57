// SPDX-License-Identifier: MIT
#include "support/arena.hpp"
#include "support/faults.hpp"
#include "support/layout_case.hpp"
#include "support/rounds.hpp"
#include "support/test_batch.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <string>
#include <vector>

/// Wide records: all that a renderer keeps of a vertex side by side, up to 128 bytes, of bodies whose regions
/// are shorter than a cache line has room for. Gaps are kept, or scratch; then they alone may change.

namespace goffer::test {
namespace {

constexpr std::string_view named[] = {
    // dense: 36, 24, 40, 52, 64 bytes; packed beside others; members in another order
    "xyzuvwpqr",
    "xyzpqr",
    "xyzuvwabcd",
    "xyzuvwabcdpqr",
    "xyzuvwabcdpqr123",
    "123xyz",
    "xyzuvw123",
    "pqr123uvw",
    "pqrxyz",
    "abcdpqruvwxyz",
    "123pqrabcd uvwxyz",
    // with gaps: 16, 32, 48, 64, 80, 128 bytes
    "xyz.",
    "123.",
    "xyz.uvw.",
    "xyzuvw..",
    "xyz.pqr.",
    "xyz.uvw.abcd",
    "..xyzpqr........",
    "xyzuvwabcdpqr...",
    ".xyz.uvw.abcd.pqr.123",
    "xyz.............................",
    "......123...............xyz.....",
    ".......xyzuvw.......abcd........ pqr.",
};

/// Streams in any mix and order, in one record or in two; with gaps the records are up to 128 bytes long.
std::string any_picture(Random& random, bool gaps) {
    std::vector<std::string> words{"xyz", "uvw", "abcd", "pqr", "123"};
    std::ranges::shuffle(words, random);
    words.resize(1 + random() % words.size());
    std::string picture;
    std::size_t size = 0, spare = 16;  // floats of the record; what gaps may take before its last stream
    for (const std::string& word : words) {
        if (!picture.empty() && random() % 5 == 0) picture += ' ', size = 0, spare = 16;
        std::size_t gap = gaps && random() % 2 == 0 ? random() % 8 : 0;
        gap = std::min(gap, spare);
        picture.append(gap, '.').append(word);
        size += gap + word.size();
        spare -= gap;
    }
    if (gaps) picture.append(random() % (33 - size), '.');
    return picture;
}

/// `count` vertices in regions of 1 to `most` each; the last one takes what is left.
bend::Body cut_body(Random& random, std::size_t count, std::size_t most) {
    std::vector<std::size_t> counts;
    while (count > 0) {
        const bool last = counts.size() + 1 == bend::max_regions;
        counts.push_back(last ? count : std::min(count, 1 + random() % most));
        count -= counts.back();
    }
    return loose_chain(random, counts);
}

/// By any stores, with gaps kept and with gaps that are scratch.
void check_any_stores(LayoutCase& test_mesh, std::string_view picture, std::size_t shift, std::size_t skew,
                      Isa isa) {
    OutputBuffer out(picture, test_mesh.count(), shift, skew);
    for (const OutputBuffer::Gaps gaps : {OutputBuffer::Gaps::kept, OutputBuffer::Gaps::scratch}) {
        for (const bend::Stores stores : {bend::Stores::cached, bend::Stores::non_temporal}) {
            INFO(picture, ", ", test_mesh.count(), " vertices, shift ", shift, ", skew ", skew, ", ",
                 name(isa), ", scratch ", gaps == OutputBuffer::Gaps::scratch, ", cached ",
                 stores == bend::Stores::cached);
            bend::DeformJob& job = test_mesh.job(out);
            job.scratch_gaps = gaps == OutputBuffer::Gaps::scratch;
            const bend::Batch batch = bend::batch_of(job);
            const bend::CrowdJob crowd{.batches = {&batch, 1}, .stores = stores, .isa = isa};
            REQUIRE(told(bend::validate(crowd)) == "none");
            bend::run(crowd);
            REQUIRE(out.fault(test_mesh.planes(), gaps) == "");
        }
    }
}

}  // namespace

TEST_CASE("wide records hold the bits of planes: every alignment") {
    Random random(141);
    const std::vector<std::size_t> counts =
        rounds<std::vector<std::size_t>>({1, 2, 15, 16, 17, 33, 70, 255, 256, 257, 511, 513}, {17, 70, 257});
    for (const std::size_t count : counts) {
        for (const std::size_t most : {std::size_t{3}, std::size_t{40}}) {
            LayoutCase test_mesh(random, cut_body(random, count, most));
            for (const Isa isa : isas_here()) {
                test_mesh.make_planes(isa);
                for (const std::string_view picture : named) {
                    for (std::size_t shift = 0; shift < 16; ++shift)
                        check_any_stores(test_mesh, picture, shift, random() % 16, isa);
                }
            }
        }
    }
}

TEST_CASE("wide records hold the bits of planes: any records, every vertex count") {
    Random random(142);
    std::vector<std::size_t> counts{250, 255, 256, 257, 258, 270, 511, 512, 513, 530, 771};
    for (std::size_t count = 1; count <= 70; ++count) counts.push_back(count);
    for (const std::size_t count : counts) {
        const std::size_t most = random() % 3 == 0 ? count : 1 + random() % 40;
        LayoutCase test_mesh(random, cut_body(random, count, most));
        for (const Isa isa : isas_here()) {
            test_mesh.make_planes(isa);
            for (int trial = 0; trial < rounds(24, 4); ++trial)
                check_any_stores(test_mesh, any_picture(random, trial % 2 == 0), random() % 16, random() % 16,
                                 isa);
        }
    }
}

TEST_CASE("records of two poses hold the bits of planes: every order, whatever the poses squeeze") {
    Random random(145);
    const auto bodies = [&](std::size_t count) {
        std::vector<bend::Body> made;
        made.push_back(loose_body(random, count));
        made.push_back(loose_shaped_body(random, count));
        made.push_back(loose_chain(random, std::vector<std::size_t>{count}));
        made.push_back(loose_chain(random, std::vector<std::size_t>{count / 2, count / 4, count / 3}));
        return made;
    };
    for (const std::size_t count : {50u, 333u, 700u}) {
        for (bend::Body& body : bodies(count)) {
            LayoutCase test_mesh(random, std::move(body));
            for (int trial = 0; trial < rounds(12, 3); ++trial) {
                test_mesh.set_wrinkles(trial % 3 != 2);
                for (const Isa isa : isas_here()) {
                    test_mesh.make_planes(isa);
                    for (const std::string_view picture :
                         {"xyzpqr", "pqrxyz", "xyzuvwpqr", "xyzpqruvw", "uvwxyzpqr", "uvwpqrxyz", "pqrxyzuvw",
                          "pqruvwxyz"})
                        check_any_stores(test_mesh, picture, random() % 16, random() % 16, isa);
                }
            }
        }
    }
}

TEST_CASE("a range of wide records writes its own vertices alone, and its own gaps at most") {
    Random random(143);
    for (const std::size_t count : {35u, 300u}) {
        LayoutCase test_mesh(random, cut_body(random, count, 12));
        for (const Isa isa : isas_here()) {
            test_mesh.make_planes(isa);
            for (int trial = 0; trial < rounds(40, 10); ++trial) {
                const std::string picture = any_picture(random, trial % 4 != 0);
                OutputBuffer out(picture, count, random() % 16, random() % 16);
                for (int range = 0; range < 40; ++range) {
                    const std::size_t first = random() % (count + 1);
                    const std::size_t last = first + random() % (count - first + 1);
                    const OutputBuffer::Gaps gaps =
                        range % 2 == 0 ? OutputBuffer::Gaps::scratch : OutputBuffer::Gaps::kept;
                    INFO(picture, ", [", first, ", ", last, "), ", name(isa));
                    bend::DeformJob& job = test_mesh.job(out);
                    job.scratch_gaps = gaps == OutputBuffer::Gaps::scratch;
                    bend::run_range(job, first, last);
                    REQUIRE(out.fault(test_mesh.planes(), first, last, gaps) == "");
                }
            }
        }
    }
}

TEST_CASE("wide records of a crowd: pieces and threads leave the bits of single jobs") {
    Random random(144);
    std::vector<bend::Body> bodies;
    for (const std::size_t count : {23u, 400u}) bodies.push_back(cut_body(random, count, 9));
    for (const Isa isa : isas_here()) {
        for (int trial = 0; trial < rounds(24, 4); ++trial) {
            TestBatches tested;
            std::string pictures[2];
            for (std::size_t i = 0; i < 2; ++i) {
                pictures[i] = trial % 4 == 0 ? std::string(named[random() % std::size(named)])
                                             : any_picture(random, trial % 4 != 1);
                BatchStyle style{.storage = all_storages[random() % 4]};
                style.places = random() % 2 == 0;
                style.scratch_gaps = trial % 3 != 0;
                style.picture = pictures[i];
                tested.add(random, bodies[i], 1 + random() % 9, style);
            }
            INFO(pictures[0], " and ", pictures[1], ", ", name(isa), ", trial ", trial);
            bend::CrowdJob crowd{.batches = tested.batches, .isa = isa};
            crowd.stores = trial % 2 == 0 ? bend::Stores::non_temporal : bend::Stores::cached;
            REQUIRE(told(bend::validate(crowd)) == "none");
            const bend::CrowdResult expected = tested.expect(isa);
            tested.clear();
            in_arena(3, [&] { CHECK(bend::run_parallel(crowd).deformed == expected.deformed); });
            REQUIRE(tested.fault() == "");
            for (const std::size_t pieces : {2u, 5u, 60u}) {
                tested.clear();
                for (std::size_t piece = pieces; piece-- > 0;) bend::run_piece(crowd, piece, pieces);
                REQUIRE(tested.fault() == "");
            }
        }
    }
}

}  // namespace goffer::test
