// SPDX-License-Identifier: MIT
#include <goffer/bend/fault.hpp>

#include <algorithm>
#include <charconv>

namespace goffer::bend {
namespace {

/// The name of a field: that of a column in a batch of a crowd, where it has another.
std::string_view name(Field field, bool of_batch) noexcept {
    switch (field) {
        case Field::none:
            return "";
        case Field::body:
            return "body";
        case Field::poses:
            return "poses";
        case Field::transform:
            return of_batch ? "transforms" : "transform";
        case Field::wrinkle_weight:
            return of_batch ? "wrinkle_weights" : "wrinkle_weight";
        case Field::positions:
            return "positions";
        case Field::normals:
            return "normals";
        case Field::tangents:
            return "tangents";
        case Field::packed:
            return "packed";
        case Field::bounds:
            return "bounds";
        case Field::previous_positions:
            return "previous_positions";
        case Field::previous_poses:
            return "previous_poses";
        case Field::previous_transform:
            return of_batch ? "previous_transforms" : "previous_transform";
        case Field::outputs:
            return "outputs";
        case Field::vertex_offsets:
            return "vertex_offsets";
        case Field::vertex_step:
            return "vertex_step";
        case Field::indices:
            return "indices";
        case Field::visible:
            return "visible";
        case Field::changed:
            return "changed";
        case Field::update_intervals:
            return "update_intervals";
        case Field::isa:
            return "isa";
    }
    return "unknown field";
}

std::string_view reason_of_empty(Field field) noexcept {
    return field == Field::body ? "empty: it was moved from, or never made"
                                : "all empty, nothing to write; give positions, normals, tangents, packed or "
                                  "previous_positions";
}

bool is_stream(Field field) noexcept {
    switch (field) {
        case Field::positions:
        case Field::normals:
        case Field::tangents:
        case Field::packed:
        case Field::previous_positions:
            return true;
        default:
            return false;
    }
}

std::string_view reason_of_null(Field field) noexcept {
    return field == Field::body ? "not given"
           : is_stream(field)   ? "a component is null beside others that are not"
                                : "not given, or a page of it is not";
}

std::string_view reason_of_count(Field field, bool of_batch) noexcept {
    return !of_batch && (field == Field::poses || field == Field::previous_poses)
               ? "not one per region of the body (a single pose is for a body of one region)"
           : field == Field::indices ? "not one for each instance"
                                     : "fewer elements than instances, or than the indices ask for";
}

std::string_view reason_of_stride(Field field) noexcept {
    switch (field) {
        case Field::poses:
        case Field::previous_poses:
            return "an element is smaller than a pose (8 bytes) for each region of the body, which lie one "
                   "after the other";
        case Field::transform:
        case Field::previous_transform:
            return "an element is smaller than its matrix: 48 bytes, or 60 in the layout columns4";
        case Field::wrinkle_weight:
        case Field::visible:
        case Field::changed:
        case Field::update_intervals:
        case Field::vertex_offsets:
            return "elements are nearer to each other than the size of one";
        default:
            return "the stride is too small or no multiple of 4, or components share bytes within `count` "
                   "vertices";
    }
}

std::string_view words(Field field, Reason reason, bool of_batch) noexcept {
    switch (reason) {
        case Reason::none:
            return "no fault";
        case Reason::null:
            return reason_of_null(field);
        case Reason::empty:
            return reason_of_empty(field);
        case Reason::not_finite:
            return "not finite: a NaN or an infinity";
        case Reason::too_large:
            return "a number in it is beyond 1e18";
        case Reason::out_of_range:
            return field == Field::vertex_offsets   ? "the instance would end beyond the end of a stream"
                   : field == Field::wrinkle_weight ? "not in 0..1"
                   : field == Field::indices        ? "beyond the end of poses"
                   : is_stream(field)               ? "its count times its stride ends beyond all addresses"
                                                    : "no such layout or page_shift";
        case Reason::count:
            return reason_of_count(field, of_batch);
        case Reason::too_short:
            return "its count is below what the instances' vertices take";
        case Reason::stride:
            return reason_of_stride(field);
        case Reason::alignment:
            return "not aligned to the type of its elements";
        case Reason::overlap:
            return field == Field::vertex_step ? "below the body's vertex_count(): instances would overlap"
                                               : "writes to the same bytes as ";
        case Reason::not_supported:
            return field == Field::isa ? "not built, or this machine cannot run it"
                                       : "the body was made without tangents";
    }
    return "unknown reason";
}

/// Appends to a FaultText and cuts off what does not fit.
class Line {
public:
    explicit Line(FaultText& to) noexcept : to_(to) {}

    Line& operator<<(std::string_view text) noexcept {
        const std::size_t room = sizeof to_.text - 1 - length_;
        length_ += text.copy(to_.text + length_, std::min(room, text.size()));
        return *this;
    }
    /// "name[index]", if there is an index.
    Line& at(std::string_view text, std::size_t index) noexcept {
        *this << text;
        return index == Fault::nowhere ? *this : (*this << "[").number(index) << "]";
    }
    Line& number(std::size_t number) noexcept {
        char digits[20] = {};
        const auto end = std::to_chars(digits, digits + sizeof digits, number).ptr;
        return *this << std::string_view(digits, static_cast<std::size_t>(end - digits));
    }

private:
    FaultText& to_;
    std::size_t length_ = 0;
};

}  // namespace

FaultText describe(const Fault& fault) noexcept {
    FaultText text;
    Line line(text);
    if (fault.none()) {
        line << "no fault";
        return text;
    }
    if (fault.batch != Fault::nowhere) line.at("batches", fault.batch) << ".";
    const bool of_batch = fault.batch != Fault::nowhere;
    line.at(name(fault.field, of_batch), fault.instance);
    if (fault.region != Fault::nowhere) line.at("", fault.region);
    line << ": " << words(fault.field, fault.reason, of_batch);
    if (fault.other != Field::none) line << name(fault.other, of_batch);
    if (fault.needs != Fault::nowhere)
        ((line << " (has ").number(fault.has) << ", needs ").number(fault.needs) << ")";
    return text;
}

}  // namespace goffer::bend
