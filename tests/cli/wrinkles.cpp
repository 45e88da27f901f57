// SPDX-License-Identifier: MIT
#include "command.hpp"
#include "support/models.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

/// What wrinkles are like without a word about them, and the words that choose others.

using namespace goffer;
using namespace goffer::test;
using nlohmann::json;

namespace {

/// The bytes that bending `file` writes.
std::string bent_file(const Folder& folder, const std::string& file, const Words& words) {
    (void)report(folder, Words{"bend", file, "-o", "out.glb"} + words);
    return bytes_of(folder / "out.glb");
}

int folds(const Folder& folder, const Words& words) {
    return report(folder, Words{"bend", "base.ply", "-o", "out.ply"} + words)["folds"];
}

void check_kept(const char* name) {
    const std::filesystem::path file = model(name);
    if (file.empty()) return;
    const Folder folder;
    const json all = report(folder, {"bend", file.string(), "-o", "out.glb"});
    REQUIRE(all["fit"]["rest_angle"] == 0.0);
    CHECK(all["pose"]["angle"] == 90.0);
    CHECK(std::abs(all["area_after"].get<double>() / all["area_before"].get<double>() - 1) < 2e-4);
}

}  // namespace

TEST_CASE("wrinkles: --paper is what the words say that it stands for") {
    const std::filesystem::path file = model("wine_bottle.glb");
    if (file.empty()) return;
    const Folder folder;
    const Words words{"--profile", "damped", "--shape", "cylinder", "--amplitude", "paper", "--onset", "0"};
    const std::string paper = bent_file(folder, file.string(), {"--paper"});
    CHECK((bent_file(folder, file.string(), words) == paper));
    CHECK_FALSE((bent_file(folder, file.string(), {}) == paper));
    const json all = report(folder, {"bend", file.string(), "-o", "out.glb", "--paper"});
    CHECK(all["amplitude"] == "paper");
    CHECK(all["profile"] == "damped");
    CHECK_FALSE(all["fit"].contains("radii"));
    CHECK(all["base_area_change"].is_number_float());
    // An onset of one's own is kept.
    const Words gentle{"--onset", "0.01"};
    CHECK_FALSE((bent_file(folder, file.string(), gentle + Words{"--paper"}) == paper));
}

TEST_CASE("wrinkles: folds half as long are twice as many") {
    const Folder folder;
    base(folder);
    CHECK(folds(folder, {}) == 20);
    CHECK(folds(folder, {"--fold-length", "0.5"}) == 20);
    CHECK(folds(folder, {"--fold-length", "0.25"}) == 40);
    CHECK(folds(folder, {"--fold-length", "2"}) == 5);
    CHECK(folds(folder, {"--paper"}) == 5);
    CHECK(folds(folder, {"--paper", "--fold-length", "0.5"}) == 10);
}

TEST_CASE("wrinkles: round crests are others") {
    const Folder folder;
    base(folder);
    const std::string usual = bent_file(folder, "base.ply", {});
    CHECK((bent_file(folder, "base.ply", {"--profile", "even", "--roundness", "0.25"}) == usual));
    for (const std::string roundness : {"0", "0.5"})
        CHECK_FALSE(
            (bent_file(folder, "base.ply", {"--profile", "even", "--roundness", roundness}) == usual));
}

TEST_CASE("wrinkles: a part of the body stays smooth, and the report says at what cost") {
    const Folder folder;
    base(folder);
    const Words words{"bend", "base.ply", "-o", "out.ply"};
    const auto ends = [&](const Words& more) {
        well(folder, words + more);
        const mesh::Mesh bent = mesh::load(folder / "out.ply"), rest = mesh::load(folder / "base.ply");
        mesh::Mesh below;
        for (std::size_t i = 0; i < rest.positions.size(); ++i) {
            if (rest.positions[i].z > 7) below.positions.push_back(bent.positions[i]);
        }
        return below;
    };
    const Words range{"--wrinkle-range", "0,0.7"};
    CHECK(farthest(ends(range), ends({"--folds", "0"})) < 1e-5);
    CHECK(farthest(ends({}), ends({"--folds", "0"})) > 0.05);
    const json all = report(folder, words + range);
    CHECK(all["wrinkle_range"]["last"] == 0.7);
    CHECK(std::abs(all["wrinkle_range"]["area_change_inside"].get<double>()) < 1e-3);
    // A bare bend takes alpha r / L.
    CHECK(all["wrinkle_range"]["area_change_outside"].get<double>() == doctest::Approx(-0.157).epsilon(0.1));
    CHECK_FALSE(report(folder, words).contains("wrinkle_range"));
    const std::string said = well(folder, words + range);
    CHECK(said.find("\nwrinkle range     0 to 0.7 of the length: area ") != said.npos);
}

