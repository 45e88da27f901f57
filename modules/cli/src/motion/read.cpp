// SPDX-License-Identifier: MIT
#include "arguments.hpp"
#include "motion/fields.hpp"
#include "motion/kinds.hpp"
#include "report.hpp"

#include <algorithm>
#include <utility>

/// From documents to motions.

namespace goffer::cli {
namespace {

using nlohmann::json;

Interpolation read_interpolation(Fields& fields, bool usually_smooth) {
    const std::string usual = usually_smooth ? "smooth" : "linear",
                      other = usually_smooth ? "linear" : "smooth";
    return fields.word("interpolation", {usual, other}) == "smooth" ? Interpolation::smooth
                                                                    : Interpolation::linear;
}

bool read_from_rest(Fields& fields) {
    return fields.word("angles_count_from", {"straight", "rest"}) == "rest";
}

/// The elements of an array of `count` values, as `read` makes them.
template <class Value, class Read>
std::vector<Value> read_array(const json& array, std::size_t count, const std::string& place, Read read) {
    if (!array.is_array()) throw InputError(place + ": is not an array");
    if (array.size() != count)
        throw InputError(place + ": " + std::to_string(array.size()) + " for " + counted(count, "region") +
                         "; give one for each");
    std::vector<Value> values;
    values.reserve(count);
    for (std::size_t i = 0; i < count; ++i)
        values.push_back(read(array[i], place + "[" + std::to_string(i) + "]"));
    return values;
}

/// One angle, which regions share, or an array of one for each.
std::vector<double> read_angles(const json& value, std::size_t regions, const std::string& place) {
    if (!value.is_array()) return {read_angle(value, place)};
    return read_array<double>(value, regions, place, read_angle);
}

std::vector<std::optional<double>> read_directions(Fields& fields, std::size_t regions) {
    const auto read = [](const json& value, const std::string& place) {
        return std::optional(read_number(value, -most_degrees, most_degrees, place));
    };
    const json* const one = fields.find("direction");
    const json* const each = fields.find("directions");
    if (one && each) throw InputError(fields.place("direction") + " and directions: give one of them");
    if (each) return read_array<std::optional<double>>(*each, regions, fields.place("directions"), read);
    std::vector<std::optional<double>> directions(regions);
    if (one) std::ranges::fill(directions, read(*one, fields.place("direction")));
    return directions;
}

RegionAngles read_key_angles(Fields& key, std::size_t regions) {
    const json* const each = key.find("angles");
    const json& angles = each ? *each : key.get("angle");
    if (each && key.find("angle")) throw InputError(key.place("angle") + " and angles: give one of them");
    if (each && !each->is_array()) throw InputError(key.place("angles") + ": is not an array");
    if (!each && angles.is_array())
        throw InputError(key.place("angle") + ": is not a number; say \"angles\"");
    RegionAngles said;
    said.angles = read_angles(angles, regions, key.place(each ? "angles" : "angle"));
    said.directions = read_directions(key, regions);
    return said;
}

/// What all keys have.
struct KeyTimes {
    Fields& document;
    const json& keys;
    Interpolation interpolation;
    bool repeats;
    std::vector<double> times = {};

    explicit KeyTimes(Fields& fields)
        : document(fields),
          keys(fields.get("keys")),
          interpolation(read_interpolation(fields, true)),
          repeats(fields.flag("repeat")) {
        if (!keys.is_array() || keys.size() < 2)
            throw InputError(fields.place("keys") +
                             ": are fewer than two; give an array of two keys or more");
    }

    [[nodiscard]] std::string place(std::size_t i) const {
        return document.place("keys[" + std::to_string(i) + "]");
    }

    /// Hands each key to `read`, and checks that times ascend.
    template <class Read>
    void each(Read read) {
        times.reserve(keys.size());
        for (std::size_t i = 0; i < keys.size(); ++i) {
            Fields key(keys[i], place(i));
            const double time = read_number(key.get("time"), 0, most_seconds, key.place("time"));
            if (i > 0 && time - times.back() < 1e-9)
                throw InputError(key.place("time") + ": is not after the key before it, which is at " +
                                 number(times.back()) + "; sort the keys, and give each a time of its own");
            times.push_back(time);
            read(key, i);
            key.finish();
        }
        if (times.back() < least_seconds)
            throw InputError(document.place("keys") + ": end within " + number(least_seconds) +
                             " seconds; give them more time");
        if (repeats && times.front() != 0)
            throw InputError(place(0) + ": is not at time 0, where a motion that repeats must begin");
    }

