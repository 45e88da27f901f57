// SPDX-License-Identifier: MIT
#pragma once

#include "gltf.hpp"

#include <functional>
#include <optional>
#include <set>
#include <span>
#include <string>

/// Which accessors and buffer views a document uses, and its buffer without what it does not use.

namespace goffer::mesh::gltf {

/// The index that a value is; null if it is no whole number of 32 bits.
[[nodiscard]] std::optional<std::size_t> index_in(const Json& json);

/// Calls `visit` with owner[key], where there is one.
template <class Owner, class Visit>
void visit_member(Owner& owner, const char* key, const Visit& visit) {
    if (owner.is_object() && owner.contains(key)) visit(owner[key]);
}

/// Calls `visit` with each number of an accessor that a document's meshes have.
template <class Document, class Visit>
void each_accessor_of_mesh(Document& json, const Visit& visit) {
    each(json, "meshes", [&](auto& mesh) {
        each(mesh, "primitives", [&](auto& primitive) {
            visit_member(primitive, "indices", visit);
            each(primitive, "attributes", visit);
            each(primitive, "targets", [&](auto& target) {
                if (!target.is_structured()) return;
                for (auto& index : target) visit(index);
            });
        });
    });
}

/// The numbers of the accessors that a document uses. Extensions that are not known may have indices of
/// anything: their numbers count, too, so that too much is kept rather than too little.
[[nodiscard]] std::set<std::size_t> used_accessors(const Json& json);

/// The same of buffer views.
[[nodiscard]] std::set<std::size_t> used_views(const Json& json);

/// Returns one buffer with the bytes that `views` have in `buffers`: in their order, at the same place modulo
/// 4, overlapping ones as one. The views then are in it. Those that `skip` answers yes to stay as they are.
[[nodiscard]] std::string pack_views(Json& views, std::span<const std::string> buffers,
                                     const std::function<bool(std::size_t)>& skip);

/// Takes out the accessors and views that `before` used and `output` no longer does, with their bytes. Where
/// an extension that is not known might number them, all stay.
void drop_unused(Output& output, const Json& before);

}  // namespace goffer::mesh::gltf
