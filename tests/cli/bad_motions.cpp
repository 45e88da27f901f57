// SPDX-License-Identifier: MIT
#include "command.hpp"
#include "key.hpp"
#include "motion/motion.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <stdexcept>

/// Motions that are refused, each in one line that says where.

using namespace goffer;
using namespace goffer::test;
using nlohmann::json;

namespace {

void check_refused(const json& document, const std::string& piece, std::size_t regions = 2) {
    CAPTURE(document.dump());
    std::string said = "nothing";
    try {
        (void)cli::read_motion(document, regions, "keys.json");
    } catch (const std::runtime_error& error) {
        said = error.what();
    }
    CAPTURE(said);
    CHECK(said.starts_with("keys.json: "));
    CHECK(said.find(piece) != said.npos);
    CHECK(said.find('\n') == said.npos);
}

}  // namespace

TEST_CASE("motion: documents that are refused, in one line that says where") {
    const auto keys = [](const json& second) { return json{{"keys", {key(0, 0), second}}}; };
    check_refused(json::array(), "is not a JSON object");
    check_refused(json::object(), "says no motion");
    check_refused({{"keys", 3}}, "two keys or more");
    check_refused({{"keys", {key(0, 0)}}}, "two keys or more");
    check_refused({{"keys", {key(0, 0), 5}}}, "keys[1]: is not a JSON object");
    check_refused(keys({{"angle", 5}}), "keys[1]: has no \"time\"");
    check_refused(keys({{"time", 1}}), "keys[1]: has no \"angle\"");
    check_refused(keys(key(0, 5)), "keys[1]: time: is not after the key before it");
    check_refused({{"keys", {key(2, 0), key(1, 5)}}}, "sort the keys");
    check_refused(keys(key(-1, 5)), "time: is not a number within 0..1e+06");
    check_refused(keys(key(1e300, 5)), "time: ");
    check_refused(keys(key(1, 1e300)), "angle: is not an angle in degrees");
    check_refused(keys(key(1, NAN)), "angle: is not an angle");
    check_refused(keys(key(1, 5, 1e300)), "direction: ");
    check_refused(keys({{"time", 1}, {"angle", "far"}}), "angle: ");
    check_refused(keys({{"time", 1}, {"angles", {1, 2, 3}}}), "angles: 3 for 2 regions");
    check_refused(keys({{"time", 1}, {"angles", {1, 2}}, {"directions", {1}}}),
                  "directions: 1 for 2 regions");
    check_refused(keys({{"time", 1}, {"angles", 5}}), "angles: is not an array");
    check_refused(keys({{"time", 1}, {"angle", 5}, {"angles", {5, 5}}}), "give one of them");
    check_refused(keys({{"time", 1}, {"angle", 5}, {"angel", 6}}), "\"angel\" is not a field here");
    check_refused({{"keys", {key(0, 0), key(1, 5)}}, {"interpolation", "bouncy"}},
                  "give one of smooth, linear");
    check_refused({{"keys", {key(0, 0), key(1, 5)}}, {"repeat", true}}, "differs from the first");
    check_refused({{"keys", {key(0, 0), key(1, 5)}}, {"seconds", 3}}, "\"seconds\" is not a field here");
    check_refused({{"keys", {key(0, 0), key(1e-5, 5)}}}, "end within");
    check_refused({{"swing", 30}}, "has no \"seconds\"");
    check_refused({{"swing", 30}, {"seconds", 0}}, "seconds: ");
    check_refused({{"swing", {{"too", 5}}}, {"seconds", 1}}, "swing: has no \"to\"");
    check_refused({{"path", {{0, 0, 0}}}, {"seconds", 1}}, "fewer than two points");
    check_refused({{"path", {{0, 0, 0}, {0, 0, 0}}}, {"seconds", 1}}, "all points are the same");
    check_refused({{"path", {{0, 0, 0}, {0, 1}}}, {"seconds", 1}}, "path[1]: is not a point");
    check_refused({{"path", {{0, 0, 0}, {0, 1, 1e300}}}, {"seconds", 1}}, "path[1]: is not a number");
    check_refused({{"path", {{"bezier", {{{0, 0, 0}, {1, 1, 1}}}}}}, {"seconds", 1}}, "four control points");
    check_refused({{"path", {{"points", {{0, 0, 0}, {1, 1, 1}}}, {"curve", "wavy"}}}, {"seconds", 1}},
                  "curve");
    const json path{{0, 0, 0}, {0, 0, 9}}, longer{{0, 0, 0}, {0, 0, 9}, {0, 0, 10}};
    check_refused({{"keys", {{{"time", 0}, {"path", path}}, {{"time", 1}, {"path", longer}}}}},
                  "differs in kind or in its number of points");
}

