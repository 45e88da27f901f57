// SPDX-License-Identifier: MIT
#pragma once

#include "stage/controls.hpp"
#include "stage/dragging.hpp"
#include "stage/stage.hpp"
#include "viewer/loader.hpp"
#include "viewer/panel.hpp"
#include "viewer/saving.hpp"
#include "viewer/window.hpp"

#include <goffer/draw/orbit_camera.hpp>
#include <goffer/draw/renderer.hpp>

#include <glm/vec2.hpp>

#include <chrono>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace goffer::cli {

/// How the viewer begins.
struct ViewerPlan {
    glm::ivec2 size{1280, 720};
    Controls controls;
    std::size_t frames = 0;  ///< pictures to draw as fast as it can, in motion; 0: until it is closed
};

/// What a number of frames took: medians in milliseconds.
struct ViewerTimes {
    FrameTimes deformation;
    std::optional<double> draw;
    double frame = 0;
    std::string device;
    std::size_t frames = 0;  ///< that were drawn
};

/// The window with a stage in it, the panel beside it, and what keys and the mouse do.
class Viewer {
public:
    /// Throws InputError where there is no display.
    Viewer(std::unique_ptr<Loaded> loaded, const ViewerPlan& plan);
    ~Viewer();
    Viewer(const Viewer&) = delete;
    Viewer& operator=(const Viewer&) = delete;

    /// Until the window is closed or the plan's frames are drawn.
    ViewerTimes run();

    [[nodiscard]] const Stage& stage() const { return *stage_; }

private:
    using Clock = std::chrono::steady_clock;

    void wait();
    void frame();
    void take_answer();
    void open(const std::vector<std::filesystem::path>& files);
    void take_keys();
    void take_mouse();
    void press(const KeyPress& key);
    void press_with_control(int key);
    void turn_region(std::size_t region, float angle, float direction);
    void bind();
    void ask(Wish wish);
    void set_instances();
    void draw_picture();
    void act(const Done& done);
    void drag_end();
    void show_all();
    template <class Save>
    void save(const Save& write);
    void say(const std::string& message, bool failed = false);
    void set_stage(std::unique_ptr<Loaded> loaded);
    [[nodiscard]] bool moves() const { return plan_.frames > 0 || controls_.animated; }
    [[nodiscard]] std::vector<bend::Pose> poses() const;
    [[nodiscard]] draw::Viewport viewport() const;
    [[nodiscard]] float panel_width() const;
    [[nodiscard]] Pointer mouse() const;
    /// The region whose end is under the mouse.
    [[nodiscard]] std::optional<std::size_t> end_under_mouse() const;

    ViewerPlan plan_;
    Window window_;
    draw::Renderer renderer_;
    Loader loader_;
    Saver saver_;
    Controls controls_;
    std::unique_ptr<Stage> stage_;
    Wish asked_;  // last; the stage's once nothing is to come
    draw::OrbitCamera camera_;
    Told told_;
    bool picture_wanted_ = false;
    bool panel_ = true;
    std::size_t region_ = 0;              // that keys turn
    std::optional<std::size_t> dragged_;  // its end is on the mouse
    bool turning_ = false, shifting_ = false;
    std::size_t motion_ = 0;  // frames in motion
    Clock::time_point last_ = Clock::now();
    int redraws_ = 3;  // frames until it may wait
    std::vector<double> set_up_times_, deform_times_, upload_times_, draw_times_, frame_times_;
};

}  // namespace goffer::cli
