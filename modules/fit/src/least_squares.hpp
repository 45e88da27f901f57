// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

namespace goffer::fit {

/// A matrix of at most 7 rows and 7 columns, which allocates nothing.
using SmallMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, 7, 7>;

/// The x of least norm that minimizes |a x - b|, column by column; `a` may have any rank. It is compiled
/// once, for every size: each size that a source decomposes for itself takes seconds to compile.
[[nodiscard]] SmallMatrix least_squares(const SmallMatrix& a, const SmallMatrix& b);

}  // namespace goffer::fit
