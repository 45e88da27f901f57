// SPDX-License-Identifier: MIT
#pragma once

#include "mesh/files.hpp"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

/// The real command, run in a folder of its own.

namespace goffer::test {

using Words = std::vector<std::string>;

struct Result {
    int code = 0;  ///< exit code; 128 and more where a signal ended it
    std::string out;
    std::string err;
};

/// Runs `goffer words..` with `folder` as the working directory.
[[nodiscard]] Result run(const Folder& folder, const Words& words);

/// The same; it must end well and say nothing on standard error. What it wrote to standard output.
std::string well(const Folder& folder, const Words& words);

/// The report of `goffer words.. --json -`, which must end well (warnings are allowed).
[[nodiscard]] nlohmann::json report(const Folder& folder, Words words);

/// Files below a folder, with their bytes and times.
using Snapshot = std::map<std::string, std::pair<std::string, std::filesystem::file_time_type>>;
[[nodiscard]] Snapshot snapshot(const Folder& folder);

/// Runs what must be refused: with `code`, nothing on standard output, one line on standard error that holds
/// all of `pieces`, and every file in the folder as it was.
void refused(const Folder& folder, int code, const Words& words, const Words& pieces);

inline constexpr double base_length = 10, base_radius = 1;

/// A base cylinder of that length and radius (64 columns, 161 rows) in `folder`; returns its name.
std::string base(const Folder& folder, const std::string& name = "base.ply", const Words& more = {});

/// Copies a bundled model, or another file of tests/data, into `folder`.
void copy_of(const Folder& folder, const std::string& name);

/// The largest distance between vertices of the same number; there must be as many of each.
[[nodiscard]] double farthest(const mesh::Mesh& a, const mesh::Mesh& b);

[[nodiscard]] Words operator+(Words words, const Words& more);

}  // namespace goffer::test
