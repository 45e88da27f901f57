// SPDX-License-Identifier: MIT
#include "support/files.hpp"

#include <cstddef>
#include <cstdint>
#include <cstdio>

/// Feeds files, and those in folders, to a fuzzer's target, without libFuzzer: replay_NAME FILE|FOLDER..

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace {

namespace fs = std::filesystem;

/// Says which one before it is tried, in case it ends the program.
int replay(const fs::path& file) {
    std::fprintf(stderr, "%s\n", file.string().c_str());
    const std::string bytes = goffer::test::bytes_of(file);
    return LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
}

int replay_all(const fs::path& place) {
    if (!fs::is_directory(place)) return replay(place), 1;
    int count = 0;
    for (const fs::directory_entry& entry : fs::directory_iterator(place)) replay(entry.path()), ++count;
    return count;
}

}  // namespace

int main(int argc, char** argv) {
    int count = 0;
    for (int i = 1; i < argc; ++i) count += replay_all(argv[i]);
    std::printf("%d inputs\n", count);
    return count > 0 ? 0 : 1;
}
