// SPDX-License-Identifier: MIT
// The viewer in a browser: what page.js calls. Texts go in and out as JSON; a text that comes out is good
// until the next call. Nothing throws: an answer with "error" says what was wrong.
#include "deformed.hpp"
#include "stage/controls.hpp"
#include "stage/dragging.hpp"
#include "stage/stage.hpp"

#include <goffer/draw/renderer.hpp>

#include <emscripten/emscripten.h>
#include <emscripten/html5.h>
#include <nlohmann/json.hpp>

#include <exception>
#include <memory>
#include <new>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace goffer::web {
namespace {

using Json = nlohmann::ordered_json;

constexpr float end_pixels = 18;  // of the discs that ends are dragged by; fingers are thick
constexpr std::uint64_t memory = std::uint64_t{1} << 29;  // bytes for a model

/// Makes a context of WebGL 2 current, on the canvas that `selector` finds.
void make_context(const char* selector) {
    EmscriptenWebGLContextAttributes attributes;
    emscripten_webgl_init_context_attributes(&attributes);
    attributes.majorVersion = 2;
    attributes.alpha = false;
    attributes.antialias = true;
    const EMSCRIPTEN_WEBGL_CONTEXT_HANDLE context = emscripten_webgl_create_context(selector, &attributes);
    if (context <= 0 || emscripten_webgl_make_context_current(context) != EMSCRIPTEN_RESULT_SUCCESS)
        throw std::runtime_error("this browser has no WebGL 2; try a newer one, or another device");
}

cli::Wish first_wish() {
    cli::Wish wish;
    wish.files = {"/caterpillar.glb"};
    wish.bind.refine = "auto";
    wish.bind.wrinkle_range = "0,0.72";  // its face stays smooth
    wish.bind.load.limits.memory = memory;
    wish.pose.direction = 90;
    return wish;
}

}  // namespace

/// What is on the canvas, and what the page's controls are set to.
class Page {
public:
    explicit Page(const char* canvas) {
        make_context(canvas);
        renderer_.emplace();
        put_on_stage(first_wish());
    }

    /// Models in place of those that are there, with the words that are chosen.
    void open(const Json& files) {
        cli::Wish wish = cli::wish_of(controls_, stage_->loaded().wish);
        wish.files.clear();
        for (const Json& file : files) wish.files.emplace_back(file.get<std::string>());
        wish.pose = {};
        wish.keep_rest = true;
        wish.new_pose = true;
        wish.bind.wrinkle_range.reset();
        wish.bind.folds.reset();
        put_on_stage(wish);
    }

    /// Binds again, with other words; `words` has some of those of state(). Where it throws, all is as it
    /// was.
    void bind(const Json& words) {
        const cli::Controls before = controls_;
        try {
            controls_.profile = words.value("profile", controls_.profile);
            controls_.amplitude = words.value("amplitude", controls_.amplitude);
            controls_.shape = words.value("shape", controls_.shape);
            controls_.folds = words.value("folds", controls_.folds);
            controls_.fold_length = words.value("fold_length", controls_.fold_length);
            controls_.onset = words.value("onset", controls_.onset);
            controls_.region_count = words.value("regions", controls_.region_count);
            const float aspect = aspect_;
            const draw::OrbitCamera camera = camera_;
            put_on_stage(cli::wish_of(controls_, stage_->loaded().wish));
            aspect_ = aspect;
            camera_ = camera;
        } catch (...) {
            controls_ = before;
            throw;
        }
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

    /// Draws the moment `frame` of the motion, if there is one.
    const cli::FrameTimes* draw(int width, int height, std::size_t frame, bool animated) {
        const draw::Viewport viewport{0, 0, width, height};
        const bool first = aspect_ == 0;
        aspect_ = viewport.aspect();
        const std::vector<bend::Pose> poses = cli::poses_of(controls_);
        stage_->pose(animated && !stage_->is_crowd() ? cli::swung(poses, frame) : poses, frame);
        if (first) look();
        times_ = stage_->deform(controls_.deformer, controls_.show);
        renderer_->begin(camera_, viewport);
        stage_->draw(*renderer_, controls_.show);
        renderer_->draw_points(cli::end_marks(stage_->frames(), region_), end_pixels * pixel_ratio());
        renderer_->end();
        return &times_;
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
                {"folds", controls_.folds},
                {"fold_length", controls_.fold_length},
                {"onset", controls_.onset},
                {"warnings", stage_->loaded().warnings},
                {"device", renderer_->device()}};
    }

    std::string answer;  ///< to the last call

private:
    using BoundModel = cli::BoundModel;

    void put_on_stage(const cli::Wish& wish) {
        auto stage = std::make_unique<cli::Stage>(std::make_unique<cli::Loaded>(cli::load(wish)));
        stage_ = std::move(stage);
        controls_.set_words(stage_->loaded().words);
        controls_.take(stage_->loaded());
        controls_.region_count = static_cast<int>(controls_.regions.size());
        region_ = 0;
        set_instances(controls_.instances);
    }

