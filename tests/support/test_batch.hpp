// SPDX-License-Identifier: MIT
#pragma once

#include "support/bodies.hpp"
#include "support/output_buffer.hpp"

#include <goffer/bend/bounds.hpp>
#include <goffer/bend/crowd.hpp>

#include <glm/mat4x3.hpp>
#include <glm/mat4x4.hpp>

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <deque>
#include <limits>
#include <numeric>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

/// Instances of one body, kept as an engine might keep them: a batch of columns, and what run() of each
/// instance alone leaves.

namespace goffer::test {

/// What is kept of an instance. Members of a byte lie between the others, so that columns have odd offsets.
struct Worm {
    static constexpr std::size_t max_regions = bend::max_regions;
    std::uint8_t visible = 1;
    bend::Pose poses[max_regions];
    std::uint8_t changed = 1;
    float weight = 1;
    bend::Pose previous_poses[max_regions];
    std::uint8_t interval = 1;
    glm::mat4x3 model{1}, previous_model{1};
    glm::mat4 model4{1}, previous_model4{1};
    float rows[12] = {}, previous_rows[12] = {};
    std::uint32_t place = 0;
};

/// Where columns lie.
enum class Storage : std::uint8_t { arrays, members, paged_arrays, paged_members };
inline constexpr Storage all_storages[] = {Storage::arrays, Storage::members, Storage::paged_arrays,
                                           Storage::paged_members};

/// How a test_batch is kept and where it is deformed to.
struct BatchStyle {
    Storage storage = Storage::members;
    bend::TransformColumn::MatrixLayout transforms = bend::TransformColumn::MatrixLayout::columns3;
    bool indices = false;   ///< elements at random places of a pool of twice as many
    bool places = false;    ///< vertices in another order; else by step
    bool dense = false;     ///< no vertices between instances, unless by `places`
    bool masks = false;     ///< visible, changed and update_intervals are given
    bool defaults = false;  ///< transforms and weights are not given
    bool hostile = false;   ///< one pose or weight in four holds any bits
    bool scratch_gaps = false;
    bool bounds = true;  ///< they are wanted
    std::string_view picture = OutputBuffer::all_planes;
};

class TestBatch {
public:
    TestBatch(Random& random, const bend::Body& body, std::size_t count, const BatchStyle& style)
        : body_(body),
          style_(style),
          count_(count),
          worms_(style.indices ? 2 * count + 1 : count),
          boxes_(count),
          expected_boxes_(count),
          out_("xyz", 1) {
        for (Worm& worm : worms_) make(random, worm);
        if (style.indices) {
            indices_.resize(worms_.size());
            std::iota(indices_.begin(), indices_.end(), 0u);
            std::ranges::shuffle(indices_, random);
            indices_.resize(count);
        }
        const std::size_t vertices = set_places(random);
        out_ = OutputBuffer(style.picture, vertices, random() % 16, random() % 2 == 0 ? 0 : random() % 16);
        for (std::size_t i = 0; i < count; ++i)
            planes_.emplace_back(OutputBuffer::all_planes, body.vertex_count());
    }

    [[nodiscard]] bend::Batch batch() {
        bend::Batch batch{.body = &body_, .count = count_, .indices = indices_};
        const std::size_t regions = body_.region_count();
        batch.poses = column<bend::Pose>(&Worm::poses, regions);
        batch.previous_poses = column<bend::Pose>(&Worm::previous_poses, regions);
        if (style_.defaults) {
            // Nothing is given, in whatever layout.
            batch.transforms = batch.previous_transforms = {StridedView<float>{}, style_.transforms};
        } else {
            batch.transforms = transforms(&Worm::model, &Worm::model4, &Worm::rows);
            batch.previous_transforms =
                transforms(&Worm::previous_model, &Worm::previous_model4, &Worm::previous_rows);
            batch.wrinkle_weights = column<float>(&Worm::weight);
        }
        if (style_.masks) {
            batch.visible = column<std::uint8_t>(&Worm::visible);
            batch.changed = column<std::uint8_t>(&Worm::changed);
            batch.update_intervals = column<std::uint8_t>(&Worm::interval);
        }
        if (style_.places) {
            batch.vertex_offsets = column<std::uint32_t>(&Worm::place);
        } else {
            batch.vertex_step = step_;
        }
        out_.attach(batch);
        if (style_.bounds) batch.bounds = boxes_;
        batch.scratch_gaps = style_.scratch_gaps;
        return batch;
    }

    /// Instance i alone, without streams.
    [[nodiscard]] bend::DeformJob job(std::size_t i) const {
        const Worm& worm = worms_[element(i)];
        const std::size_t regions = body_.region_count();
        bend::DeformJob job{.body = &body_, .poses = {worm.poses, regions}};
        job.previous_poses = {worm.previous_poses, regions};
        if (style_.defaults) return job;
        job.transform = worm.model;
        job.previous_transform = worm.previous_model;
        job.wrinkle_weight = worm.weight;
        return job;
    }

