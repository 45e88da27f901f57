// SPDX-License-Identifier: MIT
#include "budget.hpp"
#include "face_cutter.hpp"
#include "format.hpp"
#include "text.hpp"

#include <goffer/mesh/mesh.hpp>

#include <glm/vec3.hpp>

#include <utility>

namespace goffer::mesh {
namespace {

class FileImage final : public Image {
public:
    FileImage(std::filesystem::path file, const Limits& limits) : file_(std::move(file)), limits_(limits) {}

    [[nodiscard]] std::string bytes() const override {
        try {
            Budget budget(limits_);
            return read_bytes(file_, budget);
        } catch (const OverLimit& error) {
            fail(file_, error.what());
        }
    }

private:
    std::filesystem::path file_;
    Limits limits_;
};

/// The texture that faces of a part show, if they have coordinates for it; else null.
const Texture* texture_of(const Mesh& mesh, const Part& part) {
    if (part.material < 0) return nullptr;
    const auto& texture = mesh.materials[static_cast<std::size_t>(part.material)].texture;
    const bool placed = texture && texture->uv_set < mesh.uvs.size() && !mesh.uvs[texture->uv_set].empty();
    return placed ? &*texture : nullptr;
}

}  // namespace

std::shared_ptr<const Image> image_in(const std::filesystem::path& file, const Limits& limits) {
    return std::make_shared<FileImage>(file, limits);
}

std::vector<glm::vec2> texture_uvs(const Mesh& mesh) {
    bool any = false;
    for (const Part& part : mesh.parts) any = any || (part.face_count > 0 && texture_of(mesh, part));
    std::vector<glm::vec2> out;
    if (!any) return out;
    out.reserve(3 * triangle_count(mesh));
    FaceCutter cut(mesh);
    std::size_t first = 0;
    for (const Part& part : mesh.parts) {
        const Texture* const texture = texture_of(mesh, part);
        for (std::uint32_t f = part.first_face; f < part.first_face + part.face_count; ++f) {
            for (const std::size_t corner : cut(first, mesh.faces[f])) {
                glm::vec2& uv = out.emplace_back(0.0f);
                if (texture == nullptr) continue;
                const auto& uvs = mesh.uvs[texture->uv_set];
                const std::uint32_t value = value_at(uvs, corner, mesh.corners[corner]);
                if (value != uvs.none) uv = texture->transform * glm::vec3(uvs.values[value], 1);
            }
            first += mesh.faces[f];
        }
    }
    return out;
}

}  // namespace goffer::mesh
