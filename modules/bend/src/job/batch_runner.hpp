// SPDX-License-Identifier: MIT
#pragma once

#include "body/body_data.hpp"
#include "kernel/args.hpp"
#include "output/output_plan.hpp"
#include "output/staging_buffer.hpp"
#include "pose/blending.hpp"
#include "pose/posed_group.hpp"

#include <goffer/bend/crowd.hpp>

#include <cstddef>
#include <cstdint>
#include <span>

namespace goffer::bend {

/// Deforms instances of a batch. What all of them share (kernels, columns, outputs) is looked up once, when
/// the runner is made. Instances are taken in groups, whose coefficients fit into the first-level cache. Each
/// group is set up, and its vertices are deformed block by block: the rest columns of a block stay in that
/// cache, too, while they serve the whole group. A group is deformed when the next one is gathered: see
/// PosedGroup. Lives on the stack and takes at most 52 KB.
class BatchRunner {
public:
    /// `non_temporal`: whole lines go past the cache, and the caller must fence them.
    BatchRunner(const Batch& batch, const KernelSet& kernels, bool non_temporal) noexcept;

    /// Deforms an instance that is not skipped. It may wait for others to be deformed with.
    void add(std::size_t instance) noexcept {
        gather(instance);
        if (gathered_->count == group_size_) next_group();
    }
    /// Of instances that are added from now on, only the vertices [first, last) are deformed. Those that
    /// still wait are finished before. result() counts an instance when its vertex 0 is deformed.
    void set_part(std::size_t first, std::size_t last) noexcept {
        if (first == part_.first && last == part_.last) return;
        finish();
        part_ = {first, last};
    }
    /// Deforms the instances that still wait.
    void finish() noexcept;

    [[nodiscard]] const CrowdResult& result() const noexcept { return result_; }

private:
    /// An instance of a group.
    struct Member {
        std::size_t instance;  ///< its index in the batch
        std::size_t vertex;    ///< its first vertex in the buffer
        std::size_t peeled;    ///< its vertices before the first one that begins a cache line
    };

    struct Group {
        std::size_t count = 0;
        Member members[setup_width];
        std::size_t elements[setup_width];  ///< of the batch's columns, that they read

        [[nodiscard]] std::span<const std::size_t> used() const noexcept { return {elements, count}; }
    };

    /// The vertices [first, last).
    struct Span {
        std::size_t first, last;
    };

    /// Vertices in the stage.
    struct StagedBlock {
        WriteMode mode;
        std::size_t vertex;  ///< the first one's place in the buffer
        std::size_t count;   ///< 0: there are none
        bool ends;           ///< the last one is that of an instance
    };

    /// A group has `set_count_` sets of coefficients per member, one for each pose that is wanted, and in
    /// each set one per region. There is room for one member of a body with max_regions.
    static constexpr std::size_t max_coefficients = 96;
    static_assert(max_coefficients >= pass_count * max_regions);

    [[nodiscard]] Coefficients* coefficients(std::size_t member, std::size_t set) noexcept {
        return coefficients_ + (member * set_count_ + set) * regions_;
    }
    [[nodiscard]] Squeeze* squeezes(std::size_t member, std::size_t set) noexcept {
        return squeezes_ + (member * set_count_ + set) * regions_;
    }

    [[nodiscard]] std::size_t& set_of(Pass pass) noexcept { return set_of_[static_cast<std::size_t>(pass)]; }

