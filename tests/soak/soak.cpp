// SPDX-License-Identifier: MIT
#include "fit/synthetic.hpp"
#include "support/sanitized.hpp"

#include <goffer/bend/crowd.hpp>
#include <goffer/fit/bind.hpp>
#include <goffer/measure/timer.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <memory>
#include <random>
#include <string>
#include <string_view>
#include <vector>

#if defined(__linux__)
#include <unistd.h>
#endif

/// Runs a crowd whose entities and bodies come and go, for many frames, as a game does between two loads.
///
///     goffer_soak FRAMES [--times]
///
/// Ends with 1 where the process has grown after the first tenth of the frames, where a frame is not bit by
/// bit what each of its entities gives alone on a body that was bound anew, or, with --times, for a machine
/// that does nothing else, where one frame in a thousand takes more than three times the median.

namespace {

using namespace goffer;

constexpr std::size_t kinds = 12, most_entities = 400, vertex_step = 1100, stages = 10;
constexpr double growth_allowed = 0.02;

/// A tube of one of several sizes, of one to three regions, wrinkled in one of several ways.
fit::Binding bind_kind(unsigned seed) {
    std::mt19937 random(seed);
    test::Recipe recipe;
    recipe.columns = 8 + static_cast<int>(random() % 13);
    recipe.rows = 20 + static_cast<int>(random() % 31);
    recipe.closed = false;
    const test::Solid solid = test::cylinder(recipe, random);
    fit::BindOptions options;
    options.table_rows = 32;
    options.folds = static_cast<int>(random() % 12);
    if (random() % 2 == 0) options.profile = fit::Profile::damped;
    const std::size_t regions = 1 + random() % 3;
    options.regions.assign(regions, {1.0 / static_cast<double>(regions), {}});
    fit::Cylinder base = test::upright();
    if (random() % 3 == 0) base.radii = {1.2, 1, 0.8};
    return fit::bind(solid.geometry(), base, options);
}

struct Entity {
    unsigned number = 0;  ///< from which its motion follows
    bend::Pose poses[3] = {};
    glm::mat4x3 transform{1};
    float weight = 1;

    void move(std::uint32_t frame) {
        const auto turn = static_cast<float>(number % 97) + 0.05f * static_cast<float>(frame % 100'000);
        for (std::size_t r = 0; r < 3; ++r)
            poses[r] = {0.8f * std::sin(turn + static_cast<float>(r)), std::cos(0.3f * turn)};
        transform[3] = {std::sin(turn), std::cos(turn), 0.01f * static_cast<float>(number % 1000)};
        weight = number % 5 == 0 ? 0.5f + 0.5f * std::sin(turn) : 1;
    }
};

/// The entities of one body, as an ECS keeps an archetype.
struct Pool {
    unsigned seed = 0;
    std::unique_ptr<fit::Binding> binding;
    std::vector<Entity> entities;
};

struct Vertex {
    glm::vec3 position, normal;
};

class World {
public:
    World() : pools_(kinds), vertices_(most_entities * vertex_step) {
        for (Pool& pool : pools_) renew(pool);
    }

    /// Lets entities and bodies come and go. Every body is another one after a few hundred frames.
    void change(std::uint32_t frame) {
        Pool& pool = pools_[random_() % kinds];
        if (frame % 25 == 0) renew(pools_[frame / 25 % kinds]);
        if (!pool.entities.empty() && random_() % 2 == 0) {
            pool.entities[random_() % pool.entities.size()] = pool.entities.back();
            pool.entities.pop_back();
        }
        // As many on the whole, so that frames can be compared.
        while (count() < most_entities) pools_[random_() % kinds].entities.emplace_back().number = number_++;
        for (Pool& each : pools_) {
            for (Entity& entity : each.entities) entity.move(frame);
        }
    }

    void run(std::uint32_t frame) {
        batches_.clear();
        std::size_t first = 0;
        for (const Pool& pool : pools_) {
            if (pool.entities.empty()) continue;
            const std::span entities(pool.entities);
            const std::size_t room = vertices_.size() - first * vertex_step;
            float* const to = &vertices_[first * vertex_step].position.x;
            bend::Batch& batch = batches_.emplace_back();
            batch.body = &pool.binding->body;
            batch.count = entities.size();
            batch.poses = strided(entities, &Entity::poses);
            batch.transforms = strided(entities, &Entity::transform);
            batch.wrinkle_weights = strided(entities, &Entity::weight);
            batch.vertex_step = vertex_step;
            batch.positions = interleaved<3>(to, room, sizeof(Vertex));
            batch.normals = interleaved<3>(to + 3, room, sizeof(Vertex));
            first += entities.size();
        }
        bend::run_parallel({.batches = batches_, .frame = frame});
    }

