// SPDX-License-Identifier: MIT
#include "support/files.hpp"

#include <goffer/io/atomic_file.hpp>
#include <goffer/io/read_file.hpp>

#include <doctest/doctest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <optional>
#include <string>
#include <thread>
#include <vector>

using namespace goffer::io;
using namespace goffer::test;

namespace fs = std::filesystem;

namespace {

std::string refusal(const fs::path& file, const std::string& bytes = "new") {
    return message_of<Error>([&] { write_file(file, bytes); });
}

/// The end of a process of its own that does `work`, as waitpid has it.
template <class Work>
int status_of(Work work) {
    const pid_t child = fork();
    if (child == 0) {
        work();
        _exit(0);
    }
    int status = 0;
    REQUIRE(waitpid(child, &status, 0) == child);
    return status;
}

}  // namespace

TEST_CASE("atomic file: it is there when it is committed, and not before") {
    const Folder folder;
    folder.write("a", "old");
    {
        AtomicFile file(folder / "a");
        file.write("lost");
        CHECK(folder.files() == 2);
    }
    CHECK(bytes_of(folder / "a") == "old");
    CHECK(folder.files() == 1);
    AtomicFile file(folder / "a");
    AtomicFile other(folder / "a");
    file.write("new");
    std::fputs(" text", file.stream());
    CHECK(bytes_of(folder / "a") == "old");
    file.commit();
    CHECK(bytes_of(folder / "a") == "new text");
    CHECK(folder.files() == 2);
}

TEST_CASE("atomic file: links are followed, permissions stay") {
    const Folder folder;
    folder.write("real", "old");
    fs::permissions(folder / "real", fs::perms::owner_read | fs::perms::owner_write);
    fs::create_symlink("real", folder / "link");
    write_file(folder / "link", "new");
    CHECK(fs::is_symlink(folder / "link"));
    CHECK(bytes_of(folder / "real") == "new");
    CHECK(fs::status(folder / "real").permissions() == (fs::perms::owner_read | fs::perms::owner_write));
    fs::create_symlink("later", folder / "dangling");
    write_file(folder / "dangling", "made");
    CHECK(bytes_of(folder / "later") == "made");
}

TEST_CASE("atomic file: where no file can be, one line says so") {
    const Folder folder;
    folder.write("file", "old");
    fs::create_directory(folder / "taken");
    fs::create_symlink("loop", folder / "loop");
    CHECK(tells(refusal(folder / "taken"), "taken: is a folder"));
    CHECK(tells(refusal(folder / ""), "is a folder"));
    CHECK(tells(refusal(folder / "none/a"), "none/a: there is no such folder"));
    CHECK(tells(refusal(folder / "file/a"), "file/a: there is no such folder"));
    CHECK(tells(refusal(folder / "a\nb\x1b/c"), "a\\x0ab\\x1b/c: there is no such folder"));
    CHECK(tells(refusal(folder / "loop"), "loop: is a link that leads to itself"));
    CHECK(tells(refusal(folder / std::string(256, 'x')), "cannot be written: its name is too long"));
    CHECK(refusal("/dev/full").starts_with("/dev/full: is not a regular file"));
    CHECK(folder.files() == 3);
}

TEST_CASE("atomic file: what is write-protected stays") {
    const Folder folder;
    fs::permissions(folder.write("a", "old"), fs::perms::owner_read);
    if (geteuid() == 0) {
        MESSAGE("skipped: root may write to all files");
        return;
    }
    CHECK(tells(refusal(folder / "a"), "a: is write-protected"));
    CHECK(bytes_of(folder / "a") == "old");
    CHECK(folder.files() == 1);
}

