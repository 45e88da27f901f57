// SPDX-License-Identifier: MIT
#pragma once

#include <glm/vec2.hpp>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

/// A window with OpenGL and Dear ImGui in it.

namespace goffer::cli {

/// A key that went down, or repeats.
struct KeyPress {
    int key = 0;  ///< as GLFW numbers them: 'A', or Window::up and so on
    bool shift = false, control = false;
};

/// The window. One at a time.
class Window {
public:
    enum Key : int { escape = 256, right = 262, left = 263, down = 264, up = 265, f1 = 290 };

    /// Throws InputError where there is no display, or none with OpenGL 3.3. `vsync`: frames wait for the
    /// display, which shows 60 or so a second.
    Window(const std::string& title, const glm::ivec2& size, bool vsync);
    ~Window();
    Window(const Window&) = delete;
    Window& operator=(const Window&) = delete;

    /// Throws InputError where there is no display: before long work is begun.
    static void check_display();

    [[nodiscard]] bool is_open() const;
    [[nodiscard]] bool is_minimized() const;
    void hide();
    void close();
    void set_title(const std::string& title);
    void copy_to_clipboard(const std::string& text);

    /// Takes in events, for which it waits `seconds` at most. Returns whether there were any that may change
    /// what is shown.
    bool poll(double seconds);
    /// Ends such a wait, with an event. From any thread, while there is a window.
    static void wake();
    /// Begins a frame of the panel.
    void begin_frame();
    /// Draws the panel over what is there, and shows the frame.
    void end_frame();

    /// Keys since the last frame that the panel has no use for, and files that were dropped.
    [[nodiscard]] std::vector<KeyPress> take_keys();
    [[nodiscard]] std::vector<std::filesystem::path> take_files();

    /// Its size in the units of the panel and of the mouse, 1 or more.
    [[nodiscard]] glm::vec2 size() const;
    /// Pixels of the frame buffer.
    [[nodiscard]] glm::ivec2 pixels() const;
    /// Pixels in one of these units.
    [[nodiscard]] float pixel_ratio() const;
    /// How large text and controls are: 1 on an ordinary display.
    [[nodiscard]] float scale() const;

    struct Data;  // for window.cpp alone

private:
    std::unique_ptr<Data> data_;
    std::string title_;
};

}  // namespace goffer::cli
