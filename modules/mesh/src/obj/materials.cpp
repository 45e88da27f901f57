// SPDX-License-Identifier: MIT
#include "materials.hpp"

#include "format.hpp"
#include "obj.hpp"

#include <goffer/io/error.hpp>
#include <goffer/io/named_files.hpp>
#include <goffer/io/text.hpp>

#include <tiny_obj_loader.h>

#include <algorithm>
#include <array>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <sstream>
#include <string>
#include <utility>

namespace goffer::mesh {
namespace {

std::uint64_t count_materials(std::string_view library) {
    constexpr std::string_view keyword = "newmtl";
    std::uint64_t count = 0;
    for (std::size_t at = library.find(keyword); at != library.npos; at = library.find(keyword, at + 1))
        ++count;
    return count;
}

/// The names of a library's materials, which tinyobjloader 2.0.0-rc13 cuts at blanks: those that have one.
std::vector<std::string_view> material_names(std::string_view library) {
    std::vector<std::string_view> names;
    while (!library.empty()) {
        std::string_view line = next_line(library);
        if (next_token(line) != "newmtl") continue;
        if (const std::string_view name = io::trimmed(line); !name.empty()) names.push_back(name);
    }
    return names;
}

/// Replaces the backslashes that paths have on Windows.
std::string with_slashes(std::string name) {
    std::ranges::replace(name, '\\', '/');
    return name;
}

/// Kd is no factor: exporters write all kinds of gray beside a map, and programs that show it leave Kd out.
Texture texture_with(const tinyobj::texture_option_t& option, std::shared_ptr<const Image> image) {
    Texture texture{.image = std::move(image)};
    texture.transform =
        glm::mat3x2(option.scale[0], 0, 0, option.scale[1], option.origin_offset[0], option.origin_offset[1]);
    if (option.clamp) texture.wrap_u = texture.wrap_v = Wrap::clamp;
    return texture;
}

/// The names of all textures of a material, as its file has them; empty where it has none of a kind.
std::array<std::string, 12> texture_names(const tinyobj::material_t& material) {
    const auto& m = material;
    return {m.diffuse_texname,   m.ambient_texname,      m.specular_texname, m.specular_highlight_texname,
            m.bump_texname,      m.displacement_texname, m.alpha_texname,    m.reflection_texname,
            m.roughness_texname, m.metallic_texname,     m.emissive_texname, m.normal_texname};
}

class MaterialReader {
public:
    MaterialReader(const std::filesystem::path& file, std::string_view text, const MaterialLines& lines,
                   const LoadOptions& options, Budget& budget, Mesh& mesh)
        : file_(file),
          text_(text),
          lines_(lines),
          options_(options),
          files_(file, options.allow_outside),
          budget_(budget),
          mesh_(mesh) {}
    void read();
    std::vector<std::filesystem::path> files();

private:
    using Materials = std::vector<tinyobj::material_t>;

    template <class Visit>
    void each_library(const Visit& visit);
    [[nodiscard]] Materials read_library(const std::filesystem::path& library);
    void warn_of_textures(const std::filesystem::path& library, const Materials& materials);
    void find_textures(const std::filesystem::path& library, const Materials& materials);

