// SPDX-License-Identifier: MIT
#include "commands.hpp"

#include <goffer/fit/geometry.hpp>
#include <goffer/mesh/mesh.hpp>
#include <goffer/view/picture.hpp>

#include <cstdio>
#include <exception>
#include <new>
#include <string>
#include <vector>

/// goffer: exit code 0 done, 1 the input or the system was at fault, 2 wrong usage.

namespace goffer::cli {
namespace {

enum ExitCode { done = 0, failed = 1, wrong_usage = 2 };

// One line, whatever a library's message holds.
int complain(ExitCode code, std::string text) {
    for (char& c : text) {
        if (c == '\n' || c == '\r') c = ' ';
    }
    std::fprintf(stderr, "goffer: %s\n", text.c_str());
    return code;
}

int usage(const CLI::App& app, const CLI::ParseError& error) {
    if (error.get_exit_code() == static_cast<int>(CLI::ExitCodes::Success))
        return app.exit(error);  // --help, --version
    const std::vector<std::string> left = app.remaining();
    const bool no_command = app.get_subcommands().empty() && !left.empty();
    return complain(wrong_usage, (no_command ? "there is no command '" + left.front() + "'" : error.what()) +
                                     std::string("; see 'goffer --help' or 'goffer COMMAND --help'"));
}

int run(int argc, char** argv) {
    CLI::App app(
        "Bends soft, roughly cylindrical meshes and keeps their surface area: the squeezed side wrinkles.",
        "goffer");
    app.set_version_flag("--version", GOFFER_VERSION);
    app.require_subcommand(1);
    app.get_formatter()->column_width(34);
    Action action;
    add_base(app, action);
    add_inspect(app, action);
    add_refine(app, action);
    add_bend(app, action);
    add_crowd(app, action);
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        return usage(app, error);
    }
    try {
        action();
        return done;
    } catch (const UsageError& error) {
        return complain(wrong_usage, error.what());
    } catch (const std::bad_alloc&) {
        return complain(failed, "not enough memory for this; use a smaller mesh");
    } catch (const std::exception& error) {
        return complain(failed, error.what());
    }
}

}  // namespace
}  // namespace goffer::cli

int main(int argc, char** argv) {
    try {
        return goffer::cli::run(argc, argv);
    } catch (...) {  // not even a message could be put together
        std::fputs("goffer: not enough memory for this; use a smaller mesh\n", stderr);
        return 1;
    }
}