TEST_CASE("wrinkles: a color's channel says where, on refined meshes, and in body files too") {
    const Folder folder;
    base(folder);
    mesh::Mesh painted = mesh::load(folder / "base.ply");
    for (const glm::vec3& p : painted.positions) painted.colors.emplace_back(0.25f, p.z > 7 ? 0 : 1, 0, 1);
    for (const std::string name : {"painted.ply", "painted.glb"}) {
        mesh::save(painted, folder / name);
        const auto ends = [&](const Words& more) {
            well(folder, Words{"bend", name, "-o", "out.ply", "--amplitude", "paper"} + more);
            mesh::Mesh bent = mesh::load(folder / "out.ply"), above;
            for (std::size_t i = 0; i < painted.positions.size(); ++i) {
                if (painted.positions[i].z > 7) above.positions.push_back(bent.positions[i]);
            }
            return above;
        };
        const Words mask{"--wrinkle-mask", "COLOR_0.g"};
        CHECK(farthest(ends(mask), ends({"--folds", "0"})) < 1e-5);
        CHECK(farthest(ends({}), ends({"--folds", "0"})) > 0.05);
        const Result alpha = run(folder, Words{"bend", name, "-o", "out.ply", "--amplitude", "paper",
                                               "--wrinkle-mask", "COLOR_0.a"});
        CHECK(alpha.err.find("COLOR_0.a is 1 at every vertex: nothing stays smooth") != std::string::npos);
        const mesh::Mesh all = mesh::load(folder / "out.ply");
        well(folder, Words{"bend", name, "-o", "out.ply", "--amplitude", "paper"});
        CHECK(farthest(all, mesh::load(folder / "out.ply")) == 0);
        const double whole = farthest(ends({}), ends({"--folds", "0"}));
        CHECK(farthest(ends({"--wrinkle-mask", "COLOR_0.r"}), ends({"--folds", "0"})) ==
              doctest::Approx(whole / 4).epsilon(0.02));  // colors may be bytes

        well(folder, Words{"bake", name, "-o", "body.goffer", "--amplitude", "paper"} + mask);
        well(folder, {"bend", "body.goffer", "-o", "baked.ply"});
        well(folder, Words{"bend", name, "-o", "out.ply", "--amplitude", "paper", "--refine", "off"} + mask);
        CHECK(farthest(mesh::load(folder / "baked.ply"), mesh::load(folder / "out.ply")) < 1e-6);
    }
    const Words words{"bend", "painted.ply", "-o", "out.ply", "--wrinkle-mask", "COLOR_0.g"};
    const json all = report(folder, words);
    CHECK(all["wrinkle_mask"]["channel"] == "COLOR_0.g");
    CHECK(std::abs(all["wrinkle_mask"]["area_change_inside"].get<double>()) < 2e-3);
    CHECK(all["wrinkle_mask"]["area_change_outside"].get<double>() == doctest::Approx(-0.157).epsilon(0.1));
    CHECK(well(folder, words).find("\nwrinkle mask      COLOR_0.g: area ") != std::string::npos);
    const Result bare = run(folder, {"bend", "base.ply", "-o", "out.ply", "--wrinkle-mask", "COLOR_0.g"});
    CHECK(bare.code == 1);
    CHECK(bare.err.find("base.ply: has no vertex colors for --wrinkle-mask") != std::string::npos);
}

TEST_CASE("wrinkles: a range that is too short for folds is named") {
    const Folder folder;
    base(folder);
    const Result result = run(folder, {"bend", "base.ply", "-o", "out.ply", "--wrinkle-range", "0.5,0.55"});
    CHECK(result.code == 0);
    CHECK(result.err.find("--wrinkle-range leaves") != result.err.npos);
}

TEST_CASE("wrinkles: a body is as thick as it is, and its report can be read again") {
    const std::filesystem::path file = model("wine_bottle.glb");
    if (file.empty()) return;
    const Folder folder;
    const auto fit = [&](const Words& words) {
        return report(folder, Words{"bend", file.string(), "-o", "out.glb"} + words)["fit"];
    };
    CHECK_FALSE(fit({"--shape", "cylinder"}).contains("radii"));
    const json found = fit({});
    REQUIRE(found.contains("radii"));
    const auto radii = found["radii"].get<std::vector<double>>();
    const auto [thinnest, thickest] = std::ranges::minmax(radii);
    CHECK(thickest > 2 * thinnest);  // than the neck
    CHECK(thickest > found["radius"].get<double>());
    const std::string fitted = bent_file(folder, file.string(), {});
    for (const std::string command : {"inspect", "bend"}) {
        CAPTURE(command);
        Words words{command, file.string(), "--json", "fit.json"};
        if (command == "bend") words = words + Words{"-o", "out.glb"};
        well(folder, words);
        CHECK((bent_file(folder, file.string(), {"--fit", "fit.json"}) == fitted));
    }
    CHECK_FALSE(fit({"--fit", "fit.json", "--shape", "cylinder"}).contains("radii"));
    const std::string said = well(folder, {"inspect", file.string()});
    CHECK(said.find("\nshape             radii from ") != said.npos);
}

TEST_CASE("wrinkles: wine_bottle.glb keeps its area without a word") {
    check_kept("wine_bottle.glb");
}

TEST_CASE("wrinkles: log_01.glb keeps its area without a word") {
    check_kept("log_01.glb");
}

TEST_CASE("wrinkles: fuze.ply keeps its area without a word") {
    check_kept("fuze.ply");
}
