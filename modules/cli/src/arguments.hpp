// SPDX-License-Identifier: MIT
#pragma once

#include "command_line.hpp"

#include <goffer/engine/isa.hpp>
#include <goffer/fit/bind.hpp>
#include <goffer/fit/cylinder.hpp>
#include <goffer/fit/refine.hpp>
#include <goffer/mesh/mesh.hpp>

#include <glm/vec3.hpp>

#include <filesystem>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

/// What the commands take, read from words. A word that does not fit ends in a usage error (exit code 2).

namespace goffer::cli {

/// Wrong usage that shows only when values are looked at: exit code 2.
class UsageError : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

/// Fault of the input or the system that no module names: exit code 1.
class InputError : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

/// What a subcommand does once its arguments are read.
using Action = std::function<void()>;

/// "auto" (nothing), "x", "y", "z", "-x", .. or "X,Y,Z".
[[nodiscard]] std::optional<glm::dvec3> parse_axis(const std::string& text);

/// Accepts what is a number within `low`..`high` and nothing else. `what` says in the error what it should
/// be.
[[nodiscard]] CLI::Validator number_within(double low, double high, const std::string& what);

/// Finite numbers with commas between them, at least one. `option` begins the error.
[[nodiscard]] std::vector<double> read_numbers(const std::string& option, const std::string& text);

/// Accepts an angle in degrees, any finite number, and with `or_max` also "max" and "-max".
[[nodiscard]] CLI::Validator angle_word(bool or_max);

/// Where a file is or would be, links and dots resolved. Throws InputError where the working folder is gone.
[[nodiscard]] std::filesystem::path resolved(const std::filesystem::path& file);

/// Angles as angle_word(true) accepts them, with commas between them: degrees, and infinities for "max" and
/// "-max". `option` begins the error.
[[nodiscard]] std::vector<double> read_angles(const std::string& option, const std::string& text);

[[nodiscard]] fit::Amplitude parse_amplitude(const std::string& text);
[[nodiscard]] fit::Profile parse_profile(const std::string& text);

/// A set that runs here; UsageError for an unknown name, InputError for one that this machine lacks.
[[nodiscard]] Isa parse_isa_option(const std::string& text);

/// The base cylinder in a report of `goffer inspect` (or its "fit" part alone), checked. Throws InputError.
[[nodiscard]] fit::Cylinder read_fit(const std::filesystem::path& file);

/// Refuses, before any work, an output whose ending no writer knows (UsageError) or that cannot be written
/// (io::Error).
void check_model_output(const std::filesystem::path& file);
void check_picture_output(const std::filesystem::path& file);
void check_output(const std::filesystem::path& file);

/// Adds --isa, for parse_isa_option(). Here and below, what the words are read into must outlive `command`.
void add_isa_word(CLI::App& command, std::string& isa);

/// Adds --threads, for usable_threads(): 0, its default, for all of them.
void add_threads_word(CLI::App& command, int& threads);

/// Adds --json: where a Report is written to.
void add_json_word(CLI::App& command, std::filesystem::path& file);

/// A file and the word of the command line that it stands for.
struct NamedFile {
    std::string_view option;
    std::filesystem::path file;  ///< empty or "-": none
};

/// Returns the files that models among `inputs` name, each for the option of its model. Those of one that
/// cannot be read, or is beyond `limits`, are left out, which reading it reports.
[[nodiscard]] std::vector<NamedFile> files_named_by(const std::vector<NamedFile>& inputs,
                                                    const mesh::Limits& limits);

/// Refuses (UsageError) an output in the place of an input, of a file that one names, or of another output.
/// `limits`: those that inputs are read with.
void check_places(const std::vector<NamedFile>& inputs, const std::vector<NamedFile>& outputs,
                  const mesh::Limits& limits = {});

/// Whether a file lies in a folder, or below it.
[[nodiscard]] bool lies_in(const std::filesystem::path& file, const std::filesystem::path& folder);

/// Throws UsageError where an output would lie in the folder of a cache, or below it.
void check_outside(const std::filesystem::path& folder, const std::vector<NamedFile>& outputs);

/// What `work` returns; an error of fit, which knows of no files and options, gets the name of the file at
/// fault, and of the option that mends it.
template <class Work>
auto in_file(const std::filesystem::path& file, Work&& work) {
    try {
        return work();
    } catch (const fit::AxisError& error) {
        throw InputError(file.string() + ": " + error.what() + " with --axis x|y|z|X,Y,Z");
    } catch (const fit::SizeError& error) {
        throw InputError(file.string() + ": " + error.what() + ", or allow more with --max-memory");
    } catch (const fit::Error& error) {
        throw InputError(file.string() + ": " + error.what());
    } catch (const mesh::Error& error) {
        throw InputError(file.string() + ": " + error.what());
    }
}

[[nodiscard]] double degrees(double radians);
[[nodiscard]] double radians(double degrees);

}  // namespace goffer::cli
