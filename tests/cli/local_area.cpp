// SPDX-License-Identifier: MIT
#include "command.hpp"
#include "pixels.hpp"
#include "support/models.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

/// The change of area here and there: in the report, and as colors of the picture.

using namespace goffer;
using namespace goffer::test;
using nlohmann::json;

namespace {

constexpr double kappa = std::numbers::pi / 2 * 1 / 10;  // 90 degrees, r = 1, L = 10

json local(const Folder& folder, const Words& words) {
    return report(folder, Words{"bend", "base.ply", "-o", "out.ply"} + words)["local_area_change"];
}

/// How many pixels of a picture are much bluer than red, and the other way round.
std::pair<std::size_t, std::size_t> blue_and_red(const std::filesystem::path& file) {
    const Pixels pixels(file);
    std::size_t blue = 0, red = 0;
    for (std::size_t i = 0; i < pixels.bytes.size(); i += 3) {
        blue += pixels.bytes[i + 2] > pixels.bytes[i] + 40 ? 1 : 0;
        red += pixels.bytes[i] > pixels.bytes[i + 2] + 40 ? 1 : 0;
    }
    return {blue, red};
}

}  // namespace

TEST_CASE("local area: the bare bend changes sides as eq 9 says") {
    const Folder folder;
    base(folder);
    // A column at beta loses kappa (1 + cos beta); a side is a quarter turn about its middle.
    const double mean = std::sin(std::numbers::pi / 4) / (std::numbers::pi / 4);
    const double inner = kappa * (1 + mean), outer = kappa * (1 - mean);
    const double rms = std::sqrt((inner * inner + outer * outer + 2 * kappa * kappa) / 4);
    for (const std::string direction : {"0", "90", "180"}) {
        CAPTURE(direction);
        const json all = local(folder, {"--direction", direction, "--amplitude", "none"});
        CHECK(all["slices"] == 12);
        CHECK(all["sides"] == 4);
        CHECK(all["patches"] == 48);
        CHECK(std::abs(all["bent"]["rms"].get<double>() - rms) < 1e-3 * rms);
        CHECK(std::abs(all["bent"]["worst"].get<double>() + inner) < 2e-3 * inner);
        CHECK(all["bent"]["worst_side"] == std::stoi(direction) / 90);
        CHECK(all["bent"] == all["without_wrinkles"]);
    }
}

TEST_CASE("local area: wrinkles give some of it back, and the report says both") {
    const Folder folder;
    base(folder);
    const json all = local(folder, {"--paper"});
    const json bare = local(folder, {"--amplitude", "none"});
    CHECK(all["without_wrinkles"] == bare["bent"]);
    CHECK(all["bent"]["rms"].get<double>() < 0.9 * bare["bent"]["rms"].get<double>());
    // By the paper, they are deepest at mid-length: there the inner side gets more area than it had.
    CHECK(all["bent"]["worst"].get<double>() > 0.2);
    CHECK(all["bent"]["worst_side"] == 0);
    CHECK(std::abs(all["bent"]["worst_slice"].get<double>() - 5.5) < 1);
    // Folds of one depth give it back where it is missing.
    const json even = local(folder, {});
    CHECK(even["without_wrinkles"] == bare["bent"]);
    CHECK(even["bent"]["rms"].get<double>() < 0.2 * bare["bent"]["rms"].get<double>());
    CHECK(std::abs(even["bent"]["worst"].get<double>()) < 0.12);
    const std::string lines = well(folder, {"bend", "base.ply", "-o", "out.ply", "--paper"});
    CHECK(lines.find("\nlocal change      rms ") != lines.npos);
    CHECK(lines.find("of 48 patches\nwithout wrinkles  rms ") != lines.npos);
    CHECK(lines.find("side toward 0)") != lines.npos);
}

