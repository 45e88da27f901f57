// SPDX-License-Identifier: MIT
#include "format.hpp"
#include "gltf.hpp"
#include "text.hpp"

#include <glm/gtc/type_ptr.hpp>
#include <glm/vec2.hpp>

#include <cmath>
#include <map>
#include <optional>

/// Textures are for looking at: what is wrong with one is a warning, and the mesh is loaded without it.

namespace goffer::mesh::gltf {
namespace {

constexpr const char* glossy = "KHR_materials_pbrSpecularGlossiness";

/// Where a document's image is, if it is a file that may be read; it need not be there.
std::optional<std::filesystem::path> file_of(const Document& document, const std::string& uri) {
    return has_scheme(uri) ? std::nullopt : document.files.find(path_of(uri));
}

class DocumentImage final : public Image {
public:
    DocumentImage(std::shared_ptr<const Document> document, std::size_t number)
        : document_(std::move(document)), number_(number) {}

    [[nodiscard]] std::string bytes() const override {
        const Value image = document_->root()["images"][number_];
        if (image.has("bufferView"))
            return std::string(document_->view(document_->entry("bufferViews", image["bufferView"])));
        const Value uri = image["uri"];
        if (is_data_uri(uri.text())) {
            if (std::optional<std::string> data = data_of(uri.text())) return std::move(*data);
            uri.fail("is not a well-formed data URI; export the file again");
        }
        const std::optional<std::filesystem::path> file = file_of(*document_, uri.text());
        if (!file) uri.fail("names " + mesh::quoted(uri.text()) + io::NamedFiles::outside);
        return image_in(*file, document_->limits)->bytes();
    }

private:
    std::shared_ptr<const Document> document_;
    std::size_t number_;
};

class TextureReader {
public:
    explicit TextureReader(const std::shared_ptr<const Document>& document) : document_(document) {}

    /// Throws Error for one that is broken. Nothing where the image is not there.
    std::optional<Texture> read(const Value& info);

private:
    std::shared_ptr<const Image> image(const Value& index);
    [[nodiscard]] bool is_there(const Value& image) const;
    static void read_sampler(const Value& sampler, Texture& texture);
    static void read_transform(const Value& transform, Texture& texture);

