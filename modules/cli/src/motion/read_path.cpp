// SPDX-License-Identifier: MIT
#include "arguments.hpp"
#include "motion/fields.hpp"
#include "motion/path.hpp"

namespace goffer::cli {
namespace {

using nlohmann::json;

constexpr double farthest = 1e9;
constexpr std::size_t most_points = 100'000;  // of a path: they take a kilobyte each

glm::dvec3 read_point(const json& value, double scale, const std::string& place) {
    if (!value.is_array() || value.size() != 3)
        throw InputError(place + ": is not a point; give an array of three numbers");
    glm::dvec3 point(0);
    for (std::size_t i = 0; i < 3; ++i)
        point[static_cast<int>(i)] = scale * read_number(value[i], -farthest, farthest, place);
    return point;
}

void add_points(std::vector<glm::dvec3>& points, const json& array, double scale, const std::string& place) {
    if (!array.is_array()) throw InputError(place + ": is not an array of points");
    points.reserve(points.size() + array.size());
    for (std::size_t i = 0; i < array.size(); ++i)
        points.push_back(read_point(array[i], scale, place + "[" + std::to_string(i) + "]"));
}

}  // namespace

PathWords read_path(const json& document, double scale, const std::string& where) {
    PathWords path;
    if (document.is_array()) {
        add_points(path.points, document, scale, where);
    } else {
        Fields fields(document, where);
        path.closed = fields.flag("closed");
        if (const json* const curves = fields.find("bezier")) {
            path.bezier = true;
            const std::string place = fields.place("bezier");
            if (!curves->is_array()) throw InputError(place + ": is not an array of curves");
            for (std::size_t i = 0; i < curves->size(); ++i) {
                const std::string curve = place + "[" + std::to_string(i) + "]";
                add_points(path.points, (*curves)[i], scale, curve);
                if (path.points.size() != 4 * (i + 1))
                    throw InputError(curve + ": is not a curve; give it four control points");
            }
        } else {
            path.smooth = fields.word("curve", {"smooth", "straight"}) == "smooth";
            add_points(path.points, fields.get("points"), scale, fields.place("points"));
        }
        fields.finish();
    }
    if (path.points.size() < 2) throw InputError(where + ": has fewer than two points; give it more");
    if (path.points.size() > most_points)
        throw InputError(where + ": has " + std::to_string(path.points.size()) + " points; give it " +
                         std::to_string(most_points) + " at most");
    return path;
}

}  // namespace goffer::cli
