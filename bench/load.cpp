// SPDX-License-Identifier: MIT
#include "cases.hpp"
#include "measure.hpp"
#include "model.hpp"

#include <goffer/bend/body_file.hpp>
#include <goffer/engine/columns.hpp>

#include <algorithm>
#include <array>
#include <string>
#include <utility>

namespace goffer::bench {
namespace {

/// A body file in memory, as a mapped one lies there.
class Mapped {
public:
    explicit Mapped(std::size_t vertices) {
        const Model model(vertices);
        const bend::Body body = bind_model(model);
        const bend::LevelInput level{&body, {model.triangles, {}, {}, {}}};
        const std::vector<std::byte> bytes = bend::save({{&level, 1}, {}, {}, {}});
        memory_ = Columns(1, bytes.size() / sizeof(float));
        std::ranges::copy(bytes, std::as_writable_bytes(memory_[0]).begin());
    }
    [[nodiscard]] std::span<const std::byte> bytes() const { return std::as_bytes(memory_[0]); }

private:
    Columns memory_;
};

void load(benchmark::State& state, bend::Verify verify, std::size_t vertices) {
    const Mapped file(vertices);
    const Task task{.work = [&](std::size_t count) {
        for (std::size_t i = 0; i < count; ++i) {
            const auto loaded = bend::load(file.bytes(), nullptr, verify);
            benchmark::DoNotOptimize(loaded->levels.size());
        }
    }};
    report(state, measure(state, task), vertices);
}

}  // namespace

void register_load() {
    constexpr std::array ways{std::pair("everything", bend::Verify::everything),
                              std::pair("checksum", bend::Verify::checksum),
                              std::pair("layout", bend::Verify::layout)};
    for (const auto& [name, verify] : ways) {
        for (const std::size_t vertices : {10'000, 100'000}) {
            const std::string label = "load/" + std::string(name) + "/" + std::to_string(vertices);
            benchmark::RegisterBenchmark(label.c_str(), load, verify, vertices)
                ->Unit(benchmark::kMicrosecond);
        }
    }
}

}  // namespace goffer::bench
