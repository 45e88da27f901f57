// SPDX-License-Identifier: MIT
#pragma once

#include <goffer/bend/sockets.hpp>

#include <goffer.h>

#include <span>

namespace goffer::c {

/// Throws where `body` cannot have them.
[[nodiscard]] goffer_sockets* make_sockets(const bend::Body& body, std::span<const bend::Socket> sockets);

}  // namespace goffer::c
