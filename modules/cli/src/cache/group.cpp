// SPDX-License-Identifier: MIT
#include "cache/group.hpp"

#include "arguments.hpp"

#include <goffer/io/error.hpp>

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat3x3.hpp>

#include <algorithm>
#include <cmath>

namespace goffer::cli {
namespace {

constexpr double most_offset = 1e9;  // seconds, either way

/// Which of `all`, by their names, a member lists.
template <class Named>
std::vector<std::size_t> indices_of(const Members& fields, const char* name, const std::vector<Named>& all) {
    std::vector<std::size_t> indices;
    for (const std::string& word : fields.texts(name)) {
        const auto found = std::ranges::find(all, word, &Named::name);
        if (found == all.end()) fields.refuse(name, "there is no '" + io::escaped(word) + "' in the scene");
        indices.push_back(static_cast<std::size_t>(found - all.begin()));
    }
    return indices;
}

glm::dvec3 vector_of(const Members& fields, const char* name) {
    const std::vector<double> numbers = fields.numbers(name, 3);
    return {numbers[0], numbers[1], numbers[2]};
}

glm::dmat3 rotation_of(const Members& fields) {
    const std::vector<double> q = fields.numbers("rotation", 4);
    const double length = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    constexpr double tolerance = 1e-3;
    if (!(std::fabs(length - 1) < tolerance))
        fields.refuse("rotation", "is not a quaternion x, y, z, w of unit length");
    return glm::mat3_cast(glm::dquat(q[3] / length, q[0] / length, q[1] / length, q[2] / length));
}

glm::dvec3 scale_of(const Members& fields) {
    if (fields.at("scale").is_array()) return vector_of(fields, "scale");
    return glm::dvec3(fields.number("scale", -most_far, most_far));
}

/// From "transform", or from "translation", "rotation" and "scale" as in glTF.
glm::dmat4x3 read_place(const Members& fields) {
    if (!fields.has("transform")) {
        const glm::dvec3 shift = fields.has("translation") ? vector_of(fields, "translation") : glm::dvec3(0);
        const glm::dmat3 turned = fields.has("rotation") ? rotation_of(fields) : glm::dmat3(1);
        const glm::dvec3 scale = fields.has("scale") ? scale_of(fields) : glm::dvec3(1);
        return {turned[0] * scale[0], turned[1] * scale[1], turned[2] * scale[2], shift};
    }
    for (const char* other : {"translation", "rotation", "scale"}) {
        if (fields.has(other)) fields.refuse(other, "is said beside 'transform'; give one of them");
    }
    const std::vector<double> m = fields.numbers("transform", 12);
    return {m[0], m[1], m[2], m[3], m[4], m[5], m[6], m[7], m[8], m[9], m[10], m[11]};
}

/// A step of "spacing": a vector, or a length along `axis`.
glm::dvec3 step_of(const Members& fields, const nlohmann::json& value, glm::dvec3 axis) {
    if (value.is_number() && std::fabs(value.get<double>()) <= most_far) return value.get<double>() * axis;
    const auto numbers = list_of(value, 3);
    if (!numbers) fields.refuse("spacing", "is not two lengths, or two vectors of three numbers");
    return {(*numbers)[0], (*numbers)[1], (*numbers)[2]};
}

void read_grid(const Members& fields, SceneGroup& group) {
    const std::vector<double> sides = fields.numbers("grid", 2);
    for (const double side : sides) {
        if (!(side >= 1 && side <= static_cast<double>(most_instances)) || side != std::floor(side))
            fields.refuse("grid", "is not two whole numbers from 1 on: columns and rows");
    }
    group.columns = static_cast<std::uint64_t>(sides[0]);
    group.count = group.columns * static_cast<std::uint64_t>(sides[1]);
    const nlohmann::json& spacing = fields.at("spacing");
    if (!spacing.is_array() || spacing.size() != 2)
        fields.refuse("spacing", "is not two lengths, or two vectors of three numbers");
    group.right = step_of(fields, spacing[0], {1, 0, 0});
    group.back = step_of(fields, spacing[1], {0, 1, 0});
}

/// How many instances, and where.
void read_places(const Members& fields, const io::NamedFiles& files, SceneGroup& group) {
    group.place = read_place(fields);
    if (fields.has("grid")) {
        for (const char* other : {"count", "transforms"}) {
            if (fields.has(other)) fields.refuse(other, "is said beside 'grid'; give one of them");
        }
        return read_grid(fields, group);
    }
    if (fields.has("spacing")) fields.refuse("spacing", "is of no use without 'grid'");
    if (fields.has("count")) group.count = fields.whole("count", 1, most_instances);
    if (fields.has("transforms")) group.transforms = named_file(fields, "transforms", files);
    if (group.count > 1 && group.transforms.empty())
        fields.refuse("count", "needs 'transforms': without them all would stand in one place");
}

void read_timing(const Members& fields, SceneGroup& group) {
    group.offset = fields.number("offset", -most_offset, most_offset, 0);
    group.stagger = fields.number("stagger", -most_offset, most_offset, 0);
    group.scatter = fields.number("scatter", 0, most_offset, 0);
    group.speed = fields.number("speed", -1000, 1000, 1);
    if (!group.motions.empty()) return;
    for (const char* name : {"offset", "stagger", "scatter", "speed"}) {
        if (fields.has(name)) fields.refuse(name, "is of no use without 'motion'");
    }
}

}  // namespace

std::filesystem::path named_file(const Members& fields, const char* name, const io::NamedFiles& files) {
    const std::string text = fields.text(name);
    const auto found = files.find(text);
    if (!found) fields.refuse(name, "names '" + io::escaped(text) + "'" + io::NamedFiles::outside);
    return *found;
}

SceneGroup read_group(const Members& fields, const Scene& scene, const io::NamedFiles& files) {
    fields.allow({"body", "motion", "poses", "transforms", "count", "grid", "spacing", "transform",
                  "translation", "rotation", "scale", "offset", "stagger", "scatter", "speed", "weight"});
    SceneGroup group;
    group.where = fields.place();
    group.bodies = indices_of(fields, "body", scene.bodies);
    if (fields.has("motion")) group.motions = indices_of(fields, "motion", scene.motions);
    if (fields.has("poses")) {
        if (fields.has("motion")) fields.refuse("poses", "is said beside 'motion'; give one of them");
        group.poses = named_file(fields, "poses", files);
    }
    read_places(fields, files, group);
    read_timing(fields, group);
    group.weight = static_cast<float>(fields.number("weight", 0, 1, 1));
    return group;
}

glm::dmat4x3 place_in(const SceneGroup& group, std::uint64_t index) {
    glm::dmat4x3 place = group.place;
    const std::uint64_t column = index % group.columns, row = index / group.columns;
    place[3] += static_cast<double>(column) * group.right + static_cast<double>(row) * group.back;
    return place;
}

double offset_in(const SceneGroup& group, std::uint64_t index) {
    constexpr double ratio =
        0.569840290998053;  // of the plastic number: evenly spread for any run of indices
    double whole = 0;
    const auto i = static_cast<double>(index);
    return group.offset + group.stagger * i + group.scatter * std::modf(ratio * i, &whole);
}

}  // namespace goffer::cli
