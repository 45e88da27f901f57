// SPDX-License-Identifier: MIT
#include "game.hpp"

#include "crowd_system.hpp"

#include <goffer/bend/body_file.hpp>
#include <goffer/measure/allocations.hpp>
#include <goffer/measure/timer.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <memory>
#include <numbers>
#include <numeric>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace ecs {

using namespace goffer;

namespace {

constexpr const char* usage =
    "usage: %s [--creatures N] [--frames N] [--threads N] BODY.goffer..\n"
    "Plays a game without a window, and prints what a frame takes and a hash of what was drawn.\n"
    "  --threads N   deform on N threads of the game's own; default: with oneTBB\n"
    "After a quarter of the frames the last body joins, after half of them the first one is read anew,\n"
    "after three quarters the second one goes, with all of its creatures.\n";

struct Options {
    std::uint32_t creatures = 1000;
    std::uint32_t frames = 120;
    std::uint32_t threads = 0;  // 0: oneTBB
    std::vector<const char*> files;
};

std::uint32_t number(const char* text, std::uint32_t most) {
    char* end = nullptr;
    const unsigned long value = std::strtoul(text, &end, 10);
    if (end == text || *end != '\0' || value == 0 || value > most)
        throw std::invalid_argument(std::string(text) + ": not a number from 1 to " + std::to_string(most));
    return static_cast<std::uint32_t>(value);
}

std::optional<Options> parse(int argc, char** argv) {
    Options options;
    for (int i = 1; i < argc; ++i) {
        const std::string_view word = argv[i];
        if (!word.starts_with("--")) {
            options.files.push_back(argv[i]);
        } else if (i + 1 == argc) {
            return std::nullopt;
        } else if (word == "--creatures") {
            options.creatures = number(argv[++i], 100'000);
        } else if (word == "--frames") {
            options.frames = number(argv[++i], 100'000);
        } else if (word == "--threads") {
            options.threads = number(argv[++i], 256);
        } else {
            return std::nullopt;
        }
    }
    if (options.files.empty()) return std::nullopt;
    return options;
}

bend::BodyFile load(const char* name) {
    bend::BodyFileFault fault;
    std::optional<bend::BodyFile> file = bend::load_file(name, &fault);
    if (!file) throw std::runtime_error(name + std::string(": ") + bend::describe(fault).c_str());
    return std::move(*file);
}

/// Takes in one word after the other.
class Hash {
public:
    template <class T>
    void add(std::span<const T> values) {
        static_assert(sizeof(T) % sizeof(std::uint32_t) == 0);
        for (const T& value : values) {
            for (const auto word : std::bit_cast<std::array<std::uint32_t, sizeof(T) / 4>>(value))
                hash_ = std::rotl((hash_ ^ word) * 0x9e3779b97f4a7c15, 29);
        }
    }
    [[nodiscard]] std::uint64_t value() const { return hash_; }

private:
    std::uint64_t hash_ = 0;
};

/// What the parts of a frame took, in milliseconds.
class Times {
public:
    enum Part { all, animate, cull, deform, attach, parts };

    /// Room for `frames` of them.
    explicit Times(std::size_t frames) {
        for (std::vector<double>& times : times_) times.reserve(frames);
    }
    template <class Work>
    void measure(Part part, Work&& work) {
        constexpr int several = 2;  // threads: by the wall clock
        times_[part].push_back(measure::nanoseconds_of(several, work) / 1e6);
    }
    void print() const {
        std::printf("frame: %.3f ms (animate %.3f, cull %.3f, deform %.3f, hats and touch %.3f)\n", of(all),
                    of(animate), of(cull), of(deform), of(attach));
    }

    [[nodiscard]] double sum(Part part) const {
        return std::accumulate(times_[part].begin(), times_[part].end(), 0.0);
    }

private:
    [[nodiscard]] double of(Part part) const { return measure::median(times_[part]); }

    std::array<std::vector<double>, parts> times_;
};

std::size_t largest(const std::vector<bend::BodyFile>& files) {
    std::size_t vertices = 0;
    for (const bend::BodyFile& file : files) {
        for (const bend::BodyFileLevel& level : file.levels)
            vertices = std::max(vertices, level.body.vertex_count());
    }
    return vertices;
}

double longest(const std::vector<bend::BodyFile>& files) {
    double length = 0;
    for (const bend::BodyFile& file : files) length = std::max(length, file.levels[0].body.length());
    return length;
}

class Game {
public:
    Game(World& world, const Options& options, std::vector<bend::BodyFile> files, CrowdThreads* threads)
        : world_(world),
          options_(options),
          spacing_(static_cast<float>(1.5 * longest(files))),
          crowd_(options.creatures, largest(files), threads),
          last_(std::move(files.back())),
          times_(options.frames) {
        files.pop_back();
        for (bend::BodyFile& file : files) kinds_.push_back(crowd_.add_kind(std::move(file)));
        if (kinds_.empty()) kinds_.push_back(crowd_.add_kind(load(options.files[0])));
        while (world_.pools().count < options_.creatures) spawn();
        crowd_.list_kinds(world_.pools());
    }

    void play() {
        for (std::uint32_t frame = 0; frame < options_.frames; ++frame) {
            change_kinds(frame);
            replace_some();
            const std::optional<std::uint64_t> before = measure::allocations();
            times_.measure(Times::all, [&] { play(frame); });
            // oneTBB's own pools fill in the first frames.
            if (before && frame >= 10) allocated_ += *measure::allocations() - *before;
        }
    }

    void print() {
        Hash hash = hats_;
        hash.add(crowd_.vertices());
        hash.add(crowd_.previous_positions());
        std::printf("%u creatures of %zu file%s, %u frames; %u came and went\n", options_.creatures,
                    options_.files.size(), options_.files.size() == 1 ? "" : "s", options_.frames,
                    next_ - options_.creatures);
        const auto per_frame = [&](std::size_t sum) {
            return static_cast<double>(sum) / static_cast<double>(options_.frames);
        };
        std::printf("creatures per frame: %.1f seen, %.1f deformed, %.1f with hats, %.1f touched\n",
                    per_frame(seen_), per_frame(deformed_), per_frame(hat_count_), per_frame(touched_));
        times_.print();
        std::printf(
            "deform: %.2f ns per vertex, with previous positions\n",
            times_.sum(Times::deform) * 1e6 / static_cast<double>(std::max<std::size_t>(vertices_, 1)));
        if (measure::allocations())
            std::printf("allocations in frames: %llu\n", static_cast<unsigned long long>(allocated_));
        std::printf("hash %016llx\n", static_cast<unsigned long long>(hash.value()));
    }

private:
    void spawn() {
        const std::uint32_t id = next_++;
        const std::uint32_t side = static_cast<std::uint32_t>(std::ceil(std::sqrt(options_.creatures)));
        const std::uint32_t cell = id % (side * side);
        Place place;
        place.now[3] =
            spacing_ *
            glm::vec3(1 + cell / side, static_cast<float>(cell % side) - 0.5f * static_cast<float>(side), 0);
        place.drawn = place.now;
        world_.add({id, kinds_[id % kinds_.size()], crowd_.take_vertices()}, place);
    }

    template <class Condition>
    void remove_if(Condition&& condition) {
        for (std::size_t i = world_.pools().count;
             i-- > 0;) {  // from the end: the last one takes a free place
            const Creature creature = world_.pools().creatures[i];
            if (!condition(creature)) continue;
            crowd_.give_back_vertices(creature.first_vertex);
            world_.remove(i);
        }
    }

    /// In every frame one creature in a hundred goes, the oldest first, and others come.
    void replace_some() {
        first_ += std::max(1u, options_.creatures / 100);
        remove_if([&](const Creature& creature) { return creature.id < first_; });
        while (world_.pools().count < options_.creatures) spawn();
        crowd_.list_kinds(world_.pools());
    }

    void change_kinds(std::uint32_t frame) {
        if (frame == options_.frames / 4 && last_) {
            kinds_.push_back(crowd_.add_kind(std::move(*last_)));
            last_.reset();
        }
        if (frame == options_.frames / 2) crowd_.replace_kind(0, load(options_.files[0]), world_.pools());
        if (frame == 3 * options_.frames / 4 && kinds_.size() > 2) {
            const std::uint32_t gone = kinds_[1];
            kinds_.erase(kinds_.begin() + 1);
            remove_if([&](const Creature& creature) { return creature.kind == gone; });
            crowd_.remove_kind(gone);
        }
    }

    void play(std::uint32_t frame) {
        const Pools pools = world_.pools();
        times_.measure(Times::animate, [&] { animate(pools, frame); });
        const float reach = spacing_ * 2;
        const std::array<Camera::Plane, 2> planes{Camera::Plane{{0.7f, 0.7f, 0}, reach},
                                                  {{0.7f, -0.7f, 0}, reach}};
        times_.measure(Times::cull, [&] { crowd_.cull(pools, {{0, 0, 0}, planes}, frame); });
        bend::CrowdResult result;
        times_.measure(Times::deform, [&] { result = crowd_.deform(pools); });
        times_.measure(Times::attach, [&] {
            crowd_.attach_hats(pools);
            const auto t = 0.1f * static_cast<float>(frame);
            crowd_.touch(pools, {spacing_ * glm::vec3(3 + std::cos(t), std::sin(t), 0.3f), 0.4f * spacing_});
        });
        seen_ += crowd_.seen();
        deformed_ += result.deformed;
        vertices_ += crowd_.deformed_vertices();
        hat_count_ += crowd_.hats().size();
        hats_.add(crowd_.hats());
        for (std::size_t i = 0; i < pools.count; ++i) touched_ += pools.details[i].touched ? 1 : 0;
    }

    /// Creatures sway, each in a way of its own, walk to and fro, and shrink back from the ball.
    void animate(const Pools& pools, std::uint32_t frame) {
        for (std::size_t i = 0; i < pools.count; ++i) {
            const std::uint32_t id = pools.creatures[i].id;
            const float phase = 2.4f * static_cast<float>(id % 1000) + 0.1f * static_cast<float>(frame);
            pools.bends[i].now.angle = 0.8f * std::sin(phase) + (pools.details[i].touched ? 0.6f : 0.0f);
            pools.places[i].now[3].y += 0.02f * spacing_ * std::sin(0.05f * phase);
            pools.bends[i].now.direction = 0.5f * std::numbers::pi_v<float> * static_cast<float>(id % 4);
        }
    }

    World& world_;
    Options options_;
    float spacing_;
    CrowdSystem crowd_;
    std::optional<bend::BodyFile> last_;  // until it joins
    Times times_;
    std::vector<std::uint32_t> kinds_;    // that creatures come of
    std::uint32_t first_ = 0, next_ = 0;  // ids: of those that stay, and of the next one
    std::uint64_t allocated_ = 0;
    std::size_t seen_ = 0, deformed_ = 0, vertices_ = 0, hat_count_ = 0, touched_ = 0;
    Hash hats_;
};

void play(World& world, const Options& options) {
    std::vector<bend::BodyFile> files;
    for (const char* name : options.files) files.push_back(load(name));
    std::optional<CrowdThreads> threads;
    if (options.threads > 0) threads.emplace(options.threads);
    Game game(world, options, std::move(files), threads ? &*threads : nullptr);
    game.play();
    game.print();
}

}  // namespace

int play(World& world, int argc, char** argv) {
    try {
        const std::optional<Options> options = parse(argc, argv);
        if (!options) {
            std::fprintf(stderr, usage, argv[0]);
            return 2;
        }
        play(world, *options);
        return 0;
    } catch (const std::invalid_argument& error) {
        std::fprintf(stderr, "%s: %s\n", argv[0], error.what());
        return 2;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "%s: %s\n", argv[0], error.what());
        return 1;
    }
}

}  // namespace ecs
