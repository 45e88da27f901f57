// SPDX-License-Identifier: MIT
#pragma once

namespace goffer::bend {

/// Whether planes that lie near a multiple of a kilobyte apart compete for the processor's buffers when they
/// are written past the cache side by side. Processors of Intel do not mind; on others that took two to four
/// times as long. Thread-safe.
[[nodiscard]] bool planes_compete() noexcept;

}  // namespace goffer::bend
