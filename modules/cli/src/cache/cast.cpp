// SPDX-License-Identifier: MIT
#include "cache/cast.hpp"

#include "arguments.hpp"
#include "cache/members.hpp"

#include <goffer/io/error.hpp>

#include <glm/mat3x3.hpp>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace goffer::cli {
namespace {

constexpr std::uint64_t floats_per_transform = 12, floats_per_pose = 2;

/// First `inner`, then `outer`.
glm::dmat4x3 composed(const glm::dmat4x3& outer, const glm::dmat4x3& inner) {
    const glm::dmat3 linear(outer[0], outer[1], outer[2]);
    return {linear * inner[0], linear * inner[1], linear * inner[2], linear * inner[3] + outer[3]};
}

/// A job takes no transform with larger numbers.
void refuse_far(const glm::dmat4x3& place, const SceneGroup& group, std::uint64_t instance,
                std::uint64_t frame) {
    for (int column = 0; column < 4; ++column) {
        const glm::dvec3& own = place[column];
        if (std::fabs(own.x) <= most_far && std::fabs(own.y) <= most_far && std::fabs(own.z) <= most_far)
            continue;
        throw InputError(group.where + ": number " + std::to_string(instance) + " of it is carried, or " +
                         "scaled, beyond 1e18 in frame " + std::to_string(frame) + "; keep it nearer");
    }
}

[[noreturn]] void refuse_count(const NumberFile& file, const std::string& wanted) {
    throw InputError(
        io::about(file.path(), "has " + std::to_string(file.count()) + " numbers, not " + wanted));
}

std::string times(std::initializer_list<std::pair<std::uint64_t, const char*>> factors) {
    std::string text;
    for (const auto& [number, what] : factors)
        text.append(text.empty() ? "" : " x ").append(std::to_string(number)).append(" ").append(what);
    return text;
}

}  // namespace

/// Instances [first, first + count) of one group, in a frame.
struct Cast::Stretch {
    const Member& member;
    std::uint64_t frame, first, count;
    std::size_t at;  // of the first in the moments
    std::vector<float> poses, transforms;
};

Cast::Cast(const Scene& scene, std::span<const bend::Body> bodies, std::uint64_t memory)
    : scene_(scene), bodies_(bodies) {
    for (const bend::Body& body : bodies) {
        stride_ = std::max(stride_, body.region_count());
        rest_.push_back(body.rest_poses());
    }
    members_.reserve(scene.groups.size());
    for (const SceneGroup& group : scene.groups) add(group, memory);
}

void Cast::add(const SceneGroup& group, std::uint64_t& memory) {
    Member member{&group};
    member.regions = bodies_[group.bodies[0]].region_count();
    const std::uint64_t frames = scene_.frames, count = group.count;
    if (!group.motions.empty()) {
        const auto turns = static_cast<std::size_t>(std::min<std::uint64_t>(
            std::lcm<std::uint64_t>(group.motions.size(), group.bodies.size()), group.count));
        for (std::size_t i = 0; i < turns; ++i) {
            const SceneMotion& motion = scene_.motions[group.motions[i % group.motions.size()]];
            const bend::Body& body = bodies_[group.bodies[i % group.bodies.size()]];
            member.motions.push_back(motion_for(motion, body.region_count()));
        }
    }
    if (!group.poses.empty()) {
        for (const std::size_t body : group.bodies) {
            if (bodies_[body].region_count() != member.regions)
                throw InputError(group.where +
                                 ".poses: its bodies do not all have the same number of regions; give each "
                                 "an entry of its own");
        }
        member.poses = file_of(group.poses, memory);
        if (member.poses->count() != frames * count * member.regions * floats_per_pose)
            refuse_count(*member.poses, times({{frames, "frames"},
                                               {count, "instances"},
                                               {member.regions, "regions"},
                                               {floats_per_pose, "angles"}}));
    }
    if (!group.transforms.empty()) {
        member.transforms = file_of(group.transforms, memory);
        const std::uint64_t still = count * floats_per_transform, has = member.transforms->count();
        member.carried = has == still * frames && frames > 1;
        if (has != still && !member.carried)
            refuse_count(*member.transforms,
                         times({{count, "instances"}, {floats_per_transform, "numbers"}}) +
                             ", nor as many for each of " + std::to_string(frames) + " frames");
    }
    members_.push_back(std::move(member));
}

