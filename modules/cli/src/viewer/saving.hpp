// SPDX-License-Identifier: MIT
#pragma once

#include "stage/load.hpp"

#include <glm/vec2.hpp>

#include <filesystem>
#include <map>
#include <span>
#include <string>

/// What the viewer saves, into the folder that it was called from.

namespace goffer::cli {

/// Names files after a model, and none that somebody else's file has.
class Saver {
public:
    /// Each returns the file's name. Throws where it cannot be written.
    ///
    /// The model in these poses, as `goffer bend` writes it; in its own format, or as GLB.
    [[nodiscard]] std::filesystem::path save_model(const BoundModel& model,
                                                   std::span<const bend::Pose> poses);
    /// The body file that `goffer bake` makes of these words. Takes as long as binding does.
    [[nodiscard]] std::filesystem::path save_body(const Wish& wish);
    /// A part of the frame buffer, `low` being its lower left corner.
    [[nodiscard]] std::filesystem::path save_picture(const BoundModel& model, const glm::ivec2& low,
                                                     const glm::ivec2& size);

private:
    [[nodiscard]] std::filesystem::path name_for(const BoundModel& model, const std::string& tag,
                                                 const std::string& ending) const;

    std::map<std::filesystem::path, std::filesystem::path>
        own_;  // files that were written, and of which model
};

}  // namespace goffer::cli
