// SPDX-License-Identifier: MIT
#include "textures.hpp"

#include <algorithm>
#include <cstdint>
#include <map>
#include <memory>
#include <utility>

namespace goffer::cli {
namespace {

/// Decodes images, each once.
class Decoder {
public:
    explicit Decoder(const mesh::Limits& limits) : pixels_left_(limits.memory / 16) {}

    /// Null where it cannot be shown, which is then warned of, once.
    std::shared_ptr<const view::Image> operator()(const std::shared_ptr<const mesh::Image>& image,
                                                  std::vector<std::string>& warnings) {
        const auto [known, is_new] = known_.try_emplace(image);
        if (is_new) {
            try {
                view::Image decoded = view::decode_image(image->bytes(), pixels_left_);
                pixels_left_ -= decoded.rgba.size() / 4;
                known->second = std::make_shared<view::Image>(std::move(decoded));
            } catch (const mesh::Error& error) {
                warnings.push_back(std::string("a texture is not shown: ") + error.what());
            } catch (const view::Error& error) {
                warnings.push_back(std::string("a texture is not shown: ") + error.what());
            }
        }
        return known->second;
    }

private:
    std::uint64_t pixels_left_;
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
        if (!used[m] || !placed) continue;
        textures.of_material[m] = {.image = decode(material.texture->image, textures.warnings),
                                   .wrap_u = material.texture->wrap_u,
                                   .wrap_v = material.texture->wrap_v,
                                   .nearest = material.texture->nearest};
    }
    return textures;
}

}  // namespace goffer::cli
