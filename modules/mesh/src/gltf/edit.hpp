// SPDX-License-Identifier: MIT
#pragma once

#include "gltf.hpp"

#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

/// A document changed in some accessors, and everything else in it kept: what bending and refining share.

namespace goffer::mesh::gltf {

/// An accessor that takes over for another.
struct Replacement {
    std::size_t origin =
        none;           ///< whose fields, number and view it takes, where nothing else uses these; or none
    Json fields;        ///< of the accessor: componentType, count, type, min and max where they matter
    std::string bytes;  ///< of its elements, without gaps
    int target = vertices;

    static constexpr std::size_t none = ~std::size_t{0};
    static constexpr int vertices = 34962, indices = 34963;
};

/// The fields of an accessor of floats, with its bounds where glTF wants them.
[[nodiscard]] Json float_fields(const std::vector<float>& values, std::size_t components, bool bounds);

/// A node's mesh as it is to be: its primitives, with the numbers of replacements.
struct Shape {
    std::size_t node, mesh;
    Json primitives;
};

/// Where a node's mesh changes, its primitives are given new accessor numbers by `replace` and the lot goes
/// to `place`; then come settle_accessors, settle_images if the file moves, and finish, in this order. The
/// document must outlive it.
class Edit {
public:
    explicit Edit(const Document& document) : document_(document), json_(document.json) {}

    /// A number for primitives to name the accessor by until all are settled; the same for the same accessor.
    std::size_t replace(Replacement replacement);

    /// All the nodes that show something else than before.
    void place(std::vector<Shape> shapes);

    void settle_accessors();

    /// Images beside the source are taken in (`embed`) or named from the folder of `file`; those that aren't
    /// there keep their URI.
    void settle_images(const std::filesystem::path& file, bool embed);

    [[nodiscard]] Output finish() &&;

private:
    void place_one(Shape shape);
    void keep_shown_elsewhere(const std::vector<Shape>& changed);
    void renumber(const std::vector<std::size_t>& number);
    Json accessor_for(Replacement& replacement, std::set<std::size_t>& taken_views);
    std::size_t add_view(std::string bytes, Json view, std::optional<std::size_t> slot);
    [[nodiscard]] std::string pack();

    const Document& document_;
    Json json_;
    std::vector<Replacement> replacements_;
    std::map<std::size_t, std::string> new_views_;  ///< bytes, by the view's number
    std::map<std::size_t, std::vector<std::size_t>>
        mesh_entries_;  ///< of each source mesh: entries in use, first its own
};

}  // namespace goffer::mesh::gltf
