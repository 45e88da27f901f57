// SPDX-License-Identifier: MIT
#include "command.hpp"

#include "support/worst.hpp"

#include <doctest/doctest.h>
#include <glm/geometric.hpp>
#include <sys/wait.h>

#include <algorithm>
#include <cstdlib>

namespace goffer::test {
namespace {

std::string quoted(const std::string& word) {
    return std::string("'") + replaced(word, "'", "'\\''") + "'";
}

}  // namespace

Result run(const Folder& folder, const Words& words) {
    const Folder streams;
    std::string line = "cd ";
    line += quoted((folder / ".").string()) + " && exec " + quoted(GOFFER_COMMAND);
    for (const std::string& word : words) line.append(" ").append(quoted(word));
    line.append(" >").append(quoted((streams / "out").string()));
    line.append(" 2>").append(quoted((streams / "err").string()));
    const int status = std::system(line.c_str());
    const int code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    return {code, bytes_of(streams / "out"), bytes_of(streams / "err")};
}

std::string well(const Folder& folder, const Words& words) {
    CAPTURE(words);
    const Result result = run(folder, words);
    CHECK(result.err == "");
    REQUIRE(result.code == 0);
    return result.out;
}

nlohmann::json report(const Folder& folder, Words words) {
    CAPTURE(words);
    const Result result = run(folder, words + Words{"--json", "-"});
    CAPTURE(result.err);
    REQUIRE(result.code == 0);
    return nlohmann::json::parse(result.out);
}

Snapshot snapshot(const Folder& folder) {
    Snapshot files;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder / ".")) {
        const bool regular = entry.is_regular_file();
        files[entry.path().string()] = {regular ? bytes_of(entry.path()) : "", entry.last_write_time()};
    }
    return files;
}

void refused(const Folder& folder, int code, const Words& words, const Words& pieces) {
    CAPTURE(words);
    const Snapshot before = snapshot(folder);
    const Result result = run(folder, words);
    CAPTURE(result.err);
    CHECK(result.code == code);
    CHECK(result.out == "");
    CHECK(std::ranges::count(result.err, '\n') == 1);
    CHECK(result.err.starts_with("goffer: "));
    CHECK(result.err.ends_with("\n"));
    for (const std::string& piece : pieces) {
        CAPTURE(piece);
        CHECK(result.err.find(piece) != result.err.npos);
    }
    CHECK(snapshot(folder) == before);
}

std::string base(const Folder& folder, const std::string& name, const Words& more) {
    well(folder, Words{"base", "-o", name} + more);
    return name;
}

void copy_of(const Folder& folder, const std::string& name) {
    std::filesystem::copy_file(std::filesystem::path(GOFFER_SOURCE_DIR) / "tests/data" / name, folder / name);
}

double farthest(const mesh::Mesh& a, const mesh::Mesh& b) {
    REQUIRE(a.positions.size() == b.positions.size());
    double most = 0;
    for (std::size_t i = 0; i < a.positions.size(); ++i)
        test::take_worst(most, double{glm::length(a.positions[i] - b.positions[i])});
    return most;
}

Words operator+(Words words, const Words& more) {
    words.insert(words.end(), more.begin(), more.end());
    return words;
}

}  // namespace goffer::test
