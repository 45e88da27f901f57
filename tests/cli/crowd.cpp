// SPDX-License-Identifier: MIT
#include "crowd/crowd.hpp"

#include "command.hpp"
#include "model.hpp"
#include "support/models.hpp"
#include "support/sanitized.hpp"

#include <goffer/mesh/mesh.hpp>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

using namespace goffer;
using namespace goffer::test;
using nlohmann::json;

namespace {

/// A base cylinder that carries ten folds, of few vertices.
constexpr std::size_t vertices = 24 * 81;

std::string small_base(const Folder& folder, const std::string& name = "base.ply") {
    return base(folder, name, {"--columns", "24", "--rows", "81"});
}

json crowd(const Folder& folder, const Words& more) {
    return report(folder, Words{"crowd", "base.ply", "--instances", "20", "--frames", "9"} + more);
}

std::string hash(const Folder& folder, const Words& more) {
    return crowd(folder, more)["hash"];
}

double ratio(const json& all, const char* above, const char* below) {
    return all[above].get<double>() / all[below].get<double>();
}

}  // namespace

TEST_CASE("crowd: every field, with its type") {
    const Folder folder;
    small_base(folder);
    const json all = crowd(folder, {"--threads", "1", "--isa", "scalar"});
    CHECK(all["instances"] == 20);
    CHECK(all["vertices_per_frame"] == 20 * vertices);
    CHECK(all["bytes_per_frame"] == 20 * vertices * 12);
    CHECK(all["frames"] == 9);
    CHECK(all["threads"] == 1);
    CHECK(all["isa"] == "scalar");
    CHECK(all["streams"] == "planar");
    CHECK(all["normals"] == false);
    CHECK(all["stores"] == "automatic");
    CHECK(all["angles"] == json{90.0});
    CHECK(all["ms_median"].get<double>() > 0);
    CHECK(all["ms_p99"] >= all["ms_median"]);
    CHECK(all["clamped"] == 0);
    CHECK(all["warnings"] == json::array());
    REQUIRE(all["models"].size() == 1);
    CHECK(all["models"][0]["file"] == "base.ply");
    CHECK(all["models"][0]["vertices"] == vertices);
    CHECK(all["models"][0]["folds"] == 10);
    CHECK(all["models"][0]["max_angle"].get<double>() > 180);
    REQUIRE(all["models"][0]["regions"].size() == 1);
    CHECK(all["models"][0]["regions"][0]["folds"] == 10);
    CHECK(all["models"][0]["straightens"] == false);
    CHECK(all["models"][0]["suitability"]["shells"] == 1);
    const std::string bits = all["hash"];
    CHECK(bits.size() == 16);
    CHECK(bits.find_first_not_of("0123456789abcdef") == bits.npos);
}

TEST_CASE("crowd: rates are what times and bytes say") {
    const Folder folder;
    small_base(folder);
    const std::pair<Words, int> cases[] = {{{}, 12},
                                           {{"--normals"}, 24},
                                           {{"--streams", "interleaved"}, 12},
                                           {{"--streams", "interleaved", "--normals"}, 24},
                                           {{"--streams", "packed"}, 12},
                                           {{"--streams", "packed", "--normals"}, 12}};
    for (const auto& each : cases) {
        const Words& more = each.first;
        CAPTURE(more);
        const json all = crowd(folder, more);
        CHECK(all["normals"] ==
              (std::ranges::find(more, "--normals") != more.end() || all["streams"] == "packed"));
        CHECK(ratio(all, "bytes_per_frame", "vertices_per_frame") == each.second);
        CHECK(all["ns_per_vertex"].get<double>() ==
              doctest::Approx(1e6 * ratio(all, "ms_median", "vertices_per_frame")));
        CHECK(all["gb_per_s"].get<double>() ==
              doctest::Approx(1e-6 * ratio(all, "bytes_per_frame", "ms_median")));
        CHECK(all["floor_gb_per_s"].get<double>() > 0);
        CHECK(all["of_floor"].get<double>() == doctest::Approx(ratio(all, "gb_per_s", "floor_gb_per_s")));
    }
}

