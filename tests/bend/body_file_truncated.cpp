// SPDX-License-Identifier: MIT
#include "body_files.hpp"
#include "support/guarded.hpp"

#include <doctest/doctest.h>

#include <algorithm>

/// Body files of which the end is missing, in memory that ends with them.

namespace goffer::test {

TEST_CASE("body file: what is left of a file is refused, and nothing is read behind it") {
    Random random(58);
    for (int round = 0; round < 4; ++round) {
        const std::vector<std::byte> file = saved(random_body(random, 3));
        for (std::size_t size = 0; size < file.size(); ++size) {
            const Guarded<std::byte> left(size, Edge::end);
            const std::span<std::byte> bytes = left.values();
            std::ranges::copy(std::span(file).first(size), bytes.begin());
            for (const bool forged : {false, true}) {  // so that the size and the checksum fit
                if (forged) sign(bytes);
                for (const auto verify :
                     {bend::Verify::everything, bend::Verify::checksum, bend::Verify::layout}) {
                    if (bend::load(bytes, nullptr, verify) || bend::load_copy(bytes, nullptr, verify))
                        FAIL("first " << size << " bytes");
                }
            }
        }
        const Guarded<std::byte> whole(file.size(), Edge::end);
        std::ranges::copy(file, whole.data());
        CHECK(bend::load_copy(whole.values()).has_value());
    }
}

}  // namespace goffer::test
