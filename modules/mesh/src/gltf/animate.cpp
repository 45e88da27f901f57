// SPDX-License-Identifier: MIT
#include "morph.hpp"

#include <algorithm>
#include <iterator>
#include <set>
#include <utility>

namespace goffer::mesh::gltf {

namespace {

template <class T>
bool all_equal(std::span<const T> values) {
    return std::ranges::all_of(values, [&](const T& value) { return value == values.front(); });
}

std::vector<float> floats_of(const glm::vec3& v) {
    return {v.x, v.y, v.z};
}

std::vector<float> floats_of(const glm::quat& q) {
    return {q.x, q.y, q.z, q.w};
}

class Animator {
public:
    Animator(Growing& document, const Morphing& morphing) : document_(document), morphing_(morphing) {}

    void run(const std::vector<std::size_t>& nodes) {
        if (!nodes.empty()) morph(nodes);
        carry();
        if (channels_.empty()) return;
        Json animation = {{"channels", std::move(channels_)}, {"samplers", std::move(samplers_)}};
        document_.json["animations"] = Json::array();
        document_.json["animations"].push_back(std::move(animation));
    }

private:
    std::size_t add_times(const std::vector<float>& times);
    std::size_t times();
    std::size_t ends();
    std::size_t add_sampler(std::size_t input, std::size_t output);
    void add_channel(std::size_t sampler, std::size_t node, const char* path);
    std::size_t add_weights(std::size_t first, std::size_t step);
    void morph(const std::vector<std::size_t>& nodes);
    template <class T>
    void place(std::size_t node, const char* path, const char* type, std::span<const T> keys, const T& none);
    void carry();

    Growing& document_;
    const Morphing& morphing_;
    Json channels_ = Json::array(), samplers_ = Json::array();
    std::optional<std::size_t> times_;
};

std::size_t Animator::add_times(const std::vector<float>& times) {
    const std::size_t number = document_.add(bytes_of(times), float_type, "SCALAR", times.size());
    set_bounds(document_.json["accessors"][number], times, 1);
    return number;
}

/// The accessor of all keys' times.
std::size_t Animator::times() {
    if (!times_) times_ = add_times({morphing_.times.begin(), morphing_.times.end()});
    return *times_;
}

/// The accessor of the first key's time and the last one's.
std::size_t Animator::ends() {
    return add_times({morphing_.times.front(), morphing_.times.back()});
}

std::size_t Animator::add_sampler(std::size_t input, std::size_t output) {
    samplers_.push_back({{"input", input}, {"interpolation", "LINEAR"}, {"output", output}});
    return samplers_.size() - 1;
}

void Animator::add_channel(std::size_t sampler, std::size_t node, const char* path) {
    channels_.push_back({{"sampler", sampler}, {"target", {{"node", node}, {"path", path}}}});
}

/// The weights of every `step`th key, as bytes where these are exact.
std::size_t Animator::add_weights(std::size_t keys, std::size_t step) {
    const std::size_t targets = morphing_.targets.size();
    std::vector<float> weights;
    weights.reserve(keys * targets);
    for (std::size_t key = 0; key < keys; ++key) {
        const auto of_key = morphing_.weights.subspan(key * step * targets, targets);
        weights.insert(weights.end(), of_key.begin(), of_key.end());
    }
    const bool whole = std::ranges::all_of(weights, [](float w) { return w == 0.0f || w == 1.0f; });
    if (!whole) return document_.add(bytes_of(weights), float_type, "SCALAR", weights.size());
    std::vector<std::uint8_t> narrow;
    narrow.reserve(weights.size());
    for (const float weight : weights) narrow.push_back(weight == 0.0f ? 0 : 255);
    const std::size_t number = document_.add(bytes_of(narrow), u8_type, "SCALAR", narrow.size());
    document_.json["accessors"][number]["normalized"] = true;
    return number;
}

void Animator::morph(const std::vector<std::size_t>& nodes) {
    const std::size_t keys = morphing_.times.size(), targets = morphing_.targets.size();
    const auto of_key = [&](std::size_t key) { return morphing_.weights.subspan(key * targets, targets); };
    bool still = true;
    for (std::size_t key = 1; key < keys; ++key) still = still && std::ranges::equal(of_key(key), of_key(0));
    const Json first(std::vector<double>(of_key(0).begin(), of_key(0).end()));
    for (const std::size_t node : nodes) {
        document_.json["nodes"][node].erase("weights");
        document_.json["meshes"][document_.json["nodes"][node]["mesh"].get<std::size_t>()]["weights"] = first;
    }
    if (keys == 1) return;
    const std::size_t sampler =
        still ? add_sampler(ends(), add_weights(2, keys - 1)) : add_sampler(times(), add_weights(keys, 1));
    for (const std::size_t node : nodes) add_channel(sampler, node, "weights");
}

/// Gives `node` the first key's value, and animates it where others differ. `none` need not be said.
template <class T>
void Animator::place(std::size_t node, const char* path, const char* type, std::span<const T> keys,
                     const T& none) {
    const bool still = all_equal(keys);
    if (keys.empty() || (still && keys[0] == none)) return;
    const std::vector<float> first = floats_of(keys[0]);
    document_.json["nodes"][node][path] = std::vector<double>(first.begin(), first.end());
    if (still) return;
    std::vector<float> values;
    values.reserve(keys.size() * first.size());
    for (const T& key : keys) std::ranges::copy(floats_of(key), std::back_inserter(values));
    const std::size_t output = document_.add(bytes_of(values), float_type, type, keys.size());
    add_channel(add_sampler(times(), output), node, path);
}

/// Puts a node above the scene. A node has one parent, so that other scenes that have it get all of them.
void Animator::carry() {
    const glm::vec3 no_shift(0.0f);
    const glm::quat no_turn(1.0f, 0.0f, 0.0f, 0.0f);
    const auto at_rest = [](const auto& keys, const auto& none) {
        return std::ranges::all_of(keys, [&](const auto& key) { return key == none; });
    };
    if (at_rest(morphing_.translations, no_shift) && at_rest(morphing_.rotations, no_turn)) return;
    Json& json = document_.json;
    const Json roots = shown_scene(json)["nodes"];
    const std::set<Json> carried(roots.begin(), roots.end());
    const std::size_t carrier = json["nodes"].size();
    json["nodes"].push_back({{"name", "carrier"}, {"children", roots}});
    each(json, "scenes", [&](Json& scene) {
        if (!scene.contains("nodes")) return;
        Json kept = Json::array();
        for (const Json& root : scene["nodes"])
            if (!carried.contains(root)) kept.push_back(root);
        if (kept.size() != scene["nodes"].size()) kept.push_back(carrier);
        scene["nodes"] = std::move(kept);
    });
    place(carrier, "translation", "VEC3", morphing_.translations, no_shift);
    place(carrier, "rotation", "VEC4", morphing_.rotations, no_turn);
}

}  // namespace

void animate(Growing& document, const Morphing& morphing, const std::vector<std::size_t>& nodes) {
    Animator(document, morphing).run(nodes);
}

}  // namespace goffer::mesh::gltf