TEST_CASE("crowd: the bytes depend on neither threads nor stores") {
    const Folder folder;
    small_base(folder);
    for (const std::string streams : {"planar", "interleaved", "packed"}) {
        CAPTURE(streams);
        const Words words{"--streams", streams, "--normals"};
        const std::string one = hash(folder, words + Words{"--threads", "1", "--stores", "cached"});
        CHECK(hash(folder, words + Words{"--threads", "2", "--stores", "cached"}) == one);
        CHECK(hash(folder, words + Words{"--threads", "2", "--stores", "streaming"}) == one);
        CHECK(hash(folder, words + Words{"--threads", "1", "--stores", "streaming"}) == one);
        CHECK(hash(folder, words) == one);
    }
}

TEST_CASE("crowd: the bytes depend on everything else") {
    const Folder folder;
    small_base(folder);
    const Words others[] = {{},
                            {"--normals"},
                            {"--streams", "interleaved"},
                            {"--streams", "packed"},
                            {"--angle", "91"},
                            {"--angle", "-90"},
                            {"--regions", "0.5,0.5"},
                            {"--regions", "0.5,0.5", "--angles", "60,-60"},
                            {"--folds", "4"},
                            {"--profile", "smooth"},
                            {"--axis", "-z"}};
    std::vector<std::string> hashes;
    for (const Words& words : others) hashes.push_back(hash(folder, words));
    hashes.push_back(report(folder, {"crowd", "base.ply", "--instances", "20", "--frames", "10"})["hash"]);
    hashes.push_back(report(folder, {"crowd", "base.ply", "--instances", "21", "--frames", "9"})["hash"]);
    std::ranges::sort(hashes);
    CHECK(std::ranges::adjacent_find(hashes) == hashes.end());
}

TEST_CASE("crowd: no frame allocates") {
    const Folder folder;
    small_base(folder);
    for (const Words& words : {Words{}, {"--normals", "--stores", "streaming"}, {"--streams", "packed"}}) {
        const json count = crowd(folder, words + Words{"--threads", "1"})["allocations_per_frame"];
        if (sanitized && count.is_null()) continue;  // the sanitizer's functions are there instead of ours
        CHECK(count == 0.0);
    }
}

TEST_CASE("crowd: instances are spread evenly over the models") {
    const Folder folder;
    small_base(folder);
    base(folder, "other.ply", {"--columns", "16", "--rows", "161", "--length", "40", "--radius", "3"});
    const json all = report(folder, {"crowd", "base.ply", "other.ply", "--instances", "7", "--frames", "2"});
    CHECK(all["vertices_per_frame"] == 4 * vertices + 3 * 16 * 161);
    REQUIRE(all["models"].size() == 2);
    CHECK(all["models"][1]["file"] == "other.ply");
    const json all_of_one =
        report(folder, {"crowd", "base.ply", "base.ply", "--instances", "2", "--frames", "1"});
    CHECK(all_of_one["vertices_per_frame"] == 2 * vertices);
}

TEST_CASE("crowd: beyond the largest angle it swings as far as it can, and says so") {
    const Folder folder;
    small_base(folder);
    const json all = crowd(folder, {"--angle", "2000"});
    CHECK(all["clamped"] == 0);
    REQUIRE(all["warnings"].size() == 1);
    CHECK(all["warnings"][0].get<std::string>().find("beyond the largest") != std::string::npos);
    CHECK(all["hash"] == hash(folder, {"--angle", "3000"}));
    CHECK(all["hash"] == hash(folder, {"--angle", "1e9"}));
    const json most = crowd(folder, {"--angle", "max"});
    CHECK(most["hash"] == all["hash"]);
    CHECK(most["angles"] == json{"max"});
    CHECK(most["warnings"] == json::array());
}

TEST_CASE("crowd: regions bend on their own, each with its folds") {
    const Folder folder;
    small_base(folder);
    const Words words{"--regions", "0.3,0.4,0.3", "--angles", "40,-60,20", "--folds", "1,2,1"};
    const json all = crowd(folder, words + Words{"--threads", "1"});
    CHECK(all["angles"] == json{40.0, -60.0, 20.0});
    CHECK(all["models"][0]["folds"] == 4);
    REQUIRE(all["models"][0]["regions"].size() == 3);
    CHECK(all["models"][0]["regions"][1]["folds"] == 2);
    CHECK(all["hash"] == hash(folder, words + Words{"--threads", "2"}));
    const json beyond = crowd(folder, {"--regions", "0.5,0.5", "--angles", "40,2000"});
    REQUIRE(beyond["warnings"].size() == 1);
    CHECK(beyond["warnings"][0].get<std::string>().starts_with("region 2: the angle of 2000 degrees"));
}

