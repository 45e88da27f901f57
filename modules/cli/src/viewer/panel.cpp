// SPDX-License-Identifier: MIT
#include "viewer/panel.hpp"

#include <imgui.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdio>

namespace goffer::cli {
namespace {

const ImVec4 warning_color{0.62f, 0.32f, 0, 1}, error_color{0.75f, 0.05f, 0.05f, 1},
    quiet{0.35f, 0.35f, 0.35f, 1};
constexpr int most_instances = 2000, most_regions = 8, most_folds = 64;

void heading(const char* text) {
    ImGui::Separator();
    ImGui::TextColored(quiet, "%s", text);
}

void paragraph(const ImVec4& color, const std::string& text) {
    ImGui::PushStyleColor(ImGuiCol_Text, color);
    ImGui::TextWrapped("%s", text.c_str());
    ImGui::PopStyleColor();
}

std::string milliseconds(double time) {
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), time < 10 ? "%.2f ms" : "%.0f ms", time);
    return text.data();
}

std::string names_of(const std::vector<FileSocket>& sockets) {
    std::string names;
    for (const FileSocket& socket : sockets) {
        names += names.empty() ? "" : ", ";
        names += socket.name;
    }
    return names;
}

/// A choice of words. Returns whether another was chosen.
template <std::size_t N>
bool choice(const char* label, std::string& value, const std::array<const char*, N>& words) {
    bool changed = false;
    if (!ImGui::BeginCombo(label, value.c_str())) return false;
    for (const char* const word : words) {
        if (ImGui::Selectable(word, value == word) && value != word) {
            value = word;
            changed = true;
        }
    }
    ImGui::EndCombo();
    return changed;
}

/// A number of at least `least`, or `automatic`, which is below it. Returns whether it was let go at another
/// value.
bool slider_or_auto(const char* label, float& value, float automatic, float least, float most) {
    ImGui::SliderFloat(label, &value, automatic, most, value < least ? "auto" : "%.2f",
                       ImGuiSliderFlags_AlwaysClamp);
    if (value < least) value = automatic;
    return ImGui::IsItemDeactivatedAfterEdit();
}

void show_model(const Stage& stage, const Told& told) {
    const BoundModel& model = stage.model();
    ImGui::TextUnformatted(model.file.filename().string().c_str());
    if (stage.loaded().models.size() > 1) {
        ImGui::SameLine();
        ImGui::TextColored(quiet, "and %zu more", stage.loaded().models.size() - 1);
    }
    ImGui::TextColored(quiet, "%zu vertices, %zu triangles%s", model.binding.body.vertex_count(),
                       model.rest.triangles.size() / 3, model.growth ? ", refined" : "");
    int folds = 0;
    for (std::size_t r = 0; r < model.binding.regions.size(); ++r) folds += model.binding.folds(r);
    if (told.busy) {
        ImGui::TextColored(warning_color, "binding ..");
        return;
    }
    ImGui::TextColored(quiet, "length / radius %.1f, %s", model.cylinder.length / model.cylinder.radius,
                       counted(static_cast<std::size_t>(folds), "fold").c_str());
}

void show_opening(Controls& controls, const Stage& stage, const Told& told, Done& done) {
    ImGui::PushItemWidth(-1);
    done.open = ImGui::InputTextWithHint(
        "##open", "open: drop a file, or type its path", controls.path.data(), controls.path.size(),
        ImGuiInputTextFlags_EnterReturnsTrue | ImGuiInputTextFlags_AutoSelectAll);
    ImGui::PopItemWidth();
    // Always as high, so that nothing moves below.
    ImGui::BeginChild("message", {0, 2 * ImGui::GetTextLineHeightWithSpacing()});
    const std::size_t warnings = stage.loaded().warnings.size();
    if (!told.message.empty()) {
        paragraph(told.failed ? error_color : quiet, told.message);
    } else if (warnings > 0) {
        paragraph(warning_color, counted(warnings, "warning") + ": see below");
    }
    ImGui::EndChild();
}

