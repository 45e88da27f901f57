// SPDX-License-Identifier: MIT
#pragma once

#include "body/body_data.hpp"
#include "kernel/args.hpp"
#include "output/output_plan.hpp"
#include "pose/posed_group.hpp"

#include <goffer/bend/crowd.hpp>

#include <cstddef>

namespace goffer::bend {

/// Deforms whole instances of a body with few vertices per region, many instances at a time: see
/// kernel/lane_kernel.hpp. Vertices become tiles of all instances, tiles are taken apart into planes of each,
/// and planes are written to the caller's memory. Where that goes past the cache it is done in whole lines,
/// and what is left of a line waits for the next tiles. Lives on the stack and takes at most 56 KB.
class LaneRunner {
public:
    /// Whether it can deform that many instances of the batch, and a BatchRunner would take longer. A batch
    /// with previous positions would be deformed as two, of which one has these as its positions.
    [[nodiscard]] static bool suits(const Batch& batch, std::size_t instances,
                                    const KernelSet& kernels) noexcept;

    /// `wrinkled`: the instances that will be added have weights above 0; otherwise none has. `non_temporal`:
    /// whole lines go past the cache, and the caller must fence them.
    LaneRunner(const Batch& batch, const KernelSet& kernels, bool non_temporal, bool wrinkled) noexcept;

    /// Deforms an instance that is not skipped. It may wait for others to be deformed with.
    void add(std::size_t instance) noexcept;
    /// Deforms the instances that still wait.
    void finish() noexcept;

    [[nodiscard]] const CrowdResult& result() const noexcept { return result_; }

private:
    struct Member {
        std::size_t vertex;   ///< its first vertex in the buffer
        std::size_t peeled;   ///< its vertices before the first one that begins a cache line
        std::size_t written;  ///< how many of its vertices are
        std::size_t waiting;  ///< how many behind those wait at the beginning of its planes
    };

    void prefetch_ends() const noexcept;
    void set_up(std::size_t region) noexcept;
    void deform(std::size_t region) noexcept;
    template <class Kernel>
    void fill_tiles(std::size_t first, std::size_t last, const Kernel& kernel) noexcept;
    void take_tile_apart() noexcept;
    void write(bool ends) noexcept;

    [[nodiscard]] InstanceLanes* tile() noexcept { return reinterpret_cast<InstanceLanes*>(floats_); }
    [[nodiscard]] float* plane(std::size_t member, std::size_t value) noexcept {
        return floats_ + values_ * tile_vertices * setup_width + member * member_floats_ + value * stride_;
    }

    /// Room for a tile of ten values, two lines of them for each member, and one that makes that odd.
    static constexpr std::size_t max_values = 10;
    static constexpr std::size_t max_lines = max_values * tile_vertices + setup_width * (2 * max_values + 1);
    /// Squeezes and coefficients are kept for regions r - 1, r and r + 1, at their indices modulo 3.
    static constexpr std::size_t kept = 3;

    const Batch& batch_;
    const BodyData& body_;
    const KernelSet& kernels_;
    OutputPlan plan_;
    const PassPlan& pass_;  // the only one of the plan
    bool wrinkled_;
    std::size_t values_;         // per vertex
    std::size_t stride_;         // floats from one plane of a member to the next
    std::size_t member_floats_;  // from one member's planes to the next's
    CrowdResult result_;
    PosedGroup posed_;
    Member members_[setup_width];
    std::size_t filled_ = 0;   // vertices in planes, behind those that waited
    std::size_t in_tile_ = 0;  // vertices in the tile
    Squeeze squeezes_[kept];
    alignas(64) LaneCoefficients coefficients_[kept];
    // The tile, then planes, behind which a line may be read.
    alignas(64) float floats_[(max_lines + 1) * line_floats];
};

}  // namespace goffer::bend
