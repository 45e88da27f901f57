// SPDX-License-Identifier: MIT
#include "viewer/loader.hpp"

#include "body_file.hpp"
#include "report.hpp"
#include "suitability.hpp"

#include <goffer/paper/base.hpp>

#include <algorithm>
#include <cmath>
#include <exception>
#include <new>
#include <numbers>
#include <utility>

namespace goffer::cli {
namespace {

/// The base model, as `goffer base --caps` makes it.
BoundModel base_model() {
    BoundModel model;
    model.file = "base";
    model.mesh = mesh_of(paper::base_mesh(10, 1, 64, 161, true));
    model.rest = mesh::vertex_arrays(model.mesh);
    return model;
}

std::vector<Target> rest_targets(const bend::Body& body) {
    std::vector<Target> targets;
    for (const bend::Pose& rest : body.rest_poses())
        targets.push_back(
            {degrees(static_cast<double>(rest.angle)), degrees(static_cast<double>(rest.direction)), rest});
    return targets;
}

/// What the command `bend` would warn of, at a right angle or as far as the body bends.
std::vector<std::string> warnings_of(const BoundModel& model, const Textures& textures,
                                     const BindRequest& request) {
    Report report("");
    for (const std::string& warning : model.mesh.warnings) report.warn(warning);
    for (const std::string& warning : textures.warnings) report.warn(warning);
    if (!model.baked) {
        report_suitability(report, model);
        const bend::Body& body = model.binding.body;
        std::vector<double> angles;
        for (std::size_t r = 0; r < body.region_count(); ++r)
            angles.push_back(std::min(static_cast<double>(body.max_angle(r)), std::numbers::pi / 2));
        warn_of_folds(report, request, model, angles);
    }
    return report.warnings();
}

}  // namespace

Loaded load(const Wish& wish) {
    std::vector<ModelFile> files;
    for (const std::filesystem::path& file : wish.files) files.emplace_back(file, wish.bind.load.limits);
    const PoseRequest pose(wish.pose, baked_regions(files));
    const BindRequest request(wish.bind, pose.regions);
    Loaded loaded{
        .wish = wish, .models = {}, .textures = {}, .words = request.words, .targets = {}, .warnings = {}};
    if (files.empty()) loaded.models.push_back(bind_mesh(base_model(), request));
    for (ModelFile& file : files) loaded.models.push_back(bind_model(std::move(file), request));
    const bend::Body& body = loaded.models[0].binding.body;
    loaded.targets = targets_on(body, pose);
    if (wish.keep_rest && body.rest_pose().angle != 0) loaded.targets = rest_targets(body);
    for (std::size_t r = 0; r < loaded.targets.size(); ++r) {
        const double asked = std::fabs(loaded.targets[r].angle),
                     limit = degrees(static_cast<double>(body.max_angle(r)));
        // The limit itself comes back from the panel as a rounded word.
        if (std::isfinite(asked) && asked > 1.0001 * limit) {
            Report report("");
            warn_of_angle(report, region_words(r, loaded.targets.size()), asked, limit, "clamped to it");
            loaded.warnings.push_back(report.warnings()[0]);
        }
    }
    for (const BoundModel& model : loaded.models) {
        const Textures& textures =
            loaded.textures.emplace_back(textures_of(model.mesh, wish.bind.load.limits));
        for (const std::string& warning : warnings_of(model, textures, request))
            loaded.warnings.push_back(
                (loaded.models.size() > 1 ? model.file.filename().string() + ": " : "") + warning);
    }
    return loaded;
}

Loader::Loader(std::function<void()> wake) : wake_window_(std::move(wake)), thread_([this] { work(); }) {}

Loader::~Loader() {
    {
        const std::lock_guard lock(mutex_);
        stop_ = true;
    }
    wake_.notify_one();
    thread_.join();
}

void Loader::ask(Wish wish) {
    {
        const std::lock_guard lock(mutex_);
        next_ = std::make_unique<Wish>(std::move(wish));
    }
    wake_.notify_one();
}

Loader::Answer Loader::take() {
    const std::lock_guard lock(mutex_);
    Answer answer = std::exchange(answer_, {});
    answer.last = !working_ && next_ == nullptr;
    return answer;
}

bool Loader::answered() {
    const std::lock_guard lock(mutex_);
    return answer_.loaded != nullptr || !answer_.error.empty();
}

bool Loader::busy() {
    const std::lock_guard lock(mutex_);
    return working_ || next_ != nullptr;
}

void Loader::work() {
    std::unique_lock lock(mutex_);
    for (;;) {
        wake_.wait(lock, [&] { return stop_ || next_ != nullptr; });
        if (stop_) return;
        const std::unique_ptr<Wish> wish = std::move(next_);
        working_ = true;
        lock.unlock();
        Answer answer;
        try {
            answer.loaded = std::make_unique<Loaded>(load(*wish));
        } catch (const std::bad_alloc&) {
            answer.error = "not enough memory for this; use a smaller mesh";
        } catch (const std::exception& error) {
            answer.error = error.what();
        }
        lock.lock();
        answer_ = std::move(answer);
        working_ = false;
        wake_window_();
    }
}

}  // namespace goffer::cli