    void refuse_round() const {
        throw InputError(place(keys.size() - 1) +
                         ": differs from the first key; a motion that repeats must end as it begins");
    }
};

std::unique_ptr<const Motion> read_keyed_angles(Fields& fields, std::size_t regions) {
    KeyTimes said(fields);
    KeyedAngles keys;
    keys.interpolation = said.interpolation;
    keys.repeats = said.repeats;
    keys.from_rest = read_from_rest(fields);
    said.each([&](Fields& key, std::size_t) { keys.keys.push_back(read_key_angles(key, regions)); });
    keys.times = std::move(said.times);
    const RegionAngles &first = keys.keys.front(), &last = keys.keys.back();
    if (keys.repeats && (first.angles != last.angles || first.directions != last.directions))
        said.refuse_round();
    return make_motion(std::move(keys));
}

double read_scale(Fields& fields) {
    return fields.number("scale", 1e-9, 1e9, 1);
}

std::unique_ptr<const Motion> read_keyed_paths(Fields& fields, const std::string& where) {
    KeyTimes said(fields);
    const double scale = read_scale(fields);
    KeyedPaths keys;
    keys.interpolation = said.interpolation;
    keys.repeats = said.repeats;
    keys.where = where;
    said.each([&](Fields& key, std::size_t i) {
        PathWords path = read_path(key.get("path"), scale, key.place("path"));
        const PathWords& first = i == 0 ? path : keys.keys.front();
        if (path.points.size() != first.points.size() || path.bezier != first.bezier ||
            path.closed != first.closed || path.smooth != first.smooth)
            throw InputError(
                key.place("path") +
                ": differs in kind or in its number of points from that of the first key; make them alike");
        (void)Path(path, key.place("path"));
        keys.keys.push_back(std::move(path));
    });
    keys.times = said.times;
    if (keys.repeats && keys.keys.front().points != keys.keys.back().points) said.refuse_round();
    return make_motion(std::move(keys));
}

double read_seconds(Fields& fields) {
    return read_number(fields.get("seconds"), least_seconds, most_seconds, fields.place("seconds"));
}

std::unique_ptr<const Motion> read_swing(Fields& fields, std::size_t regions) {
    const json& said = fields.get("swing");
    const std::string place = fields.place("swing");
    Swing swing;
    swing.from.angles = {0};
    if (said.is_object()) {
        Fields ends(said, place);
        swing.to.angles = read_angles(ends.get("to"), regions, ends.place("to"));
        if (const json* const from = ends.find("from"))
            swing.from.angles = read_angles(*from, regions, ends.place("from"));
        ends.finish();
    } else {
        swing.to.angles = read_angles(said, regions, place);
    }
    swing.from.directions = swing.to.directions = read_directions(fields, regions);
    swing.seconds = read_seconds(fields);
    swing.lag = fields.number("lag", -100, 100, 0);
    swing.from_rest = read_from_rest(fields);
    return make_motion(std::move(swing));
}

std::unique_ptr<const Motion> read_walk(Fields& fields) {
    const std::string place = fields.place("path");
    Path path(read_path(fields.get("path"), read_scale(fields), place), place);
    const double seconds = read_seconds(fields);
    return make_motion(Walk{std::move(path), seconds, read_interpolation(fields, false)});
}

/// Whether the first key has a path; a key that is none is refused later.
bool has_paths(const json& keys) {
    return keys.is_array() && !keys.empty() && keys[0].is_object() && keys[0].contains("path");
}

}  // namespace

std::unique_ptr<const Motion> read_motion(const json& document, std::size_t regions,
                                          const std::string& where) {
    Fields fields(document, where);
    std::unique_ptr<const Motion> motion;
    if (const json* const keys = fields.find("keys")) {
        motion = has_paths(*keys) ? read_keyed_paths(fields, where) : read_keyed_angles(fields, regions);
    } else if (fields.find("swing")) {
        motion = read_swing(fields, regions);
    } else if (fields.find("path")) {
        motion = read_walk(fields);
    } else {
        throw InputError(where + ": says no motion; give it \"keys\", a \"swing\" or a \"path\"");
    }
    fields.finish();
    return motion;
}

}  // namespace goffer::cli
