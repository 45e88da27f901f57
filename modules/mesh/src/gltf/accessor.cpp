// SPDX-License-Identifier: MIT
#include "gltf.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

namespace goffer::mesh::gltf {

namespace {

std::size_t size_of(std::uint64_t component) {
    switch (component) {
        case i8_type:
        case u8_type:
            return 1;
        case i16_type:
        case u16_type:
            return 2;
        case u32_type:
        case float_type:
            return 4;
        default:
            return 0;
    }
}

/// The type of an accessor whose elements have so many components, of those that are read here.
std::string type_of(std::size_t components) {
    if (components == 1) return "SCALAR";
    return components == 16 ? "MAT4" : "VEC" + std::to_string(components);
}

template <class T>
T get(const char* bytes) {
    T value;
    std::memcpy(&value, bytes, sizeof(T));
    return value;
}

/// A component as a number; normalized integers by the formulas of glTF 2.0, 3.11 (Animations) and
/// KHR_mesh_quantization.
double component_at(const char* bytes, std::uint64_t component, bool normalized) {
    switch (component) {
        case i8_type:
            return normalized ? std::max(get<std::int8_t>(bytes) / 127.0, -1.0) : get<std::int8_t>(bytes);
        case u8_type:
            return get<std::uint8_t>(bytes) / (normalized ? 255.0 : 1.0);
        case i16_type:
            return normalized ? std::max(get<std::int16_t>(bytes) / 32767.0, -1.0) : get<std::int16_t>(bytes);
        case u16_type:
            return get<std::uint16_t>(bytes) / (normalized ? 65535.0 : 1.0);
        case u32_type:
            return get<std::uint32_t>(bytes) / (normalized ? 4294967295.0 : 1.0);
        default:
            return static_cast<double>(get<float>(bytes));
    }
}

/// Elements at equal distances in a buffer, all of them known to lie in it.
struct Run {
    const char* first = nullptr;
    std::size_t stride = 0;
    std::uint64_t component = float_type;
    bool normalized = false;
};

/// `owner` is what has the fields bufferView and byteOffset: an accessor, or a part of its `sparse`.
Run run_of(const Document& document, const Value& owner, std::uint64_t component, std::size_t components,
           std::uint64_t count) {
    const Value view = document.entry("bufferViews", owner["bufferView"]);
    const std::string_view bytes = document.view(view);
    const std::size_t element = size_of(component) * components;
    const std::uint64_t offset = owner.whole_or("byteOffset", 0),
                        stride = view.whole_or("byteStride", element);
    if (stride < element || stride > 252) {
        view.fail("byteStride is " + std::to_string(stride) + ", expected " + std::to_string(element) +
                  " to 252; export the file again");
    }
    const bool fits = offset <= bytes.size() && element <= bytes.size() - offset &&
                      (count - 1) <= (bytes.size() - offset - element) / stride;
    if (count > 0 && !fits) {
        owner.fail(std::to_string(count) + " elements from byte " + std::to_string(offset) + " on, " +
                   std::to_string(stride) + " bytes apart, do not fit into the " +
                   std::to_string(bytes.size()) + " bytes of bufferViews[" +
                   std::to_string(owner["bufferView"].whole()) + "]; export the file again");
    }
    return {bytes.data() + std::min<std::uint64_t>(offset, bytes.size()), static_cast<std::size_t>(stride),
            component, false};
}

template <class T>
void copy_element(const Run& run, std::size_t element, std::size_t components, T* to) {
    const char* bytes = run.first + element * run.stride;
    for (std::size_t c = 0; c < components; ++c) {
        to[c] =
            static_cast<T>(component_at(bytes + c * size_of(run.component), run.component, run.normalized));
    }
}

std::uint64_t component_type(const Value& owner, bool unsigned_only) {
    const Value type = owner["componentType"];
    const std::uint64_t value = type.whole();
    const bool known =
        size_of(value) != 0 && (!unsigned_only || value == u8_type || value == u16_type || value == u32_type);
    if (!known)
        type.fail("is " + std::to_string(value) + ", expected " +
                  (unsigned_only ? "5121, 5123 or 5125" : "5120 to 5126") + "; export the file again");
    return value;
}

template <class T>
void apply_sparse(const Document& document, const Value& accessor, const Run& like, std::size_t components,
                  std::vector<T>& values) {
    const Value sparse = accessor["sparse"];
    const std::uint64_t count = sparse["count"].whole();
    const std::size_t elements = values.size() / components;
    if (count > elements)
        sparse["count"].fail("is " + std::to_string(count) + ", but the accessor has " +
                             std::to_string(elements) + " elements; export the file again");
    const Value indices = sparse["indices"], replacements = sparse["values"];
    const Run where = run_of(document, indices, component_type(indices, true), 1, count);
    Run what = run_of(document, replacements, like.component, components, count);
    what.normalized = like.normalized;
    for (std::size_t i = 0; i < count; ++i) {
        std::uint32_t element = 0;
        copy_element(where, i, 1, &element);
        if (element >= elements) {
            indices.fail("entry " + std::to_string(i) + " is " + std::to_string(element) +
                         ", but the accessor has " + std::to_string(elements) +
                         " elements; export the file again");
        }
        copy_element(what, i, components, &values[element * components]);
    }
}

template <class T>
std::vector<T> read(const Document& document, const Value& index, std::size_t components,
                    bool unsigned_only) {
    const Value accessor = document.entry("accessors", index);
    if (const std::string type = type_of(components); accessor["type"].text() != type)
        accessor["type"].fail("is the wrong one here, expected " + type + "; export the file again");
    const std::uint64_t count = accessor["count"].whole();
    if (count == 0) accessor["count"].fail("is 0, expected 1 or more; export the file again");
    Run run;
    run.component = component_type(accessor, unsigned_only);
    if (accessor.has("bufferView")) {
        run = run_of(document, accessor, run.component, components, count);
    } else if (count > max_unbacked) {
        accessor["count"].fail("is " + std::to_string(count) + " without a bufferView; give it one");
    }
    run.normalized = accessor.flag("normalized");
    std::vector<T> values(count * components);
    for (std::size_t i = 0; run.first && i < count; ++i)
        copy_element(run, i, components, &values[i * components]);
    if (accessor.has("sparse")) apply_sparse(document, accessor, run, components, values);
    return values;
}

}  // namespace

std::vector<float> read_floats(const Document& document, const Value& index, std::size_t components) {
    return read<float>(document, index, components, false);
}

std::vector<std::uint32_t> read_indices(const Document& document, const Value& index) {
    return read<std::uint32_t>(document, index, 1, true);
}

void set_bounds(Json& accessor, const std::vector<float>& values, std::size_t components) {
    std::vector<float> least(components, std::numeric_limits<float>::max()),
        most(components, std::numeric_limits<float>::lowest());
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (!std::isfinite(values[i])) continue;  // of a broken file; JSON cannot hold it
        least[i % components] = std::min(least[i % components], values[i]);
        most[i % components] = std::max(most[i % components], values[i]);
    }
    for (std::size_t c = 0; c < components; ++c)
        if (least[c] > most[c]) least[c] = most[c] = 0;
    // As doubles, so that the JSON has the exact floats.
    accessor["min"] = std::vector<double>(least.begin(), least.end());
    accessor["max"] = std::vector<double>(most.begin(), most.end());
}

}  // namespace goffer::mesh::gltf
