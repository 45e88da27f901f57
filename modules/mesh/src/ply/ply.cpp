// SPDX-License-Identifier: MIT
#include "ply.hpp"

#include <goffer/io/text.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>

namespace goffer::mesh::ply {
namespace {

struct TypeWord {
    std::string_view word, other_word;
    Type type;
};
constexpr std::array<TypeWord, 8> type_words{{{"char", "int8", Type::i8},
                                              {"uchar", "uint8", Type::u8},
                                              {"short", "int16", Type::i16},
                                              {"ushort", "uint16", Type::u16},
                                              {"int", "int32", Type::i32},
                                              {"uint", "uint32", Type::u32},
                                              {"float", "float32", Type::f32},
                                              {"double", "float64", Type::f64}}};

/// Calls `use` with a zero of the number type that `type` means.
template <class Use>
auto with_type(Type type, Use use) {
    switch (type) {
        case Type::i8:
            return use(std::int8_t{});
        case Type::u8:
            return use(std::uint8_t{});
        case Type::i16:
            return use(std::int16_t{});
        case Type::u16:
            return use(std::uint16_t{});
        case Type::i32:
            return use(std::int32_t{});
        case Type::u32:
            return use(std::uint32_t{});
        case Type::f32:
            return use(float{});
        case Type::f64:
            break;
    }
    return use(double{});
}

/// The names are in the order of the roles; other names of u and v follow.
Role role_in_vertex(std::string_view name) {
    constexpr std::array names{"x",    "y",     "z", "nx", "ny", "nz", "red",       "green",
                               "blue", "alpha", "u", "v",  "s",  "t",  "texture_u", "texture_v"};
    const auto i = static_cast<std::size_t>(std::ranges::find(names, name) - names.begin());
    if (i == names.size()) return Role::other;
    return i < vertex_roles ? static_cast<Role>(i) : i % 2 == 0 ? Role::u : Role::v;
}

Role role_of(const Element& element, const Property& property) {
    if (element.name == "vertex" && !property.count) return role_in_vertex(property.name);
    if (element.name != "face" || !property.count) return Role::other;
    if (property.name == "vertex_indices" || property.name == "vertex_index") return Role::indices;
    return property.name == "texcoord" ? Role::texcoord : Role::other;
}

/// Takes the header line by line.
class HeaderReader {
public:
    HeaderReader(const std::filesystem::path& file, std::string_view bytes) : rest_(io::without_bom(bytes)) {
        header_.file = file;
        header_.bytes = bytes;
    }
    Header read();

private:
    void take(std::string_view keyword, std::string_view arguments);
    void take_format(std::string_view arguments);
    void take_element(std::string_view arguments);
    void take_property(std::string_view arguments);
    Type type(std::string_view word) const;
    [[noreturn]] void fail_here(const std::string& what) const {
        fail(header_.file, line_of(header_.bytes, line_.data()) + ": " + what);
    }

