// SPDX-License-Identifier: MIT
#include "file/load_held.hpp"

#include <goffer/bend/body_file.hpp>

#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <memory>
#include <utility>

namespace goffer::bend {
namespace {

/// Room for the bytes of a file, as long as `holdings` are.
std::span<std::byte> copy_of_size(const FileMemory& holdings, std::size_t bytes) {
    holdings->copy = Columns(1, (bytes + sizeof(float) - 1) / sizeof(float));
    return std::as_writable_bytes(holdings->copy[0]).first(bytes);
}

/// Bytes of a file, which is rewound; negative where it has no size.
std::int64_t size_of(std::FILE* file) {
#ifdef _WIN32
    const std::int64_t size = _fseeki64(file, 0, SEEK_END) == 0 ? _ftelli64(file) : -1;
#else
    const std::int64_t size = std::fseek(file, 0, SEEK_END) == 0 ? std::ftell(file) : -1;
#endif
    std::rewind(file);
    return size;
}

}  // namespace

BodyFile::BodyFile(FileMemory memory) noexcept : memory_(std::move(memory)) {}
BodyFile::BodyFile(BodyFile&& other) noexcept = default;
BodyFile& BodyFile::operator=(BodyFile&& other) noexcept = default;
BodyFile::~BodyFile() = default;

bool is_body_file(std::span<const std::byte> bytes) noexcept {
    return bytes.size() >= file_magic.size() &&
           std::memcmp(bytes.data(), file_magic.data(), file_magic.size()) == 0;
}

std::optional<BodyFile> load(std::span<const std::byte> bytes, BodyFileFault* fault, Verify verify) {
    return load_held(bytes, fault, verify, FileMemory(new FileHoldings));
}

std::optional<BodyFile> load_copy(std::span<const std::byte> bytes, BodyFileFault* fault, Verify verify) {
    auto holdings = FileMemory(new FileHoldings);
    const std::span<std::byte> copy = copy_of_size(holdings, bytes.size());
    if (!bytes.empty()) std::memcpy(copy.data(), bytes.data(), bytes.size());
    return load_held(copy, fault, verify, std::move(holdings));
}

std::optional<BodyFile> load_file(const char* name, BodyFileFault* fault, Verify verify) {
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(name, "rb"), std::fclose);
    const auto refused = [&](const BodyFileFault& found) {
        if (fault != nullptr) *fault = found;
        return std::nullopt;
    };
    if (!file) return refused({errno == ENOENT ? FileReason::missing : FileReason::unreadable});
    // A folder opens and has a size, but cannot be read: reading comes first.
    FileHeader header = {};
    const bool whole = std::fread(&header, sizeof header, 1, file.get()) == 1;
    if (!whole) header = {};
    if (std::ferror(file.get()) != 0) return refused({FileReason::unreadable});
    const std::int64_t size = whole ? size_of(file.get()) : 0;
    if (size < 0) return refused({FileReason::unreadable});
    if (const BodyFileFault found = check_start(header, static_cast<std::uint64_t>(size)); !found.none())
        return refused(found);
    auto holdings = FileMemory(new FileHoldings);
    const std::span<std::byte> copy = copy_of_size(holdings, static_cast<std::size_t>(size));
    if (std::fread(copy.data(), 1, copy.size(), file.get()) != copy.size())
        return refused({FileReason::unreadable});
    return load_held(copy, fault, verify, std::move(holdings));
}

}  // namespace goffer::bend
