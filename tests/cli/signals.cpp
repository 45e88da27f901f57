// SPDX-License-Identifier: MIT
#include "command.hpp"

#include <doctest/doctest.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <thread>

/// What is left when the command is ended from outside: every output as it was, and nothing beside it.

using namespace goffer::test;

namespace {

bool has_part(const Folder& folder) {
    for (const auto& entry : std::filesystem::directory_iterator(folder / "."))
        if (entry.path().extension() == ".part") return true;
    return false;
}

/// Starts a command, whose standard output is `out`, and ends it by `signal` once `ready`. Returns its
/// status.
template <class Ready>
int ended_by(int signal, const Folder& folder, const char* out, Ready ready) {
    const pid_t child = fork();
    if (child == 0) {
        const int file = open(out, O_WRONLY);
        if (file < 0 || dup2(file, STDOUT_FILENO) < 0 || chdir((folder / ".").c_str()) != 0) _exit(99);
        execl(GOFFER_COMMAND, "goffer", "refine", "base.ply", "--folds", "8", "-o", "out.ply", nullptr);
        _exit(98);
    }
    const auto start = std::chrono::steady_clock::now();
    while (!ready() && std::chrono::steady_clock::now() - start < std::chrono::seconds(60))
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    kill(child, signal);
    int status = 0;
    REQUIRE(waitpid(child, &status, 0) == child);
    return status;
}

}  // namespace

TEST_CASE("signals: a command that is ended while its output is being written leaves nothing") {
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
        const Folder folder;
        base(folder);
        folder.write("out.ply", "kept");
        // A pipe that is full and that nobody empties holds the command where its outputs are all but done.
        const std::string pipe = folder / "pipe";
        REQUIRE(mkfifo(pipe.c_str(), 0600) == 0);
        const int keep = open(pipe.c_str(), O_RDWR | O_NONBLOCK);
        REQUIRE(keep >= 0);
        const std::string block(1 << 12, 'x');
        while (write(keep, block.data(), block.size()) > 0) {
        }
        bool seen = false;
        const int status = ended_by(signal, folder, pipe.c_str(), [&] {
            if (seen)
                return has_part(folder);  // not the one that only looks whether the output can be written
            seen = has_part(folder) && std::filesystem::file_size(folder / "out.ply") == 4;
            std::this_thread::sleep_for(std::chrono::milliseconds(500));
            return false;
        });
        close(keep);
        CHECK(WIFSIGNALED(status));
        CHECK(WTERMSIG(status) == signal);
        CHECK(bytes_of(folder / "out.ply") == "kept");
        CHECK(!has_part(folder));
    }
}
