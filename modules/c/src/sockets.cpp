// SPDX-License-Identifier: MIT
#include "convert.hpp"

#include <goffer/fit/sockets.hpp>

#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>
#include <vector>

using namespace goffer;
using namespace goffer::c;

struct goffer_sockets {
    bend::Sockets sockets;
};

// Frames are written as C++ has them.
static_assert(sizeof(goffer_socket_frame) == sizeof(bend::SocketFrame) &&
              offsetof(goffer_socket_frame, position) == 3 * sizeof(bend::SocketFrame::col_type));

goffer_sockets* goffer::c::handle_of(std::optional<bend::Sockets> made) {
    if (!made) throw std::invalid_argument("sockets: there is none, or one is not of this body");
    return std::make_unique<goffer_sockets>(goffer_sockets{std::move(*made)}).release();
}

goffer_sockets* goffer_body_sockets(const goffer_body* body, const goffer_mesh* mesh, const float* points,
                                    size_t count, goffer_error* error) {
    return guarded(error, [&]() -> goffer_sockets* {
        if (body == nullptr || !body->binding)
            throw std::invalid_argument("body: not one that was bound here; a file has its own sockets");
        if (mesh == nullptr) throw std::invalid_argument("mesh: null");
        if (points == nullptr && count > 0) throw std::invalid_argument("points: null");
        const fit::Geometry geometry = geometry_of(*mesh);
        std::vector<bend::Socket> sockets;
        for (std::size_t i = 0; i < count; ++i) {
            const float* p = points + 3 * i;
            if (!std::all_of(p, p + 3, [](float x) { return std::isfinite(x); }))
                throw std::invalid_argument("points: one is not finite");
            sockets.push_back(fit::socket_near(*body->binding, geometry, glm::dvec3(p[0], p[1], p[2])));
        }
        return handle_of(bend::Sockets::make(*body->body, sockets));
    });
}

void goffer_sockets_free(goffer_sockets* sockets) {
    delete sockets;
}

size_t goffer_sockets_count(const goffer_sockets* sockets) {
    return sockets != nullptr ? sockets->sockets.count() : 0;
}

void goffer_sockets_frames(const goffer_sockets* sockets, const goffer_job* job,
                           goffer_socket_frame* result) {
    if (sockets == nullptr || job == nullptr) return;
    sockets->sockets.frames(job_of(*job),
                            {reinterpret_cast<bend::SocketFrame*>(result), sockets->sockets.count()});
}