TEST_CASE("atomic file: in a sticky folder, what is another user's is refused at once") {
    constexpr uid_t one = 1001, other = 1002;
    const Folder folder;
    const fs::path file = folder.write("a", "old");
    fs::permissions(file, fs::perms::all);
    if (geteuid() != 0 || chown(file.c_str(), one, one) != 0) {
        MESSAGE("skipped: files of other users cannot be made here");
        return;
    }
    enum { made, refused, unreachable, other_error };
    const auto as = [&](uid_t user, fs::perms permissions) {
        fs::permissions(folder / "", permissions);
        const int status = status_of([&] {
            if (seteuid(user) != 0 || !std::ifstream(file)) _exit(unreachable);
            const std::string said = message_of<Error>([&] { const AtomicFile probe(file); });
            _exit(said.empty() ? made : tells(said, "another user's") ? refused : other_error);
        });
        REQUIRE(WIFEXITED(status));
        return WEXITSTATUS(status);
    };
    const fs::perms shared = fs::perms::all | fs::perms::sticky_bit;
    if (as(other, shared) == unreachable) {
        MESSAGE("skipped: other users do not reach the folder of temporary files");
        return;
    }
    CHECK(as(other, shared) == refused);
    CHECK(as(one, shared) == made);
    CHECK(as(0, shared) == made);
    CHECK(as(other, fs::perms::all) == made);
}

TEST_CASE("atomic file: when the disk is full nothing is left behind and the old file stays") {
    const Folder folder;
    folder.write("a", "old");
    const auto refused = [&](std::size_t bytes) {
        const FullDisk full(1000);
        return refusal(folder / "a", std::string(bytes, 'x'));
    };
    CHECK(tells(refused(100000), "a: cannot be written: File too large"));
    CHECK(tells(refused(1001), "a: cannot be written: File too large"));  // not before it is closed
    CHECK(refused(1000).empty());
    CHECK(bytes_of(folder / "a") == std::string(1000, 'x'));
    CHECK(folder.files() == 1);
}

TEST_CASE("atomic file: the longest name that a folder takes") {
    const Folder folder;
    for (const std::size_t length : {250, 255}) {
        write_file(folder / std::string(length, 'x'), "new");
        CHECK(bytes_of(folder / std::string(length, 'x')) == "new");
    }
    CHECK(folder.files() == 2);
}

TEST_CASE("atomic file: what a process left that was killed is removed, what others write is not") {
    const Folder folder;
    folder.write(".goffer-1-0.part", "of a process that lives");
    folder.write(".goffer-x-0.part", "somebody's own");
    folder.write("a.part0", "somebody's own");
    const int status = status_of([&] {
        AtomicFile file(folder / "a");
        file.write("half");
        file.flush();
        _exit(3);
    });
    CHECK(WEXITSTATUS(status) == 3);
    REQUIRE(folder.files() == 4);
    {
        const AtomicFile mine(folder / "b");
        CHECK(folder.files() == 4);
        write_file(folder / "c", "new");
        CHECK(folder.files() == 5);
    }
    CHECK(folder.files() == 4);
}

TEST_CASE("atomic file: what an earlier process of the same number left is removed, as in containers") {
    const Folder folder;
    const std::string part = ".goffer-" + std::to_string(getpid()) + "-7.part";
    folder.write(part, "half");
    const AtomicFile mine(folder / "a");
    CHECK(!fs::exists(folder / part));
    CHECK(folder.files() == 1);
    write_file(folder / "b", "new");  // does not take the one that is being written
    CHECK(folder.files() == 2);
}

TEST_CASE("atomic file: a part of a process that is gone stays while somebody holds its lock") {
    const Folder folder;
    std::optional<AtomicFile> mine(std::in_place, folder / "a");
    const fs::path part = fs::directory_iterator(folder / ".")->path();
    const fs::path foreign = folder / ".goffer-2147483646-0.part";  // as another container has it
    fs::rename(part, foreign);
    write_file(folder / "b", "new");
    CHECK(fs::exists(foreign));
    mine.reset();
    write_file(folder / "b", "new");
    CHECK(!fs::exists(foreign));
}

TEST_CASE("atomic file: a signal handler can remove what is unfinished") {
    const Folder folder;
    folder.write("a", "old");
    const fs::path before = fs::current_path();
    const int status = status_of([&] {
        fs::current_path(folder / ".");
        AtomicFile file("a"), other("b"), done("c");
        file.write("half");
        done.commit();
        fs::current_path(before);
        std::signal(SIGTERM, [](int number) {
            remove_unfinished();
            std::signal(number, SIG_DFL);
            std::raise(number);
        });
        std::raise(SIGTERM);
    });
    CHECK(WTERMSIG(status) == SIGTERM);
    CHECK(bytes_of(folder / "a") == "old");
    CHECK(fs::exists(folder / "c"));
    CHECK(folder.files() == 2);
}

