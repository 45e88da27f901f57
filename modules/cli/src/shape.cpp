// SPDX-License-Identifier: MIT
#include "shape.hpp"

#include <goffer/fit/shape.hpp>

#include <string>

namespace goffer::cli {
namespace {

// Found by looking at models: see tests/cli/shape.cpp.
constexpr double mostly = 0.5;   // share of the area: spurs and claws that lie side by side are no reason
constexpr double flat = 3;       // as many times as wide as thick
constexpr double far_off = 0.6;  // rms distance of the surface from the base cylinder, in radii

std::string warning(const fit::Shape& shape, double residual) {
    if (shape.side_by_side_share > mostly)
        return std::to_string(shape.side_by_side) + " of its " + std::to_string(shape.shells) +
               " separate parts lie side by side, and all are bent about one axis between them; cut the "
               "model "
               "into its parts and bend each";
    if (shape.flatness > flat)
        return "it is flat, " + number(shape.flatness) +
               " times as wide as thick, and wrinkles are made for a round body; bend it across its thin "
               "side "
               "with --direction, or try --amplitude none";
    if (residual > far_off)
        return "its surface is " + number(residual) +
               " radii (rms) from the base cylinder, and a round body has 0; cut it into longish parts and "
               "bend "
               "each, or name another axis with --axis";
    return {};
}

}  // namespace

void report_shape(Report& report, const BoundModel& model) {
    const fit::Geometry geometry{model.rest.positions, model.rest.triangles};
    const fit::Shape shape = fit::shape_of(geometry, model.cylinder);
    report.json["shape"] = {{"shells", shape.shells},
                            {"side_by_side", shape.side_by_side},
                            {"side_by_side_share", shape.side_by_side_share},
                            {"flatness", shape.flatness}};
    const std::string why = warning(shape, model.cylinder.residual);
    if (!why.empty()) report.warn("the body is no cylinder and may look odd when bent: " + why);
}

}  // namespace goffer::cli
