// SPDX-License-Identifier: MIT
#pragma once

#include "model.hpp"

#include <goffer/bend/pose.hpp>
#include <goffer/bend/sockets.hpp>

#include <glm/mat4x3.hpp>

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace goffer::cli {

/// The frames that a body carries when it is bent: those in which its regions begin and the last one ends, on
/// the axis, and those of its sockets.
class Frames {
public:
    explicit Frames(const BoundModel& model);

    /// Bends it, by one pose for each of its regions.
    void set(std::span<const bend::Pose> poses);

    /// Frame i is where region i begins; one more is where the last ends. Columns e1, e2, e3 and the center.
    [[nodiscard]] std::span<const glm::mat4x3> regions() const { return regions_; }
    /// As bend::SocketFrame, in the order of BoundModel::sockets.
    [[nodiscard]] std::span<const bend::SocketFrame> sockets() const;

private:
    std::optional<bend::Sockets> places_;  // on the axis, then the model's
    std::vector<bend::SocketFrame> frames_;
    std::vector<glm::mat4x3> regions_;
};

}  // namespace goffer::cli
