// SPDX-License-Identifier: MIT
#include "figures/charts.hpp"

#include "arguments.hpp"

#include <goffer/io/error.hpp>

#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <memory>
#include <string_view>
#include <thread>

extern char** environ;  // NOLINT: POSIX has it in no header

namespace goffer::cli {
namespace {

struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, Close>;

/// A file without a name, which goes with its stream.
File unnamed_file() {
    File file(std::tmpfile());
    if (!file)
        throw InputError(std::string("no file for temporary data can be made: ") + std::strerror(errno));
    return file;
}

std::string contents(std::FILE* file) {
    std::rewind(file);
    std::string text;
    std::array<char, 4096> part{};
    for (std::size_t count = 0; (count = std::fread(part.data(), 1, part.size(), file)) > 0;)
        text.append(part.data(), count);
    return text;
}

/// What a program is told to use in place of its standard streams.
class FileActions {
public:
    FileActions() { posix_spawn_file_actions_init(&actions_); }
    FileActions(const FileActions&) = delete;
    FileActions& operator=(const FileActions&) = delete;
    ~FileActions() { posix_spawn_file_actions_destroy(&actions_); }
    void put(std::FILE* file, int descriptor) {
        posix_spawn_file_actions_adddup2(&actions_, fileno(file), descriptor);
    }
    [[nodiscard]] const posix_spawn_file_actions_t* get() const { return &actions_; }

private:
    posix_spawn_file_actions_t actions_{};
};

struct Output {
    bool good = false, in_time = false;
    std::string out, err;
};

/// It takes less than a second.
constexpr std::chrono::seconds longest_chart(60);

/// Runs gnuplot with `input` as its standard input. Throws InputError where it is not there.
Output run_gnuplot(const std::string& input) {
    const File in = unnamed_file(), out = unnamed_file(), err = unnamed_file();
    if (std::fwrite(input.data(), 1, input.size(), in.get()) != input.size() || std::fflush(in.get()) != 0)
        throw InputError("what gnuplot is to draw cannot be written; is the disk full?");
    std::rewind(in.get());
    FileActions actions;
    actions.put(in.get(), STDIN_FILENO);
    actions.put(out.get(), STDOUT_FILENO);
    actions.put(err.get(), STDERR_FILENO);
    // --default-settings: a user's own would change the charts.
    std::string name = "gnuplot", settings = "--default-settings";
    const std::array<char*, 3> words{name.data(), settings.data(), nullptr};
    pid_t process = 0;
    if (const int error =
            posix_spawnp(&process, name.c_str(), actions.get(), nullptr, words.data(), environ)) {
        throw InputError(std::string("gnuplot cannot be run: ") + std::strerror(error) +
                         "; install it (Debian's package gnuplot-nox), or go without charts by --no-charts");
    }
    int status = 0;
    using namespace std::chrono_literals;
    const auto end = std::chrono::steady_clock::now() + longest_chart;
    bool in_time = true;
    pid_t ended = 0;
    while ((ended = waitpid(process, &status, WNOHANG)) == 0) {
        in_time = in_time && std::chrono::steady_clock::now() <= end;
        if (!in_time) (void)kill(process, SIGKILL);
        std::this_thread::sleep_for(5ms);
    }
    // Whoever started this program may have had it told of no child's end: then its output says how it went.
    const bool good = ended < 0 ? contents(err.get()).empty() : WIFEXITED(status) && WEXITSTATUS(status) == 0;
    return {good && in_time, in_time, contents(out.get()), contents(err.get())};
}

[[noreturn]] void refuse(const std::string& what, const Output& output) {
    const std::string words = io::one_line(output.err.substr(0, 300));
    throw InputError("gnuplot does not draw " + what + ": " +
                     (!output.in_time ? "it took more than " + std::to_string(longest_chart.count()) + " s"
                      : words.empty() ? "it does not say why"
                                      : words) +
                     "; version 5.4 or newer is needed, or go without charts by --no-charts");
}

/// What every script begins with.
constexpr std::string_view settings =
    R"(set terminal svg size 540, 460 font "sans-serif,16" background "white"
set datafile separator comma
set datafile columnheaders
set grid xtics ytics lc rgb "#d8d8d8" lw 0.5
set tics nomirror
set border 3
set xlabel offset 0, 0.6
)";

}  // namespace

void check_gnuplot() {
    const Output output = run_gnuplot("print GPVAL_VERSION\n");
    if (!output.good) refuse("anything", output);
}

std::string chart_script(const Figure& figure) {
    return "# " + io::one_line(figure.title) + "\n#   gnuplot " + figure.name + ".gp\n" +
           std::string(settings) + "if (!exists(\"data\")) data = \"" + figure.name +
           ".csv\"; set output \"" + figure.name + ".svg\"\n" + figure.script;
}

std::string drawn_chart(const Figure& figure) {
    // The data come with the script, and the chart goes to standard output: no file is in its place before
    // all are.
    const Output output = run_gnuplot("$table << end_of_table\n" + figure.table.csv() +
                                      "end_of_table\ndata = \"$table\"\n" + chart_script(figure));
    if (!output.good || !output.out.starts_with("<?xml") || output.out.find("</svg>") == std::string::npos)
        refuse(figure.name, output);
    return output.out;
}

}  // namespace goffer::cli
