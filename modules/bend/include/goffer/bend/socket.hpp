// SPDX-License-Identifier: MIT
#pragma once

#include <goffer/bend/rest_vertex.hpp>

#include <cstddef>
#include <string_view>

/// A socket: see goffer/bend/sockets.hpp.

namespace goffer::bend {

/// A place on or in the rest body, with a frame. fit::socket_at and fit::socket_near make one.
struct Socket {
    std::size_t region = 0;          ///< index of the region that it lies in
    RestVertex vertex;               ///< z is counted from where the region begins
    RestVector normal = {1, 0, 0};   ///< third axis of the frame, unit length. Default: outward
    RestVector tangent = {0, 0, 1};  ///< first axis, unit length, orthogonal to `normal`. Default: to the tip
};

/// A socket with a name, as body files hold them. Does not own the name.
struct NamedSocket {
    std::string_view name;  ///< may be empty
    Socket socket;
};

}  // namespace goffer::bend
