// SPDX-License-Identifier: MIT
#include "viewer/viewer.hpp"

#include "report.hpp"

#include <goffer/measure/timer.hpp>

#include <glm/geometric.hpp>
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <numbers>
#include <utility>

namespace goffer::cli {
namespace {

constexpr float panel_units = 330;  // wide
constexpr float end_pixels = 14;    // of the discs that ends are dragged by
constexpr double longest_wait = 1;  // seconds
constexpr int settling = 3;         // frames until the panel stands still

double milliseconds(std::chrono::steady_clock::duration time) {
    return std::chrono::duration<double, std::milli>(time).count();
}

}  // namespace

Viewer::Viewer(std::unique_ptr<Loaded> loaded, const ViewerPlan& plan)
    : plan_(plan),
      window_("goffer", plan.size, plan.frames == 0),
      loader_(Window::wake),
      controls_(plan.controls),
      asked_(loaded->wish) {
    told_.device = renderer_.device();
    set_stage(std::move(loaded));
    controls_.region_count = static_cast<int>(controls_.regions.size());
    show_all();
}

Viewer::~Viewer() {
    window_.hide();  // before it waits for what is being bound
}

ViewerTimes Viewer::run() {
    std::size_t drawn = 0;
    while (window_.is_open() && (plan_.frames == 0 || drawn < plan_.frames)) {
        wait();
        if (window_.is_minimized()) continue;
        frame();
        ++drawn;
        if (plan_.frames > 0) {
            set_up_times_.push_back(told_.times.set_up);
            deform_times_.push_back(told_.times.deform);
            upload_times_.push_back(told_.times.upload);
            if (told_.draw) draw_times_.push_back(*told_.draw);
            frame_times_.push_back(told_.frame);
        }
    }
    ViewerTimes times;
    times.frames = drawn;
    times.deformation = {measure::median(set_up_times_), measure::median(deform_times_),
                         measure::median(upload_times_)};
    if (!draw_times_.empty()) times.draw = measure::median(draw_times_);
    times.frame = measure::median(frame_times_);
    times.device = told_.device;
    return times;
}

void Viewer::wait() {
    const bool rests = (!moves() && redraws_ == 0) || window_.is_minimized();
    if (!rests) {
        redraws_ = window_.poll(0) ? settling : std::max(redraws_ - 1, 0);
        return;
    }
    const bool was_busy = told_.busy;
    while (window_.is_open() && !window_.poll(longest_wait) && !loader_.answered() &&
           loader_.busy() == was_busy) {
    }
    redraws_ = settling;
}

void Viewer::frame() {
    window_.begin_frame();
    take_answer();
    open(window_.take_files());
    if (plan_.frames == 0) take_keys();
    const Clock::time_point now = Clock::now();
    told_.frame = milliseconds(now - std::exchange(last_, now));
    told_.moving = moves();
    told_.busy = loader_.busy();
    window_.set_title("goffer: " + stage_->model().file.filename().string() +
                      (told_.busy ? " (binding ..)" : ""));
    if (panel_) act(show_panel(controls_, *stage_, told_, panel_width()));
    take_mouse();
    if (moves()) ++motion_;
    try {
        draw_picture();
    } catch (const std::exception& error) {  // more than the GPU holds
        if (plan_.frames > 0 || (controls_.deformer == Deformer::processor && !stage_->is_crowd())) throw;
        controls_.deformer = Deformer::processor;
        controls_.instances = 0;
        controls_.animated = false;
        set_instances();
        show_all();
        say(error.what(), true);
    }
    window_.end_frame();
}

void Viewer::draw_picture() {
    stage_->pose(poses(), motion_);
    told_.times = stage_->deform(controls_.deformer, controls_.show);
    renderer_.begin(camera_, viewport());
    stage_->draw(renderer_, controls_.show);
    if (std::exchange(picture_wanted_, false)) {  // before ends are marked
        const draw::Viewport part = viewport();
        save([&] {
            return saver_.save_picture(stage_->model(), {part.x, part.y}, {part.width, part.height});
        });
    }
    renderer_.draw_points(end_marks(stage_->frames(), region_),
                          end_pixels * window_.scale() * window_.pixel_ratio());
    renderer_.end();
    told_.draw = renderer_.draw_milliseconds();
}

/// Puts models on stage, and has the controls be about them.
void Viewer::set_stage(std::unique_ptr<Loaded> loaded) {
    stage_ = std::make_unique<Stage>(std::move(loaded));
    controls_.take(stage_->loaded());
    region_ = std::min(region_, controls_.regions.size() - 1);
    dragged_.reset();
    set_instances();
    stage_->pose(poses(), motion_);
}

void Viewer::set_instances() {
    try {
        stage_->set_instances(static_cast<std::size_t>(controls_.instances));
    } catch (const std::exception& error) {
        if (plan_.frames > 0) throw;
        controls_.instances = 0;
        controls_.animated = false;
        say(error.what(), true);
    }
}

void Viewer::take_answer() {
    Loader::Answer answer = loader_.take();
    if (!answer.loaded && answer.error.empty()) return;
    const bool other = answer.loaded && answer.loaded->wish.files != stage_->loaded().wish.files;
    if (answer.loaded) {
        try {
            set_stage(std::move(answer.loaded));
        } catch (const std::exception& error) {
            answer.error = error.what();
        }
    }
    if (answer.last) {
        asked_ = stage_->loaded().wish;
        if (!answer.error.empty()) controls_.set_words(stage_->loaded().words);
        controls_.region_count = static_cast<int>(controls_.regions.size());
    }
    if (!answer.error.empty()) return say(answer.error, true);
    if (told_.failed) say("");
    if (other) {
        controls_.path = {};
        show_all();
    }
    redraws_ = settling;
}

void Viewer::ask(Wish wish) {
    asked_ = wish;
    loader_.ask(std::move(wish));
    redraws_ = settling;
}

/// Binds with the words that the controls stand for.
void Viewer::bind() {
    const Wish& now = stage_->loaded().wish;
    if (asked_.files != now.files) return open(asked_.files);  // with the words that are chosen now
    ask(wish_of(controls_, now));
}

void Viewer::open(const std::vector<std::filesystem::path>& files) {
    if (files.empty() || files[0].empty()) return;
    ask(wish_to_open(files, controls_, stage_->loaded().wish));
}

void Viewer::turn_region(std::size_t region, float angle, float direction) {
    controls_.turn(region, {angle, direction}, stage_->model().binding.body.max_angle(region));
}

void Viewer::take_keys() {
    for (const KeyPress& key : window_.take_keys()) press(key);
}

void Viewer::press_with_control(int key) {
    Done done;
    done.save_model = key == 'S';
    done.save_picture = key == 'P';
    done.save_body = key == 'B';
    done.copy = key == 'C';
    act(done);
    if (key == 'Q') window_.close();
}

void Viewer::press(const KeyPress& key) {
    const float step = key.shift ? 1 : 5;
    redraws_ = settling;
    if (key.control) return press_with_control(key.key);
    Show& show = controls_.show;
    const auto flip = [](bool& value) { value = !value; };
    if (key.key >= '1' && key.key <= '9') {
        region_ = std::min(static_cast<std::size_t>(key.key - '1'), controls_.regions.size() - 1);
        return;
    }
    switch (key.key) {
        case Window::up:
            return turn_region(region_, step, 0);
        case Window::down:
            return turn_region(region_, -step, 0);
        case Window::left:
            return turn_region(region_, 0, -step);
        case Window::right:
            return turn_region(region_, 0, step);
        case ' ':
            return flip(controls_.animated);
        case 'W':
            return flip(show.wireframe);
        case 'N':
            return flip(show.normals);
        case 'A':
            return flip(show.area);
        case 'B':
            return flip(show.base);
        case 'F':
            return flip(show.frames);
        case 'R':
            return flip(show.rest);
        case 'D':
            controls_.deformer =
                controls_.deformer == Deformer::shader ? Deformer::processor : Deformer::shader;
            return;
        case 'C': {
            controls_.instances = controls_.instances == 0 ? 100 : 0;
            Done done;
            done.crowd = true;
            return act(done);
        }
        case 'L':
            return show_all();
        case Window::f1:
            return flip(panel_);
        case Window::escape:
            return window_.close();
        default:
            return;
    }
}

void Viewer::act(const Done& done) {
    if (done.bind) bind();
    if (done.open) {
        open({std::u8string(controls_.path.begin(), std::ranges::find(controls_.path, 0))});
    }
    if (done.crowd) {
        controls_.animated = controls_.instances > 0;
        set_instances();
        show_all();
    }
    if (done.look) show_all();
    if (done.save_picture) picture_wanted_ = true;
    if (done.save_model) save([&] { return saver_.save_model(stage_->model(), poses()); });
    if (done.save_body) save([&] { return saver_.save_body(wish_of(controls_, stage_->loaded().wish)); });
    if (!done.copy) return;
    try {
        window_.copy_to_clipboard(command_of(controls_, stage_->loaded().wish, stage_->model()));
        say("The command is in the clipboard.");
    } catch (const std::exception& error) {
        say(error.what(), true);
    }
}

template <class Save>
void Viewer::save(const Save& write) {
    try {
        say("Saved " + write().string() + ".");
    } catch (const std::exception& error) {
        say(error.what(), true);
    }
}

void Viewer::say(const std::string& message, bool failed) {
    told_.message = message;
    told_.failed = failed;
    redraws_ = settling;
}

std::vector<bend::Pose> Viewer::poses() const {
    const bool swings = !stage_->is_crowd() && moves();
    return swings ? swung(poses_of(controls_), motion_) : poses_of(controls_);
}

float Viewer::panel_width() const {
    return panel_ ? std::min(panel_units * window_.scale(), 0.5f * window_.size().x) : 0;
}

draw::Viewport Viewer::viewport() const {
    const glm::ivec2 pixels = window_.pixels();
    const int panel = static_cast<int>(panel_width() * window_.pixel_ratio());
    return {panel, 0, std::max(pixels.x - panel, 1), std::max(pixels.y, 1)};
}

Pointer Viewer::mouse() const {
    const ImGuiIO& io = ImGui::GetIO();
    const float width = std::max(window_.size().x - panel_width(), 1.0f), height = window_.size().y;
    return {{2 * (io.MousePos.x - panel_width()) / width - 1, 1 - 2 * io.MousePos.y / height},
            viewport().aspect()};
}

std::optional<std::size_t> Viewer::end_under_mouse() const {
    return end_at(stage_->frames(), camera_, mouse(), 1.5f * end_pixels * window_.scale() / window_.size().y);
}

/// Bends the region so that its end follows the mouse.
void Viewer::drag_end() {
    if (*dragged_ + 1 >= stage_->frames().size()) return;
    region_ = *dragged_;
    controls_.regions[region_] = bend_of(dragged_pose(stage_->frames(), region_, camera_, mouse()));
    turn_region(region_, 0, 0);
}

void Viewer::take_mouse() {
    const ImGuiIO& io = ImGui::GetIO();
    const bool free = !io.WantCaptureMouse;
    if (free && ImGui::IsMouseClicked(0)) {
        if (!moves()) dragged_ = end_under_mouse();
        turning_ = !dragged_ && !io.KeyShift;
        shifting_ = !dragged_ && io.KeyShift;
    }
    if (free && (ImGui::IsMouseClicked(1) || ImGui::IsMouseClicked(2))) shifting_ = true;
    const float height = window_.size().y;
    const glm::vec2 moved(io.MouseDelta.x / height, io.MouseDelta.y / height);
    if (dragged_ && (moved.x != 0 || moved.y != 0)) {
        drag_end();
    } else if (turning_) {
        camera_.orbit(-std::numbers::pi_v<float> * moved.x, std::numbers::pi_v<float> * moved.y);
    } else if (shifting_) {
        camera_.pan({2 * moved.x, -2 * moved.y});
    }
    // Behind the last motion, which may come in the same frame as the release.
    if (!ImGui::IsMouseDown(0)) {
        dragged_.reset();
        turning_ = false;
    }
    if (!ImGui::IsMouseDown(0) && !ImGui::IsMouseDown(1) && !ImGui::IsMouseDown(2)) shifting_ = false;
    if (free && io.MouseWheel != 0) camera_.zoom(std::pow(0.9f, io.MouseWheel));
}

void Viewer::show_all() {
    stage_->show_all(camera_, viewport().aspect());
}

}  // namespace goffer::cli