TEST_CASE("local area: without options, real models keep it several times better than by the paper") {
    const Folder folder;
    std::vector<double> over_paper;
    for (const std::string name :
         {"log_01.glb", "wine_bottle.glb", "fuze.ply", "blub_open.obj", "insect_leg.glb"}) {
        // One is bent at rest.
        const std::string file = model(name).string(), turn = name == "insect_leg.glb" ? "--by" : "--angle";
        CAPTURE(name);
        const auto rms = [&](const Words& words) {
            const json all = report(folder, Words{"bend", file, "-o", "out.ply", turn, "60"} + words);
            return all["local_area_change"]["bent"]["rms"].get<double>();
        };
        over_paper.push_back(rms({}) / rms({"--paper", "--refine", "on"}));
        CHECK(over_paper.back() < (name == "blub_open.obj" ? 0.9 : 0.8));  // which has fins
    }
    std::ranges::sort(over_paper);
    CHECK(over_paper[over_paper.size() / 2] < 0.25);
}

TEST_CASE("local area: where it changes much, one line says why, unless somebody said how to wrinkle") {
    const Folder folder;
    copy_of(folder, "blub_open.obj");
    const auto said = [&](const Words& words) {
        const json all = report(folder, Words{"bend", "blub_open.obj", "-o", "out.ply"} + words);
        return std::ranges::any_of(all["warnings"], [](const json& warning) {
            return warning.get<std::string>().starts_with("the area is kept in all, but changes by");
        });
    };
    CHECK(said({"--angle", "80"}));
    CHECK_FALSE(said({"--angle", "80", "--amplitude", "none"}));
    CHECK_FALSE(said({"--angle", "20"}));
    CHECK_FALSE(said({"--angle", "80", "--profile", "damped"}));
}

TEST_CASE("local area: regions, whose vertices are in another order, are as one") {
    const Folder folder;
    base(folder);
    const Words turned{"--axis", "-z", "--folds", "0"};
    const json one = local(folder, turned);
    const json several = local(folder, turned + Words{"--regions", "0.2,0.5,0.3"});
    for (const std::string mesh : {"bent", "without_wrinkles"}) {
        CAPTURE(mesh);
        CHECK(std::abs(one[mesh]["rms"].get<double>() - several[mesh]["rms"].get<double>()) < 1e-6);
        CHECK(std::abs(one[mesh]["worst"].get<double>() - several[mesh]["worst"].get<double>()) < 1e-5);
    }
}

TEST_CASE("show: area is blue where it shrank, white where it was kept, and the scale is said") {
    const Folder folder;
    base(folder);
    const auto shown = [&](const Words& words) {
        const json all =
            report(folder, Words{"bend", "base.ply", "-o", "out.ply", "--png", "out.png"} + words);
        return std::pair(blue_and_red(folder / "out.png"), all);
    };
    const Words bare{"--amplitude", "none", "--angle", "150"};
    const auto [bent, all] = shown(bare + Words{"--show", "area"});
    CHECK(bent.first > 20000);
    CHECK(bent.second == 0);
    CHECK(all["show"] == json{{"quantity", "area"}, {"blue", -0.5}, {"white", 0}, {"red", 0.5}});
    const auto kept = shown({"--angle", "0", "--show", "area"}).first;
    CHECK(kept.first == 0);
    CHECK(kept.second == 0);
    const auto [plain, without] = shown(bare);
    CHECK(plain.first == 0);
    CHECK(plain.second > 20000);  // the color of models without materials
    CHECK_FALSE(without.contains("show"));
    const Words words{"bend", "base.ply", "-o", "out.ply", "--png", "out.png", "--show", "area"};
    CHECK(well(folder, words).find("blue -50 % or less, white 0, red +50 % or more") != std::string::npos);
}

TEST_CASE("show: red is where it grew") {
    const Folder folder;
    base(folder);
    // Straightened, a body that was bent without wrinkles is longer on its inner side.
    well(folder, {"bend", "base.ply", "--angle", "80", "--amplitude", "none", "-o", "bent.ply"});
    (void)report(folder, {"bend", "bent.ply", "--axis", "z", "--angle", "0", "--direction", "0", "--show",
                          "area", "--png", "out.png", "-o", "out.ply"});
    CHECK(blue_and_red(folder / "out.png").second > 20000);
}

TEST_CASE("show: belongs to a picture, and knows its words") {
    const Folder folder;
    base(folder);
    refused(folder, 2, {"bend", "base.ply", "-o", "new.ply", "--show", "area"}, {"--show", "--png"});
    refused(folder, 2, {"bend", "base.ply", "-o", "new.ply", "--png", "a.png", "--show", "heat"},
            {"--show", "heat", "area"});
}
