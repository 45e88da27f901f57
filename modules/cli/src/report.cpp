// SPDX-License-Identifier: MIT
#include "report.hpp"

#include "arguments.hpp"
#include "poses.hpp"

#include <goffer/io/atomic_file.hpp>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdio>

namespace goffer::cli {
namespace {

template <class Value>
std::string formatted(const char* format, Value value) {
    char text[64];
    std::snprintf(text, sizeof text, format, value);
    return text;
}

// What is rounding, next to `scale`, reads as 0.
std::string vector_text(const glm::dvec3& v, double scale) {
    const auto text = [scale](double value) { return number(std::fabs(value) < 1e-9 * scale ? 0 : value); };
    return text(v.x) + ", " + text(v.y) + ", " + text(v.z);
}

nlohmann::ordered_json vector_json(const glm::dvec3& v) {
    return {v.x, v.y, v.z};
}

/// JSON with the control characters escaped that it allows as they are: DEL, and U+0080 to U+009F.
std::string for_terminals(const std::string& json) {
    std::string out;
    for (std::size_t i = 0; i < json.size(); ++i) {
        const auto byte = static_cast<unsigned char>(json[i]);
        const unsigned char next = i + 1 < json.size() ? static_cast<unsigned char>(json[i + 1]) : 0;
        if (byte == 127) {
            out += "\\u007f";
        } else if (byte == 0xc2 && next >= 0x80 && next < 0xa0) {
            out += formatted("\\u%04x", next);
            ++i;
        } else {
            out += json[i];
        }
    }
    return out;
}

bool flushed() {
    return std::fflush(stdout) == 0 && std::ferror(stdout) == 0;
}

[[noreturn]] void throw_output_error() {
    throw InputError("standard output: cannot be written; is it closed, or its disk full?");
}

}  // namespace

void flush_output() {
    if (!flushed() && errno != EBADF) throw_output_error();
}

std::string number(double value) {
    return formatted("%.6g", value);
}

std::string angle_text(double degrees) {
    constexpr double rounding = 1e-3;  // of floats, and of what is fitted to them
    return number(std::fabs(degrees) < rounding ? 0 : degrees);
}

std::string percent(double fraction) {
    return formatted("%+.4f %%", 100 * fraction);
}

std::string hex(std::uint64_t number) {
    return formatted("%016llx", static_cast<unsigned long long>(number));
}

std::string counted(std::size_t count, const std::string& thing) {
    return std::to_string(count) + " " + thing + (count == 1 ? "" : "s");
}

Report::Report(std::filesystem::path json_file) : json_file_(std::move(json_file)) {
    if (!json_file_.empty() && json_file_ != "-") check_output(json_file_);
}

void Report::line(const std::string& label, const std::string& value) {
    constexpr std::size_t width = 18;
    lines_.push_back(label + std::string(label.size() < width ? width - label.size() : 1, ' ') + value);
}

void Report::warn(const std::string& text) {
    warnings_.push_back(text);
}

void Report::finish(io::AtomicFiles& outputs) {
    json["warnings"] = warnings_;
    // A file name need not be UTF-8; what is not is replaced, so that the report stays JSON.
    const std::string text =
        for_terminals(json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n");
    const bool to_output = json_file_ == "-";
    if (!json_file_.empty() && !to_output) outputs.add(json_file_).write(text);
    outputs.flush();  // what the lines say is true but for the last step

    if (to_output) {
        std::fwrite(text.data(), 1, text.size(), stdout);
        if (!flushed()) throw_output_error();
    }
    std::FILE* people = to_output ? stderr : stdout;
    for (const std::string& line : lines_) std::fprintf(people, "%s\n", io::escaped(line).c_str());
    for (const std::string& warning : warnings_)
        std::fprintf(stderr, "goffer: warning: %s\n", io::escaped(warning).c_str());
    if (!to_output) flush_output();
    outputs.commit();
}

void report_model(Report& report, const std::filesystem::path& file, const mesh::Mesh& mesh, double area) {
    const std::size_t triangles = mesh::triangle_count(mesh);
    report.json["file"] = file.string();
    report.json["vertices"] = mesh.positions.size();
    report.json["triangles"] = triangles;
    report.json["primitives"] = mesh.parts.size();
    report.json["area"] = area;
    report.line("model", file.string());
    report.line("mesh", std::to_string(mesh.positions.size()) + " vertices, " + std::to_string(triangles) +
                            " triangles, " + counted(mesh.parts.size(), "primitive"));
    report.line("area", number(area));
    for (const std::string& warning : mesh.warnings) report.warn(warning);
}

void report_fit(Report& report, const fit::Cylinder& cylinder) {
    nlohmann::ordered_json& fit = report.json["fit"];
    fit["origin"] = vector_json(cylinder.origin);
    fit["axis"] = vector_json(cylinder.axis);
    fit["zero"] = vector_json(cylinder.zero);
    fit["length"] = cylinder.length;
    fit["radius"] = cylinder.radius;
    fit["rest_angle"] = degrees(cylinder.rest_angle);
    fit["rest_direction"] = degrees(cylinder.rest_direction);
    fit["residual"] = cylinder.residual;
    if (!cylinder.radii.empty()) fit["radii"] = cylinder.radii;
    for (const fit::RestArc& arc : cylinder.arcs)
        fit["arcs"].push_back(
            {{"length", arc.length}, {"angle", degrees(arc.angle)}, {"direction", degrees(arc.direction)}});
    report.line("base end", vector_text(cylinder.origin, cylinder.length));
    report.line("axis", vector_text(cylinder.axis, 1));
    report.line("zero direction", vector_text(cylinder.zero, 1));
    report.line("length, radius", number(cylinder.length) + ", " + number(cylinder.radius) + " (ratio " +
                                      number(cylinder.length / cylinder.radius) + ")");
    if (cylinder.rest_angle != 0) {
        report.line("at rest", "bent by " + number(degrees(cylinder.rest_angle)) + " degrees toward " +
                                   angle_text(degrees(cylinder.rest_direction)));
    }
    for (std::size_t i = 0; i < cylinder.arcs.size(); ++i) {
        const fit::RestArc& arc = cylinder.arcs[i];
        report.line(i == 0 ? "at rest" : "", region_words(i, cylinder.arcs.size()) + "bent by " +
                                                 angle_text(degrees(arc.angle)) + " degrees toward " +
                                                 angle_text(degrees(arc.direction)));
    }
    if (!cylinder.radii.empty()) {
        const auto [thinnest, thickest] = std::ranges::minmax(cylinder.radii);
        report.line("shape", "radii from " + number(thinnest) + " to " + number(thickest));
    }
    report.line("fit residual", number(cylinder.residual) + " of the radius");
}

}  // namespace goffer::cli
