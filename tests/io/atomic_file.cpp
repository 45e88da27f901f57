// SPDX-License-Identifier: MIT
#include "support/files.hpp"

#include <goffer/io/atomic_file.hpp>

#include <doctest/doctest.h>
#include <unistd.h>

using namespace goffer::io;
using namespace goffer::test;

namespace fs = std::filesystem;

namespace {

std::string refusal(const fs::path& file, const std::string& bytes = "new") {
    return message_of<Error>([&] { write_file(file, bytes); });
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
    CHECK(tells(refusal(folder / "a\nb/c"), "a_b/c: there is no such folder"));
    CHECK(tells(refusal(folder / "loop"), "loop: is a link that leads to itself"));
    CHECK(tells(refusal(folder / std::string(254, 'x')), "cannot be written: File name too long"));
    CHECK(refusal("/dev/full").starts_with("/dev/full: is not a regular file"));
    CHECK(folder.files() == 3);
}

TEST_CASE("atomic file: what is write-protected stays") {
    const Folder folder;
    fs::permissions(folder.write("a", "old"), fs::perms::owner_read);
    if (geteuid() == 0) return;  // who may write to all files
    CHECK(tells(refusal(folder / "a"), "a: is write-protected"));
    CHECK(bytes_of(folder / "a") == "old");
    CHECK(folder.files() == 1);
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
