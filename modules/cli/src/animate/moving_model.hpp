// SPDX-License-Identifier: MIT
#pragma once

#include "model.hpp"
#include "motion/motion.hpp"

#include <goffer/clip/frames.hpp>
#include <goffer/engine/isa.hpp>
#include <goffer/mesh/mesh.hpp>

#include <cstddef>
#include <vector>

namespace goffer::cli {

/// A bound model that moves. Every frame is deformed when it is asked for, and none is kept. Frame k is that
/// of the time k / rate. Unlike of other Frames, all const functions are thread-safe.
class MovingModel final : public clip::Frames {
public:
    /// `model` and `motion`, which is for its regions, must outlive this. Throws InputError where the motion
    /// does not suit the body.
    MovingModel(const BoundModel& model, const Motion& motion, std::size_t frames, double rate, Isa isa);

    [[nodiscard]] std::size_t count() const noexcept override { return frames_; }
    [[nodiscard]] double rate() const noexcept override { return rate_; }
    [[nodiscard]] std::size_t vertices() const noexcept override { return model_.rest.positions.size(); }
    void read(std::size_t frame, std::span<glm::vec3> positions, std::span<glm::vec3> normals) override;
    [[nodiscard]] glm::mat4x3 placement(std::size_t frame) const override { return moment(frame).transform; }

    [[nodiscard]] const BoundModel& model() const noexcept { return model_; }
    [[nodiscard]] Moment moment(std::size_t frame) const;

    /// The model in its place in the scene, in its own order, as `goffer bend` writes it.
    [[nodiscard]] mesh::VertexArrays records(std::size_t frame) const { return records(moment(frame)); }
    [[nodiscard]] mesh::VertexArrays records(const Moment& moment) const;

private:
    const BoundModel& model_;
    const Motion& motion_;
    std::size_t frames_;
    double rate_;
    Isa isa_;
};

}  // namespace goffer::cli
