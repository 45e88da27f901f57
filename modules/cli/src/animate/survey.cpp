// SPDX-License-Identifier: MIT
#include "animate/survey.hpp"

#include "poses.hpp"
#include "progress.hpp"

#include <goffer/fit/geometry.hpp>
#include <goffer/measure/timer.hpp>

#include <glm/mat3x3.hpp>

#include <algorithm>
#include <cmath>

namespace goffer::cli {
namespace {

/// How far all regions bend together, radians.
double bend_of(const Moment& moment) {
    double sum = 0;
    for (const bend::Pose& pose : moment.poses) sum += static_cast<double>(std::fabs(pose.angle));
    return sum;
}

void look_at_poses(Survey& survey, const Moment& moment, const bend::Body& body) {
    bool clamped = moment.clamped;
    for (std::size_t r = 0; r < body.region_count(); ++r) {
        survey.largest[r] = std::max(survey.largest[r], used_angle(body, r, moment.poses[r]));
        clamped = clamped || std::fabs(moment.poses[r].angle) > body.max_angle(r);
    }
    survey.clamped += clamped ? 1 : 0;
    survey.beyond_full_turn += beyond_full_turn(body, moment.poses) ? 1 : 0;
    survey.path_error = std::max(survey.path_error, moment.path_error);
}

view::Camera camera_of(const MovingModel& frames, const Viewpoint& viewpoint) {
    Moment most = frames.moment(0);
    for (std::size_t frame = 1; frame < frames.count(); ++frame) {
        Moment other = frames.moment(frame);
        if (bend_of(other) > bend_of(most)) most = std::move(other);
    }
    const Sight sight = sight_of(frames.model().binding.body, most.poses, viewpoint);
    const glm::mat3 turn(most.transform);
    view::Camera camera;
    camera.toward = turn * sight.toward;
    camera.up = turn * sight.up;
    return camera;
}

}  // namespace

Survey survey(const MovingModel& frames, const SurveyView* pictures) {
    Survey found;
    const BoundModel& model = frames.model();
    found.area_before = fit::surface_area(model.rest.positions, model.rest.triangles);
    found.largest.assign(model.binding.body.region_count(), 0);
    if (pictures) found.camera = camera_of(frames, pictures->viewpoint);
    Progress progress("measuring frames", frames.count());
    std::vector<double> times;
    times.reserve(frames.count());
    for (std::size_t frame = 0; frame < frames.count(); ++frame) {
        const Moment moment = frames.moment(frame);
        look_at_poses(found, moment, model.binding.body);
        mesh::VertexArrays bent;
        times.push_back(1e-6 *
                        measure::nanoseconds_of(measure::wall_clock, [&] { bent = frames.records(moment); }));
        const double change = fit::surface_area(bent.positions, bent.triangles) / found.area_before - 1;
        if (std::fabs(change) > std::fabs(found.worst_area_change)) {
            found.worst_area_change = change;
            found.worst_frame = frame;
        }
        if (pictures) {
            const std::vector<glm::vec3> now =
                view::deciding_points(found.camera, bent.positions, pictures->settings);
            found.seen.insert(found.seen.end(), now.begin(), now.end());
            found.seen = view::deciding_points(found.camera, found.seen, pictures->settings);
        }
        progress.advance();
    }
    found.milliseconds = measure::median(times);
    return found;
}

}  // namespace goffer::cli
