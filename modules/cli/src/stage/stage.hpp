// SPDX-License-Identifier: MIT
#pragma once

#include "crowd/crowd.hpp"
#include "stage/frames.hpp"
#include "stage/load.hpp"
#include "stage/rig.hpp"

#include <goffer/bend/kernel_input.hpp>
#include <goffer/draw/mesh.hpp>
#include <goffer/draw/orbit_camera.hpp>
#include <goffer/draw/renderer.hpp>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace goffer::cli {

/// Who deforms what is seen.
enum class Deformer : std::uint8_t { processor, shader };

/// What is shown besides the surface.
struct Show {
    bool wireframe = false;
    /// These are for one body alone.
    bool normals = false, area = false, base = false, frames = false, rest = false;
};

/// Milliseconds of a frame.
struct FrameTimes {
    double set_up = 0;  ///< making the shader's coefficients; 0 where the processor deforms
    double deform = 0;  ///< on the processor, its set-up included
    double upload = 0;
};

/// Models that have been loaded, deformed and drawn: one body in a pose, or a crowd in motion. Needs the
/// context that it was made in to be current.
class Stage {
public:
    /// One body, the first model.
    explicit Stage(std::unique_ptr<Loaded> loaded);

    /// Makes a crowd of so many, or shows one body again for 0, which it does too where it throws: InputError
    /// for a crowd that memory does not hold.
    void set_instances(std::size_t instances);
    [[nodiscard]] std::size_t instances() const { return crowd_ ? crowd_->instances() : 1; }
    [[nodiscard]] bool is_crowd() const { return crowd_ != nullptr; }
    [[nodiscard]] const Loaded& loaded() const { return *loaded_; }
    /// The first model: that of the pose.
    [[nodiscard]] const BoundModel& model() const { return loaded_->models[0]; }
    [[nodiscard]] std::size_t vertices() const;

    /// Poses the body, by one pose for each of its regions; or has the crowd swing this far, as it is in
    /// frame `frame`.
    void pose(std::span<const bend::Pose> poses, std::size_t frame);
    /// Deforms all instances at these poses and uploads them.
    FrameTimes deform(Deformer how, const Show& show);
    void draw(draw::Renderer& renderer, const Show& show);

    /// Where regions begin, and the last one ends; none in a crowd.
    [[nodiscard]] std::span<const glm::mat4x3> frames() const;
    /// Has the camera see all, from where pictures are taken.
    void show_all(draw::OrbitCamera& camera, float aspect) const;

private:
    [[nodiscard]] std::span<const bend::Batch> batches() const;
    void upload_vertices(std::size_t group);
    void mark_normals();
    void draw_base(draw::Renderer& renderer);
    void mark_axes(const glm::mat4x3& frame, float size);

    std::unique_ptr<Loaded> loaded_;
    Frames frames_;
    std::vector<draw::Mesh> meshes_;  // of each model
    std::optional<draw::Mesh> rest_;  // the first model at rest, once it is shown
    std::optional<Rig> rig_;          // the base, once it is shown
    bool rig_sought_ = false;
    std::vector<bend::Pose> poses_;
    std::vector<draw::Vertex> vertices_;  // of one body
    bend::Batch batch_;                   // it
    std::unique_ptr<Crowd> crowd_;
    std::vector<bend::Coefficients> coefficients_;
    std::vector<draw::Mark> normals_, frame_marks_;
    bool area_shown_ = false;
};

}  // namespace goffer::cli
