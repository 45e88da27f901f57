// SPDX-License-Identifier: MIT
#pragma once

#include <goffer/bend/fault.hpp>

#include <cstddef>
#include <iterator>
#include <string>
#include <string_view>

/// Faults in short, for tests to compare: "poses not_finite, batch 1, instance 7, region 2".

namespace goffer::test {

inline constexpr std::string_view field_names[] = {"none",
                                                   "body",
                                                   "poses",
                                                   "transform",
                                                   "wrinkle_weight",
                                                   "positions",
                                                   "normals",
                                                   "tangents",
                                                   "packed",
                                                   "bounds",
                                                   "previous_positions",
                                                   "previous_poses",
                                                   "previous_transform",
                                                   "outputs",
                                                   "vertex_offsets",
                                                   "vertex_step",
                                                   "indices",
                                                   "visible",
                                                   "changed",
                                                   "update_intervals",
                                                   "isa"};
static_assert(std::size(field_names) == static_cast<std::size_t>(bend::Field::isa) + 1);

inline constexpr std::string_view reason_names[] = {"none",      "null",         "empty",   "not_finite",
                                                    "too_large", "out_of_range", "count",   "too_short",
                                                    "stride",    "alignment",    "overlap", "not_supported"};
static_assert(std::size(reason_names) == static_cast<std::size_t>(bend::Reason::not_supported) + 1);

/// Where the fault is, and in which field.
[[nodiscard]] inline std::string place_of(const bend::Fault& fault) {
    if (fault.none()) return "none";
    std::string text(field_names[static_cast<std::size_t>(fault.field)]);
    const auto add = [&](std::string_view name, std::size_t index) {
        if (index != bend::Fault::nowhere) text.append(name).append(std::to_string(index));
    };
    add(", batch ", fault.batch);
    add(", instance ", fault.instance);
    add(", region ", fault.region);
    return text;
}

/// The same, and what is wrong there.
[[nodiscard]] inline std::string told(const bend::Fault& fault) {
    if (fault.none()) return "none";
    const std::string_view field = field_names[static_cast<std::size_t>(fault.field)];
    std::string text(field);
    text.append(" ").append(reason_names[static_cast<std::size_t>(fault.reason)]);
    if (fault.other != bend::Field::none)
        text.append(" ").append(field_names[static_cast<std::size_t>(fault.other)]);
    return text + place_of(fault).substr(field.size());
}

/// Whether streams `a` and `b` overlap, whichever of them is named first.
[[nodiscard]] inline bool is_overlap(const bend::Fault& fault, bend::Field a, bend::Field b) {
    return fault.reason == bend::Reason::overlap &&
           ((fault.field == a && fault.other == b) || (fault.field == b && fault.other == a));
}

}  // namespace goffer::test
