// SPDX-License-Identifier: MIT
#include "references.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <iterator>
#include <map>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

namespace goffer::mesh::gltf {

namespace {

void add_index(const Json& json, std::set<std::size_t>& found) {
    if (const auto index = index_in(json)) found.insert(*index);
}

/// Whether an extension is known to have no numbers of accessors or views.
bool names_no_accessors(std::string_view extension) {
    if (extension.starts_with("KHR_materials_")) return true;
    for (const char* known : {"KHR_texture_transform", "KHR_texture_basisu", "KHR_lights_punctual",
                              "EXT_texture_webp", "EXT_texture_avif", "MSFT_texture_dds"})
        if (extension == known) return true;
    return false;
}

/// Adds the number in a JSON pointer, as "/accessors/3".
void add_pointer(const Json& json, std::set<std::size_t>& found) {
    if (!json.is_string()) return;
    for (const std::string_view list : {"/accessors/", "/bufferViews/"}) {
        const auto& text = json.get_ref<const std::string&>();
        if (!text.starts_with(list)) continue;
        std::size_t number = 0;
        std::from_chars(text.data() + list.size(), text.data() + text.size(), number);
        found.insert(number);
    }
}

/// Adds all numbers inside extensions that are not known.
void numbers_in_extensions(const Json& json, bool inside, std::set<std::size_t>& found) {
    if (inside) add_index(json, found), add_pointer(json, found);
    if (json.is_array()) {
        for (const Json& child : json) numbers_in_extensions(child, inside, found);
    } else if (json.is_object()) {
        for (const auto& [key, child] : json.items()) {
            if (!names_no_accessors(key)) numbers_in_extensions(child, inside || key == "extensions", found);
        }
    }
}

template <class Document, class Visit>
void each_accessor(Document& json, const Visit& visit) {
    each_accessor_of_mesh(json, visit);
    each(json, "skins", [&](auto& skin) { visit_member(skin, "inverseBindMatrices", visit); });
    each(json, "animations", [&](auto& animation) {
        each(animation, "samplers", [&](auto& sampler) {
            visit_member(sampler, "input", visit);
            visit_member(sampler, "output", visit);
        });
    });
}

template <class Document, class Visit>
void each_view(Document& json, const Visit& visit) {
    each(json, "images", [&](auto& image) { visit_member(image, "bufferView", visit); });
    each(json, "accessors", [&](auto& accessor) {
        visit_member(accessor, "bufferView", visit);
        each(accessor, "sparse", [&](auto& part) { visit_member(part, "bufferView", visit); });
    });
}

/// Takes the elements that `goes` names out of a list. Returns the new numbers of the others.
std::map<std::size_t, std::size_t> take_out(Json& list, const std::set<std::size_t>& goes) {
    std::map<std::size_t, std::size_t> numbers;
    Json kept = Json::array();
    for (std::size_t i = 0; i < list.size(); ++i) {
        if (goes.contains(i)) continue;
        numbers.emplace(i, kept.size());
        kept.push_back(std::move(list[i]));
    }
    list = std::move(kept);
    return numbers;
}

/// Takes elements out of json[list], and calls each(json, renumber) for what names the others.
template <class Each>
void take_out(Json& json, const char* list, const std::set<std::size_t>& goes, const Each& each_reference) {
    if (goes.empty() || !json.contains(list)) return;
    const std::map<std::size_t, std::size_t> numbers = take_out(json[list], goes);
    each_reference(json, [&](Json& reference) {
        const auto index = index_in(reference);
        const auto number = index ? numbers.find(*index) : numbers.end();
        if (number != numbers.end()) reference = number->second;
    });
    if (json[list].empty()) json.erase(list);
}

std::set<std::size_t> difference(const std::set<std::size_t>& all, const std::set<std::size_t>& without) {
    std::set<std::size_t> rest;
    std::ranges::set_difference(all, without, std::inserter(rest, rest.end()));
    return rest;
}

/// Where bytes of some buffers go in the one that they are packed into.
struct Kept {
    std::size_t buffer, begin, end, to = 0;
};

/// What a view has of its buffer.
Kept range_of(const Json& view) {
    const Value value(view, "bufferViews");
    const auto begin = static_cast<std::size_t>(value.whole_or("byteOffset", 0)),
               length = static_cast<std::size_t>(value["byteLength"].whole());
    return {static_cast<std::size_t>(value["buffer"].whole()), begin, begin + length};
}

/// Sorts ranges, and makes one of those that overlap.
std::vector<Kept> merged(std::vector<Kept> ranges) {
    std::vector<Kept> all;
    std::ranges::sort(ranges, {}, [](const Kept& k) { return std::tie(k.buffer, k.begin, k.end); });
    for (const Kept& range : ranges) {
        const bool joins = !all.empty() && all.back().buffer == range.buffer && range.begin <= all.back().end;
        if (joins) {
            all.back().end = std::max(all.back().end, range.end);
        } else {
            all.push_back(range);
        }
    }
    return all;
}

}  // namespace

std::optional<std::size_t> index_in(const Json& json) {
    constexpr double most = 4294967295.0;  // more than any list has
    const double value = json.is_number() ? json.get<double>() : -1.0;
    if (value >= 0.0 && value <= most && value == std::floor(value)) return static_cast<std::size_t>(value);
    return std::nullopt;
}

std::set<std::size_t> used_accessors(const Json& json) {
    std::set<std::size_t> used;
    each_accessor(json, [&](const Json& index) { add_index(index, used); });
    numbers_in_extensions(json, false, used);
    return used;
}

std::set<std::size_t> used_views(const Json& json) {
    std::set<std::size_t> used;
    each_view(json, [&](const Json& index) { add_index(index, used); });
    numbers_in_extensions(json, false, used);
    return used;
}

std::string pack_views(Json& views, std::span<const std::string> buffers,
                       const std::function<bool(std::size_t)>& skip) {
    std::vector<Kept> ranges;
    for (std::size_t i = 0; i < views.size(); ++i)
        if (!skip(i)) ranges.push_back(range_of(views[i]));
    std::vector<Kept> kept = merged(std::move(ranges));
    std::string packed;
    for (Kept& range : kept) {
        packed.resize(packed.size() + (range.begin - packed.size()) % 4, '\0');
        range.to = packed.size();
        packed += std::string_view(buffers[range.buffer]).substr(range.begin, range.end - range.begin);
    }
    for (std::size_t i = 0; i < views.size(); ++i) {
        if (skip(i)) continue;
        const Kept view = range_of(views[i]);
        const auto behind =
            std::ranges::upper_bound(kept, std::pair(view.buffer, view.begin), {},
                                     [](const Kept& k) { return std::pair(k.buffer, k.begin); });
        const Kept& range = *std::prev(behind);
        if (view.buffer != 0) views[i]["buffer"] = 0;
        const std::size_t to = range.to + view.begin - range.begin;
        if (to != view.begin) views[i]["byteOffset"] = to;
    }
    return packed;
}

void drop_unused(Output& output, const Json& before) {
    Json& json = output.json;
    std::set<std::size_t> numbers;
    numbers_in_extensions(json, false, numbers);
    if (!numbers.empty()) return;
    const std::set<std::size_t> views = used_views(before);
    take_out(json, "accessors", difference(used_accessors(before), used_accessors(json)),
             [](Json& all, const auto& visit) { each_accessor(all, visit); });
    const std::set<std::size_t> free = difference(views, used_views(json));
    if (free.empty()) return;
    take_out(json, "bufferViews", free, [](Json& all, const auto& visit) { each_view(all, visit); });
    const std::string buffers[] = {std::move(output.buffer)};
    output.buffer.clear();
    if (json.contains("bufferViews"))
        output.buffer = pack_views(json["bufferViews"], buffers, [](std::size_t) { return false; });
}

}  // namespace goffer::mesh::gltf
