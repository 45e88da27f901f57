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
#include <cstdlib>
#include <string_view>
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

/// GLFW 3.4 and newer ask Wayland first. Where there is none, its library prints a line of its own.
void leave_out_wayland() {
#ifdef GLFW_PLATFORM
    if (std::getenv("WAYLAND_DISPLAY") == nullptr && std::getenv("XDG_RUNTIME_DIR") == nullptr &&
        glfwPlatformSupported(GLFW_PLATFORM_X11) == GLFW_TRUE)
        glfwInitHint(GLFW_PLATFORM, GLFW_PLATFORM_X11);
#endif
}

/// Loads a font that reads well, where one is in the usual places; else Dear ImGui's own.
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
    /// GLFW, from its start to its end. It does not count its users: only one may exist at a time.
    struct Library {
        Library() {
            leave_out_wayland();
            if (glfwInit() == GLFW_FALSE) refuse();
        }
        Library(const Library&) = delete;
        Library& operator=(const Library&) = delete;
        ~Library() { glfwTerminate(); }
    };

    Library library;
    GLFWwindow* window = nullptr;
    float scale = 1;
    std::vector<KeyPress> keys;
    std::vector<std::filesystem::path> files;
    bool happened = false;  // since the last poll

    static Data& of(GLFWwindow* window) { return *static_cast<Data*>(glfwGetWindowUserPointer(window)); }
};

namespace {

void note(GLFWwindow* window) {
    Window::Data::of(window).happened = true;
}

/// Arrows repeat while they are held; other keys do something once.
bool repeats(int key) {
    return key >= Window::right && key <= Window::up;
}

/// The letter or digit that is printed on the key, whatever the keyboard; else GLFW's number of its place.
int printed(int key, int scancode) {
    const char* const name = glfwGetKeyName(key, scancode);
    if (name == nullptr || name[0] == 0 || name[1] != 0) return key;
    return name[0] >= 'a' && name[0] <= 'z' ? name[0] - 'a' + 'A' : name[0];
}

void note_key(GLFWwindow* window, int key, int scancode, int action, int mods) noexcept {
    note(window);
    if (action == GLFW_PRESS || (action == GLFW_REPEAT && repeats(key)))
        Window::Data::of(window).keys.push_back(
            {printed(key, scancode), (mods & GLFW_MOD_SHIFT) != 0, (mods & GLFW_MOD_CONTROL) != 0});
}

void note_files(GLFWwindow* window, int count, const char** names) noexcept {
    note(window);
    for (int i = 0; i < count; ++i) {
        const std::string_view name(names[i]);  // UTF-8, whatever the system
        Window::Data::of(window).files.emplace_back(std::u8string(name.begin(), name.end()));
    }
}

/// Before Dear ImGui sets its own, which call these.
void set_callbacks(GLFWwindow* window) {
    glfwSetKeyCallback(window, note_key);
    glfwSetDropCallback(window, note_files);
    glfwSetMouseButtonCallback(window, [](GLFWwindow* from, int, int, int) { note(from); });
    glfwSetCursorPosCallback(window, [](GLFWwindow* from, double, double) { note(from); });
    glfwSetScrollCallback(window, [](GLFWwindow* from, double, double) { note(from); });
    glfwSetCharCallback(window, [](GLFWwindow* from, unsigned) { note(from); });
    glfwSetWindowFocusCallback(window, [](GLFWwindow* from, int) { note(from); });
    glfwSetFramebufferSizeCallback(window, [](GLFWwindow* from, int, int) { note(from); });
    glfwSetWindowRefreshCallback(window, note);
    glfwSetWindowCloseCallback(window, note);
}

}  // namespace

void Window::check_display() {
    const Data::Library library;
}

Window::Window(const std::string& title, const glm::ivec2& size, bool vsync)
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
    glfwSwapInterval(vsync ? 1 : 0);
    glfwSetWindowUserPointer(window, data_.get());
    set_callbacks(window);
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
    ImGui::GetStyle().Colors[ImGuiCol_SliderGrab] = {0.58f, 0.76f, 0.99f, 1};  // numbers stand on it
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

bool Window::is_minimized() const {
    glm::ivec2 size(1);
    glfwGetFramebufferSize(data_->window, &size.x, &size.y);
    return size.x == 0 || size.y == 0 || glfwGetWindowAttrib(data_->window, GLFW_ICONIFIED) == GLFW_TRUE;
}

void Window::hide() {
    glfwHideWindow(data_->window);
    glfwPollEvents();
}

void Window::close() {
    glfwSetWindowShouldClose(data_->window, GLFW_TRUE);
}

void Window::set_title(const std::string& title) {
    if (title == title_) return;
    title_ = title;
    glfwSetWindowTitle(data_->window, title.c_str());
}

void Window::copy_to_clipboard(const std::string& text) {
    glfwSetClipboardString(data_->window, text.c_str());
}

bool Window::poll(double seconds) {
    if (seconds > 0) {
        glfwWaitEventsTimeout(seconds);
    } else {
        glfwPollEvents();
    }
    return std::exchange(data_->happened, false);
}

void Window::wake() {
    glfwPostEmptyEvent();
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
    return glm::max(size, 1);
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
