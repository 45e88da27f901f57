// SPDX-License-Identifier: MIT
#include "command.hpp"
#include "support/rounds.hpp"

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

/// Angles that count from straight (--angle) and from the rest pose (--by), and the largest one.

using namespace goffer;
using namespace goffer::test;
using nlohmann::json;

namespace {

constexpr double radians_per_degree = std::numbers::pi / 180;

/// A base cylinder that is bent by 70 degrees toward 30 in its file.
struct Bent {
    Folder folder;

    Bent() {
        base(folder);
        well(folder, {"bend", "base.ply", "--angle", "70", "--direction", "30", "--amplitude", "none", "-o",
                      "bent.ply"});
    }

    [[nodiscard]] json bend(const Words& words, const std::string& model = "bent.ply") const {
        return report(folder, Words{"bend", model, "--axis", "z", "-o", "out.ply"} + words);
    }

    [[nodiscard]] json pose(const Words& words) const { return bend(words)["pose"]; }
};

void check_pose(const json& pose, double angle, double direction) {
    CAPTURE(pose.dump());
    CHECK(std::abs(pose["angle"].get<double>() - angle) < 1e-3);
    CHECK(std::abs(std::remainder(pose["direction"].get<double>() - direction, 360)) < 1e-3);
}

/// Angle and direction of the sum of two bends.
std::pair<double, double> sum(double a, double at, double b, double bt) {
    const double x = a * std::cos(at * radians_per_degree) + b * std::cos(bt * radians_per_degree);
    const double y = a * std::sin(at * radians_per_degree) + b * std::sin(bt * radians_per_degree);
    return {std::hypot(x, y), std::atan2(y, x) / radians_per_degree};
}

}  // namespace

TEST_CASE("from rest: by 0 is the shape of the file") {
    const Bent bent;
    const json all = bent.bend({"--by", "0"});
    check_pose(all["pose"], 70, 30);
    CHECK(all["asked_from"] == "rest");
    CHECK(all["straightens"] == false);
    CHECK(farthest(mesh::load(bent.folder / "bent.ply"), mesh::load(bent.folder / "out.ply")) < 1e-5);
}

TEST_CASE("from rest: without a direction it bends on in the plane of the rest arc") {
    const Bent bent;
    check_pose(bent.pose({"--by", "25"}), 95, 30);
    check_pose(bent.pose({"--by", "-25"}), 45, 30);
    check_pose(bent.pose({"--by", "-100"}), -30, 30);
    // The same mesh as with the angle from straight.
    (void)bent.bend({"--by", "25"});
    const mesh::Mesh by = mesh::load(bent.folder / "out.ply");
    (void)bent.bend({"--angle", "95", "--direction", "30"});
    CHECK(farthest(by, mesh::load(bent.folder / "out.ply")) < 1e-3);
}

TEST_CASE("from rest: with a direction, bends are added as vectors") {
    const Bent bent;
    for (const double by : {40.0, -40.0, 3.0}) {
        for (const double direction : {30.0, 120.0, 210.0, -75.0}) {
            CAPTURE(by);
            CAPTURE(direction);
            const auto [angle, toward] = sum(70, 30, by, direction);
            check_pose(bent.pose({"--by", std::to_string(by), "--direction", std::to_string(direction)}),
                       angle, toward);
        }
    }
}

TEST_CASE("from rest: without a direction, an angle is one in the plane of the rest arc") {
    const Bent bent;
    check_pose(bent.pose({"--angle", "90"}), 90, 30);
    check_pose(bent.pose({"--angle", "-20"}), -20, 30);
    check_pose(bent.pose({"--angle", "90", "--direction", "0"}), 90, 0);
    const json regions = bent.bend({"--regions", "0.5,0.5", "--angles", "40,-30"})["poses"];
    check_pose(regions[0], 40, 30);
    check_pose(regions[1], -30, 30);
}