TEST_CASE("crowd: a coarse model is given the vertices of its folds") {
    const Folder folder;
    base(folder, "base.ply", {"--columns", "24", "--rows", "9"});
    const json all = crowd(folder, {"--refine"});
    CHECK(all["warnings"] == json::array());
    CHECK(all["models"][0]["vertices"].get<int>() > 24 * 9);
    CHECK(all["models"][0]["folds"] == 20);
    CHECK(crowd(folder, {"--refine", "--paper"})["models"][0]["folds"] == 5);
    const json rough = crowd(folder, {});
    CHECK(rough["models"][0]["vertices"] == 24 * 9);
    CHECK(rough["models"][0]["folds"] == 0);
    CHECK(rough["warnings"].size() == 1);
}

TEST_CASE("crowd: a warning says which of several models is meant") {
    const Folder folder;
    small_base(folder);
    base(folder, "coarse.ply", {"--columns", "12", "--rows", "5"});
    const json all = report(folder, {"crowd", "base.ply", "coarse.ply", "--instances", "2", "--frames", "1"});
    REQUIRE(all["warnings"].size() == 1);
    CHECK(all["warnings"][0].get<std::string>().starts_with("coarse.ply: bent without wrinkles"));
}

TEST_CASE("crowd: a straight chain is not straightened, and more than a full turn is said") {
    const Folder folder;
    small_base(folder);
    const json chain = crowd(folder, {"--arcs", "3"});
    CHECK(chain["warnings"].dump().find("at rest") == std::string::npos);
    CHECK(chain["models"][0]["straightens"] == false);
    CHECK(chain["models"][0]["beyond_full_turn"] == false);
    base(folder, "base.ply", {"--length", "30", "--rows", "481"});
    CHECK(crowd(folder, {"--angle", "359"})["models"][0]["beyond_full_turn"] == false);
    for (const Words& words :
         {Words{"--angle", "max"}, Words{"--angle", "-361"}, Words{"--angle", "361", "--from-rest"},
          Words{"--regions", "0.5,0.5", "--angles", "200,200"}}) {
        CAPTURE(words.back());
        const json round = crowd(folder, words);
        CHECK(round["models"][0]["beyond_full_turn"] == true);
        REQUIRE(round["warnings"].size() == 1);
        CHECK(round["warnings"][0].get<std::string>().find("more than a full turn") != std::string::npos);
    }
    CHECK(crowd(folder, {"--regions", "0.5,0.5", "--angles", "200,-200"})["warnings"] == json::array());
    // From rest, instances swing each its own way: some, the way that the body is bent.
    for (const std::string direction : {"0", "90"}) {
        CAPTURE(direction);
        well(folder, {"bend", "base.ply", "--angle", "200", "--direction", direction, "--amplitude", "none",
                      "-o", "bent.ply"});
        for (const std::string angle : {"200", "-200"})
            CHECK(report(folder, {"crowd", "bent.ply", "--instances", "2", "--frames", "1", "--from-rest",
                                  "--angle", angle})["models"][0]["beyond_full_turn"] == true);
    }
}

