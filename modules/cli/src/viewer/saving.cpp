// SPDX-License-Identifier: MIT
#include "viewer/saving.hpp"

#include "body_file.hpp"
#include "deformed.hpp"

#include <goffer/bend/job.hpp>
#include <goffer/io/atomic_file.hpp>
#include <goffer/mesh/mesh.hpp>
#include <goffer/view/picture.hpp>

#include <epoxy/gl.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <system_error>
#include <utility>
#include <vector>

namespace goffer::cli {

std::filesystem::path Saver::name_for(const BoundModel& model, const std::string& tag,
                                      const std::string& ending) const {
    const std::string stem = model.file.stem().string() + tag;
    std::filesystem::path name = stem + ending;
    const auto taken = [&](const std::filesystem::path& at) {
        std::error_code error;
        const auto own = own_.find(at);
        return own == own_.end() ? std::filesystem::exists(at, error) : own->second != model.file;
    };
    for (int i = 2; taken(name); ++i) {
        std::string other = stem;
        other += "-" + std::to_string(i) + ending;
        name = std::move(other);
    }
    return name;
}

std::filesystem::path Saver::save_model(const BoundModel& model, std::span<const bend::Pose> poses) {
    std::filesystem::path file = name_for(model, "-bent", ending_of(model));
    mesh::save(bent_mesh(model, poses), file);
    own_[file] = model.file;
    return file;
}

std::filesystem::path Saver::save_body(const Wish& wish) {
    if (wish.files.empty()) throw InputError("the base model has no file to bake; open a model");
    refuse_body_file(wish.files[0]);
    BindRequest request = bind_request(wish, PoseRequest(wish.pose, wish.bind.fit.arcs));
    request.with_uvs = true;
    BoundModel model = bind_model(wish.files[0], request);
    std::filesystem::path file = name_for(model, "", ".goffer");
    const std::vector<std::byte> bytes = baked_bytes(std::move(model), request);
    io::write_file(file, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
    own_[file] = wish.files[0];
    return file;
}

std::filesystem::path Saver::save_picture(const BoundModel& model, const glm::ivec2& low,
                                          const glm::ivec2& size) {
    constexpr std::size_t channels = 3;
    view::Picture picture{size.x, size.y, {}};
    const std::size_t row = channels * static_cast<std::size_t>(size.x);
    picture.rgb.resize(row * static_cast<std::size_t>(size.y));
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glReadPixels(low.x, low.y, size.x, size.y, GL_RGB, GL_UNSIGNED_BYTE, picture.rgb.data());
    for (std::size_t top = 0, bottom = static_cast<std::size_t>(size.y) - 1; top < bottom; ++top, --bottom) {
        const auto at = [&](std::size_t y) {
            return picture.rgb.begin() + static_cast<std::ptrdiff_t>(y * row);
        };
        std::swap_ranges(at(top), at(top + 1), at(bottom));
    }
    std::filesystem::path file = name_for(model, "-view", ".png");
    view::save_png(picture, file);
    own_[file] = model.file;
    return file;
}

}  // namespace goffer::cli