TEST_CASE("from rest: a straight body is bent as by --angle, to the byte") {
    const Folder folder;
    base(folder);
    for (const Words& more : {Words{}, Words{"--direction", "40"}, Words{"--regions", "0.3,0.7"}}) {
        well(folder, Words{"bend", "base.ply", "-o", "a.ply", "--angle", "-50"} + more);
        well(folder, Words{"bend", "base.ply", "-o", "b.ply", "--by", "-50"} + more);
        CHECK(bytes_of(folder / "a.ply") == bytes_of(folder / "b.ply"));
    }
    const std::string lines = well(folder, {"bend", "base.ply", "-o", "a.ply", "--angle", "10"});
    CHECK(lines.find("absolute") == lines.npos);
    CHECK(lines.find("straightens") == lines.npos);
}

TEST_CASE("from rest: a body that can be bent no further says so, whatever is asked for") {
    const Folder folder;
    base(folder, "base.ply", {"--length", "7", "--radius", "1"});
    well(folder, {"bend", "base.ply", "--angle", "170", "--amplitude", "none", "-o", "bent.ply"});
    mesh::Mesh mesh = mesh::load(folder / "bent.ply");
    const float center = 7 / static_cast<float>(170 * radians_per_degree) - 1;
    glm::vec3& inner = *std::ranges::min_element(
        mesh.positions, {}, [&](const glm::vec3& p) { return glm::length(p - glm::vec3(center, 0, 0)); });
    inner += 0.999f * (glm::vec3(center, 0, 0) - inner);
    mesh::save(mesh, folder / "bent.ply");
    for (const Words& words : {Words{"--by", "20"}, {"--angle", "max"}, {"--angle", "200"}, {}}) {
        const json all = report(
            folder, Words{"bend", "bent.ply", "--axis", "x", "--refine", "off", "-o", "out.ply"} + words);
        CAPTURE(all.dump());
        const auto said = all["warnings"][0].get<std::string>();
        CHECK(said.find("the body is bent at rest by 1") != said.npos);
        CHECK(said.starts_with("the angle of ") == (!words.empty() && words[1] != "max"));
        CHECK(all["max_angle"].get<double>() == doctest::Approx(all["fit"]["rest_angle"].get<double>()));
        CHECK(farthest(mesh, mesh::load(folder / "out.ply")) < 0.01);
    }
}

TEST_CASE(
    "from rest: where no word says how far, a bent body bends by 90 degrees more, or as far as it can") {
    const Bent bent;
    const json all = bent.bend({});
    check_pose(all["pose"], 160, 30);
    CHECK(all["asked_from"] == "rest");
    CHECK(all["straightens"] == false);
    const auto [angle, toward] = sum(70, 30, 90, 120);
    check_pose(bent.pose({"--direction", "120"}), angle, toward);
    const json straight = bent.bend({}, "base.ply");
    check_pose(straight["pose"], 90, 0);
    CHECK(straight["asked_from"] == "straight");

    base(bent.folder, "thick.ply", {"--length", "5", "--radius", "1"});
    well(bent.folder, {"bend", "thick.ply", "--angle", "70", "--amplitude", "none", "-o", "hook.ply"});
    for (const Words& words : {Words{}, {"--regions", "0.3,0.7"}}) {
        const json limited = bent.bend(words, "hook.ply");
        CAPTURE(limited.dump());
        for (std::size_t r = 0; r < limited["poses"].size(); ++r)
            CHECK(limited["poses"][r]["angle"].get<double>() ==
                  doctest::Approx(limited["regions"][r]["max_angle"].get<double>()).epsilon(1e-6));
        CHECK(limited["max_angle"].get<double>() < 159);
        CHECK(limited["clamped"] == false);
        CHECK(limited["warnings"] == json::array());
    }
}