TEST_CASE("crowd: a body that is bent at rest") {
    const Folder folder;
    small_base(folder, "straight.ply");
    well(folder, {"bend", "straight.ply", "--angle", "70", "--direction", "30", "--amplitude", "none", "-o",
                  "base.ply"});
    const json straightened = crowd(folder, {});
    REQUIRE(straightened["warnings"].size() == 1);
    CHECK(straightened["warnings"][0].get<std::string>().find("the swing straightens it") !=
          std::string::npos);
    CHECK(straightened["models"][0]["straightens"] == true);
    const json further = crowd(folder, {"--from-rest"});
    CHECK(further["warnings"] == json::array());
    CHECK(further["models"][0]["straightens"] == false);
    CHECK(further["hash"] != straightened["hash"]);
    // Not at all from the rest pose is one pose, from straight to it and back another.
    const std::string still = hash(folder, {"--from-rest", "--angle", "0"});
    CHECK(report(folder, {"crowd", "base.ply", "--instances", "20", "--frames", "50", "--from-rest",
                          "--angle", "0"})["hash"] == still);
    CHECK(hash(folder, {"--angle", "0"}) != still);
    const json beyond = crowd(folder, {"--from-rest", "--angle", "2000"});
    REQUIRE(beyond["warnings"].size() == 1);
    CHECK(
        beyond["warnings"][0].get<std::string>().starts_with("2000 degrees from the rest pose, which is 70"));
    CHECK(beyond["clamped"] == 0);
    CHECK(crowd(folder, {"--from-rest", "--angle", "max"})["hash"] == beyond["hash"]);
    CHECK(hash(folder, {"--from-rest", "--angle", "-40"}) != hash(folder, {"--from-rest", "--angle", "40"}));
    well(folder, {"bake", "base.ply", "-o", "baked.goffer"});
    const json baked = report(folder, {"crowd", "baked.goffer", "--instances", "20", "--frames", "9"});
    CHECK(baked["models"][0]["straightens"] == true);
    CHECK_FALSE(baked["models"][0].contains("suitability"));
}

TEST_CASE("crowd: from rest, instances are at the rest pose and as far from it as was asked") {
    const Folder folder;
    small_base(folder, "straight.ply");
    well(folder, {"bend", "straight.ply", "--angle", "70", "--direction", "30", "--amplitude", "none", "-o",
                  "bent.ply"});
    std::vector<cli::BoundModel> models;
    models.push_back(cli::bind_model(folder / "bent.ply", cli::BindRequest({}, {})));
    const bend::Region& region = models[0].binding.body.regions()[0];
    for (const float asked : {0.5f, -0.5f, 100.0f}) {
        cli::Crowd moving(models, {.instances = 50,
                                   .poses = {{asked, 0}},
                                   .from_rest = true,
                                   .layout = measure::stream_layout("positions")});
        float nearest = 1e9f, farthest = 0;
        for (std::size_t frame = 0; frame < 120; ++frame) {
            moving.set_poses(frame);
            for (std::size_t i = 0; i < 50; ++i) {
                const bend::Pose pose = moving.job().batches[0].poses[i];
                CHECK(pose.angle <= region.max_angle);
                const glm::vec2 from = region.rest.angle * glm::vec2(std::cos(region.rest.direction),
                                                                     std::sin(region.rest.direction));
                const glm::vec2 to =
                    pose.angle * glm::vec2(std::cos(pose.direction), std::sin(pose.direction));
                nearest = std::min(nearest, glm::distance(from, to));
                farthest = std::max(farthest, glm::distance(from, to));
            }
        }
        CHECK(nearest < 1e-3f);
        if (std::fabs(asked) < 1) {
            CHECK(farthest == doctest::Approx(std::fabs(asked)).epsilon(1e-3));
        } else {  // straight through, to the largest angle on the other side
            CHECK(farthest > 0.98f * (region.max_angle + region.rest.angle));
        }
    }
}

TEST_CASE("crowd: says which model is not a cylinder") {
    const Folder folder;
    small_base(folder);
    mesh::Mesh flat = mesh::load(folder / "base.ply");
    for (glm::vec3& p : flat.positions) p.y /= 6;
    flat.normals = {};
    mesh::save(flat, folder / "flat.ply");
    const json all = report(folder, {"crowd", "base.ply", "flat.ply", "--instances", "2", "--frames", "1"});
    CHECK(std::ranges::count_if(all["warnings"], [](const json& warning) {
              return warning.get<std::string>().starts_with("flat.ply: the body is not a cylinder");
          }) == 1);
    CHECK(all["models"][1]["suitability"]["flatness"].get<double>() > 3);
}

TEST_CASE("crowd: one instance, one frame") {
    const Folder folder;
    small_base(folder);
    const json all = report(folder, {"crowd", "base.ply", "--instances", "1", "--frames", "1"});
    CHECK(all["ms_p99"] == all["ms_median"]);
    CHECK(all["floor_gb_per_s"].get<double>() > 0);
}