    /// Whether instance i has its turn.
    [[nodiscard]] bool active(std::size_t i, std::uint32_t frame) const {
        const Worm& worm = worms_[element(i)];
        if (!style_.masks) return true;
        const std::uint64_t interval = std::max<std::uint8_t>(worm.interval, 1);
        return worm.visible != 0 && worm.changed != 0 && (std::uint64_t{frame} + i) % interval == 0;
    }

    /// Runs the instances one by one; `result` counts those that are active.
    void expect(Isa isa, std::uint32_t frame, bend::CrowdResult& result) {
        for (std::size_t i = 0; i < count_; ++i) {
            bend::DeformJob one = job(i);
            one.isa = isa;
            one.bounds = &expected_boxes_[i];
            planes_[i].attach(one);
            const bend::DeformResult left = bend::run(one);
            if (!active(i, frame)) continue;
            ++result.deformed;
            result.clamped += left.clamped ? 1 : 0;
            result.at_rest += left.at_rest ? 1 : 0;
        }
    }

    void clear() {
        out_.clear();
        boxes_.assign(count_, untouched);
    }

    /// Empty if the active instances hold what is expected, and nothing else was written; or what is not so.
    [[nodiscard]] std::string fault(std::uint32_t frame) const {
        std::vector<OutputBuffer::Part> parts;
        for (std::size_t i = 0; i < count_; ++i) {
            const bool runs = active(i, frame);
            const std::size_t vertices = body_.vertex_count();
            const std::size_t padding = style_.places || i + 1 == count_ ? 0 : step_ - vertices;
            if (runs) parts.push_back({&planes_[i], 0, vertices, place(i), true, padding});
            const bend::Bounds& box = runs && style_.bounds ? expected_boxes_[i] : untouched;
            if (std::memcmp(&box, &boxes_[i], sizeof box) != 0) return "bounds of " + std::to_string(i);
        }
        return out_.fault(parts,
                          style_.scratch_gaps ? OutputBuffer::Gaps::scratch : OutputBuffer::Gaps::kept);
    }

    [[nodiscard]] std::size_t count() const { return count_; }
    [[nodiscard]] const bend::Body& body() const { return body_; }

private:
    static constexpr bend::Bounds untouched{glm::vec3(7), glm::vec3(-7)};
    static constexpr std::size_t page_size = 4;

    [[nodiscard]] std::size_t element(std::size_t i) const { return indices_.empty() ? i : indices_[i]; }
    [[nodiscard]] std::size_t place(std::size_t i) const {
        return style_.places ? worms_[element(i)].place : i * step_;
    }

    /// Every sixth pose is beyond the body's limit.
    static bend::Pose random_pose(Random& random) {
        return {static_cast<float>(uniform(random, -4, random() % 6 == 0 ? 60 : 4)),
                static_cast<float>(uniform(random, -9, 9))};
    }

    /// A fourth of them of any bits, among them infinities and NaNs, where the test_batch is hostile.
    float hostile(Random& random, float value) const {
        if (!style_.hostile || random() % 4 != 0) return value;
        const auto bits = static_cast<std::uint32_t>(random());
        return std::bit_cast<float>(random() % 3 == 0 ? bits | 0x7f800000u : bits);
    }

    static void copy(const glm::mat4x3& from, glm::mat4& columns4, float (&rows)[12]) {
        columns4 = glm::mat4(std::numeric_limits<float>::quiet_NaN());  // the fourth row is not read
        for (int c = 0; c < 4; ++c) {
            for (int r = 0; r < 3; ++r) {
                columns4[c][r] = from[c][r];
                rows[4 * r + c] = from[c][r];
            }
            columns4[c][3] = std::numeric_limits<float>::quiet_NaN();
        }
    }

    void make(Random& random, Worm& worm) const {
        for (bend::Pose* poses : {worm.poses, worm.previous_poses}) {
            for (std::size_t r = 0; r < Worm::max_regions; ++r) {
                poses[r] = random_pose(random);
                poses[r].angle = hostile(random, poses[r].angle);
                poses[r].direction = hostile(random, poses[r].direction);
            }
        }
        const auto kind = random() % 3;
        worm.weight = hostile(random, kind == 0   ? 0
                                      : kind == 1 ? 1
                                                  : static_cast<float>(uniform(random, 0, 1)));
        worm.model = random_transform(random, 5);
        worm.previous_model = random_transform(random, 5);
        copy(worm.model, worm.model4, worm.rows);
        copy(worm.previous_model, worm.previous_model4, worm.previous_rows);
        worm.visible = random() % 4 == 0 ? 0 : static_cast<std::uint8_t>(1 + random() % 255);
        worm.changed = random() % 4 == 0 ? 0 : static_cast<std::uint8_t>(1 + random() % 255);
        worm.interval = static_cast<std::uint8_t>(random() % 4);
    }

