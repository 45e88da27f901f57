// SPDX-License-Identifier: MIT
#include "arguments.hpp"

#include "json.hpp"

#include <goffer/io/atomic_file.hpp>
#include <goffer/io/ending.hpp>
#include <goffer/io/error.hpp>
#include <goffer/io/text.hpp>
#include <goffer/mesh/mesh.hpp>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <fstream>
#include <iterator>
#include <limits>
#include <numbers>
#include <sstream>
#include <system_error>

namespace goffer::cli {
namespace {

std::optional<glm::dvec3> named_axis(std::string_view name) {
    const double sign = name.starts_with('-') ? -1 : 1;
    if (name.starts_with('-') || name.starts_with('+')) name.remove_prefix(1);
    if (name == "x") return glm::dvec3(sign, 0, 0);
    if (name == "y") return glm::dvec3(0, sign, 0);
    if (name == "z") return glm::dvec3(0, 0, sign);
    return std::nullopt;
}

std::optional<glm::dvec3> three_numbers(const std::string& text) {
    glm::dvec3 axis(0);
    const char* at = text.data();
    const char* end = text.data() + text.size();
    for (int i = 0; i < 3; ++i) {
        if (i > 0 && (at == end || *at++ != ',')) return std::nullopt;
        const auto [next, error] = std::from_chars(at, end, axis[i]);
        if (error != std::errc()) return std::nullopt;
        at = next;
    }
    return at == end ? std::optional(axis) : std::nullopt;
}

glm::dvec3 vector_field(const nlohmann::json& fit, const char* name) {
    const nlohmann::json& value = fit.at(name);
    return {value.at(0).get<double>(), value.at(1).get<double>(), value.at(2).get<double>()};
}

fit::Cylinder cylinder_from(const nlohmann::json& fit) {
    fit::Cylinder cylinder;
    cylinder.origin = vector_field(fit, "origin");
    cylinder.axis = vector_field(fit, "axis");
    cylinder.zero = vector_field(fit, "zero");
    cylinder.length = fit.at("length").get<double>();
    cylinder.radius = fit.at("radius").get<double>();
    cylinder.rest_angle = radians(fit.value("rest_angle", 0.0));
    cylinder.rest_direction = radians(fit.value("rest_direction", 0.0));
    cylinder.residual = fit.value("residual", 0.0);
    if (fit.contains("arcs")) {
        for (const nlohmann::json& arc : fit.at("arcs"))
            cylinder.arcs.push_back({arc.at("length").get<double>(), radians(arc.at("angle").get<double>()),
                                     radians(arc.at("direction").get<double>())});
    }
    if (fit.contains("radii")) cylinder.radii = fit.at("radii").get<std::vector<double>>();
    return cylinder;
}

/// Degrees, or an infinity for the largest angle of a body.
std::optional<double> one_angle(const std::string& text) {
    constexpr double largest = std::numeric_limits<double>::infinity();
    if (text == "max") return largest;
    if (text == "-max") return -largest;
    const std::optional<double> value = io::to_double(text);
    return value && std::isfinite(*value) ? value : std::nullopt;
}

[[noreturn]] void refuse_number(const std::string& option, const std::string& part, const std::string& text,
                                const std::string& wanted) {
    throw UsageError(option + ": '" + part + "' in '" + text + "' is not a number" + wanted +
                     "; give numbers with commas between them");
}

/// What `read` makes of the parts of `text`. `wanted` says in the error what each should be.
template <class Read>
std::vector<double> read_list(const std::string& option, const std::string& text, const std::string& wanted,
                              Read read) {
    std::vector<double> numbers;
    std::istringstream parts(text + ",");
    for (std::string part; std::getline(parts, part, ',');) {
        const std::optional<double> value = read(part);
        if (!value) refuse_number(option, part, text, wanted);
        numbers.push_back(*value);
    }
    return numbers;
}

}  // namespace

std::optional<glm::dvec3> parse_axis(const std::string& text) {
    if (text == "auto") return std::nullopt;
    if (const auto axis = named_axis(text)) return axis;
    std::optional<glm::dvec3> axis = three_numbers(text);
    if (!axis)
        throw UsageError("--axis: '" + text + "' is not auto, x, y, z (or -x, ..) or three numbers X,Y,Z");
    double largest = 0;
    bool finite = true;
    for (int i = 0; i < 3; ++i) {
        finite = finite && std::isfinite((*axis)[i]);
        largest = std::fmax(largest, std::fabs((*axis)[i]));
    }
    if (!finite || largest == 0) {
        throw UsageError("--axis: " + text +
                         " has no direction; give three finite numbers that are not all 0");
    }
    // Squares may be beyond double. A power of two changes no bit of the direction.
    for (int i = 0; i < 3; ++i) (*axis)[i] = std::scalbn((*axis)[i], -std::ilogb(largest));
    return axis;
}

CLI::Validator number_within(double low, double high, const std::string& what) {
    std::ostringstream range;
    range << " is not " << what << " within " << low << ".." << high;
    const auto check = [low, high, complaint = range.str()](std::string& text) {
        const std::optional<double> value = io::to_double(text);
        return value && low <= *value && *value <= high ? std::string() : "'" + text + "'" + complaint;
    };
    return {check, ""};
}

std::vector<double> read_numbers(const std::string& option, const std::string& text) {
    const auto finite = [](const std::string& part) {
        const std::optional<double> value = io::to_double(part);
        return value && std::isfinite(*value) ? value : std::nullopt;
    };
    return read_list(option, text, "", finite);
}

std::filesystem::path resolved(const std::filesystem::path& file) {
    std::error_code error;
    const std::filesystem::path absolute = std::filesystem::absolute(file, error);
    if (error) throw InputError("the working folder is not there any more; change to one that is");
    const std::filesystem::path place = std::filesystem::weakly_canonical(io::link_target(absolute), error);
    return error ? file : place;
}

CLI::Validator angle_word(bool or_max) {
    const std::string wanted = or_max ? " or max" : "";
    const auto check = [=](std::string& text) {
        const std::optional<double> value = one_angle(text);
        const bool taken = value && (or_max || std::isfinite(*value));
        return taken ? std::string() : "'" + text + "' is not an angle in degrees" + wanted;
    };
    return {check, ""};
}

std::vector<double> read_angles(const std::string& option, const std::string& text) {
    return read_list(option, text, " of degrees or max", one_angle);
}

fit::Amplitude parse_amplitude(const std::string& text) {
    if (text == "none") return fit::Amplitude::none;
    if (text == "mesh") return fit::Amplitude::mesh;
    return text == "area" ? fit::Amplitude::area : fit::Amplitude::paper;
}

fit::Profile parse_profile(const std::string& text) {
    if (text == "even") return fit::Profile::even;
    return text == "smooth" ? fit::Profile::smooth : fit::Profile::damped;
}

Isa parse_isa_option(const std::string& text) {
    const std::optional<Isa> isa = parse_isa(text);
    std::string known = "auto";
    for (const Isa built : built_isas()) {
        if (runs_here(built)) known += ", " + std::string(name(built));
    }
    if (!isa) throw UsageError("--isa: '" + text + "' is not known; choose one of " + known);
    if (!runs_here(*isa))
        throw InputError("--isa: this machine or this build has no " + text + "; choose one of " + known);
    return *isa;
}

fit::Cylinder read_fit(const std::filesystem::path& file) {
    const std::string mend = "; give the JSON that 'goffer inspect --json' writes";
    // A stream that is open already, as /dev/stdin and a shell's <(..), ends; a pipe in a folder may not even
    // begin.
    const bool open_stream = file == "/dev/stdin" || file.parent_path() == "/dev/fd";
    std::error_code no_status;
    const std::filesystem::file_status status = std::filesystem::status(file, no_status);
    if (status.type() == std::filesystem::file_type::not_found)
        throw InputError(file.string() + ": there is no such file; check the name");
    if (!open_stream && !std::filesystem::is_regular_file(status))
        throw InputError(file.string() + ": cannot be read, since it is not a regular file" + mend);
    std::ifstream stream(file);
    if (!stream) throw InputError(file.string() + ": cannot be read" + mend);
    constexpr std::size_t most = std::size_t{1} << 20;  // a report has some thousand characters
    std::string text(most + 1, '\0');
    text.resize(static_cast<std::size_t>(stream.read(text.data(), most + 1).gcount()));
    if (text.size() > most) throw InputError(file.string() + ": has more than " + io::size_text(most) + mend);
    fit::Cylinder cylinder;
    try {
        const nlohmann::json report = parse_json(file, text);
        const nlohmann::json& said = report.contains("fit") ? report.at("fit") : report;
        if (!said.is_object()) throw InputError(file.string() + ": not a fit");
        cylinder = cylinder_from(said);
    } catch (const nlohmann::json::exception& error) {
        throw InputError(file.string() + ": not a fit (" + reason(error) + ")" + mend);
    } catch (const InputError& error) {
        throw InputError(error.what() + mend);
    }
    in_file(file, [&] { fit::check(cylinder); });
    return cylinder;
}

void check_model_output(const std::filesystem::path& file) {
    if (!mesh::can_save(file)) {
        throw UsageError("-o: " + file.string() +
                         " has no known ending; use .glb, .gltf, .obj, .ply or .stl");
    }
    check_output(file);
}

void check_picture_output(const std::filesystem::path& file) {
    if (io::ending_of(file) != ".png") {
        throw UsageError("--png: " + file.string() + " does not end in .png; the picture is a PNG");
    }
    check_output(file);
}

void check_output(const std::filesystem::path& file) {
    const io::AtomicFile probe(file);
}

std::vector<NamedFile> files_named_by(const std::vector<NamedFile>& inputs, const mesh::Limits& limits) {
    std::vector<NamedFile> files;
    for (const NamedFile& input : inputs) {
        std::error_code none;
        if (!std::filesystem::is_regular_file(input.file, none)) continue;  // a pipe can be read but once
        try {
            for (std::filesystem::path& named :
                 mesh::named_files(input.file, {.allow_outside = true, .limits = limits}))
                files.push_back({input.option, std::move(named)});
        } catch (const mesh::Error&) {
            continue;
        }
    }
    return files;
}

void check_places(const std::vector<NamedFile>& inputs, const std::vector<NamedFile>& outputs,
                  const mesh::Limits& limits) {
    const auto is_file = [](const NamedFile& named) { return !named.file.empty() && named.file != "-"; };
    std::vector<NamedFile> taken = inputs;
    // A file that an output would replace is there: most runs need not look for any.
    const bool may_replace = std::ranges::any_of(outputs, [&](const NamedFile& output) {
        std::error_code error;
        return is_file(output) && std::filesystem::exists(output.file, error);
    });
    if (may_replace) std::ranges::move(files_named_by(inputs, limits), std::back_inserter(taken));
    for (const NamedFile& output : outputs) {
        for (const NamedFile& other : taken) {
            if (!is_file(output) || !is_file(other) || resolved(output.file) != resolved(other.file))
                continue;
            throw UsageError(std::string(output.option) + ": " + output.file.string() +
                             " would replace the file of " + std::string(other.option) +
                             "; give another name");
        }
        taken.push_back(output);
        std::filesystem::path materials = output.file;  // that an OBJ may have beside it
        materials.replace_extension(".mtl");
        if (io::ending_of(output.file) == ".obj") taken.push_back({"-o's materials", materials});
    }
}

bool lies_in(const std::filesystem::path& file, const std::filesystem::path& folder) {
    const std::filesystem::path relative = resolved(file).lexically_relative(resolved(folder / ""));
    return !relative.empty() && *relative.begin() != "..";
}

void check_outside(const std::filesystem::path& folder, const std::vector<NamedFile>& outputs) {
    for (const NamedFile& output : outputs) {
        if (output.file.empty() || output.file == "-" || !lies_in(output.file, folder)) continue;
        throw UsageError(std::string(output.option) + ": " + output.file.string() +
                         " would lie in the folder of the cache; put it elsewhere");
    }
}

double degrees(double radians) {
    return radians * 180 / std::numbers::pi;
}

double radians(double degrees) {
    return degrees * std::numbers::pi / 180;
}

void add_isa_word(CLI::App& command, std::string& isa) {
    command.add_option("--isa", isa, "Use these kernels: auto, scalar, sse4.2, avx2, avx512, neon")
        ->capture_default_str();
}

void add_threads_word(CLI::App& command, int& threads) {
    command.add_option("--threads", threads, "Use this many threads, at most the machine's; 0: all of them")
        ->check(CLI::Range(0, 1024))
        ->capture_default_str();
}

void add_json_word(CLI::App& command, std::filesystem::path& file) {
    // As a file, what standard output leads to would be replaced.
    const auto standard_output = [](const std::string& text) { return text == "/dev/stdout" ? "-" : text; };
    command.add_option("--json", file, "Write a report as JSON (- for standard output)")
        ->transform(standard_output);
}

}  // namespace goffer::cli
