// SPDX-License-Identifier: MIT
#include "job/batch_runner.hpp"

#include "pose/bounds_of.hpp"

#include <algorithm>
#include <cassert>
#include <utility>

namespace goffer::bend {
namespace {

/// Few enough for the rest columns of a block, about a dozen, to stay in the first-level cache.
constexpr std::size_t block_vertices = 512;

/// Kernels write whole lines of a region directly if they hold at least this many vertices. Shorter stretches
/// go through the stage, together with the joints beside them.
constexpr std::size_t min_direct = 48;

/// A joint goes through the stage whole if at most this many vertices are near it.
constexpr std::size_t max_staged_joint = 224;

/// Makes positions come out in steps of the box, 0..65535, which the packed kernel rounds. On an axis where
/// the box is too thin or too long for float to count its steps, all are at its low side.
void quantize(Coefficients& k, const Bounds& bounds) noexcept {
    constexpr float thinnest = 1e-33f, longest = 1e38f;
    for (int row = 0; row < 3; ++row) {
        const float extent = bounds.high[row] - bounds.low[row];
        if (!(extent > thinnest && extent < longest)) {
            for (int c = 0; c < 3; ++c) k.matrix[4 * c + row] = 0.0f;
            k.offset[row] = 0.0f;
            continue;
        }
        const float scale = 65535.0f / extent;
        for (int c = 0; c < 3; ++c) k.matrix[4 * c + row] *= scale;
        k.offset[row] = (k.offset[row] - bounds.low[row]) * scale;
    }
}

}  // namespace

static_assert(sizeof(BatchRunner) <= std::size_t{52} << 10, "crowd.hpp states how much stack a run takes");

BatchRunner::BatchRunner(const Batch& batch, const KernelSet& kernels, bool non_temporal) noexcept
    : batch_(batch),
      body_(*batch.body->data()),
      kernels_(kernels),
      plan_(batch, kernels, non_temporal),
      regions_(body_.regions.size()),
      pads_(non_temporal && batch.scratch_gaps && batch.vertex_offsets.empty() &&
            batch.vertex_step != body_.vertex_count),
      shares_lines_(non_temporal && may_share_lines()),
      part_{0, body_.vertex_count},
      posed_(body_, PosedGroup::capacity(regions_)),
      staging_(plan_) {
    bool streams = false;
    for (const PassPlan& pass : plan_.passes()) {
        streams |= pass.pass == Pass::current;
        normals_ |= pass.streams != StreamSet::positions;
        if (pass.pass == Pass::previous) set_of(Pass::previous) = set_count_++;
    }
    posed_now_ = streams || !batch.packed.empty() || !batch.bounds.empty();
    if (posed_now_) set_of(Pass::current) = set_count_++;
    // If nothing else needs the current coefficients, they are quantized in place.
    set_of(Pass::packed) = !batch.packed.empty() && streams ? set_count_++ : set_of(Pass::current);
    assert(set_count_ != 0 && "a batch that asks for nothing: see validate()");
    group_size_ =
        std::clamp<std::size_t>(max_coefficients / (std::max<std::size_t>(set_count_, 1) * regions_), 1,
                                PosedGroup::capacity(regions_));
}

void BatchRunner::finish() noexcept {
    if (gathered_->count != 0) next_group();
    deform_group();
}

/// Deforms the group that is set up, and sets up the one that was gathered.
void BatchRunner::next_group() noexcept {
    take_poses();
    deform_group();
    set_up();
}

/// Takes the current poses of the group that was gathered.
void BatchRunner::take_poses() noexcept {
    CrowdResult ignored;
    posed_.add(batch_, gathered_->used(), Time::now, begins() ? result_ : ignored);
    if (!posed_now_) posed_.clear();
}

/// Deforms the group that is set up, if there is one.
void BatchRunner::deform_group() noexcept {
    if (group_->count == 0) return;
    const auto [first, last] = part_;
    if (shares_lines_ && last - first == body_.vertex_count) {
        deform_row();
        group_->count = 0;
        return;
    }
    for (std::size_t begin = first; begin < last;) {
        const std::size_t end = (begin / block_vertices + 1) * block_vertices;
        for (std::size_t i = 0; i < group_->count; ++i) {
            // Blocks end where cache lines end: for each instance at another vertex.
            const std::size_t peeled = group_->members[i].peeled;
            const std::size_t from = begin == first ? first : std::min(begin + peeled, last);
            deform(i, from, end >= last ? last : std::min(end + peeled, last));
        }
        begin = end;
    }
    write_staged();
    group_->count = 0;
}

/// Whether whole instances are deformed by deform_row(): those of a body of one block and one region, to
/// planes past the cache, if there are kernels for shared lines.
bool BatchRunner::may_share_lines() const noexcept {
    const std::size_t vertices = body_.vertex_count;
    if (pads_ || regions_ != 1) return false;
    if (vertices < line_floats || vertices > block_vertices) return false;
    return std::ranges::all_of(plan_.passes(), [&](const PassPlan& pass) {
        return pass.mode == WriteMode::planes &&
               kernels_.shared_line_kernel(Squeeze::none, pass.streams) != nullptr &&
               floats_to_line<Record>(pass.planes.position[0]) == plan_.peeled(0);
    });
}

/// Deforms the group that is set up, instance after instance. The line that an instance shares with the next
/// one is written whole: in parts, it would have to be read.
void BatchRunner::deform_row() noexcept {
    std::size_t first = 0;
    for (std::size_t i = 0; i < group_->count; ++i) {
        const bool shares = shares_line(i);
        const std::size_t last = shares ? line_before(i, body_.vertex_count) : body_.vertex_count;
        for (const PassPlan& pass : plan_.passes()) {
            const std::size_t set = set_of(pass.pass);
            const std::size_t vertex = group_->members[i].vertex;
            const Coefficients& k = *coefficients(i, set);
            const Squeeze squeeze = *squeezes(i, set);
            kernels_.plane_kernel(squeeze, pass.streams)(body_.columns, k, pass.planes, vertex + first, first,
                                                         last - first, Write::non_temporal);
            if (shares)
                kernels_.shared_line_kernel(squeeze, pass.streams)(
                    body_.columns, k, *coefficients(i + 1, set), pass.planes, vertex + last, last,
                    body_.vertex_count - last);
        }
        first = shares ? group_->members[i + 1].peeled : 0;
    }
}

/// Whether an instance's last line is the first one of the next in the group, and a kernel can write it.
bool BatchRunner::shares_line(std::size_t member) const noexcept {
    if (member + 1 == group_->count) return false;
    const Member &ending = group_->members[member], &beginning = group_->members[member + 1];
    const Squeeze* const squeeze = squeezes_ + member * set_count_;  // it depends on no pose
    return beginning.peeled != 0 && beginning.vertex == ending.vertex + body_.vertex_count &&
           squeeze[0] == squeeze[set_count_];
}

/// Sets up the group that was gathered, in place of the one that was deformed.
void BatchRunner::set_up() noexcept {
    std::swap(group_, gathered_);
    gathered_->count = 0;
    const std::size_t current = set_of(Pass::current);
    if (posed_now_) set_up_poses(current, normals_);
    for (const PassPlan& pass : plan_.passes()) {
        if (pass.pass != Pass::previous) continue;
        CrowdResult ignored;  // its current pose was counted
        posed_.add(batch_, group_->used(), Time::before, ignored);
        set_up_poses(set_of(Pass::previous), false);
    }
    const bool packed = !batch_.packed.empty(), sets_bounds = !batch_.bounds.empty() && begins();
    if (!packed && !sets_bounds) return;
    for (std::size_t i = 0; i < group_->count; ++i) {
        const Bounds bounds = bounds_of(body_, coefficients(i, current), squeezes(i, current));
        if (sets_bounds) batch_.bounds[group_->members[i].instance] = bounds;
        if (packed) set_up_packed(i, bounds);
    }
}

/// Sets up the poses that were added, and makes room for others.
void BatchRunner::set_up_poses(std::size_t set, bool normals) noexcept {
    for (std::size_t r = 0; r < regions_; ++r) {
        posed_.set_up(r, kernels_.setup, normals, coefficients(0, set) + r, set_count_ * regions_);
        for (std::size_t i = 0; i < group_->count; ++i) squeezes(i, set)[r] = posed_.squeeze(i);
    }
    posed_.clear();
}

void BatchRunner::set_up_packed(std::size_t member, const Bounds& bounds) noexcept {
    const std::size_t current = set_of(Pass::current);
    const std::size_t packed = set_of(Pass::packed);
    Coefficients* const k = coefficients(member, packed);
    if (packed != current) {
        std::copy_n(coefficients(member, current), regions_, k);
        std::copy_n(squeezes(member, current), regions_, squeezes(member, packed));
    }
    for (std::size_t r = 0; r < regions_; ++r) quantize(k[r], bounds);
}

/// Where a kernel of `columns` ends that is to deform an instance's vertices up to `end`. The last line of an
/// instance is filled up if what follows it is scratch: a line that is written in part must be read before.
/// `to_line`: the vertices from there to the next one that begins a line.
std::size_t BatchRunner::padded_end(std::size_t member, const RestColumns& columns, std::size_t end,
                                    std::size_t to_line) const noexcept {
    const bool blended = &columns != &body_.columns;
    const bool last = group_->members[member].instance + 1 == batch_.count;
    if (end != body_.vertex_count || blended || last) return end;
    return end + to_line <= batch_.vertex_step ? end + to_line : end;
}

/// How many vertices of `record` lie between an instance's vertex and the next one that begins a line; 0 if
/// it is not written in lines.
std::size_t BatchRunner::to_line(const Record& record, std::size_t member,
                                 std::size_t vertex) const noexcept {
    return record.in_lines ? record.to_line(group_->members[member].vertex + vertex) : 0;
}

std::size_t BatchRunner::line_before(std::size_t member, std::size_t vertex) const noexcept {
    const std::size_t peeled = group_->members[member].peeled;
    return vertex < peeled ? 0 : vertex - (vertex - peeled) % line_floats;
}

std::size_t BatchRunner::line_behind(std::size_t member, std::size_t vertex) const noexcept {
    const std::size_t before = line_before(member, vertex);
    return before == vertex                          ? vertex
           : vertex < group_->members[member].peeled ? group_->members[member].peeled
                                                     : before + line_floats;
}

/// The vertices near the joint behind a region if they are few, so that each side is blended in one call;
/// else an empty span.
BatchRunner::Span BatchRunner::joint_behind(std::size_t region) const noexcept {
    const std::size_t at = body_.regions[region].last;
    if (region + 1 == regions_) return {at, at};
    const Span near = {body_.details[region].joints.above.first, body_.details[region + 1].joints.below.last};
    return near.last - near.first <= max_staged_joint ? near : Span{at, at};
}

/// The end of a stretch that goes through the stage: it begins at `first` in `region`, holds the joint behind
/// that region, and ends where a line does. Joints that follow are part of it too, unless enough whole lines
/// of one region lie before them for a kernel call of their own.
std::size_t BatchRunner::joints_end(std::size_t member, std::size_t region, std::size_t first,
                                    std::size_t last) const noexcept {
    std::size_t end = first;
    for (;; ++region) {
        end = std::max(end, std::min(line_behind(member, joint_behind(region).last), last));
        if (end == last) return end;
        while (body_.regions[region + 1].last <= end) ++region;
        const std::size_t next = std::min(joint_behind(region + 1).first, last);
        if (line_before(member, next) >= end + min_direct) return end;
    }
}

/// Calls deform(input, begin, end) with what kernels are called with for the vertices [begin, end), one after
/// the other, until all of [first, last) are deformed, which are of region `region`.
template <class Deform>
void BatchRunner::each_input(std::size_t member, const PassPlan& pass, std::size_t region, std::size_t first,
                             std::size_t last, const Deform& deform) noexcept {
    const std::size_t set = set_of(pass.pass);
    const Squeeze squeeze = squeezes(member, set)[region];
    if (regions_ > 1 && squeeze != Squeeze::none) {
        const Joint &below = body_.details[region].joints.below, &above = body_.details[region].joints.above;
        if (below.last > first || above.first < last) [[unlikely]]
            return each_blended(member, pass, region, first, last, deform);
    }
    deform(KernelInput{&body_.columns, &coefficients(member, set)[region], squeeze, first}, first, last);
}

/// Those of the vertices [first, last) that are not near joints. They begin and end where lines do, if there
/// is room between two joints, since vertices that are not near have the same bits either way.
BatchRunner::Span BatchRunner::between_joints(std::size_t member, std::size_t region, std::size_t first,
                                              std::size_t last) const noexcept {
    const Joint &below = body_.details[region].joints.below, &above = body_.details[region].joints.above;
    const std::size_t begin =
        below.last > first ? std::min({line_behind(member, below.last), above.first, last}) : first;
    return {begin, above.first < last ? std::max(line_before(member, above.first), begin) : last};
}

/// The same where some of the vertices are near joints: a few at a time.
template <class Deform>
void BatchRunner::each_blended(std::size_t member, const PassPlan& pass, std::size_t region,
                               std::size_t first, std::size_t last, const Deform& deform) noexcept {
    const Joint &below = body_.details[region].joints.below, &above = body_.details[region].joints.above;
    const Coefficients* const k = coefficients(member, set_of(pass.pass));
    const Squeeze* const squeeze = squeezes(member, set_of(pass.pass));
    const auto [below_end, above_begin] = between_joints(member, region, first, last);
    const auto blend = [&](const Joint& joint, std::size_t begin, std::size_t end) {
        while (begin < end) {
            const std::size_t next = block_end(member, begin, end, BlendColumns::vertices);
            const bool in_lines =
                begin >= group_->members[member].peeled && line_before(member, begin) == begin;
            deform(blending_.blend(body_, kernels_, region, joint, {k, squeeze}, pass.streams, begin,
                                   next - begin, in_lines),
                   begin, next);
            begin = next;
        }
    };
    blend(below, first, below_end);
    if (below_end < above_begin)
        deform(KernelInput{&body_.columns, &k[region], squeeze[region], below_end}, below_end, above_begin);
    blend(above, above_begin, last);
}

/// Calls deform(region, begin, end) for each region that vertices in [first, last) belong to.
template <class Deform>
void BatchRunner::each_piece(std::size_t first, std::size_t last, const Deform& deform) noexcept {
    for (std::size_t region = 0; first < last; ++region) {
        const std::size_t end = std::min(body_.regions[region].last, last);
        if (end <= first) continue;
        deform(region, first, end);
        first = end;
    }
}

/// The end of a block that begins at `first`: where a line ends, after at most `most` vertices.
std::size_t BatchRunner::block_end(std::size_t member, std::size_t first, std::size_t last,
                                   std::size_t most) const noexcept {
    return last - first <= most ? last : line_before(member, first + most);
}

void BatchRunner::deform(std::size_t member, std::size_t first, std::size_t last) noexcept {
    if (first >= last) return;
    if (plan_.has(WriteMode::staged)) return deform_staged(member, WriteMode::staged, first, last);
    if (plan_.has(WriteMode::pairs)) return deform_pairs(member, first, last);
    if (plan_.has(WriteMode::records)) deform_records(member, first, last);
    if (plan_.has(WriteMode::planes)) deform_planes(member, first, last);
}

/// Kernels write the caller's planes. Past the cache, what each_stretch leaves out goes through the stage.
void BatchRunner::deform_planes(std::size_t member, std::size_t first, std::size_t last) noexcept {
    each_call(member, WriteMode::planes, first, last,
              [&](const PassPlan& pass, const KernelInput& input, std::size_t begin, std::size_t end) {
                  const std::size_t vertex = group_->members[member].vertex;
                  const bool in_lines = plan_.non_temporal();
                  std::size_t padded = end;
                  if (pads_) [[unlikely]]
                      padded = padded_end(member, *input.columns, end,
                                          floats_to_line<Record>(pass.planes.position[0] + vertex + end));
                  kernels_.plane_kernel(input.squeeze, pass.streams)(
                      *input.columns, *input.k, pass.planes, vertex + begin, input.first, padded - begin,
                      in_lines ? Write::non_temporal : Write::cached);
              });
}

/// Kernels write the caller's records, likewise.
void BatchRunner::deform_records(std::size_t member, std::size_t first, std::size_t last) noexcept {
    each_call(member, WriteMode::records, first, last,
              [&](const PassPlan& pass, const KernelInput& input, std::size_t begin, std::size_t end) {
                  const Record& record = *pass.record;
                  const std::size_t vertex = group_->members[member].vertex + begin,
                                    stride = record.stride_floats();
                  std::size_t padded = end;
                  if (pads_) [[unlikely]]
                      padded = padded_end(member, *input.columns, end, to_line(record, member, end));
                  const RecordOutput out = {record.first + vertex * stride, stride, pass.gaps,
                                            pass.gaps != RecordGaps::none && padded == body_.vertex_count,
                                            to_line(record, member, begin)};
                  kernels_.weaving_kernel(input.squeeze, pass.streams)(
                      *input.columns, *input.k, out, input.first, padded - begin,
                      record.in_lines ? Write::non_temporal : Write::cached);
              });
}

/// Kernels of both poses write the caller's records, likewise. Vertices near joints go through the stage,
/// since blended columns are those of one pose.
void BatchRunner::deform_pairs(std::size_t member, std::size_t first, std::size_t last) noexcept {
    each_stretch(
        member, WriteMode::pairs, first, last, [&](std::size_t region, std::size_t begin, std::size_t end) {
            const Squeeze squeeze = squeezes(member, set_of(Pass::current))[region];
            assert(squeeze == squeezes(member, set_of(Pass::previous))[region]);  // it depends on no pose
            const Span plain =
                squeeze == Squeeze::none ? Span{begin, end} : between_joints(member, region, begin, end);
            deform_staged(member, WriteMode::pairs, begin, plain.first);
            if (plain.first < plain.last) deform_pair(member, region, plain);
            deform_staged(member, WriteMode::pairs, plain.last, end);
        });
}

void BatchRunner::deform_pair(std::size_t member, std::size_t region, Span vertices) noexcept {
    const std::size_t current = set_of(Pass::current), previous = set_of(Pass::previous);
    const PassPlan& pass = plan_.passes().back();
    const Record& record = *pass.record;
    const std::size_t vertex = group_->members[member].vertex + vertices.first;
    const PairOutput out = {record.first + vertex * record.stride_floats(), plan_.pair_order(),
                            to_line(record, member, vertices.first)};
    std::size_t last = vertices.last;
    if (pads_) [[unlikely]]
        last = padded_end(member, body_.columns, last, to_line(record, member, last));
    kernels_.pair_kernel(squeezes(member, current)[region], pass.streams)(
        body_.columns, coefficients(member, current)[region], coefficients(member, previous)[region], out,
        vertices.first, last - vertices.first, record.in_lines ? Write::non_temporal : Write::cached);
}

/// Calls deform(region, begin, end) for each stretch of vertices of one region. Into the cache, a stretch is
/// all of the region. Past the cache it is whole lines, except at `first` and `last`; lines that regions
/// share go through the stage, and joints that few vertices are near.
template <class Deform>
void BatchRunner::each_stretch(std::size_t member, WriteMode mode, std::size_t first, std::size_t last,
                               const Deform& deform) noexcept {
    if (regions_ == 1) return deform(0, first, last);
    const bool in_lines = plan_.in_lines(mode);
    std::size_t region = 0;
    while (first < last) {
        while (body_.regions[region].last <= first) ++region;
        const std::size_t region_end = std::min(body_.regions[region].last, last);
        const bool whole = region_end == last || !in_lines;
        const std::size_t end = whole ? region_end : line_before(member, joint_behind(region).first);
        if (!whole && end < first + min_direct) {
            const std::size_t joints = joints_end(member, region, first, last);
            deform_staged(member, mode, first, joints);
            first = joints;
            continue;
        }
        deform(region, first, end);
        first = end;
    }
}

/// Calls deform(pass, input, begin, end) for each pass in the mode `mode`, and for what each_input makes of
/// [first, last).
template <class Deform>
void BatchRunner::each_pass(std::size_t member, WriteMode mode, std::size_t region, std::size_t first,
                            std::size_t last, const Deform& deform) noexcept {
    for (const PassPlan& pass : plan_.passes()) {
        if (pass.mode != mode) continue;
        each_input(member, pass, region, first, last,
                   [&](const KernelInput& input, std::size_t begin, std::size_t end) {
                       deform(pass, input, begin, end);
                   });
    }
}

/// The same for each stretch.
template <class Deform>
void BatchRunner::each_call(std::size_t member, WriteMode mode, std::size_t first, std::size_t last,
                            const Deform& deform) noexcept {
    each_stretch(member, mode, first, last, [&](std::size_t region, std::size_t begin, std::size_t end) {
        each_pass(member, mode, region, begin, end, deform);
    });
}

/// Kernels of all passes in the mode `mode` write planes of the stage. The last block of it stays there until
/// write_staged(): to read a line that two kernels have just written waits until all before it is in memory,
/// past the cache too, which goes on beside the next stretch.
void BatchRunner::deform_staged(std::size_t member, WriteMode mode, std::size_t first,
                                std::size_t last) noexcept {
    while (first < last) {
        write_staged();
        const std::size_t end = block_end(member, first, last, staging_.capacity());
        each_piece(first, end, [&](std::size_t region, std::size_t begin, std::size_t piece_end) {
            each_pass(member, mode, region, begin, piece_end,
                      [&](const PassPlan& pass, const KernelInput& input, std::size_t from, std::size_t to) {
                          kernels_.plane_kernel(input.squeeze, pass.streams)(
                              *input.columns, *input.k, staging_.output(pass.pass), from - first, input.first,
                              to - from, Write::staged);
                      });
        });
        staged_ = {mode, group_->members[member].vertex + first, end - first, end == body_.vertex_count};
        first = end;
    }
}

void BatchRunner::write_staged() noexcept {
    const auto [mode, vertex, count, ends] = std::exchange(staged_, {});
    if (count != 0) staging_.planes().write(plan_, kernels_, mode, vertex, count, ends);
}

}  // namespace goffer::bend