    [[nodiscard]] static float pixel_ratio() {
        return static_cast<float>(emscripten_get_device_pixel_ratio());
    }

    std::optional<draw::Renderer> renderer_;
    std::unique_ptr<cli::Stage> stage_;
    cli::Controls controls_;
    draw::OrbitCamera camera_;
    cli::FrameTimes times_;
    std::size_t region_ = 0;
    float aspect_ = 0;  // width over height; 0: nothing has been drawn
};

namespace {

/// What `work` returns, as text that `page` keeps; or what it throws.
template <class Work>
const char* answered(Page& page, const Work& work) {
    Json answer;
    try {
        answer = work();
    } catch (const std::bad_alloc&) {
        answer = {{"error", "not enough memory for this; use a smaller mesh"}};
    } catch (const std::exception& error) {
        answer = {{"error", error.what()}};
    }
    page.answer = answer.dump(-1, ' ', false, Json::error_handler_t::replace);
    return page.answer.c_str();
}

template <class Work>
const char* then_state(Page& page, const Work& work) {
    return answered(page, [&] {
        work();
        return page.state();
    });
}

}  // namespace
}  // namespace goffer::web

using goffer::web::Page;

extern "C" {

/// Null where there is no WebGL 2.
EMSCRIPTEN_KEEPALIVE Page* goffer_page_make(const char* canvas) {
    try {
        return new Page(canvas);
    } catch (const std::exception& error) {
        emscripten_log(EM_LOG_ERROR, "%s", error.what());
        return nullptr;
    }
}

EMSCRIPTEN_KEEPALIVE const char* goffer_page_state(Page* page) {
    return goffer::web::then_state(*page, [] {});
}

EMSCRIPTEN_KEEPALIVE const char* goffer_page_open(Page* page, const char* files) {
    return goffer::web::then_state(*page, [&] { page->open(goffer::web::Json::parse(files)); });
}

EMSCRIPTEN_KEEPALIVE const char* goffer_page_bind(Page* page, const char* words) {
    return goffer::web::then_state(*page, [&] { page->bind(goffer::web::Json::parse(words)); });
}

EMSCRIPTEN_KEEPALIVE const char* goffer_page_crowd(Page* page, int instances) {
    return goffer::web::then_state(*page, [&] { page->set_instances(instances); });
}

EMSCRIPTEN_KEEPALIVE const char* goffer_page_bend(Page* page, int region, float angle, float direction) {
    return goffer::web::then_state(*page, [&] {
        page->set_bend(static_cast<std::size_t>(region), {angle, direction});
    });
}

EMSCRIPTEN_KEEPALIVE const char* goffer_page_drag(Page* page, int region, float x, float y) {
    return goffer::web::then_state(*page, [&] { page->drag(static_cast<std::size_t>(region), {x, y}); });
}

EMSCRIPTEN_KEEPALIVE const char* goffer_page_show(Page* page, const char* what) {
    return goffer::web::then_state(*page, [&] { page->show(goffer::web::Json::parse(what)); });
}

EMSCRIPTEN_KEEPALIVE const char* goffer_page_save(Page* page) {
    return goffer::web::answered(*page, [&] { return goffer::web::Json{{"file", page->save()}}; });
}

EMSCRIPTEN_KEEPALIVE const char* goffer_page_command(Page* page) {
    return goffer::web::answered(*page, [&] { return goffer::web::Json{{"command", page->command()}}; });
}

/// The region whose end is at a place of the picture, -1 to 1 from edge to edge; or -1.
EMSCRIPTEN_KEEPALIVE int goffer_page_end_at(Page* page, float x, float y, float reach) {
    return page->end_at({x, y}, reach);
}

/// {"set_up", "deform", "upload"} in milliseconds.
EMSCRIPTEN_KEEPALIVE const char* goffer_page_draw(Page* page, int width, int height, int frame,
                                                  int animated) {
    return goffer::web::answered(*page, [&] {
        const auto* const times = page->draw(width, height, static_cast<std::size_t>(frame), animated != 0);
        return goffer::web::Json{
            {"set_up", times->set_up}, {"deform", times->deform}, {"upload", times->upload}};
    });
}

EMSCRIPTEN_KEEPALIVE void goffer_page_orbit(Page* page, float azimuth, float elevation) {
    page->camera().orbit(azimuth, elevation);
}
EMSCRIPTEN_KEEPALIVE void goffer_page_pan(Page* page, float x, float y) {
    page->camera().pan({x, y});
}
EMSCRIPTEN_KEEPALIVE void goffer_page_zoom(Page* page, float factor) {
    page->camera().zoom(factor);
}
EMSCRIPTEN_KEEPALIVE void goffer_page_look(Page* page) {
    page->look();
}

}  // extern "C"