TEST_CASE("from rest: regions share it by their lengths") {
    const Bent bent;
    const json plain = bent.bend({"--by", "20", "--regions", "0.25,0.75"})["poses"];
    check_pose(plain[0], 90 * 0.25, 30);
    check_pose(plain[1], 90 * 0.75, 30);
    CHECK(std::abs(plain[1]["rest_angle"].get<double>() - 70 * 0.75) < 1e-3);
    const json apart =
        bent.bend({"--by", "20", "--regions", "0.25,0.75", "--directions", "120,210"})["poses"];
    for (const int i : {0, 1}) {
        const double share = i == 0 ? 0.25 : 0.75;
        const auto [angle, toward] = sum(70 * share, 30, 20 * share, i == 0 ? 120 : 210);
        check_pose(apart[static_cast<std::size_t>(i)], angle, toward);
    }
}

TEST_CASE("from rest: a bend that straightens says so in one line, and names --by") {
    const Bent bent;
    const auto said = [&](const Words& words) {
        const Words all = Words{"bend", "bent.ply", "--axis", "z", "-o", "out.ply"} + words;
        const Result result = run(bent.folder, all);
        CHECK(result.code == 0);
        const std::string lines = result.out;
        const bool stretched = result.err.find("straightening stretches the inner side") != lines.npos;
        CHECK((stretched || result.err.empty()));
        CHECK(lines.find("are absolute: 0 is straight") != lines.npos);
        const bool note = lines.find("straightens") != lines.npos;
        CHECK(note == (lines.find("--by D") != lines.npos));
        if (note) CHECK(stretched);  // by 2 % or more
        return note;
    };
    CHECK(said({"--angle", "0"}));
    CHECK(said({"--angle", "60", "--direction", "30"}));
    CHECK(said({"--angle", "60", "--direction", "5"}));
    CHECK(said({"--angle", "-60", "--direction", "210"}));
    CHECK(said({"--angle", "50", "--direction", "30", "--regions", "0.5,0.5"}));
    CHECK(said({"--angle", "60"}));
    CHECK_FALSE(said({"--angle", "-60"}));
    CHECK_FALSE(said({"--angle", "69.9", "--direction", "30"}));  // the rest pose, rounded
    CHECK_FALSE(said({"--angle", "80", "--direction", "30"}));
    CHECK_FALSE(said({"--angle", "60", "--direction", "210"}));
    CHECK_FALSE(said({"--angle", "-60", "--direction", "30"}));
    CHECK_FALSE(said({"--by", "-20"}));  // as asked
    CHECK(bent.bend({"--by", "-20"})["straightens"] == true);
    CHECK(bent.bend({"--angle", "60", "--direction", "30"})["straightens"] == true);
    CHECK(bent.bend({"--angle", "60", "--direction", "120"})["straightens"] == false);
}

TEST_CASE("from rest: the largest angle has a name") {
    const Bent bent;
    for (const std::string model : {"base.ply", "bent.ply"}) {
        CAPTURE(model);
        const json most = bent.bend({"--angle", "max", "--direction", "20"}, model);
        const mesh::Mesh by_name = mesh::load(bent.folder / "out.ply");
        CHECK(most["pose"]["angle"] == most["max_angle"]);
        CHECK(most["clamped"] == false);
        CHECK(most["warnings"] == json::array());
        const json clamped = bent.bend({"--angle", "1e6", "--direction", "20"}, model);
        CHECK(clamped["clamped"] == true);
        CHECK(farthest(by_name, mesh::load(bent.folder / "out.ply")) == 0);
        const json other = bent.bend({"--angle=-max"}, model);
        CHECK(other["pose"]["angle"].get<double>() == -most["max_angle"].get<double>());
        const json plain = bent.bend({"--by", "max"}, model);
        CHECK(plain["pose"]["angle"] == plain["max_angle"]);
        CHECK(plain["warnings"] == json::array());
    }
    const json regions = bent.bend({"--regions", "0.5,0.5", "--angles", "max,-max"}, "base.ply");
    CHECK(regions["clamped"] == false);
    CHECK(regions["poses"][0]["angle"] == regions["regions"][0]["max_angle"]);
    CHECK(regions["poses"][1]["angle"].get<double>() == -regions["regions"][1]["max_angle"].get<double>());
}

