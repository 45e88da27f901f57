// SPDX-License-Identifier: MIT
#include "cases.hpp"
#include "ratios.hpp"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cstdio>
#include <string_view>

namespace {

void print_help() {
    std::puts(
        "goffer_bench [--sweep] [Google Benchmark's options]\n"
        "\n"
        "  --sweep   the sweep/ cases as well: crowds of 1 to 10,000 instances of 200 to 1,000,000 vertices\n"
        "            (up to 500 MB of output)\n"
        "\n"
        "What the cases are called and how to read them: bench/README.md. Google Benchmark's options:\n");
    benchmark::PrintDefaultHelp();
}

/// Whether `word` was among the arguments. It is taken out, so that Google Benchmark does not see it.
bool take(std::string_view word, int& count, char** words) {
    char** const end = std::remove(words + 1, words + count, word);
    const bool found = end != words + count;
    count = static_cast<int>(end - words);
    words[count] = nullptr;
    return found;
}

}  // namespace

int main(int count, char** words) {
    using namespace goffer::bench;
    const bool sweep = take("--sweep", count, words);
    benchmark::Initialize(&count, words, print_help);
    if (benchmark::ReportUnrecognizedArguments(count, words)) return 2;
    Fixture fixture;
    register_naive();
    register_floor(fixture);
    register_setup(fixture);
    register_bind();
    register_load();
    register_deform(fixture);
    if (sweep) register_sweep(fixture);
    RatioReporter reporter;
    benchmark::RunSpecifiedBenchmarks(&reporter);
}
