// SPDX-License-Identifier: MIT
#include "suitability.hpp"

#include "arguments.hpp"

#include <goffer/fit/cylinder.hpp>
#include <goffer/fit/suitability.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace goffer::cli {
namespace {

// Found by looking at models: see tests/cli/suitability.cpp.
constexpr double mostly = 0.5;   // share of the area: spurs and claws that lie side by side are no reason
constexpr double flat = 3;       // as many times as wide as thick
constexpr double far_off = 0.6;  // rms distance of the surface from the base cylinder, in radii

/// Where coordinates are so large that floats round them by a share of the radius that shows.
std::string far_away(const BoundModel& model) {
    constexpr double most = 2e-3;  // radii: from some thousand lengths away
    float largest = 0;
    for (const std::uint32_t vertex : model.rest.triangles) {
        const glm::vec3& p = model.rest.positions[vertex];
        largest = std::max({largest, std::fabs(p.x), std::fabs(p.y), std::fabs(p.z)});
    }
    const auto step =
        static_cast<double>(std::nextafter(largest, std::numeric_limits<float>::max()) - largest);
    const double radius = model.cylinder.radius;
    if (step <= most * radius) return {};
    return "it lies so far from the origin that its coordinates are rounded to steps of " + number(step) +
           ", " + number(100 * step / radius) + " % of its radius; move it nearer to the origin";
}

/// How many vertices that no face uses lie beyond an end of the body, by more than bind() leaves alone.
std::size_t stray_vertices(const BoundModel& model) {
    constexpr double slack = 1e-3;  // of the length
    std::vector<bool> used(model.rest.positions.size());
    for (const std::uint32_t vertex : model.rest.triangles) used[vertex] = true;
    std::vector<glm::vec3> loose;
    for (std::size_t i = 0; i < used.size(); ++i)
        if (!used[i]) loose.push_back(model.rest.positions[i]);
    const double length = model.cylinder.length;
    return static_cast<std::size_t>(std::ranges::count_if(fit::heights(loose, model.cylinder), [&](double z) {
        return z < -slack * length || z > (1 + slack) * length;
    }));
}

std::string warning(const fit::Suitability& found, double residual) {
    if (found.side_by_side_share > mostly)
        return std::to_string(found.side_by_side) + " of its " + std::to_string(found.shells) +
               " separate parts lie side by side, and all are bent about one axis between them; cut the "
               "model into its parts and bend each";
    if (found.flatness > flat)
        return "it is flat, " + number(found.flatness) +
               " times as wide as thick, and wrinkles are made for a round body; bend it across its thin "
               "side with --direction " +
               number(std::round(degrees(found.thin_direction))) +
               ", or try --amplitude none; if it is curled, --arcs N follows it";
    if (residual > far_off)
        return "its surface is " + number(residual) +
               " radii (rms) from the base cylinder, where a cylinder has 0; cut it into longish parts and "
               "bend each, or name another axis with --axis; if it is curled, --arcs N follows it";
    return {};
}

}  // namespace

bool report_suitability(Report& report, const BoundModel& model, nlohmann::ordered_json& json,
                        const std::string& where) {
    const fit::Geometry geometry{model.rest.positions, model.rest.triangles};
    const fit::Suitability found = fit::suitability_of(geometry, model.cylinder);
    json["suitability"] = {{"shells", found.shells},
                           {"side_by_side", found.side_by_side},
                           {"side_by_side_share", found.side_by_side_share},
                           {"flatness", found.flatness}};
    const bool round = !model.cylinder.arcs.empty();  // about its chain, or it would have none
    const std::string why = warning(found, round ? 0 : model.cylinder.residual);
    if (const std::string far = far_away(model); !far.empty()) report.warn(where + far);
    if (const std::size_t stray = stray_vertices(model); stray > 0)
        report.warn(where +
                    (stray == 1 ? "a vertex that no face uses lies"
                                : std::to_string(stray) + " vertices that no face uses lie") +
                    std::string(" beyond the ends of the body, and the output has ") +
                    (stray == 1 ? "it" : "them") +
                    " at its ends; take out loose points and lines, or give them faces");
    if (!why.empty()) report.warn(where + "the body is not a cylinder, and may look odd when bent: " + why);
    return !why.empty();
}

}  // namespace goffer::cli
