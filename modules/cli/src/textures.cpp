// SPDX-License-Identifier: MIT
#include "textures.hpp"

#include <goffer/io/error.hpp>

#include <algorithm>
#include <cstdint>
#include <map>
#include <memory>
#include <new>
#include <string>
#include <utility>

namespace goffer::cli {
namespace {

/// Decodes images, each once.
class Decoder {
public:
    explicit Decoder(const mesh::Limits& limits) : pixels_left_(limits.memory / 16) {}

    /// The image of a material. Null where it cannot be shown, which is then warned of, once.
    std::shared_ptr<const view::Image> operator()(const std::shared_ptr<const mesh::Image>& image,
                                                  const std::string& material,
                                                  std::vector<std::string>& warnings) {
        const auto warn = [&](const std::string& why) {
            ++failures_;
            warnings.push_back("the texture of material '" + material + "' is not shown: " + why);
        };
        const auto [known, is_new] = known_.try_emplace(image);
        if (is_new && failures_ == most_failures) {
            ++failures_;
            warnings.emplace_back(
                "the textures of further materials are not shown: too many images are broken");
        }
        if (is_new && failures_ < most_failures) {
            try {
                view::Image decoded = view::decode_image(image->bytes(), pixels_left_);
                pixels_left_ -= decoded.rgba.size() / 4;
                known->second = std::make_shared<view::Image>(std::move(decoded));
            } catch (const mesh::Error& error) {
                warn(error.what());
            } catch (const view::Error& error) {
                warn(error.what());
            } catch (const std::bad_alloc&) {
                warn("there is not enough memory for its image; make it smaller");
            }
        }
        return known->second;
    }

private:
    /// An image may be broken in its last byte only, and takes as long as a good one.
    static constexpr int most_failures = 4;

    std::uint64_t pixels_left_;
    int failures_ = 0;
    std::map<std::shared_ptr<const mesh::Image>, std::shared_ptr<const view::Image>> known_;
};

}  // namespace

Textures textures_of(const mesh::Mesh& mesh, const mesh::Limits& limits) {
    Textures textures;
    textures.uvs = mesh::texture_uvs(mesh);
    if (textures.uvs.empty()) return textures;
    textures.of_material.resize(mesh.materials.size());
    std::vector<bool> used(mesh.materials.size(), false);
    for (const mesh::Part& part : mesh.parts)
        if (part.material >= 0 && part.face_count > 0) used[static_cast<std::size_t>(part.material)] = true;
    Decoder decode(limits);
    for (std::size_t m = 0; m < mesh.materials.size(); ++m) {
        const mesh::Material& material = mesh.materials[m];
        const bool placed = material.texture && material.texture->uv_set < mesh.uvs.size();
        if (used[m] && material.texture && !placed)
            textures.warnings.push_back("the texture of material '" + io::escaped(material.name) +
                                        "' is not shown: the model has no texture coordinates of set " +
                                        std::to_string(material.texture->uv_set));
        if (!used[m] || !placed) continue;
        textures.of_material[m] = {
            .image = decode(material.texture->image, io::escaped(material.name), textures.warnings),
            .wrap_u = material.texture->wrap_u,
            .wrap_v = material.texture->wrap_v,
            .nearest = material.texture->nearest};
    }
    return textures;
}

}  // namespace goffer::cli
