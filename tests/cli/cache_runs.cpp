// SPDX-License-Identifier: MIT
#include "cache.hpp"
#include "support/sanitized.hpp"

#include <doctest/doctest.h>
#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>

/// Runs of `goffer cache` seen from outside: several at once, ended early, and what they take.

using namespace goffer::test;

namespace {

std::size_t parts_in(const std::filesystem::path& folder) {
    std::size_t parts = 0;
    if (!std::filesystem::exists(folder)) return 0;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
        parts += entry.path().extension() == ".part" ? 1 : 0;
    return parts;
}

/// Starts a command in `folder`; its process.
pid_t start(const Folder& folder, const std::vector<const char*>& words) {
    const pid_t child = fork();
    if (child != 0) return child;
    std::vector<char*> arguments{const_cast<char*>("goffer")};
    for (const char* word : words) arguments.push_back(const_cast<char*>(word));
    arguments.push_back(nullptr);
    const int nothing = open("/dev/null", O_WRONLY);
    if (dup2(nothing, STDOUT_FILENO) < 0 || chdir((folder / ".").c_str()) != 0) _exit(99);
    execv(GOFFER_COMMAND, arguments.data());
    _exit(98);
}

/// A scene whose cache has 499 MB, a quarter of them in a frame.
void write_large_scene(const Folder& folder) {
    base(folder, "worm.ply", {"--columns", "16", "--rows", "65"});
    nlohmann::json scene{
        {"version", 1},
        {"fps", 24},
        {"frames", 4},
        {"bodies", {{"worm", {{"file", "worm.ply"}, {"refine", "off"}}}}},
        {"motions", {{"sway", {{"swing", 70}, {"seconds", 2}}}}},
        {"instances", {{{"body", "worm"}, {"motion", "sway"}, {"grid", {100, 100}}, {"spacing", {3, 3}}}}}};
    write(folder, scene);
}

}  // namespace

TEST_CASE("cache: two runs at the same time leave one cache") {
    const Folder folder;
    write(folder, scene_in(folder));
    well(folder, cache_words("alone", small_shards));
    std::vector<pid_t> runs;
    for (int i = 0; i < 4; ++i)
        runs.push_back(start(
            folder, {"cache", "scene.json", "-o", "cache", "--shard-frames", "4", "--shard-instances", "5"}));
    for (const pid_t child : runs) {
        int status = 0;
        REQUIRE(waitpid(child, &status, 0) == child);
        CHECK(status == 0);
    }
    CHECK(files_in(folder / "cache") == files_in(folder / "alone"));
}

TEST_CASE("cache: a run that is ended leaves only whole shards") {
    const Folder folder;
    write_large_scene(folder);
    for (const int signal : {SIGINT, SIGTERM}) {
        const pid_t child = start(folder, {"cache", "scene.json", "-o", "cache", "--shard-size", "100M"});
        const auto begin = std::chrono::steady_clock::now();
        while (parts_in(folder / "cache") == 0 ||
               !std::filesystem::exists(folder / "cache/shard-000000.gofferc")) {
            if (std::chrono::steady_clock::now() - begin > std::chrono::seconds(60)) break;
        }
        kill(child, signal);
        int status = 0;
        REQUIRE(waitpid(child, &status, 0) == child);
        CHECK(WIFSIGNALED(status));
        CHECK(parts_in(folder / "cache") == 0);
        CHECK(!std::filesystem::exists(folder / "cache/manifest.json"));
        const auto again = report(folder, cache_words("cache"));
        CHECK(again["wrong"] == 0);
        CHECK(again["kept"].get<int>() >= 1);
        well(folder, {"cache", "--verify", "cache"});
        std::filesystem::remove_all(folder / "cache");
    }
}

TEST_CASE("cache: memory does not grow with the shard") {
    const Folder folder;
    write_large_scene(folder);
    const pid_t child = start(folder, {"cache", "scene.json", "-o", "cache", "--shard-size", "2G"});
    int status = 0;
    rusage usage{};
    REQUIRE(wait4(child, &status, 0, &usage) == child);
    CHECK(status == 0);
    CHECK(std::filesystem::file_size(folder / "cache/shard-000000.gofferc") > 400'000'000);
    if (!sanitized) CHECK(usage.ru_maxrss < 100'000);  // kB: what samples/farm/README.md says
}
