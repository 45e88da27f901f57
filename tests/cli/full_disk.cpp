// SPDX-License-Identifier: MIT
#include "command.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cstdlib>

/// Each call that writes an output fails once, as on a full disk: old outputs stay, whole, and nothing beside
/// them.

using namespace goffer::test;

namespace {

/// What `goffer words..` does where its call number `call` fails.
Result run_failing(const Folder& folder, const Words& words, int call) {
    setenv("GOFFER_FAIL_CALL", std::to_string(call).c_str(), 1);
    setenv("LD_PRELOAD", GOFFER_FAIL_A_CALL, 1);
    Result result = run(folder, words);
    unsetenv("LD_PRELOAD");
    unsetenv("GOFFER_FAIL_CALL");
    return result;
}

/// Fails each call of a command once. Returns how many there were.
int fail_each_call(const Words& words, const Words& outputs) {
    const Folder good;
    base(good);
    well(good, words);
    int partly = 0;
    for (int call = 1;; ++call) {
        CAPTURE(call);
        const Folder folder;
        base(folder);
        for (const std::string& output : outputs) folder.write(output, "kept");
        const std::size_t files = snapshot(folder).size();
        const Result result = run_failing(folder, words, call);
        if (result.code == 0) {
            for (const std::string& output : outputs)
                CHECK(bytes_of(folder / output) == bytes_of(good / output));
            CHECK(partly < static_cast<int>(outputs.size()));
            return call - 1;
        }
        CHECK(result.code == 1);
        CHECK(result.err.find("cannot be written: No space left on device; ") != std::string::npos);
        CHECK(std::ranges::count(result.err, '\n') == 1);
        CHECK(snapshot(folder).size() == files);
        // Outputs take their places one after the other: some are new where a later one cannot be renamed.
        const auto kept = std::ranges::count_if(
            outputs, [&](const std::string& output) { return bytes_of(folder / output) == "kept"; });
        partly += kept < static_cast<std::ptrdiff_t>(outputs.size());
        for (const std::string& output : outputs) {
            const std::string bytes = bytes_of(folder / output);
            CHECK((bytes == "kept" || bytes == bytes_of(good / output)));
        }
    }
}

}  // namespace

TEST_CASE("full disk: whichever call fails, old outputs stay and nothing is left beside them") {
    // Five calls a file: open, write, flush, send to the disk, rename.
    CHECK(fail_each_call({"refine", "base.ply", "--folds", "12", "-o", "out.ply", "--json", "out.json"},
                         {"out.ply", "out.json"}) >= 10);
}
