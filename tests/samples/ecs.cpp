// SPDX-License-Identifier: MIT
#include "command_folder.hpp"

#include <goffer/measure/allocations.hpp>

#include <doctest/doctest.h>

#include <regex>
#include <string>

/// The game of samples/ecs draws the same in whatever world and on whatever threads.

namespace goffer::test {
namespace {

/// Bodies of two levels, of one, and of two regions.
class Game {
public:
    Game() {
        folder_.goffer("base --length 10 --radius 1 --columns 24 --rows 61 --caps -o worm.ply");
        folder_.goffer("base --length 10 --radius 1 --columns 12 --rows 31 --caps -o far.ply");
        folder_.goffer("base --length 4 --radius 1.2 --columns 20 --rows 41 --caps -o fat.ply");
        folder_.goffer("bake worm.ply --lod far.ply --refine off --socket tip=0,0,10 -o worm.goffer");
        folder_.goffer("bake fat.ply --refine off --socket tip=0,0,4 -o fat.goffer");
        folder_.goffer("bake far.ply --refine off -o bald.goffer");
        folder_.goffer("bake far.ply --refine off --regions 0.5,0.5 -o chain.goffer");
    }

    /// What the game over `world` prints, and its exit code.
    [[nodiscard]] std::string play(const std::string& world, const std::string& words) const {
        return folder_.output(GOFFER_ECS "/" + world, words + " 2>&1; echo \"exit $?\"");
    }

private:
    CommandFolder folder_;
};

const std::string three = "--creatures 300 --frames 40 worm.goffer fat.goffer bald.goffer";

/// A line of what the game prints that begins with `begin`.
std::string line_of(const std::string& out, const std::string& begin) {
    std::smatch found;
    CAPTURE(out);
    REQUIRE(std::regex_search(out, found, std::regex("(?:^|\n)(" + begin + "[^\n]*)\n")));
    return found[1];
}

}  // namespace

TEST_CASE("ecs: worlds and threads draw the same, and frames do not allocate") {
    const Game game;
    const std::string plain = game.play("arrays", "--threads 1 " + three);
    CHECK(line_of(plain, "300 creatures") == "300 creatures of 3 files, 40 frames; 245 came and went");
    const std::string drawn = line_of(plain, "creatures per frame:");
    CHECK(std::regex_match(
        drawn,
        std::regex(
            R"(creatures per frame: \d{3}\.\d seen, \d{2,3}\.\d deformed, \d+\.\d with hats, \d*\.\d touched)")));
    const std::string hash = line_of(plain, "hash "), frame = line_of(plain, "frame: ");
    MESSAGE(hash << "; " << frame);
    const std::string time = R"((\d+\.\d{3}))";
    std::smatch times;
    REQUIRE(std::regex_match(frame, times,
                             std::regex("frame: " + time + R"( ms \(animate )" + time + ", cull " + time +
                                        ", deform " + time + ", hats and touch " + time + R"(\))")));
    // Milliseconds: medians of the whole and of its parts.
    const double whole = std::stod(times[1]), deform = std::stod(times[4]);
    CHECK(deform > 0);
    CHECK(whole > deform);
    CHECK(whole < 1000);
    const auto plays_the_same = [&](const std::string& world, const std::string& words) {
        CAPTURE(world);
        CAPTURE(words);
        const std::string out = game.play(world, words + three);
        CHECK(line_of(out, "hash ") == hash);
        CHECK(line_of(out, "creatures per frame:") == drawn);
        CHECK(out.ends_with("exit 0\n"));
        if (measure::allocations()) CHECK(line_of(out, "allocations") == "allocations in frames: 0");
    };
    plays_the_same("arrays", "--threads 1 ");
    plays_the_same("arrays", "--threads 3 ");
    plays_the_same("arrays", "");
#ifdef GOFFER_HAS_ENTT
    plays_the_same("entt", "--threads 1 ");
    plays_the_same("entt", "--threads 2 ");
    plays_the_same("entt", "");
#endif
}

TEST_CASE("ecs: what cannot be played is said") {
    const Game game;
    CHECK(game.play("arrays", "").ends_with("exit 2\n"));
    CHECK(game.play("arrays", "--creatures worm.goffer")
              .ends_with("/arrays: worm.goffer: not a number from 1 to 100000\nexit 2\n"));
    CHECK(game.play("arrays", "none.goffer")
              .ends_with("/arrays: none.goffer: body file: there is no such file; check its name, and the "
                         "working folder\nexit 1\n"));
    CHECK(game.play("arrays", "chain.goffer")
              .ends_with("/arrays: this game is for bodies of one region\nexit 1\n"));
    CHECK(game.play("arrays", "--creatures 1 --frames 1 bald.goffer").ends_with("exit 0\n"));
}

}  // namespace goffer::test