void show_pose(Controls& controls, const Stage& stage, Done& done) {
    heading("BEND");
    const BoundModel& model = stage.model();
    const bend::Body& body = model.binding.body;
    if (!model.baked) {
        const int most = std::max(most_regions, static_cast<int>(body.region_count()));
        ImGui::SliderInt("regions", &controls.region_count, 1, most, "%d", ImGuiSliderFlags_AlwaysClamp);
        if (ImGui::IsItemDeactivatedAfterEdit()) {
            controls.folds_list.clear();
            done.bind = true;
        }
    } else {
        ImGui::TextColored(quiet, "a body file: by the sliders alone");
    }
    const bool several = controls.regions.size() > 1;
    for (std::size_t r = 0; r < controls.regions.size(); ++r) {
        ImGui::PushID(static_cast<int>(r));
        Bend& bend = controls.regions[r];
        const auto limit = static_cast<float>(degrees(static_cast<double>(body.max_angle(r))));
        const std::string which = several ? " " + std::to_string(r + 1) : "";
        ImGui::SliderFloat(("angle" + which).c_str(), &bend.angle, -limit, limit, "%.1f",
                           ImGuiSliderFlags_AlwaysClamp);
        ImGui::SliderFloat(("direction" + which).c_str(), &bend.direction, -180, 180, "%.1f",
                           ImGuiSliderFlags_AlwaysClamp);
        ImGui::PopID();
    }
    ImGui::Checkbox("animate", &controls.animated);
    ImGui::SameLine();
    if (ImGui::Button("straight")) {
        for (Bend& bend : controls.regions) bend.angle = 0;
    }
    ImGui::SameLine();
    if (ImGui::Button("at rest")) {
        const std::vector<bend::Pose> rest = body.rest_poses();
        for (std::size_t r = 0; r < controls.regions.size(); ++r)
            controls.regions[r] = {static_cast<float>(degrees(static_cast<double>(rest[r].angle))),
                                   static_cast<float>(degrees(static_cast<double>(rest[r].direction)))};
    }
}

void show_folds(Controls& controls, const Stage& stage, Done& done) {
    if (stage.model().baked) return;  // was bound when it was made
    heading("FOLDS");
    done.bind |= choice("profile", controls.profile, std::array{"even", "damped", "smooth"});
    const char* const said = controls.folds_list.empty() ? "auto" : controls.folds_list.c_str();
    if (ImGui::SliderInt("folds", &controls.folds, -1, most_folds, controls.folds < 0 ? said : "%d",
                         ImGuiSliderFlags_AlwaysClamp))
        controls.folds_list.clear();
    done.bind |= ImGui::IsItemDeactivatedAfterEdit();
    if (controls.folds < 0 && controls.folds_list.empty())
        done.bind |= slider_or_auto("fold length", controls.fold_length, 0, 0.05f, 2.5f);
    if (controls.profile == "even") {
        ImGui::SliderFloat("roundness", &controls.roundness, 0, 0.5f, "%.2f", ImGuiSliderFlags_AlwaysClamp);
        done.bind |= ImGui::IsItemDeactivatedAfterEdit();
    }
    done.bind |= choice("amplitude", controls.amplitude, std::array{"mesh", "paper", "area", "none"});
    done.bind |= choice("shape", controls.shape, std::array{"auto", "cylinder"});
    done.bind |= slider_or_auto("onset", controls.onset, -0.01f, 0, 0.2f);
    done.bind |= choice("refine", controls.refine, std::array{"auto", "on", "off"});
}

void show_looks(Controls& controls, const Stage& stage, Done& done) {
    heading("SHOW");
    Show& show = controls.show;
    ImGui::Checkbox("wireframe", &show.wireframe);
    if (!stage.is_crowd()) {
        const float second = 0.5f * ImGui::GetContentRegionAvail().x;
        ImGui::SameLine(second);
        ImGui::Checkbox("normals", &show.normals);
        ImGui::Checkbox("area", &show.area);
        ImGui::SameLine(second);
        ImGui::Checkbox("rest shape", &show.rest);
        if (!stage.model().baked) {
            ImGui::Checkbox("base", &show.base);
            ImGui::SameLine(second);
        }
        ImGui::Checkbox("frames", &show.frames);
        if (show.frames && !stage.model().sockets.empty())
            paragraph(quiet, "sockets: " + names_of(stage.model().sockets));
        if (show.area) ImGui::TextColored(quiet, "blue: smaller by half, red: larger by half");
    }
    if (ImGui::Button("look at all")) done.look = true;
}

