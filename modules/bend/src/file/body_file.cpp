// SPDX-License-Identifier: MIT
#include "file/format.hpp"
#include "file/load_held.hpp"

#include <goffer/bend/body_file.hpp>

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
    const auto refused = [&](FileReason reason) {
        if (fault != nullptr) *fault = {reason};
        return std::nullopt;
    };
    // Its size is asked for once it has shown to be a file: folders have one too.
    FileHeader header = {};
    if (!file) return refused(FileReason::unreadable);
    if (std::fread(&header, sizeof header, 1, file.get()) != 1)
        return refused(std::ferror(file.get()) != 0 ? FileReason::unreadable : FileReason::not_a_body_file);
    const long size = std::fseek(file.get(), 0, SEEK_END) == 0 ? std::ftell(file.get()) : -1;
    if (size < 0 || std::fseek(file.get(), 0, SEEK_SET) != 0) return refused(FileReason::unreadable);
    auto holdings = FileMemory(new FileHoldings);
    const std::span<std::byte> copy = copy_of_size(holdings, static_cast<std::size_t>(size));
    if (std::fread(copy.data(), 1, copy.size(), file.get()) != copy.size())
        return refused(FileReason::unreadable);
    return load_held(copy, fault, verify, std::move(holdings));
}

}  // namespace goffer::bend
