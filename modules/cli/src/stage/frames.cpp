// SPDX-License-Identifier: MIT
#include "stage/frames.hpp"

namespace goffer::cli {

Frames::Frames(const BoundModel& model) {
    const bend::Body& body = model.binding.body;
    std::vector<bend::Socket> places;
    for (std::size_t r = 0; r < body.region_count(); ++r) places.push_back({.region = r, .vertex = {}});
    bend::Socket& end = places.emplace_back(places.back());
    end.vertex.z = body.region_inputs()[end.region].length;
    regions_.resize(places.size());
    for (const FileSocket& socket : model.sockets) places.push_back(socket.socket);
    places_ = bend::Sockets::make(body, places);
    frames_.resize(places.size());
}

void Frames::set(std::span<const bend::Pose> poses) {
    if (!places_) return;
    places_->frames(poses, frames_);
    for (std::size_t i = 0; i < regions_.size(); ++i) {
        const bend::SocketFrame& frame = frames_[i];  // e3, -e2, e1 and the place
        regions_[i] = glm::mat4x3(frame[2], -frame[1], frame[0], frame[3]);
    }
}

std::span<const bend::SocketFrame> Frames::sockets() const {
    return std::span(frames_).subspan(regions_.size());
}

}  // namespace goffer::cli