TEST_CASE("crowd: what a person reads") {
    const Folder folder;
    small_base(folder);
    const std::string said = well(folder, {"crowd", "base.ply", "--instances", "3", "--frames", "3"});
    for (const std::string piece : {"3 instances", "5832 vertices a frame", "per second", "ms (median)",
                                    "ms (p99)", " ns\n", "GB/s", "of the floor", "10 folds"}) {
        CAPTURE(piece);
        CHECK(said.find(piece) != said.npos);
    }
    CHECK(folder.files() == 1);
}

TEST_CASE("crowd: the picture is what the streams hold") {
    const Folder folder;
    small_base(folder);
    const auto picture = [&](const Words& more) {
        const Words words{"crowd", "base.ply", "--instances", "2", "--frames", "30", "--png", "out.png"};
        (void)report(folder, words + more);
        return bytes_of(folder / "out.png");
    };
    const std::string planar = picture({});
    CHECK(planar.size() > 10000);
    const bool same = picture({"--streams", "interleaved", "--normals"}) == planar;
    CHECK(same);
    const bool other = picture({"--angle", "20"}) != planar;
    CHECK(other);
}

TEST_CASE("crowd: bad words") {
    const Folder folder;
    small_base(folder);
    for (const std::string name : {"out.png", "out.json"}) folder.write(name, "kept");
    const auto refuse = [&](const Words& words, const Words& pieces) {
        refused(folder, 2, Words{"crowd", "base.ply"} + words, pieces);
    };
    refused(folder, 2, {"crowd"}, {"models is required"});
    refused(folder, 2, {"crowd", "--instances", "4"}, {"models is required"});
    for (const std::string option : {"--instances", "--frames"}) {
        for (const std::string word : {"0", "-1", "1000001", "1.5", "many", ""})
            refuse({option, word}, {option});
    }
    for (const std::string word : {"-1", "1025", "x"}) refuse({"--threads", word}, {"--threads"});
    for (const std::string word : {"nan", "inf", "", "90deg"})
        refuse({"--angle", word}, {"--angle", "degrees or max"});
    refuse({"--regions", "0.5,0.6"}, {"--regions", "1.1", "make it 1"});
    refuse({"--regions", "0.5,0.5", "--angles", "40"}, {"--angles", "1 for 2 regions"});
    refuse({"--angles", "40"}, {"--angles", "--regions"});
    refuse({"--streams", "soa"}, {"--streams", "soa", "planar", "interleaved", "packed"});
    refuse({"--stores", "nt"}, {"--stores", "nt", "automatic", "cached", "streaming"});
    refuse({"--isa", "mmx"}, {"--isa", "mmx", "scalar"});
    refuse({"--axis", "0,0,0"}, {"--axis", "three finite numbers"});
    refuse({"--folds", "513"}, {"--folds"});
    refuse({"--fit", "fit.json"}, {"--fit"});
    refuse({"-o", "out.ply"}, {"-o"});
    refuse({"base.ply", "base.ply", "--instances", "2"}, {"--instances", "2", "3 models"});
    refuse({"--png", "out.jpg"}, {"--png", "out.jpg", ".png"});
    refuse({"--png", "out.png", "--json", "out.png"}, {"--json", "out.png", "--png"});
    refuse({"--json", "base.ply"}, {"--json", "base.ply", "MODEL"});
}

TEST_CASE("crowd: bad files, and more than memory holds") {
    const Folder folder;
    small_base(folder);
    folder.write("out.png", "kept");
    folder.write("broken.ply", "ply\n");
    const auto refuse = [&](const Words& words, const Words& pieces) {
        refused(folder, 1, Words{"crowd", "base.ply"} + words, pieces);
    };
    refuse({"none.ply", "--png", "out.png"}, {"none.ply"});
    refuse({"broken.ply", "--png", "out.png"}, {"broken.ply"});
    refuse({"--png", "none/out.png"}, {"none"});
    refuse({"--json", "none/out.json"}, {"none"});
    base(folder, "fine.ply", {"--columns", "100", "--rows", "2001"});
    refuse({"fine.ply", "--instances", "1000000", "--normals", "--png", "out.png"},
           {"--instances", "1000000", "GB", "use fewer"});
}
