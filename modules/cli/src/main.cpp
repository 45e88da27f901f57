// SPDX-License-Identifier: MIT
#include "commands.hpp"
#include "report.hpp"
#include "usage.hpp"

#include <goffer/fit/geometry.hpp>
#include <goffer/io/atomic_file.hpp>
#include <goffer/mesh/mesh.hpp>
#include <goffer/view/picture.hpp>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <exception>
#include <iterator>
#include <new>
#include <string>
#include <string_view>

#ifndef _WIN32
#include <CLI/CLI.hpp>
#include <fcntl.h>
#endif

/// goffer: exit code 0 done, 1 the input or the system was at fault, 2 wrong usage.

namespace goffer::cli {
namespace {

enum ExitCode { done = 0, failed = 1, wrong_usage = 2 };

// One line, whatever a library's message and the names in it hold.
int complain(ExitCode code, std::string text) {
    std::ranges::replace(text, '\n', ' ');
    std::fprintf(stderr, "goffer: %s\n", io::escaped(text).c_str());
    return code;
}

int usage(const CLI::App& app, const CLI::ParseError& error) {
    if (error.get_exit_code() != static_cast<int>(CLI::ExitCodes::Success))
        return complain(wrong_usage, fault_of(app, error));
    const int code = app.exit(error);  // --help, --version
    try {
        flush_output();
    } catch (const std::exception& fault) {
        return complain(failed, fault.what());
    }
    return code;
}

/// A signal that ends the command leaves no unfinished file behind, and ends it as it would have.
void end_by(int signal) {
    io::remove_unfinished();
    std::signal(signal, SIG_DFL);
    std::raise(signal);
}

/// Standard streams that the caller has closed lead nowhere: a file that is opened in the place of one would
/// get what is printed. What is printed to standard output then fails, as a report may not get lost.
void hold_standard_streams() {
#ifndef _WIN32
    for (int descriptor = 0; descriptor <= 2; ++descriptor) {
        if (fcntl(descriptor, F_GETFD) == -1 && errno == EBADF)
            (void)open("/dev/null", descriptor == 2 ? O_WRONLY : O_RDONLY);  // takes the lowest that is free
    }
#endif
}

void heed_signals() {
#ifdef _WIN32
    constexpr std::array signals{SIGINT, SIGTERM};
#else
    constexpr std::array signals{SIGINT, SIGTERM, SIGHUP, SIGPIPE, SIGQUIT, SIGALRM, SIGXCPU};
    std::signal(SIGXFSZ, SIG_IGN);  // what cannot be written is then told as any other fault
#endif
    for (const int signal : signals) {
        if (std::signal(signal, end_by) == SIG_IGN) std::signal(signal, SIG_IGN);  // as nohup wants it
    }
}

struct Subcommand {
    std::string_view name;
    void (*add)(CLI::App& app, Action& action);
};

// In the order of the help.
constexpr Subcommand subcommands[] = {
    {"base", add_base},       {"inspect", add_inspect}, {"refine", add_refine}, {"bend", add_bend},
    {"animate", add_animate}, {"bake", add_bake},       {"crowd", add_crowd},   {"cache", add_cache},
    {"figures", add_figures}, {"view", add_view}};

/// Adds the one that the first word names, or all of them: to set up all options takes longer than many a
/// run.
void add_subcommands(CLI::App& app, Action& action, std::string_view first_word) {
    const auto named = std::ranges::find(subcommands, first_word, &Subcommand::name);
    if (named != std::end(subcommands)) return named->add(app, action);
    for (const Subcommand& subcommand : subcommands) subcommand.add(app, action);
}

int run(int argc, char** argv) {
    CLI::App app(
        "Bends soft, roughly cylindrical meshes and keeps their surface area: the squeezed side wrinkles.",
        "goffer");
    app.set_version_flag("--version", GOFFER_VERSION);
    app.require_subcommand(1);
    app.get_formatter()->column_width(34);
    Action action;
    add_subcommands(app, action, argc > 1 ? argv[1] : "");
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        return usage(app, error);
    }
    try {
        if (const std::string fault = fault_of_values(app); !fault.empty()) throw UsageError(fault);
        action();
        return done;
    } catch (const UsageError& error) {
        return complain(wrong_usage, error.what());
    } catch (const std::bad_alloc&) {
        return complain(failed, "not enough memory for this; use smaller files");
    } catch (const std::exception& error) {
        return complain(failed, error.what());
    }
}

}  // namespace
}  // namespace goffer::cli

int main(int argc, char** argv) {
    try {
        goffer::cli::hold_standard_streams();
        goffer::cli::heed_signals();
        return goffer::cli::run(argc, argv);
    } catch (...) {  // not even a message could be put together
        std::fputs("goffer: not enough memory for this; use smaller files\n", stderr);
        return 1;
    }
}