const NumberFile* Cast::file_of(const std::filesystem::path& path, std::uint64_t& memory) {
    std::unique_ptr<NumberFile>& file = files_[path];
    if (!file) {
        file = std::make_unique<NumberFile>(path, memory);
        memory -= std::min(file->memory(), memory);
    }
    return file.get();
}

const Motion* Cast::motion_for(const SceneMotion& motion, std::size_t regions) {
    std::unique_ptr<const Motion>& made = motions_[{&motion, regions}];
    if (!made) made = read_motion(motion.document, regions, motion.where);
    return made.get();
}

std::size_t Cast::body_of(std::uint64_t instance) const {
    const SceneGroup& group = group_of(scene_, instance);
    return group.bodies[static_cast<std::size_t>((instance - group.first) % group.bodies.size())];
}

void Cast::read(std::uint64_t frame, std::uint64_t first, std::uint64_t count, Moments& moments) const {
    moments.stride = stride_;
    moments.poses.resize(count * stride_);
    moments.transforms.resize(count);
    moments.weights.resize(count);
    moments.clamped.assign(count, 0);
    for (std::uint64_t done = 0; done < count;) {
        const SceneGroup& group = group_of(scene_, first + done);
        const Member& member = members_[static_cast<std::size_t>(&group - scene_.groups.data())];
        const std::uint64_t from = first + done - group.first,
                            some = std::min(count - done, group.count - from);
        read({member, frame, from, some, static_cast<std::size_t>(done), {}, {}}, moments);
        done += some;
    }
}

void Cast::read(const Stretch& given, Moments& moments) const {
    Stretch stretch = given;
    const Member& member = stretch.member;
    const std::uint64_t row = stretch.frame * member.group->count + stretch.first;
    if (member.poses) {
        const std::uint64_t width = member.regions * floats_per_pose;
        stretch.poses.resize(stretch.count * width);
        member.poses->read(row * width, stretch.poses);
    }
    if (member.transforms) {
        stretch.transforms.resize(stretch.count * floats_per_transform);
        member.transforms->read((member.carried ? row : stretch.first) * floats_per_transform,
                                stretch.transforms);
    }
    constexpr std::uint64_t grain = 256;  // instances
    tbb::parallel_for(tbb::blocked_range<std::uint64_t>(0, stretch.count, grain), [&](const auto& range) {
        for (std::uint64_t i = range.begin(); i != range.end(); ++i) read_one(stretch, i, moments);
    });
}

void Cast::read_one(const Stretch& stretch, std::uint64_t index, Moments& moments) const {
    const Member& member = stretch.member;
    const SceneGroup& group = *member.group;
    const std::uint64_t instance = stretch.first + index;
    const std::size_t at = stretch.at + static_cast<std::size_t>(index);
    const std::size_t which = group.bodies[static_cast<std::size_t>(instance % group.bodies.size())];
    const auto poses = std::span(moments.poses).subspan(at * stride_, stride_);
    glm::dmat4x3 place = place_in(group, instance);
    if (member.transforms) {
        const float* m = &stretch.transforms[index * floats_per_transform];
        place = composed(place, {m[0], m[1], m[2], m[3], m[4], m[5], m[6], m[7], m[8], m[9], m[10], m[11]});
    }
    if (!member.motions.empty()) {
        const double seconds = static_cast<double>(stretch.frame) / scene_.fps * group.speed;
        const Motion& motion = *member.motions[static_cast<std::size_t>(instance % member.motions.size())];
        const Moment moment = motion.at(seconds + offset_in(group, instance), bodies_[which]);
        std::ranges::copy(moment.poses, poses.begin());
        place = composed(place, glm::dmat4x3(moment.transform));
        moments.clamped[at] = moment.clamped ? 1 : 0;
    } else if (member.poses) {
        const float* angles = &stretch.poses[index * member.regions * floats_per_pose];
        for (std::size_t r = 0; r < member.regions; ++r) poses[r] = {angles[2 * r], angles[2 * r + 1]};
    } else {
        std::ranges::copy(rest_[which], poses.begin());
    }
    refuse_far(place, group, instance, stretch.frame);
    moments.transforms[at] = glm::mat4x3(place);
    moments.weights[at] = group.weight;
}

}  // namespace goffer::cli
