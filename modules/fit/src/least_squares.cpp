// SPDX-License-Identifier: MIT
#include "least_squares.hpp"

#include <Eigen/QR>

namespace goffer::fit {

SmallMatrix least_squares(const SmallMatrix& a, const SmallMatrix& b) {
    return a.completeOrthogonalDecomposition().solve(b);
}

}  // namespace goffer::fit
