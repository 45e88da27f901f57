// SPDX-License-Identifier: MIT
#pragma once

#include "deformed.hpp"
#include "stage/controls.hpp"
#include "stage/dragging.hpp"
#include "stage/stage.hpp"

#include <goffer/draw/renderer.hpp>

#include <emscripten/emscripten.h>
#include <emscripten/html5.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace goffer::web {
using Json = nlohmann::ordered_json;

inline constexpr float end_pixels = 18;  // of the discs that ends are dragged by; fingers are thick
inline constexpr std::uint64_t memory = std::uint64_t{1} << 29;  // bytes for a model

/// Makes a context of WebGL 2 current, on the canvas that `selector` finds.
inline void make_context(const char* selector) {
    EmscriptenWebGLContextAttributes attributes;
    emscripten_webgl_init_context_attributes(&attributes);
    attributes.majorVersion = 2;
    attributes.alpha = false;
    attributes.antialias = true;
    const EMSCRIPTEN_WEBGL_CONTEXT_HANDLE context = emscripten_webgl_create_context(selector, &attributes);
    if (context <= 0 || emscripten_webgl_make_context_current(context) != EMSCRIPTEN_RESULT_SUCCESS)
        throw std::runtime_error("this browser has no WebGL 2; try a newer one, or another device");
}

inline cli::Wish first_wish() {
    cli::Wish wish;
    wish.files = {"/caterpillar.glb"};
    wish.bind.refine = "auto";
    wish.bind.wrinkle_range = "0,0.72";  // its face stays smooth
    wish.bind.load.limits.memory = memory;
    wish.pose.direction = 90;
    return wish;
}

/// What is on the canvas, and what the page's controls are set to.
class Page {
public:
    /// Before all else. Where it throws, there is nothing on the canvas, and no other call may follow.
    void start(const char* canvas) {
        make_context(canvas);
        renderer_.emplace();
        put_on_stage(first_wish(), controls_);
    }

    /// Models in place of those that are there, with the words that are chosen. Where it throws, all is as it
    /// was.
    void open(const Json& files) {
        std::vector<std::filesystem::path> names;
        for (const Json& file : files) names.emplace_back(file.get<std::string>());
        cli::Wish wish = cli::wish_to_open(std::move(names), controls_, stage_->loaded().wish);
        wish.bind.folds.reset();
        put_on_stage(wish, controls_);
        region_ = 0;
    }

    /// Binds again, with other words; `words` has some of those of state(). Where it throws, all is as it
    /// was.
    void bind(const Json& words) {
        cli::Controls controls = controls_;
        controls.profile = words.value("profile", controls.profile);
        controls.amplitude = words.value("amplitude", controls.amplitude);
        controls.shape = words.value("shape", controls.shape);
        controls.folds = words.value("folds", controls.folds);
        controls.fold_length = words.value("fold_length", controls.fold_length);
        controls.onset = words.value("onset", controls.onset);
        controls.region_count = words.value("regions", controls.region_count);
        put_on_stage(cli::wish_of(controls, stage_->loaded().wish), controls);
    }

    void set_instances(int instances) {
        controls_.instances = 0;
        stage_->set_instances(static_cast<std::size_t>(instances));
        controls_.instances = instances;
        look();
    }

    void set_bend(std::size_t region, const cli::Bend& bend) {
        controls_.regions.at(region) = {};
        controls_.turn(region, bend, stage_->model().binding.body.max_angle(region));
        region_ = region;
    }

    void show(const Json& what) {
        cli::Show& show = controls_.show;
        show.wireframe = what.value("wireframe", show.wireframe);
        show.normals = what.value("normals", show.normals);
        show.area = what.value("area", show.area);
        show.base = what.value("base", show.base);
        show.frames = what.value("frames", show.frames);
        show.rest = what.value("rest", show.rest);
        if (what.contains("shader"))
            controls_.deformer = what["shader"] ? cli::Deformer::shader : cli::Deformer::processor;
    }

    /// Draws the moment `frame` of the motion, if there is one. Where that is more than the device can do,
    /// throws, and shows one body from then on, deformed by the processor.
    cli::FrameTimes draw(int width, int height, std::size_t frame, bool animated) {
        try {
            return draw_picture({0, 0, width, height}, frame, animated);
        } catch (...) {
            controls_.deformer = cli::Deformer::processor;
            set_instances(0);
            throw;
        }
    }

