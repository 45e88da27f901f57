// SPDX-License-Identifier: MIT
#include "command.hpp"

#include <doctest/doctest.h>

#include <algorithm>

/// What goes to which stream, names of files, and help.

using namespace goffer::test;

namespace {

bool has_full_device() {
    const bool is_there = std::filesystem::exists("/dev/full");
    if (!is_there) MESSAGE("skipped: there is no /dev/full");
    return is_there;
}

}  // namespace

TEST_CASE("streams: nothing on standard error where all is well") {
    const Folder folder;
    base(folder);
    well(folder, {"inspect", "base.ply"});
    const std::string said = well(folder, {"bend", "base.ply", "-o", "out.ply"});
    CHECK(said.find('\r') == said.npos);
    CHECK(said.find('\033') == said.npos);
    CHECK(said.find("area change") != said.npos);
}

TEST_CASE("streams: help and version") {
    const Folder folder;
    for (const Words& words : {Words{"--help"},
                               {"-h"},
                               {"base", "--help"},
                               {"inspect", "-h"},
                               {"bend", "--help"},
                               {"crowd", "-h"}}) {
        const std::string usage = "goffer " + (words.size() > 1 ? words[0] + " " : "") + "[OPTIONS]";
        const std::string help = well(folder, words);
        const std::string before = help.substr(0, std::min(help.find(usage), help.size()));
        CHECK(before.size() < help.size());
        CHECK((before.ends_with("\nUsage: ") || before.ends_with("\n\n")));  // the latter from CLI11 2.5 on
    }
    const std::string help = well(folder, {"bend", "--help"});
    for (const std::string option :
         {"--output", "--angle", "--direction", "--folds", "--amplitude", "--profile", "--axis", "--fit",
          "--isa", "--threads", "--png", "--ghost", "--json"}) {
        CAPTURE(option);
        CHECK(help.find(option) != help.npos);
    }
    CHECK(well(folder, {"--version"}).starts_with("0."));
    CHECK(folder.files() == 0);
}

TEST_CASE("streams: a full standard output is an error") {
    const Folder folder;
    base(folder);
    if (!has_full_device()) return;
    for (const std::string more : {"", " --json -"}) {
        const std::string line = std::string("'") + GOFFER_COMMAND + "' inspect '" +
                                 (folder / "base.ply").string() + "'" + more + " >/dev/full 2>/dev/null";
        CHECK(std::system(line.c_str()) != 0);
    }
    for (const std::string word : {"--help", "--version", "bend --help"}) {
        const std::string silent =
            std::string("'") + GOFFER_COMMAND + "' " + word + " >/dev/full 2>/dev/null";
        CHECK(std::system(silent.c_str()) != 0);
        const std::string line = std::string("'") + GOFFER_COMMAND + "' " + word +
                                 " 2>&1 >/dev/full | grep -q '^goffer: standard output: cannot be written'";
        CHECK(std::system(line.c_str()) == 0);
    }
}

TEST_CASE("streams: where a report cannot be printed, nothing is said to be written") {
    const Folder folder;
    base(folder);
    if (!has_full_device()) return;
    const std::string line = "cd '" + (folder / ".").string() + "' && '" + GOFFER_COMMAND +
                             "' bend base.ply -o out.ply --json - >/dev/full 2>said.txt";
    CHECK(std::system(line.c_str()) != 0);
    const std::string said = bytes_of(folder / "said.txt");
    CHECK(said.starts_with("goffer: standard output: cannot be written"));
    CHECK(!std::filesystem::exists(folder / "out.ply"));
}

TEST_CASE("streams: nothing that is printed gets into an output where a standard stream is closed") {
    const Folder folder;
    const std::string whole = bytes_of(folder / base(folder));
    const std::string begin =
        "cd '" + (folder / ".").string() + "' && '" + GOFFER_COMMAND + "' base -o out.ply --json out.json ";
    for (const std::string closed : {">&-", "2>&-", ">&- 2>&-", "<&- >&- 2>&-"}) {
        CAPTURE(closed);
        CHECK(std::system((begin + closed).c_str()) == 0);
        CHECK((bytes_of(folder / "out.ply") == whole));
        CHECK(nlohmann::json::parse(bytes_of(folder / "out.json"))["vertices"] == 10304);
    }
}

TEST_CASE("streams: control characters of a file's name stay out of the terminal") {
    const Folder folder;
    const std::string name = "a\x7f\xc2\x9b.ply";
    base(folder, name);
    const std::string json = run(folder, {"inspect", name, "--json", "-"}).out;
    CHECK(json.find("a\\u007f\\u009b.ply") != std::string::npos);
    CHECK(nlohmann::json::parse(json)["file"] == name);
}

TEST_CASE("streams: names with spaces, quotes and letters of any script, relative and dotted paths") {
    const Folder folder;
    std::filesystem::create_directories(folder / "a b/ümläut 日本");
    const std::string name = "a b/ümläut 日本/it's ö.ply";
    base(folder, name);
    CHECK(report(folder, {"inspect", name})["file"] == name);
    well(folder, {"bend", name, "-o", "./a b/../a b/out é.gltf", "--json", "a b/日本.json"});
    for (const std::string file : {"a b/out é.gltf", "a b/日本.json"}) {
        CAPTURE(file);
        CHECK(std::filesystem::file_size(folder / file) > 500);
    }
}

TEST_CASE("streams: a name that is not UTF-8 leaves the report JSON") {
    const Folder folder;
    const std::string name = "\xff\xfe.ply";
    base(folder, name);
    CHECK(report(folder, {"inspect", name})["vertices"] == 10304);
}

TEST_CASE("streams: an output replaces a file and follows a link") {
    const Folder folder;
    base(folder);
    folder.write("old.ply", "old");
    std::filesystem::create_symlink("old.ply", folder / "link.ply");
    well(folder, {"bend", "base.ply", "-o", "link.ply"});
    CHECK(std::filesystem::is_symlink(folder / "link.ply"));
    CHECK(bytes_of(folder / "old.ply").starts_with("ply"));
    CHECK(folder.files() == 3);
}
