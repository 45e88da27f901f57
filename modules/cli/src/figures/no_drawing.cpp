// SPDX-License-Identifier: MIT
#include "figures/drawing.hpp"

namespace goffer::cli {

std::optional<std::vector<double>> drawing_times(const bend::Body&, std::span<const std::uint32_t>,
                                                 const std::function<bend::Pose(std::size_t)>&, int, int,
                                                 std::string& device) {
    device = "this goffer was built without what draws with OpenGL";
    return std::nullopt;
}

}  // namespace goffer::cli