    /// Whether each entity is what it is alone, on a body that was bound anew.
    [[nodiscard]] bool right() const {
        std::size_t first = 0;
        for (const Pool& pool : pools_) {
            const fit::Binding fresh = bind_kind(pool.seed);
            std::vector<Vertex> alone(fresh.body.vertex_count());
            for (const Entity& entity : pool.entities) {
                bend::DeformJob job{.body = &fresh.body};
                job.poses = std::span(entity.poses).first(fresh.body.region_count());
                job.transform = entity.transform;
                job.wrinkle_weight = entity.weight;
                job.positions = interleaved<3>(&alone[0].position.x, alone.size(), sizeof(Vertex));
                job.normals = interleaved<3>(&alone[0].normal.x, alone.size(), sizeof(Vertex));
                bend::run(job);
                if (std::memcmp(alone.data(), &vertices_[first++ * vertex_step],
                                alone.size() * sizeof(Vertex)) != 0)
                    return false;
            }
        }
        return true;
    }

    [[nodiscard]] unsigned bodies() const { return next_seed_; }
    [[nodiscard]] unsigned entities() const { return number_; }

private:
    [[nodiscard]] std::size_t count() const {
        std::size_t sum = 0;
        for (const Pool& pool : pools_) sum += pool.entities.size();
        return sum;
    }

    void renew(Pool& pool) {
        pool.entities.clear();
        pool.seed = next_seed_++;
        pool.binding = std::make_unique<fit::Binding>(bind_kind(pool.seed));
    }

    std::vector<Pool> pools_;
    std::vector<Vertex> vertices_;
    std::vector<bend::Batch> batches_;
    std::mt19937 random_{7};
    unsigned next_seed_ = 1, number_ = 0;
};

/// Bytes of the process that are in memory; 0 where that is not known.
double resident() {
#if defined(__linux__)
    std::ifstream file("/proc/self/statm");
    double all = 0, pages = 0;
    file >> all >> pages;
    return pages * static_cast<double>(sysconf(_SC_PAGESIZE));
#else
    return 0;
#endif
}

int fail(std::uint32_t frame, const char* what) {
    std::printf("frame %u: %s\n", frame, what);
    return 1;
}

}  // namespace

int main(int argc, char** argv) {
    const auto frames = static_cast<std::uint32_t>(argc > 1 ? std::strtoul(argv[1], nullptr, 10) : 3000);
    const bool times_count = argc > 2 && std::string_view(argv[2]) == "--times";
    if (frames < stages) return fail(0, "usage: goffer_soak FRAMES [--times], with 10 frames or more");
    World world;
    std::vector<double> microseconds;
    microseconds.reserve(frames);
    double warm = 0, largest = 0;
    const std::uint32_t stage = frames / stages;
    for (std::uint32_t frame = 0; frame < frames; ++frame) {
        world.change(frame);
        microseconds.push_back(1e-3 * measure::nanoseconds_of(2, [&] { world.run(frame); }));
        if (frame % (stage / 4 + 1) == 0 && !world.right())
            return fail(frame, "not what its entities give alone");
        if ((frame + 1) % stage != 0) continue;
        const double now = resident();
        if (frame + 1 == stage) warm = now;
        largest = std::max(largest, now);
        std::printf("%9u frames: %6.1f MB, %7u bodies, %8u entities so far\n", frame + 1, 1e-6 * now,
                    world.bodies(), world.entities());
    }
    const double median = measure::median(microseconds), slow = measure::quantile(microseconds, 0.999);
    std::printf("a frame: median %.0f us, 99 %% %.0f us, 99.9 %% %.0f us (%.2f times the median)\n", median,
                measure::quantile(microseconds, 0.99), slow, slow / median);
    // Sanitizers keep what was freed.
    if (!test::sanitized && largest > (1 + growth_allowed) * warm + 1e6) return fail(frames, "memory grew");
    if (times_count && slow > 3 * median)
        return fail(frames, "some frames take more than three times the median");
    return 0;
}
