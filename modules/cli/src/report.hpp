// SPDX-License-Identifier: MIT
#pragma once

#include <goffer/fit/cylinder.hpp>
#include <goffer/mesh/mesh.hpp>

#include <nlohmann/json.hpp>

#include <filesystem>
#include <string>
#include <vector>

/// What a command says: lines for a person and, where asked for, the same as JSON.

namespace goffer::io {
class AtomicFiles;
}

namespace goffer::cli {

/// Throws where lines that were printed to standard output cannot be written. Does not throw where it is
/// closed.
void flush_output();

/// Collects a command's results and prints them at its end.
class Report {
public:
    /// `json_file`: empty for none, "-" for standard output (the lines then go to standard error). Throws
    /// where the file cannot be written, before any work is done.
    explicit Report(std::filesystem::path json_file);

    /// A line "label   value" for a person.
    void line(const std::string& label, const std::string& value);

    /// A warning: a line, and an entry of "warnings" in the JSON.
    void warn(const std::string& text);

    [[nodiscard]] const std::vector<std::string>& warnings() const noexcept { return warnings_; }

    /// The JSON, to be filled in the order that it is to be printed in.
    nlohmann::ordered_json json;

    /// Writes the JSON and prints the lines, and only then puts all outputs, of which the JSON is one, in
    /// their places. Throws where any of it cannot be written.
    void finish(io::AtomicFiles& outputs);

private:
    std::filesystem::path json_file_;
    std::vector<std::string> lines_;
    std::vector<std::string> warnings_;
};

/// Numbers as people read them: six significant digits.
[[nodiscard]] std::string number(double value);

/// Returns degrees in words: what is rounding reads as 0.
[[nodiscard]] std::string angle_text(double degrees);

/// A fraction in per cent with a sign, to four decimals.
[[nodiscard]] std::string percent(double fraction);

/// 16 hexadecimal digits.
[[nodiscard]] std::string hex(std::uint64_t number);

/// "1 fold", "2 folds".
[[nodiscard]] std::string counted(std::size_t count, const std::string& thing);

/// What `inspect` and `bend` say of a file and its fit. Capacity and angle are filled in by the caller.
void report_model(Report& report, const std::filesystem::path& file, const mesh::Mesh& mesh, double area);
void report_fit(Report& report, const fit::Cylinder& cylinder);

}  // namespace goffer::cli