TEST_CASE("animate: what is refused, in one line, and nothing written") {
    const Folder folder;
    base(folder);
    folder.write("keys.json", R"({"keys": [{"time": 0, "angle": 0}, {"time": 2, "angle": 60}]})");
    folder.write("path.txt", "0 0 0\n5 0 10\n0 3 20\n10 0 30\n20 -5 20\n");
    const Words model{"animate", "base.ply", "-o"};
    refused(folder, 2, model + Words{"f%d.ply"}, {"--keys FILE, --swing D or --path FILE"});
    refused(folder, 2, model + Words{"f.ply", "--swing", "9"}, {"f.ply", "f_%04d.ply"});
    refused(folder, 2, model + Words{"f%d.mdd", "--swing", "9"}, {"all frames in one file"});
    refused(folder, 2, model + Words{"f%d.fbx", "--swing", "9"}, {"no known ending", "%04d.obj"});
    for (const std::string name : {"f%x.ply", "f%4d.ply", "f%d%d.ply", "f%00d.ply", "f%.ply"})
        refused(folder, 2, model + Words{name, "--swing", "9"}, {"is not a pattern"});
    const Words to = model + Words{"f%d.ply"};
    for (const std::string angle : {"nan", "1,2,3", "far", ""})
        refused(folder, 2, to + Words{"--swing", angle}, {"--swing"});
    for (const std::string frames : {"0", "-1", "1000001", "1e9", "99999999999999999999"})
        refused(folder, 2, to + Words{"--swing", "9", "--frames", frames}, {"--frames"});
    for (const std::string fps : {"0", "nan", "1e9"})
        refused(folder, 2, to + Words{"--swing", "9", "--fps", fps}, {"--fps"});
    refused(folder, 2, to + Words{"--swing", "9", "--keys", "keys.json"}, {"--keys", "--swing"});
    refused(folder, 2, to + Words{"--keys", "keys.json", "--lag", "1"}, {"--lag", "--swing"});
    refused(folder, 2, to + Words{"--swing", "9", "--lag", "1"}, {"--lag", "one region", "--regions"});
    refused(folder, 2, to + Words{"--swing", "9", "--size", "9x9"}, {"--size", "%04d.png"});
    refused(folder, 2, to + Words{"--swing", "9", "--path-scale", "2"}, {"--path-scale", "--path FILE"});
    refused(folder, 2, to + Words{"--path", "path.txt", "--path-scale", "fit"}, {"--path-scale"});
    refused(folder, 2, {"bend", "base.ply", "-o", "o.ply", "--path", "path.txt", "--angle", "3"},
            {"--path", "--angle"});
    refused(folder, 2, {"bend", "base.ply", "-o", "o.ply", "--path-start", "3"},
            {"--path-start", "--path FILE"});
    refused(folder, 1, {"bend", "base.ply", "-o", "o.ply", "--path", "path.txt", "--path-start", "300"},
            {"--path-start: 300 is beyond the end"});
    refused(folder, 1, to + Words{"--path", "none.txt"}, {"none.txt"});
    refused(folder, 1, model + Words{"none/f%d.ply", "--swing", "9"}, {"none/f1.ply", "no such folder"});
    folder.write("f1.json", R"({"keys": [{"time": 0, "angles": [1, 2]}, {"time": 1, "angles": [1, 2, 3]}]})");
    refused(folder, 1, to + Words{"--keys", "f1.json"}, {"f1.json: keys[1]: angles: 3 for 2 regions"});
    refused(folder, 1, to + Words{"--keys", "f1.json", "--regions", "0.2,0.3,0.5"},
            {"keys[0]: angles: 2 for 3 regions"});
    refused(folder, 2, model + Words{"f%d.json", "--keys", "f1.json"}, {"-o"});
    folder.write("bad.json", "{\"keys\": [{\"time\": 0, \"angle\": NaN}]}");
    refused(folder, 1, to + Words{"--keys", "bad.json"}, {"bad.json", "is not JSON"});
    folder.write("huge.json", R"({"keys": [{"time": 0, "angle": 0}, {"time": 1e300, "angle": 5}]})");
    refused(folder, 1, to + Words{"--keys", "huge.json"}, {"huge.json: keys[1]: time: "});
    folder.write("long.csv", "time,angle\n0,0\n900000,5\n");
    refused(folder, 1, to + Words{"--keys", "long.csv"}, {"long.csv", "more than a million frames"});
    folder.write("nan.csv", "time,angle\n0,0\n1,nan\n");
    refused(folder, 1, to + Words{"--keys", "nan.csv"}, {"nan.csv: line 3: 'nan' is not a number"});
    std::string points;
    for (int i = 0; i <= 100'000; ++i) points += std::to_string(i) + " 0 0\n";
    folder.write("many.txt", points);
    refused(folder, 1, to + Words{"--path", "many.txt"},
            {"many.txt", "100001 points; give it 100000 at most"});
    folder.write("large.txt", std::string((8 << 20) + 1, ' '));
    refused(folder, 1, to + Words{"--path", "large.txt"}, {"large.txt: has more than 8 MiB"});
    folder.write("nul.txt", std::string("0 0 0\n1 1 \0"
                                        "1\n",
                                        13));
    refused(folder, 1, to + Words{"--path", "nul.txt"}, {"nul.txt: line 2: '\\x001' is not a number"});
    folder.write("short.csv", "time,angle\n0\n");
    refused(folder, 1, to + Words{"--keys", "short.csv"}, {"line 2: has 1 values for 2 columns"});
    folder.write("short.txt", "0 0 0\n0 0 9\n");
    refused(folder, 1, to + Words{"--path", "short.txt"}, {"no room to walk on a path of 9"});
}
