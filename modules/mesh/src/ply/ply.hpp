// SPDX-License-Identifier: MIT
#pragma once

#include "text.hpp"

#include <goffer/io/bytes.hpp>
#include <goffer/mesh/mesh.hpp>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

/// A PLY file as a sequence of values. Reader and writer both walk over it: the reader takes what a mesh has,
/// the writer replaces what bending changed, and neither needs to know what other elements and properties
/// mean. (No PLY library that Debian 12 packages gives back properties that it does not know.)

namespace goffer::mesh::ply {

using io::append_bytes;
using io::from_bytes;

enum class Type { i8, u8, i16, u16, i32, u32, f32, f64 };

/// What a property means for a mesh.
enum class Role { x, y, z, nx, ny, nz, red, green, blue, alpha, u, v, other, indices, texcoord };
constexpr std::size_t vertex_roles = 12;  ///< the roles before `other`: scalars of a vertex

struct Property {
    std::string_view name;
    Type type = Type::f32;
    std::optional<Type> count;  ///< type of a list's count; none for a scalar
    std::string_view type_word;
    Role role = Role::other;
};

struct Element {
    std::string_view name;
    std::uint64_t count = 0;
    std::vector<Property> properties;

    [[nodiscard]] const Property* find(Role role) const;
};

/// A view of a file's bytes, which must outlive it.
struct Header {
    std::filesystem::path file;  ///< for messages
    std::string_view bytes;      ///< of the whole file
    std::size_t size = 0;        ///< of the header, in bytes
    bool text = false;           ///< ASCII
    std::endian order = std::endian::little;
    std::vector<Element> elements;
    std::vector<std::string> warnings;

    [[nodiscard]] const Element* find(std::string_view name) const;
};

/// One value: a scalar, or an item of a list.
struct Value {
    double number = 0;       ///< exact, whatever its type
    std::string_view bytes;  ///< a view into the file
};

/// Reads the header. Throws Error that names the line.
[[nodiscard]] Header read_header(const std::filesystem::path& file, std::string_view bytes);

[[nodiscard]] inline bool is_integer(Type type) {
    return type < Type::f32;
}

/// The position of a walk over the values.
class Cursor {
public:
    explicit Cursor(const Header& header) : header_(header), rest_(header.bytes.substr(header.size)) {}

    void begin_row(const Element& element, std::uint64_t row);
    [[nodiscard]] std::uint64_t count(const Property& property);
    [[nodiscard]] Value next(Type type);
    void end_row();

    /// The bytes that are left after the last row.
    [[nodiscard]] std::string_view rest() const { return rest_; }
    [[noreturn]] void fail_here(const std::string& what) const;

private:
    [[nodiscard]] Value next_text(Type type);

    const Header& header_;
    std::string_view rest_, line_;
    const Element* element_ = nullptr;
    std::uint64_t row_ = 0;
};

/// Calls visitor.value(cursor, property, value) for each value, visitor.end_row(cursor, element) after each
/// row, and visitor.end(cursor) at the end. Throws Error that names element and row if the file ends too soon
/// or has something that is not a number.
template <class Visitor>
void walk(const Header& header, Visitor& visitor) {
    Cursor cursor(header);
    for (const Element& element : header.elements) {
        if (element.properties.empty()) continue;
        for (std::uint64_t row = 0; row < element.count; ++row) {
            cursor.begin_row(element, row);
            for (const Property& property : element.properties) {
                const std::uint64_t count = property.count ? cursor.count(property) : 1;
                for (std::uint64_t i = 0; i < count; ++i)
                    visitor.value(cursor, property, cursor.next(property.type));
            }
            cursor.end_row();
            visitor.end_row(cursor, element);
        }
    }
    visitor.end(cursor);
}

}  // namespace goffer::mesh::ply

namespace goffer::mesh {

/// Keeps the file that was read, and the mesh that was made of it, which has no source of its own.
struct PlySource final : Source {
    std::string bytes;
    Mesh read;
};

}  // namespace goffer::mesh
