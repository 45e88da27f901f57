// SPDX-License-Identifier: MIT
#include "viewer/window.hpp"

#include "arguments.hpp"

#define GLFW_INCLUDE_NONE  // epoxy has OpenGL
#include <GLFW/glfw3.h>
#include <epoxy/gl.h>
#include <glm/common.hpp>
#include <imgui.h>
#if __has_include(<backends/imgui_impl_glfw.h>)
#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>
#else
#include <imgui_impl_glfw.h>
#include <imgui_impl_opengl3.h>
#endif

#include <algorithm>
#include <array>
#include <utility>

namespace goffer::cli {
namespace {

constexpr float text_size = 15;

[[noreturn]] void refuse() {
    const char* text = nullptr;
    glfwGetError(&text);
    std::string why = text != nullptr ? text : "GLFW does not say why";
    while (why.ends_with(' ')) why.pop_back();
    throw InputError("no window can be opened here: " + why +
                     "; 'goffer bend' and 'goffer crowd' write pictures without a display, by --png FILE");
}

/// GLFW, begun. It counts nothing: one at a time.
struct Library {
    Library() {
        if (glfwInit() == GLFW_FALSE) refuse();
    }
    Library(const Library&) = delete;
    Library& operator=(const Library&) = delete;
    ~Library() { glfwTerminate(); }
};

/// A font that has been made to be read, where the usual places have one; else that of the panel.
void load_font(float scale) {
    constexpr std::array fonts{"/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf",
                               "/usr/share/fonts/dejavu-sans-fonts/DejaVuSans.ttf",
                               "/usr/share/fonts/TTF/DejaVuSans.ttf", "/System/Library/Fonts/Helvetica.ttc",
                               "C:\\Windows\\Fonts\\segoeui.ttf"};
    ImGuiIO& io = ImGui::GetIO();
    for (const char* const font : fonts) {
        std::error_code error;
        if (std::filesystem::exists(font, error) &&
            io.Fonts->AddFontFromFileTTF(font, scale * text_size) != nullptr)
            return;
    }
    ImFontConfig config;
    config.SizePixels = scale * 13;
    io.Fonts->AddFontDefault(&config);
}

}  // namespace

struct Window::Data {
    Library library;
    GLFWwindow* window = nullptr;
    float scale = 1;
    std::vector<KeyPress> keys;
    std::vector<std::filesystem::path> files;

    static Data& of(GLFWwindow* window) { return *static_cast<Data*>(glfwGetWindowUserPointer(window)); }
};

void Window::check_display() {
    const Library library;
}

Window::Window(const std::string& title, const glm::ivec2& size, bool wait)
    : data_(std::make_unique<Data>()) {
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    glfwWindowHint(GLFW_OPENGL_FORWARD_COMPAT, GLFW_TRUE);
    glfwWindowHint(GLFW_SAMPLES, 4);
    GLFWwindow*& window = data_->window;
    window = glfwCreateWindow(size.x, size.y, title.c_str(), nullptr, nullptr);
    if (window == nullptr) refuse();
    glfwMakeContextCurrent(window);
    glfwSwapInterval(wait ? 1 : 0);
    glfwSetWindowUserPointer(window, data_.get());
    glfwSetKeyCallback(window, [](GLFWwindow* from, int key, int, int action, int mods) {
        if (action != GLFW_RELEASE)
            Data::of(from).keys.push_back(
                {key, (mods & GLFW_MOD_SHIFT) != 0, (mods & GLFW_MOD_CONTROL) != 0});
    });
    glfwSetDropCallback(window, [](GLFWwindow* from, int count, const char** names) {
        for (int i = 0; i < count; ++i) Data::of(from).files.emplace_back(names[i]);
    });
    float ratio = 1, ignored = 1;
    glfwGetWindowContentScale(window, &ratio, &ignored);
    data_->scale = std::clamp(ratio / pixel_ratio(), 1.0f, 4.0f);
    IMGUI_CHECKVERSION();
    ImGui::CreateContext();
    ImGui::GetIO().IniFilename = nullptr;  // leaves nothing in the folder it is called from
    ImGui::StyleColorsLight();
    ImGui::GetStyle().FramePadding = {4, 2};
    ImGui::GetStyle().ItemSpacing = {8, 2};
    ImGui::GetStyle().Colors[ImGuiCol_FrameBg] = {1, 1, 1, 1};
    ImGui::GetStyle().FrameBorderSize = 1;
    ImGui::GetStyle().ScaleAllSizes(data_->scale);
    load_font(data_->scale);
    ImGui_ImplGlfw_InitForOpenGL(window, true);  // calls what was set above, too
    ImGui_ImplOpenGL3_Init("#version 330 core");
}

Window::~Window() {
    ImGui_ImplOpenGL3_Shutdown();
    ImGui_ImplGlfw_Shutdown();
    ImGui::DestroyContext();
    glfwDestroyWindow(data_->window);
}

bool Window::is_open() const {
    return glfwWindowShouldClose(data_->window) == GLFW_FALSE;
}

void Window::close() {
    glfwSetWindowShouldClose(data_->window, GLFW_TRUE);
}

void Window::set_title(const std::string& title) {
    glfwSetWindowTitle(data_->window, title.c_str());
}

void Window::copy_to_clipboard(const std::string& text) {
    glfwSetClipboardString(data_->window, text.c_str());
}

bool Window::poll(double seconds) {
    const double begin = glfwGetTime();
    if (seconds > 0) {
        glfwWaitEventsTimeout(seconds);
    } else {
        glfwPollEvents();
    }
    return glfwGetTime() - begin < 0.99 * seconds;
}

void Window::begin_frame() {
    ImGui_ImplOpenGL3_NewFrame();
    ImGui_ImplGlfw_NewFrame();
    ImGui::NewFrame();
}

void Window::end_frame() {
    ImGui::Render();
    const glm::ivec2 size = pixels();
    glViewport(0, 0, size.x, size.y);
    ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
    glfwSwapBuffers(data_->window);
}

std::vector<KeyPress> Window::take_keys() {
    std::vector<KeyPress> keys = std::exchange(data_->keys, {});
    if (ImGui::GetIO().WantTextInput) keys.clear();
    return keys;
}

std::vector<std::filesystem::path> Window::take_files() {
    return std::exchange(data_->files, {});
}

glm::ivec2 Window::pixels() const {
    glm::ivec2 size(1);
    glfwGetFramebufferSize(data_->window, &size.x, &size.y);
    return size;
}

glm::vec2 Window::size() const {
    glm::ivec2 size(1);
    glfwGetWindowSize(data_->window, &size.x, &size.y);
    return glm::max(glm::vec2(size), 1.0f);
}

float Window::pixel_ratio() const {
    return static_cast<float>(pixels().x) / size().x;
}

float Window::scale() const {
    return data_->scale;
}

}  // namespace goffer::cli
