// SPDX-License-Identifier: MIT
#include "references.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace goffer::mesh::gltf {
namespace {

/// Fields that have one meaning wherever they stand.
constexpr std::array texts{"name", "uri", "mimeType", "alphaMode", "generator", "copyright"};
constexpr std::array numbers{"metallicFactor", "roughnessFactor", "alphaCutoff", "strength"};
constexpr std::array wholes{"index",      "source",    "sampler",   "texCoord", "material", "mesh",
                            "skin",       "camera",    "skeleton",  "node",     "input",    "output",
                            "bufferView", "magFilter", "minFilter", "wrapS",    "wrapT"};
constexpr std::array flags{"doubleSided", "normalized"};

/// Fields that hold an index into a list, and that nothing here reads. `owner` is the member that they are
/// in.
struct Reference {
    const char* owner;
    const char* name;
    const char* list;
};
constexpr std::array references{
    Reference{"target", "node", "nodes"}, Reference{"samplers", "input", "accessors"},
    Reference{"samplers", "output", "accessors"}, Reference{"nodes", "camera", "cameras"},
    Reference{"skins", "skeleton", "nodes"}};

template <class List>
bool is_one_of(const std::string& key, const List& list) {
    return std::ranges::find(list, key) != list.end();
}

bool is_whole(const Json& json) {
    if (!json.is_number()) return false;
    const auto value = json.get<double>();
    return value >= 0 && value == std::floor(value);
}

/// The path of a member. It has only the beginning of a long name, which many paths may have in them.
std::string member_of(const std::string& path, const std::string& name) {
    constexpr std::size_t most = 100;
    std::string place = path;
    if (!place.empty()) place += '.';
    return place.append(name, 0, most);
}

/// The path of an element.
std::string element_of(const std::string& path, std::size_t element) {
    std::string place = path;
    return place.append("[").append(std::to_string(element)).append("]");
}

/// Looks for fields of the wrong type, and numbers of what is not there; what `extras` and extensions hold is
/// theirs.
class TypeChecker {
public:
    explicit TypeChecker(const Document& document) : document_(document) {}

    void check(const Json& json, const std::string& key, const std::string& path) {
        if (json.is_array()) {
            for (std::size_t i = 0; i < json.size(); ++i)
                if (json[i].is_structured()) check(json[i], key, element_of(path, i));
        }
        if (!json.is_object()) return;
        if (key == "animations") check_channels(json, path);
        for (const auto& [name, value] : json.items()) {
            const std::string place = member_of(path, name);
            check_field(key, name, value, place);
            if (value.is_structured() && name != "extras" && name != "extensions") check(value, name, place);
        }
    }

    [[nodiscard]] std::vector<std::string> warnings() const {
        if (count_ == 0) return {};
        const std::string more = count_ > 1 ? ", and " + std::to_string(count_ - 1) + " more" : "";
        return {first_ + more + ": kept as it is, but the file is not valid; export it again"};
    }

private:
    void check_field(const std::string& owner, const std::string& name, const Json& value,
                     const std::string& place) {
        if (is_one_of(name, texts)) expect(value.is_string(), value, place, "a string");
        if (is_one_of(name, wholes)) expect(is_whole(value), value, place, "a whole number of 0 or more");
        if (is_one_of(name, flags)) expect(value.is_boolean(), value, place, "true or false");
        if (is_one_of(name, numbers) || (name == "scale" && owner == "normalTexture"))
            expect(value.is_number(), value, place, "a number");
        for (const auto& [whose, which, list] : references)
            if (owner == whose && name == which)
                expect_entry(value, place, list, entries(document_.json, list));
        if (name != "extensions") return;
        expect(value.is_object(), value, place, "an object");
        if (!value.is_object()) return;
        for (const auto& [extension, fields] : value.items())
            expect(fields.is_object(), fields, member_of(place, extension), "an object");
    }

    /// A channel's sampler is one of its own animation.
    void check_channels(const Json& animation, const std::string& path) {
        const std::size_t samplers = entries(animation, "samplers");
        std::size_t number = 0;
        each(animation, "channels", [&](const Json& channel) {
            const std::string place = element_of(member_of(path, "channels"), number++);
            visit_member(channel, "sampler", [&](const Json& sampler) {
                expect_entry(sampler, member_of(place, "sampler"), "samplers in the animation", samplers);
            });
        });
    }

    [[nodiscard]] static std::size_t entries(const Json& owner, const char* list) {
        return owner.contains(list) && owner[list].is_structured() ? owner[list].size() : 0;
    }

    void expect_entry(const Json& value, const std::string& place, const char* list, std::size_t count) {
        const bool told = !is_whole(value);  // by check_field
        if (told || value.get<double>() < static_cast<double>(count)) return;
        note(place, value, ", but there are " + std::to_string(count) + " " + list);
    }

    void expect(bool fits, const Json& value, const std::string& place, const char* expected) {
        if (!fits) note(place, value, std::string(", expected ") + expected);
    }

    void note(const std::string& place, const Json& value, const std::string& wrong) {
        if (count_++ > 0) return;
        const std::string is = value.is_number() ? value.dump() : std::string("a JSON ") + value.type_name();
        first_ = place + " is " + is + wrong;
    }

    const Document& document_;
    std::string first_;
    std::size_t count_ = 0;
};

}  // namespace

std::vector<std::string> wrong_types(const Document& document) {
    TypeChecker checker(document);
    checker.check(document.json, "", "");
    return checker.warnings();
}

}  // namespace goffer::mesh::gltf