    /// Adds an instance to the group that is being gathered.
    void gather(std::size_t instance) noexcept {
        const std::size_t vertex = first_vertex_of(batch_, instance);
        gathered_->elements[gathered_->count] = element_of(batch_, instance);
        gathered_->members[gathered_->count++] = {instance, vertex, plan_.peeled(vertex)};
    }
    /// Whether instances are counted, and their bounds set.
    [[nodiscard]] bool begins() const noexcept { return part_.first == 0 && part_.last != 0; }
    void next_group() noexcept;
    void take_poses() noexcept;
    void set_up() noexcept;
    void set_up_poses(std::size_t set, bool normals) noexcept;
    void deform_group() noexcept;
    [[nodiscard]] bool may_share_lines() const noexcept;
    void deform_row() noexcept;
    [[nodiscard]] bool shares_line(std::size_t member) const noexcept;
    void set_up_packed(std::size_t member, const Bounds& bounds) noexcept;
    void deform(std::size_t member, std::size_t first, std::size_t last) noexcept;
    void deform_planes(std::size_t member, std::size_t first, std::size_t last) noexcept;
    void deform_records(std::size_t member, std::size_t first, std::size_t last) noexcept;
    void deform_pairs(std::size_t member, std::size_t first, std::size_t last) noexcept;
    void deform_pair(std::size_t member, std::size_t region, Span vertices) noexcept;
    template <class Deform>
    void each_stretch(std::size_t member, WriteMode mode, std::size_t first, std::size_t last,
                      const Deform& deform) noexcept;
    void deform_staged(std::size_t member, WriteMode mode, std::size_t first, std::size_t last) noexcept;
    void write_staged() noexcept;
    [[nodiscard]] std::size_t block_end(std::size_t member, std::size_t first, std::size_t last,
                                        std::size_t most) const noexcept;
    template <class Deform>
    void each_pass(std::size_t member, WriteMode mode, std::size_t region, std::size_t first,
                   std::size_t last, const Deform& deform) noexcept;
    template <class Deform>
    void each_call(std::size_t member, WriteMode mode, std::size_t first, std::size_t last,
                   const Deform& deform) noexcept;
    template <class Deform>
    void each_input(std::size_t member, const PassPlan& pass, std::size_t region, std::size_t first,
                    std::size_t last, const Deform& deform) noexcept;
    template <class Deform>
    void each_blended(std::size_t member, const PassPlan& pass, std::size_t region, std::size_t first,
                      std::size_t last, const Deform& deform) noexcept;
    [[nodiscard]] Span between_joints(std::size_t member, std::size_t region, std::size_t first,
                                      std::size_t last) const noexcept;
    template <class Deform>
    void each_piece(std::size_t first, std::size_t last, const Deform& deform) noexcept;
    [[nodiscard]] Span joint_behind(std::size_t region) const noexcept;
    [[nodiscard]] std::size_t joints_end(std::size_t member, std::size_t region, std::size_t first,
                                         std::size_t last) const noexcept;
    [[nodiscard]] std::size_t padded_end(std::size_t member, const RestColumns& columns, std::size_t end,
                                         std::size_t to_line) const noexcept;
    [[nodiscard]] std::size_t to_line(const Record& record, std::size_t member,
                                      std::size_t vertex) const noexcept;
    [[nodiscard]] std::size_t line_before(std::size_t member, std::size_t vertex) const noexcept;
    [[nodiscard]] std::size_t line_behind(std::size_t member, std::size_t vertex) const noexcept;
    const Batch& batch_;
    const BodyData& body_;
    const KernelSet& kernels_;
    OutputPlan plan_;
    std::size_t regions_;
    bool pads_;          // the last lines of instances may be filled up
    bool shares_lines_;  // whole instances are deformed by deform_row()
    std::size_t set_count_ = 0;
    std::size_t set_of_[pass_count] = {};
    bool posed_now_ = false;  // current poses are wanted, not only previous ones
    bool normals_ = false;    // of current poses, more than positions are wanted
    std::size_t group_size_ = 0;
    Span part_;  // of each instance, that is deformed
    CrowdResult result_;
    Group groups_[2];
    Group* group_ = &groups_[0];     // that is set up, and not yet deformed
    Group* gathered_ = &groups_[1];  // that is being gathered
    Squeeze squeezes_[max_coefficients];
    Coefficients coefficients_[max_coefficients];
    PosedGroup posed_;
    StagingBuffer staging_;
    StagedBlock staged_ = {};  // what is yet to be written of the stage
    Blending blending_;
};

}  // namespace goffer::bend