    Header header_;
    std::string_view rest_, line_;
    std::set<std::string_view> element_names_;
    std::set<Role> roles_;  ///< that properties of the last element have
    bool has_format_ = false;
};

Header HeaderReader::read() {
    if (next_line(rest_) != "ply") fail(header_.file, "line 1: does not say ply; give a PLY file");
    while (true) {
        if (rest_.empty()) fail(header_.file, "the header has no end_header line; is the file cut off?");
        line_ = next_line(rest_);
        std::string_view arguments = line_;
        const std::string_view keyword = next_token(arguments);
        if (keyword == "end_header") break;
        take(keyword, arguments);
    }
    if (!has_format_) fail(header_.file, "the header has no format line; write format ascii 1.0");
    header_.size = header_.bytes.size() - rest_.size();
    return std::move(header_);
}

void HeaderReader::take(std::string_view keyword, std::string_view arguments) {
    if (keyword.empty() || keyword == "comment" || keyword == "obj_info") return;
    if (keyword == "format") return take_format(arguments);
    if (keyword == "element") return take_element(arguments);
    if (keyword == "property") return take_property(arguments);
    if (!header_.elements.empty())
        fail_here(quoted(keyword) + " is not a word of a PLY header; is the file damaged?");
    // Blender 2.4 wrote its name there, and left out the word comment. One line is enough to say so.
    if (!header_.warnings.empty()) return;
    header_.warnings.push_back(line_of(header_.bytes, line_.data()) + ": " + quoted(keyword) +
                               " is not a word of a PLY header: the line is taken for a comment");
}

void HeaderReader::take_format(std::string_view arguments) {
    const std::string_view word = next_token(arguments);
    if (word != "ascii" && word != "binary_little_endian" && word != "binary_big_endian")
        fail_here("format " + quoted(word) +
                  " is not one of PLY's; give ascii, binary_little_endian or binary_big_endian");
    header_.text = word == "ascii";
    header_.order = word == "binary_big_endian" ? std::endian::big : std::endian::little;
    has_format_ = true;
}

void HeaderReader::take_element(std::string_view arguments) {
    Element element;
    element.name = next_token(arguments);
    const std::string_view word = next_token(arguments);
    const std::optional<std::int64_t> count = io::to_integer(word);
    if (!count || *count < 0)
        fail_here("element count " + quoted(word) +
                  " is not a whole number of 0 or more; export the mesh again");
    if (!element_names_.insert(element.name).second)
        fail_here("element " + quoted(element.name) + " is there twice; remove one of them");
    roles_.clear();
    element.count = static_cast<std::uint64_t>(*count);
    header_.elements.push_back(std::move(element));
}

void HeaderReader::take_property(std::string_view arguments) {
    if (header_.elements.empty())
        fail_here("a property stands before the first element; export the mesh again");
    Property property;
    property.type_word = next_token(arguments);
    if (property.type_word == "list") {
        property.count = type(next_token(arguments));
        if (!is_integer(*property.count)) fail_here("a list's count is not of an integer type; give uchar");
        property.type_word = next_token(arguments);
    }
    property.type = type(property.type_word);
    property.name = next_token(arguments);
    if (property.name.empty()) fail_here("a property has no name; give it one");
    Element& element = header_.elements.back();
    property.role = role_of(element, property);
    if (!roles_.insert(property.role).second) property.role = Role::other;  // only the first of a role counts
    element.properties.push_back(property);
}

Type HeaderReader::type(std::string_view word) const {
    for (const TypeWord& known : type_words)
        if (word == known.word || word == known.other_word) return known.type;
    fail_here("type " + quoted(word) +
              " is not one of PLY's; give char, uchar, short, ushort, int, uint, float or double");
}

}  // namespace

const Property* Element::find(Role role) const {
    const auto found = std::ranges::find(properties, role, &Property::role);
    return found == properties.end() ? nullptr : &*found;
}

const Element* Header::find(std::string_view name) const {
    const auto found = std::ranges::find(elements, name, &Element::name);
    return found == elements.end() ? nullptr : &*found;
}

Header read_header(const std::filesystem::path& file, std::string_view bytes) {
    return HeaderReader(file, bytes).read();
}

void Cursor::begin_row(const Element& element, std::uint64_t row) {
    element_ = &element;
    row_ = row;
    if (!header_.text) return;
    do {
        if (rest_.empty()) fail_here("the file ends before this row; is it cut off?");
        line_ = next_line(rest_);
    } while (io::trimmed(line_).empty());
}

std::uint64_t Cursor::count(const Property& property) {
    const double number = next(*property.count).number;
    if (number < 0)
        fail_here("list " + quoted(property.name) + " has a negative count; is the file damaged?");
    return static_cast<std::uint64_t>(number);
}

Value Cursor::next(Type type) {
    if (header_.text) return next_text(type);
    return with_type(type, [&]<class T>(T) {
        if (rest_.size() < sizeof(T)) fail_here("the file ends within this row; is it cut off?");
        const std::string_view bytes = rest_.substr(0, sizeof(T));
        rest_.remove_prefix(sizeof(T));
        return Value{static_cast<double>(from_bytes<T>(bytes, header_.order)), bytes};
    });
}

Value Cursor::next_text(Type type) {
    const std::string_view token = next_token(line_);
    if (token.empty()) fail_here("the line has too few numbers; is the file cut off?");
    // A float is read as a float: read as a double it might be rounded twice.
    const std::optional<double> number =
        type == Type::f32 ? std::optional<double>(io::to_float(token)) : io::to_double(token);
    if (!number) fail_here(quoted(token) + " is not a number; write one like -0.25 or 1e-3");
    const bool in_range = !is_integer(type) || with_type(type, [&]<class T>(T) {
        return *number >= static_cast<double>(std::numeric_limits<T>::lowest()) &&
               *number <= static_cast<double>(std::numeric_limits<T>::max()) &&
               *number == std::floor(*number);
    });
    if (!in_range)
        fail_here(quoted(token) +
                  " is not a whole number in the range of the property's type; export the mesh again");
    return {*number, token};
}

void Cursor::end_row() {
    if (!header_.text) return;
    if (const std::string_view token = next_token(line_); !token.empty())
        fail_here("the line has more numbers than the header says, from " + quoted(token) +
                  " on; is the file damaged?");
}

void Cursor::fail_here(const std::string& what) const {
    std::string where = "element " + quoted(element_->name) + ", row " + std::to_string(row_) + " of " +
                        std::to_string(element_->count) + " (counted from 0)";
    if (header_.text && line_.data()) where = line_of(header_.bytes, line_.data()) + ": " + where;
    fail(header_.file, where + ": " + what);
}

}  // namespace goffer::mesh::ply