    [[nodiscard]] int end_at(const glm::vec2& place, float reach) const {
        const std::optional<std::size_t> end =
            cli::end_at(stage_->frames(), camera_, {place, aspect_}, reach);
        return end ? static_cast<int>(*end) : -1;
    }

    void drag(std::size_t region, const glm::vec2& place) {
        if (region + 1 >= stage_->frames().size()) return;
        set_bend(region,
                 cli::bend_of(cli::dragged_pose(stage_->frames(), region, camera_, {place, aspect_})));
    }

    /// Has the camera see all of the pose that the controls say.
    void look() {
        stage_->pose(cli::poses_of(controls_), 0);
        stage_->show_all(camera_, aspect_ > 0 ? aspect_ : 1);
    }
    [[nodiscard]] draw::OrbitCamera& camera() { return camera_; }

    /// The model as it is bent, in a file whose name is returned.
    [[nodiscard]] std::string save() const {
        const BoundModel& model = stage_->model();
        const std::string file = "/" + model.file.stem().string() + "-bent.glb";
        mesh::save(cli::bent_mesh(model, cli::poses_of(controls_)), file);
        return file;
    }

    [[nodiscard]] std::string command() const {
        cli::Wish wish = stage_->loaded().wish;
        for (std::filesystem::path& file : wish.files) file = file.filename();
        return cli::command_of(controls_, wish, stage_->model());
    }

    [[nodiscard]] Json state() const {
        const BoundModel& model = stage_->model();
        const bend::Body& body = model.binding.body;
        Json regions = Json::array();
        int folds = 0;
        for (std::size_t r = 0; r < controls_.regions.size(); ++r) {
            const cli::Bend& bend = controls_.regions[r];
            folds += model.binding.folds(r);
            regions.push_back({{"angle", bend.angle},
                               {"direction", bend.direction},
                               {"limit", cli::degrees(static_cast<double>(body.max_angle(r)))}});
        }
        return {{"name", model.file.filename().string()},
                {"models", stage_->loaded().models.size()},
                {"vertices", stage_->vertices()},
                {"triangles", model.rest.triangles.size() / 3},
                {"folds_made", folds},
                {"baked", model.baked},
                {"regions", regions},
                {"instances", controls_.instances},
                {"profile", controls_.profile},
                {"amplitude", controls_.amplitude},
                {"shape", controls_.shape},
                {"shader", controls_.deformer == cli::Deformer::shader},
                {"folds", controls_.folds},
                {"fold_length", controls_.fold_length},
                {"onset", controls_.onset},
                {"warnings", stage_->loaded().warnings},
                {"device", renderer_->device()}};
    }

    std::string answer;  ///< to the last call

private:
    using BoundModel = cli::BoundModel;

    cli::FrameTimes draw_picture(const draw::Viewport& viewport, std::size_t frame, bool animated) {
        const bool first = aspect_ == 0;
        aspect_ = viewport.aspect();
        if (first) look();
        const std::vector<bend::Pose> poses = cli::poses_of(controls_);
        stage_->pose(animated && !stage_->is_crowd() ? cli::swung(poses, frame) : poses, frame);
        const cli::FrameTimes times = stage_->deform(controls_.deformer, controls_.show);
        renderer_->begin(camera_, viewport);
        stage_->draw(*renderer_, controls_.show);
        renderer_->draw_points(cli::end_marks(stage_->frames(), region_), end_pixels * pixel_ratio());
        renderer_->end();
        return times;
    }

    /// `controls`: what is to be chosen then.
    void put_on_stage(const cli::Wish& wish, cli::Controls controls) {
        auto stage = std::make_unique<cli::Stage>(std::make_unique<cli::Loaded>(cli::load(wish)));
        controls.set_words(stage->loaded().words);
        controls.take(stage->loaded());
        controls.region_count = static_cast<int>(controls.regions.size());
        stage->set_instances(static_cast<std::size_t>(controls.instances));
        stage_ = std::move(stage);
        controls_ = std::move(controls);
        region_ = std::min(region_, controls_.regions.size() - 1);
    }

    [[nodiscard]] static float pixel_ratio() {
        return static_cast<float>(emscripten_get_device_pixel_ratio());
    }

    std::optional<draw::Renderer> renderer_;
    std::unique_ptr<cli::Stage> stage_;
    cli::Controls controls_;
    draw::OrbitCamera camera_;
    std::size_t region_ = 0;
    float aspect_ = 0;  // width over height; 0: nothing has been drawn
};

}  // namespace goffer::web