void show_crowd(Controls& controls, const Stage& stage, const Told& told, Done& done) {
    heading("CROWD");
    ImGui::SliderInt("instances", &controls.instances, 0, most_instances,
                     controls.instances == 0 ? "none" : "%d",
                     ImGuiSliderFlags_AlwaysClamp | ImGuiSliderFlags_Logarithmic);
    done.crowd |= ImGui::IsItemDeactivatedAfterEdit();
    int deformer = static_cast<int>(controls.deformer);
    ImGui::RadioButton("processor", &deformer, static_cast<int>(Deformer::processor));
    ImGui::SameLine();
    ImGui::RadioButton("shader", &deformer, static_cast<int>(Deformer::shader));
    controls.deformer = static_cast<Deformer>(deformer);
    ImGui::TextColored(quiet, "%zu vertices a frame", stage.vertices());
    const FrameTimes& times = told.times;
    const bool by_shader = controls.deformer == Deformer::shader;
    const std::string work =
        by_shader ? "set-up " + milliseconds(times.set_up) : "deform " + milliseconds(times.deform);
    ImGui::TextUnformatted((work + ", upload " + milliseconds(times.upload)).c_str());
    const std::string draw = told.draw ? "draw " + milliseconds(*told.draw) : "";
    const std::string frame = told.moving ? "frame " + milliseconds(told.frame) : "";
    ImGui::TextUnformatted((draw + (draw.empty() || frame.empty() ? "" : ", ") + frame).c_str());
}

/// A button that is gray unless `enabled`.
bool button(const char* label, bool enabled) {
    ImGui::BeginDisabled(!enabled);
    const bool pressed = ImGui::Button(label);
    ImGui::EndDisabled();
    return pressed;
}

void show_saving(const Stage& stage, const Told& told, Done& done) {
    heading("SAVE");
    const bool file = !stage.loaded().wish.files.empty();
    done.save_model = button("model", true);
    ImGui::SameLine();
    done.save_picture = button("picture", true);
    ImGui::SameLine();
    done.save_body = button("body", file && !told.busy && !stage.model().baked);
    ImGui::SameLine();
    done.copy = button("copy command", file && !told.busy);
}

/// What keys and the mouse do, in two columns.
void show_help() {
    heading("KEYS AND MOUSE");
    constexpr std::array<std::array<const char*, 2>, 13> lines{
        {{"drag an orange end", "bend"},
         {"drag beside the body", "turn the view"},
         {"drag, right button", "shift it"},
         {"wheel", "zoom"},
         {"Ctrl + click a slider", "type its number"},
         {"arrows", "angle, direction"},
         {"1 to 9", "region for the arrows"},
         {"Space, C, L", "animate, crowd, look at all"},
         {"W, N, A", "wireframe, normals, area"},
         {"B, F, R", "base, frames, rest shape"},
         {"D", "deform: processor, shader"},
         {"Ctrl + S, P, B, C", "save model, picture, body; copy"},
         {"F1, Escape", "hide the panel, quit"}}};
    for (const auto& [keys, effect] : lines) {
        ImGui::TextColored(quiet, "%s", keys);
        ImGui::SameLine(0.46f * ImGui::GetWindowWidth());
        paragraph(quiet, effect);
    }
}

}  // namespace

Done show_panel(Controls& controls, const Stage& stage, const Told& told, float width) {
    Done done;
    ImGui::SetNextWindowPos({0, 0});
    ImGui::SetNextWindowSize({width, ImGui::GetIO().DisplaySize.y});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 0);
    constexpr ImGuiWindowFlags fixed = ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize |
                                       ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoCollapse |
                                       ImGuiWindowFlags_NoBringToFrontOnFocus;
    ImGui::Begin("goffer", nullptr, fixed);
    ImGui::PushItemWidth(0.58f * width);
    show_model(stage, told);
    show_opening(controls, stage, told, done);
    show_pose(controls, stage, done);
    show_folds(controls, stage, done);
    show_looks(controls, stage, done);
    show_crowd(controls, stage, told, done);
    show_saving(stage, told, done);
    if (!stage.loaded().warnings.empty()) {
        heading("WARNINGS");
        for (const std::string& warning : stage.loaded().warnings) paragraph(warning_color, warning);
    }
    show_help();
    paragraph(quiet, told.device);
    ImGui::PopItemWidth();
    ImGui::End();
    ImGui::PopStyleVar();
    return done;
}

}  // namespace goffer::cli