TEST_CASE("from rest: by max with a direction goes that way until the angle is the largest") {
    const Bent bent;
    for (const double direction : {120.0, 200.0, 30.0}) {
        for (const std::string by : {"--by=max", "--by=-max"}) {
            CAPTURE(direction);
            CAPTURE(by);
            const json all = bent.bend({by, "--direction", std::to_string(direction)});
            CHECK(all["warnings"] == json::array());
            CHECK(all["pose"]["angle"] == all["max_angle"]);
            const auto [way, toward] =
                sum(all["pose"]["angle"].get<double>(), all["pose"]["direction"].get<double>(), -70, 30);
            const double expected = by == "--by=max" ? direction : direction + 180;
            CHECK(std::abs(std::remainder(toward - expected, 360)) < 1e-3);
            CHECK(way > 0);
        }
    }
}

TEST_CASE("from rest: any finite number beyond the largest is clamped, with the same warning") {
    const Bent bent;
    std::vector<std::string> beyond{"3600", "-1e9", "1e300"};
    if (all_rounds()) beyond.insert(beyond.end(), {"36001", "100000", "1e9", "-1.7e308"});
    for (const std::string& angle : beyond) {
        for (const std::string option : {"--angle", "--by"}) {
            CAPTURE(angle);
            CAPTURE(option);
            const json all = bent.bend({option, angle});
            CHECK(all["clamped"] == true);
            CHECK(std::abs(all["pose"]["angle"].get<double>()) == all["max_angle"].get<double>());
            REQUIRE(all["warnings"].size() == 1);
            const std::string warning = all["warnings"][0];
            CHECK(warning.starts_with("the angle of "));
            CHECK(warning.ends_with("fold through itself; clamped to it"));
        }
    }
    const json turned = bent.bend({"--angle", "40", "--direction", "36000030"}, "base.ply");
    CHECK(turned["warnings"] == json::array());
    const mesh::Mesh far = mesh::load(bent.folder / "out.ply");
    (void)bent.bend({"--angle", "40", "--direction", "30"}, "base.ply");
    CHECK(farthest(far, mesh::load(bent.folder / "out.ply")) < 1e-6);
}

TEST_CASE("from rest: what does not go together, and help that says what counts from where") {
    const Bent bent;
    const Words bend{"bend", "bent.ply", "-o", "new.ply"};
    refused(bent.folder, 2, bend + Words{"--by", "1", "--angle", "2"}, {"--by", "--angle"});
    refused(bent.folder, 2, bend + Words{"--by", "1", "--regions", "0.5,0.5", "--angles", "1,2"},
            {"--by", "--angles"});
    for (const std::string word : {"most", "nan", "inf", "", "1,2"})
        refused(bent.folder, 2, bend + Words{"--by", word}, {"--by", "'" + word + "'", "degrees or max"});
    const std::string help = well(bent.folder, {"bend", "--help"});
    CHECK(help.find("Angles are absolute") != help.npos);
    CHECK(help.find("--by FLOAT|max") != help.npos);
    CHECK(run(bent.folder, {"crowd", "base.ply", "--by", "3"}).code == 2);
}

TEST_CASE("from rest: a swing from straight says so, and names --from-rest") {
    const Bent bent;
    const auto said = [&](const Words& words) {
        const Words all{"animate", "bent.ply", "--axis", "z",  "--swing",
                        "30",      "--frames", "4",      "-o", "out.glb"};
        const Result result = run(bent.folder, all + words);
        CHECK(result.code == 0);
        const bool warned = result.err.find("straightening stretches the inner side") != std::string::npos &&
                            result.err.find("use --from-rest") != std::string::npos;
        CHECK(warned != result.err.empty());
        CHECK(warned == (result.out.find("to swing from there, use --from-rest") != std::string::npos));
        return warned;
    };
    CHECK(said({}));
    CHECK_FALSE(said({"--from-rest"}));
}
