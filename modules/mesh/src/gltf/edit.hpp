// SPDX-License-Identifier: MIT
#pragma once

#include "gltf.hpp"

#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

/// Changes some accessors of a document and keeps everything else: what bending and refining share.

namespace goffer::mesh::gltf {

/// An accessor that takes the place of another.
struct Replacement {
    /// The accessor whose fields it takes over, with its number and view where nothing else uses these; or
    /// none.
    std::size_t origin = none;
    Json fields;        ///< of the accessor: componentType, count, type, min and max where they matter
    std::string bytes;  ///< of its elements, without gaps
    int target = vertices;

    static constexpr std::size_t none = ~std::size_t{0};
    static constexpr int vertices = 34962, indices = 34963;
};

/// Returns the fields of an accessor of floats; `bounds`: with min and max, which glTF requires of positions.
[[nodiscard]] Json float_fields(const std::vector<float>& values, std::size_t components, bool bounds);

/// What a node's mesh is to become: its primitives, with the numbers of replacements.
struct Shape {
    std::size_t node, mesh;
    Json primitives;
};

/// An edit of a document, which must outlive it. To be called in this order: replace() for each accessor that
/// changes, whose number goes into the primitives; place() once, with the shapes of all nodes that change;
/// settle_accessors(); settle_images(), if the file moves; finish().
class Edit {
public:
    explicit Edit(const Document& document) : document_(document), json_(document.json) {}

    /// Returns a number by which primitives name the accessor until all are settled; equal replacements share
    /// one.
    std::size_t replace(Replacement replacement);

    /// Gives each node in `shapes` its new primitives.
    void place(std::vector<Shape> shapes);

    /// Puts the replacements into the document and gives them their final numbers.
    void settle_accessors();

    /// Embeds the images that lie beside the source (`embed`), or names them from the folder of `file`.
    /// Images that are not there keep their URI.
    void settle_images(const std::filesystem::path& file, bool embed);

    [[nodiscard]] Output finish() &&;

private:
    using OwnerAndHash = std::pair<std::size_t, std::size_t>;

    void place_one(Shape shape);
    void use_entry(std::size_t mesh, std::size_t entry);
    void keep_shown_elsewhere(const std::vector<Shape>& changed);
    void renumber(const std::vector<std::size_t>& number);
    Json accessor_for(Replacement& replacement, std::set<std::size_t>& taken_views);
    std::size_t add_view(std::string bytes, Json view, std::optional<std::size_t> slot);
    [[nodiscard]] std::string pack();

    const Document& document_;
    Json json_;
    std::vector<Replacement> replacements_;
    std::multimap<OwnerAndHash, std::size_t> numbers_;  ///< of replacements, by origin and bytes
    std::map<std::size_t, std::string> new_views_;      ///< bytes, by the view's number
    std::set<std::size_t> taken_meshes_;                ///< of the source: those whose own entry is in use
    std::multimap<OwnerAndHash, std::size_t> entries_;  ///< in use, by mesh of the source and primitives
};

}  // namespace goffer::mesh::gltf
