// SPDX-License-Identifier: MIT
#include <goffer/bend/body.hpp>
#include <goffer/bend/body_input.hpp>

#include <cstdio>

namespace goffer::bend {
namespace {

/// The name of a field, and what is wanted of it.
struct Words {
    const char* list;    ///< before the index; empty if there is none
    const char* member;  ///< behind the index
    const char* wanted;
};

// The words below say these numbers.
using Range = WorkingRange;
static_assert(Range::min_length == 1e-12 && Range::max_length == 1e12 && Range::max_origin == 1e15 &&
              Range::min_angle == 1e-12 && Range::max_angle == 1000 && Range::max_rest == 1 - 1e-5 &&
              Range::max_joint_rest == 0.98 && Range::max_wrinkle == 1e18 && Range::max_scale == 1e3 &&
              Range::max_taper == 1e3 && Range::max_blend_gain == 1e3 && Range::max_depth == 1e15 &&
              Range::max_growth == 1e6 && Range::max_radius_ratio == 1e4);

Words words_of(BodyField field) noexcept {
    switch (field) {
        case BodyField::none:
            break;
        case BodyField::origin:
            return {"", "origin", "three numbers within 1e15"};
        case BodyField::axes:
            return {"", "axes", "a right-handed orthonormal frame"};
        case BodyField::radius:
            return {"", "radius", "from 1e-12 to 1e12"};
        case BodyField::regions:
            return {"", "regions", "one to max_regions"};
        case BodyField::length:
            return {"regions", ".length", "from 1e-12 to 1e12"};
        case BodyField::region_radius:
            return {"regions", ".radius", "0, or from 1e-12 to 1e12"};
        case BodyField::max_scale:
            return {"regions", ".max_scale", "1 to 1000"};
        case BodyField::max_angle:
            return {"regions", ".max_angle",
                    "from 1e-12 to the smaller of 1000 radians and length / (2 radius max_scale)"};
        case BodyField::rest_angle:
            return {"regions", ".rest_angle",
                    "0 to max_angle, and at most (1 - 1e-5) length / (2 radius max_scale)"};
        case BodyField::rest_direction:
            return {"regions", ".rest_direction", "within 1000 radians"};
        case BodyField::onset:
            return {"regions", ".onset", "0 to 1"};
        case BodyField::table:
            return {"regions", ".table",
                    "no rows, or at least two of finite numbers, with a max_angle of at least 1e-12 and "
                    "wrinkles no deeper than 1e15"};
        case BodyField::factors:
            return {"regions", ".factors",
                    "no rows, or at least two of finite numbers, with a max_angle of at least 1e-12"};
        case BodyField::blend:
            return {"regions", ".blend",
                    "0, or from 1e-5 of both lengths to the room in both; both wrinkle, both or neither have "
                    "an onset, or an arc that leaves 2 % of inner lines"};
        case BodyField::blend_gain:
            return {"regions", ".blend_gain",
                    "0.001 to 1000, and such that wrinkles stay below 1e15 in both regions"};
        case BodyField::vertex_count:
            return {"", "regions.vertex_count", "adding up to the number of vertices"};
        case BodyField::vertices:
            return {"vertices", "",
                    "at least one; those near one joint of a region before those near the other"};
        case BodyField::beta:
            return {"vertices", ".beta", "within 1000 radians"};
        case BodyField::z:
            return {"vertices", ".z", "0 to its region's length, within a thousandth of that"};
        case BodyField::rho:
            return {"vertices", ".rho",
                    "0 to 1e12, and with the deepest wrinkle at most 1e4 length / max_angle"};
        case BodyField::wrinkle:
            return {"vertices", ".wrinkle",
                    "within 1e18, and such that the deepest wrinkle stretches by 1e6 at most"};
        case BodyField::slope:
            return {"vertices", ".slope",
                    "within 1e18, and such that the deepest wrinkle is no steeper than 1e6"};
        case BodyField::scale:
            return {"vertices", ".scale",
                    "0.001 to its region's max_scale, and near a joint to that of the region beyond"};
        case BodyField::scale_slope:
            return {"vertices", ".scale_slope",
                    "within 1000 scale / length, and such that the deepest wrinkle is no steeper than 1e6"};
        case BodyField::drift:
            return {"vertices", ".drift", "within its region's length times radius and max_scale"};
        case BodyField::normals:
            return {"normals", "", "one per vertex, of unit length"};
        case BodyField::tangents:
            return {"tangents", "", "none or one per vertex, of unit length"};
        case BodyField::tangent_signs:
            return {"tangent_signs", "", "as many as tangents, each a number"};
    }
    return {"", "unknown", "a field"};
}

const char* words_of(Reason reason) noexcept {
    switch (reason) {
        case Reason::empty:
            return "none";
        case Reason::not_finite:
            return "not finite";
        case Reason::count:
            return "wrong number";
        default:
            return "out of range";
    }
}

}  // namespace

FaultText describe(const BodyFault& fault) noexcept {
    FaultText result;
    if (fault.none()) {
        std::snprintf(result.text, sizeof(result.text), "no fault");
        return result;
    }
    const auto [list, member, wanted] = words_of(fault.field);
    char index[24] = "";
    if (fault.index != BodyFault::nowhere) std::snprintf(index, sizeof(index), "[%zu]", fault.index);
    std::snprintf(result.text, sizeof(result.text), "%s%s%s: %s; wanted: %s", list, index, member,
                  words_of(fault.reason), wanted);
    return result;
}

}  // namespace goffer::bend