    const std::filesystem::path& file_;
    std::string_view text_;
    const MaterialLines& lines_;
    const LoadOptions& options_;
    io::NamedFiles files_;
    Budget& budget_;
    Mesh& mesh_;
    std::map<std::filesystem::path, std::shared_ptr<const Image>> images_;
    std::vector<std::optional<Texture>> textures_;  ///< of each entry of the material files
};

MaterialReader::Materials MaterialReader::read_library(const std::filesystem::path& library) {
    std::string bytes;
    try {
        bytes = read_bytes(library, budget_);
        budget_.take(2 * bytes.size() + count_materials(bytes) * sizeof(tinyobj::material_t));
    } catch (const OverLimit&) {
        throw;
    } catch (const Error& error) {
        mesh_.warnings.push_back(std::string("materials are left out: ") + error.what());
    }
    std::istringstream text(bytes);
    std::map<std::string, int> index;
    std::string warnings, errors;
    Materials materials;
    tinyobj::LoadMtl(&index, &materials, &text, &warnings, &errors);
    const std::vector<std::string_view> names = material_names(bytes);
    if (names.size() != materials.size()) return materials;
    for (std::size_t i = 0; i < names.size(); ++i) materials[i].name = names[i];
    return materials;
}

/// Finds the images of map_Kd that are there and may be read, each once.
void MaterialReader::find_textures(const std::filesystem::path& library, const Materials& materials) {
    const io::NamedFiles files(library, options_.allow_outside);
    std::set<std::string> outside;
    for (const tinyobj::material_t& material : materials) {
        const std::string name = with_slashes(material.diffuse_texname);
        std::error_code error;
        const auto place = name.empty() ? std::nullopt : files.find(name);
        if (!name.empty() && !place && outside.insert(name).second)
            mesh_.warnings.push_back("a texture is not looked at: " + io::about(library, "names ") +
                                     mesh::quoted(name) + io::NamedFiles::outside);
        if (place && images_.find(*place) == images_.end() && std::filesystem::is_regular_file(*place, error))
            images_.emplace(*place, image_in(*place, options_.limits));
        const auto image = place ? images_.find(*place) : images_.end();
        textures_.push_back(image == images_.end()
                                ? std::nullopt
                                : std::optional(texture_with(material.diffuse_texopt, image->second)));
    }
}

/// Most of them nothing reads, but whoever shows the output wants them. Those outside are not even looked
/// for.
void MaterialReader::warn_of_textures(const std::filesystem::path& library, const Materials& materials) {
    const io::NamedFiles files(library, false);
    std::set<std::string> missing;
    for (const tinyobj::material_t& material : materials) {
        for (const std::string& texture : texture_names(material)) {
            if (texture.empty()) continue;
            const std::string name = with_slashes(texture);
            std::error_code error;
            const auto place = files.find(name);
            if (place && !std::filesystem::is_regular_file(*place, error)) missing.insert(name);
        }
    }
    for (const std::string& name : missing)
        mesh_.warnings.push_back("a texture is missing: " + io::about(library, "names ") +
                                 mesh::quoted(name) +
                                 ", which is not there; put it beside the material file");
}

/// Reads the material files, each once, and calls visit(file, materials). To look a name up takes far longer
/// than to read it: hence the limit on names, whether they name the same file or none.
template <class Visit>
void MaterialReader::each_library(const Visit& visit) {
    constexpr std::size_t most = 1000;
    std::size_t names = 0;
    std::set<std::string_view> lines;
    std::set<std::filesystem::path> read;
    for (const std::string_view line : lines_.libraries) {
        if (!lines.insert(line).second) continue;
        for (const std::string_view name : library_names(file_, line)) {
            if (++names > most) {
                mesh_.warnings.push_back("materials are left out: there are more than " +
                                         std::to_string(most) + " material files; merge them");
                return;
            }
            std::optional<std::filesystem::path> library = files_.find(name);
            std::error_code error;
            if (!library || !std::filesystem::exists(*library, error))
                library = files_.find(with_slashes(std::string(name)));
            if (!library) {
                mesh_.warnings.push_back("materials are left out: " + line_of(text_, name.data()) +
                                         ": mtllib names " + quoted(name) + io::NamedFiles::outside);
            } else if (read.insert(*library).second) {
                visit(*library, read_library(*library));
            }
        }
    }
}

void MaterialReader::read() {
    Materials found;
    each_library([&](const std::filesystem::path& library, const Materials& materials) {
        warn_of_textures(library, materials);
        find_textures(library, materials);
        found.insert(found.end(), materials.begin(), materials.end());
    });
    std::vector<bool> colored(mesh_.materials.size(), false);  // the first entry of a name counts
    for (std::size_t i = 0; i < found.size(); ++i) {
        const tinyobj::material_t& entry = found[i];
        const auto used = lines_.used.find(io::trimmed(entry.name));
        if (used == lines_.used.end()) continue;
        const auto number = static_cast<std::size_t>(used->second);
        if (colored[number]) continue;
        colored[number] = true;
        const float rgba[] = {entry.diffuse[0], entry.diffuse[1], entry.diffuse[2], entry.dissolve};
        for (int c = 0; c < 4; ++c) mesh_.materials[number].base_color[c] = std::clamp(rgba[c], 0.0f, 1.0f);
        mesh_.materials[number].texture = textures_[i];
    }
}

std::vector<std::filesystem::path> MaterialReader::files() {
    std::vector<std::filesystem::path> named;
    each_library([&](const std::filesystem::path& library, const Materials& materials) {
        named.push_back(library);
        const io::NamedFiles files(library, options_.allow_outside);
        for (const tinyobj::material_t& material : materials) {
            for (const std::string& texture : texture_names(material)) {
                const auto place = texture.empty() ? std::nullopt : files.find(with_slashes(texture));
                if (place) named.push_back(*place);
            }
        }
    });
    return named;
}

}  // namespace

void read_materials(const std::filesystem::path& file, std::string_view text, const MaterialLines& lines,
                    const LoadOptions& options, Budget& budget, Mesh& mesh) {
    MaterialReader(file, text, lines, options, budget, mesh).read();
}

std::vector<std::filesystem::path> material_files(const std::filesystem::path& file, std::string_view text,
                                                  const MaterialLines& lines, const LoadOptions& options,
                                                  Budget& budget) {
    Mesh unread;
    return MaterialReader(file, text, lines, options, budget, unread).files();
}

}  // namespace goffer::mesh
