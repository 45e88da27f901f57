// SPDX-License-Identifier: MIT
#include "commands.hpp"

#include <CLI/CLI.hpp>

#include <memory>
#include <string>
#include <vector>

/// `goffer view` where what a window needs was not there when goffer was built.

namespace goffer::cli {

void add_view(CLI::App& app, Action& action) {
    CLI::App* command = app.add_subcommand("view", "Bend models in a window (not in this build)");
    command->allow_extras();
    command->callback([&action] {
        action = [] {
            throw InputError(
                "this goffer was built without its viewer; install GLFW, Dear ImGui and epoxy "
                "(libglfw3-dev libimgui-dev libepoxy-dev) and build it again");
        };
    });
}

}  // namespace goffer::cli