TEST_CASE("atomic file: a signal handler finds what all threads are writing, in any moment") {
    for (int round = 0; round < 100; ++round) {
        const Folder folder;
        const pid_t child = fork();
        if (child == 0) {
            std::signal(SIGTERM, [](int number) {
                remove_unfinished();
                _exit(number);
            });
            const auto writes = [&](int thread) {
                try {
                    while (true) write_file(folder / std::to_string(thread), "new");
                } catch (const Error&) {  // the process ends
                    pause();
                }
            };
            std::vector<std::thread> threads;
            for (int thread = 1; thread < 20; ++thread) threads.emplace_back(writes, thread);
            writes(0);
        }
        while (folder.files() == 0) std::this_thread::yield();
        std::this_thread::sleep_for(std::chrono::microseconds(97 * round));
        kill(child, SIGTERM);
        int status = 0;
        REQUIRE(waitpid(child, &status, 0) == child);
        REQUIRE(WIFEXITED(status));
        CHECK(WEXITSTATUS(status) == SIGTERM);
        for (const auto& entry : fs::directory_iterator(folder / "."))
            CHECK(!entry.path().filename().string().starts_with(".goffer"));
    }
}

TEST_CASE("atomic file: of several, none takes its place before all are written") {
    const Folder folder;
    folder.write("a", "old");
    const std::string message = message_of<Error>([&] {
        const FullDisk full(1000);
        AtomicFiles files;
        files.add(folder / "a").write("new");
        files.add(folder / "b").write(std::string(1001, 'x'));
        files.commit();
    });
    CHECK(tells(message, "b: cannot be written: File too large"));
    CHECK(bytes_of(folder / "a") == "old");
    CHECK(folder.files() == 1);
    AtomicFiles files;
    for (const char* name : {"a", "b"}) files.add(folder / name).write("new");
    CHECK(bytes_of(folder / "a") == "old");
    files.commit();
    CHECK(bytes_of(folder / "a") + bytes_of(folder / "b") == "newnew");
}

TEST_CASE("read file: a regular file, and nothing that might never end") {
    const Folder folder;
    CHECK(read_file(folder.write("a", std::string("b\0c", 3))) == std::string("b\0c", 3));
    CHECK(read_file(folder.write("empty", "")).empty());
    REQUIRE(mkfifo((folder / "pipe").c_str(), 0600) == 0);
    const auto refused = [&](const char* name) {
        return message_of<Error>([&] { (void)read_file(folder / name); });
    };
    CHECK(tells(refused("pipe"), "pipe: is not a regular file"));
    CHECK(tells(refused("."), "is a folder"));
    CHECK(tells(refused("none"), "none: there is no such file"));
}

TEST_CASE("error: text fit for a terminal, and sizes") {
    CHECK(escaped("a\x1b[31m\x7f\t\xc2\x9b") == "a\\x1b[31m\\x7f\\x09\\xc2\\x9b");
    CHECK(escaped("gr\xc3\xbc\xc3\x9f") == "gr\xc3\xbc\xc3\x9f");
    CHECK(escaped("\xe2\x82\xac \xf0\x9f\x90\x9b") == "\xe2\x82\xac \xf0\x9f\x90\x9b");
    CHECK(escaped("\x9b\x33\x31m \xe2\x80\xae \xe2\x82") == "\\x9b31m \\xe2\\x80\\xae \\xe2\\x82");
    CHECK(escaped("\xc0\xaf \xed\xa0\x80") == "\\xc0\\xaf \\xed\\xa0\\x80");
    CHECK(size_text(std::uint64_t{3} << 30) == "3 GiB");
    CHECK(size_text(1536) == "1536 bytes");
    CHECK(size_text(5 << 20) == "5 MiB");
}