    const std::shared_ptr<const Document>& document_;
    std::map<std::size_t, std::shared_ptr<const Image>> images_;  ///< null: not there
};

bool TextureReader::is_there(const Value& image) const {
    if (image.has("bufferView")) {
        (void)document_->number("bufferViews", image["bufferView"]);  // that it names one
        return true;
    }
    const Value named = image["uri"];
    const std::string& uri = named.text();
    if (is_data_uri(uri)) return true;
    if (has_scheme(uri)) named.fail("is " + mesh::quoted(uri) + "; only paths are read");
    std::error_code error;
    const std::optional<std::filesystem::path> file = file_of(*document_, uri);
    return file && std::filesystem::is_regular_file(*file, error);
}

std::shared_ptr<const Image> TextureReader::image(const Value& index) {
    const std::size_t number = document_->number("images", index);
    const auto known = images_.find(number);
    if (known != images_.end()) return known->second;
    std::shared_ptr<const Image> image;
    if (is_there(document_->entry("images", index)))
        image = std::make_shared<DocumentImage>(document_, number);
    return images_.emplace(number, std::move(image)).first->second;
}

void TextureReader::read_sampler(const Value& sampler, Texture& texture) {
    enum : std::uint64_t { nearest = 9728, clamp = 33071, mirror = 33648, repeat = 10497 };
    const auto wrap = [&](const char* key) {
        const std::uint64_t mode = sampler.whole_or(key, repeat);
        return mode == clamp ? Wrap::clamp : mode == mirror ? Wrap::mirror : Wrap::repeat;
    };
    texture.wrap_u = wrap("wrapS");
    texture.wrap_v = wrap("wrapT");
    texture.nearest = sampler.whole_or("magFilter", 0) == nearest;
}

/// KHR_texture_transform: scaled, then turned, then shifted, where v points down. Here it points up.
void TextureReader::read_transform(const Value& transform, Texture& texture) {
    const auto pair = [&](const char* key, double otherwise) {
        if (!transform.has(key)) return glm::dvec2(otherwise);
        const std::vector<double> values = transform[key].numbers(2);
        return glm::dvec2(values[0], values[1]);
    };
    const glm::dvec2 offset = pair("offset", 0), scale = pair("scale", 1);
    const double turn = transform.has("rotation") ? transform["rotation"].number() : 0;
    const double c = std::cos(turn), s = std::sin(turn);
    texture.transform = glm::mat3x2(glm::dmat3x2(c * scale.x, s * scale.x, -s * scale.y, c * scale.y,
                                                 offset.x + s * scale.y, 1 - offset.y - c * scale.y));
    texture.uv_set = transform.whole_or("texCoord", texture.uv_set);
}

std::optional<Texture> TextureReader::read(const Value& info) {
    const Value entry = document_->entry("textures", info["index"]);
    if (!entry.has("source")) entry.fail("has no image that all programs read; export it with PNG or JPEG");
    Texture texture{.image = image(entry["source"])};
    if (!texture.image) return std::nullopt;
    texture.uv_set = info.whole_or("texCoord", 0);
    if (entry.has("sampler")) read_sampler(document_->entry("samplers", entry["sampler"]), texture);
    constexpr const char* transform = "KHR_texture_transform";
    if (info.has("extensions") && info["extensions"].has(transform))
        read_transform(info["extensions"][transform], texture);
    return texture;
}

/// Where a material says its base color's texture; nothing where it has none.
std::optional<Value> info_of(const Value& material) {
    const auto member = [](const Value& owner, const char* key) {
        return owner.has(key) ? std::optional(owner[key]) : std::nullopt;
    };
    if (material.has("pbrMetallicRoughness"))
        return member(material["pbrMetallicRoughness"], "baseColorTexture");
    if (material.has("extensions") && material["extensions"].has(glossy))
        return member(material["extensions"][glossy], "diffuseTexture");
    return std::nullopt;
}

glm::vec4 color_of(const Value& owner, const char* key) {
    if (!owner.has(key)) return glm::vec4(1.0f);
    return glm::vec4(glm::make_vec4(owner[key].numbers(4).data()));
}

}  // namespace

std::vector<Material> materials_of(const Document& document) {
    std::vector<Material> materials;
    for (std::size_t i = 0; i < document.count("materials"); ++i) {
        const Value material = document.root()["materials"][i];
        Material read{.name = material.text_or("name", ""), .base_color = glm::vec4(1.0f)};
        if (material.has("pbrMetallicRoughness")) {
            read.base_color = color_of(material["pbrMetallicRoughness"], "baseColorFactor");
        } else if (material.has("extensions") && material["extensions"].has(glossy)) {
            read.base_color = color_of(material["extensions"][glossy], "diffuseFactor");
        }
        materials.push_back(std::move(read));
    }
    return materials;
}

std::vector<std::string> read_textures(const std::shared_ptr<const Document>& document, Mesh& mesh) {
    TextureReader reader(document);
    std::string first;
    std::size_t broken = 0;
    for (std::size_t i = 0; i < mesh.materials.size(); ++i) {
        try {
            Material& material = mesh.materials[i];
            const std::optional<Value> info = info_of(document->root()["materials"][i]);
            if (info) material.texture = reader.read(*info);
            if (material.texture) material.texture->factor = material.base_color;
        } catch (const Error& error) {
            if (broken++ == 0) first = error.what();
        }
    }
    if (broken == 0) return {};
    const std::string more = broken > 1 ? ", and " + std::to_string(broken - 1) + " more" : "";
    return {"a texture is not looked at: " + first + more};
}

}  // namespace goffer::mesh::gltf