    /// Returns how many vertices there must be room for: none to spare.
    std::size_t set_places(Random& random) {
        const std::size_t vertices = body_.vertex_count();
        step_ = vertices + (style_.dense ? 0 : random() % (random() % 2 == 0 ? 4 : 40));
        if (!style_.places || count_ == 0) return count_ == 0 ? 1 : (count_ - 1) * step_ + vertices;
        for (Worm& worm : worms_) worm.place = std::numeric_limits<std::uint32_t>::max();  // of nobody's
        std::vector<std::size_t> order(count_);
        std::iota(order.begin(), order.end(), std::size_t{0});
        std::ranges::shuffle(order, random);
        std::size_t end = random() % 5;
        for (const std::size_t i : order) {
            worms_[element(i)].place = static_cast<std::uint32_t>(end);
            end += vertices + random() % 3;
        }
        return worms_[element(order.back())].place + vertices;
    }

    template <class M3, class M4, class Rows>
    bend::TransformColumn transforms(M3 Worm::*columns3, M4 Worm::*columns4, Rows Worm::*rows) {
        using Kind = bend::TransformColumn::MatrixLayout;
        if (style_.transforms == Kind::columns3) return column<glm::mat4x3>(columns3);
        if (style_.transforms == Kind::columns4) return column<glm::mat4>(columns4);
        return {column<float>(rows, 12), Kind::rows4};
    }

    /// The column of `member`, which holds `size` values of T that are read.
    template <class T, class M>
    StridedView<T> column(M Worm::*member, std::size_t size = 1) {
        const std::size_t total = worms_.size();
        if (style_.storage == Storage::members) return strided(std::span(std::as_const(worms_)), member);
        if (style_.storage == Storage::paged_members) return paged(worm_pages(), page_size, total, member);
        if (total == 0) return {};
        const bool pages = style_.storage == Storage::paged_arrays;
        const std::size_t length = pages ? page_size : total;
        std::vector<const void*>& addresses = addresses_.emplace_back();
        for (std::size_t first = 0; first < total; first += length) {
            const std::size_t last = std::min(first + length, total);
            // No longer than it must be, so that a sanitizer sees one value too many.
            std::vector<std::byte>& page = pages_.emplace_back((last - first) * size * sizeof(T));
            for (std::size_t i = first; i < last; ++i)
                std::memcpy(&page[(i - first) * size * sizeof(T)], &(worms_[i].*member), size * sizeof(T));
            addresses.push_back(page.data());
        }
        const auto* const first_page = reinterpret_cast<const T* const*>(addresses.data());
        StridedView<T> view =
            pages ? paged(first_page, page_size, total) : strided(std::span(*first_page, total));
        view.stride = static_cast<std::uint32_t>(size * sizeof(T));
        return view;
    }

    const Worm* const* worm_pages() {
        if (!worm_pages_.empty()) return worm_page_addresses_.data();
        for (std::size_t first = 0; first < worms_.size(); first += page_size) {
            const std::size_t last = std::min(first + page_size, worms_.size());
            worm_pages_.emplace_back(worms_.data() + first, worms_.data() + last);
            worm_page_addresses_.push_back(worm_pages_.back().data());
        }
        return worm_page_addresses_.data();
    }

    const bend::Body& body_;
    BatchStyle style_;
    std::size_t count_;
    std::vector<Worm> worms_;
    std::vector<std::uint32_t> indices_;
    std::size_t step_ = 0;
    // Copies of the worms and of their members, in pages or in one stretch.
    std::deque<std::vector<Worm>> worm_pages_;
    std::vector<const Worm*> worm_page_addresses_;
    std::deque<std::vector<std::byte>> pages_;
    std::deque<std::vector<const void*>> addresses_;
    std::vector<bend::Bounds> boxes_, expected_boxes_;
    std::vector<OutputBuffer> planes_;  // what each instance leaves
    OutputBuffer out_;
};

/// What a crowd of several batches is deformed to.
struct TestBatches {
    std::deque<TestBatch> tests;
    std::vector<bend::Batch> batches;

    void add(Random& random, const bend::Body& body, std::size_t count, const BatchStyle& style) {
        batches.push_back(tests.emplace_back(random, body, count, style).batch());
    }

    [[nodiscard]] bend::CrowdResult expect(Isa isa, std::uint32_t frame = 0) {
        bend::CrowdResult result;
        for (TestBatch& test : tests) test.expect(isa, frame, result);
        return result;
    }

    void clear() {
        for (TestBatch& test : tests) test.clear();
    }

    [[nodiscard]] std::string fault(std::uint32_t frame = 0) const {
        for (std::size_t i = 0; i < tests.size(); ++i) {
            if (std::string text = tests[i].fault(frame); !text.empty())
                return "batch " + std::to_string(i) + ": " + text;
        }
        return {};
    }
};

}  // namespace goffer::test
