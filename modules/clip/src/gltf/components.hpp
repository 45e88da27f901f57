// SPDX-License-Identifier: MIT
#pragma once

#include "shapes.hpp"

#include <Eigen/Core>
#include <cstdint>
#include <vector>

/// Principal components of a clip, within a bound of memory.

namespace goffer::clip {

/// Beyond it the work grows with the cube, and the components do not get better: frames are alike.
inline constexpr std::size_t most_samples = 1024;

/// What fits into `memory` bytes, 1 or more entries and frames given.
struct Capacity {
    std::size_t samples = 0;     ///< frames that components are made of
    std::size_t block = 0;       ///< frames that are held at once
    std::size_t components = 0;  ///< with their weights in all frames

    /// Throws mesh::Error if that is too little.
    Capacity(std::uint64_t memory, std::size_t entries, std::size_t frames);
};

/// The mean of the sampled frames, as displacement from the rest, and the directions in which they spread
/// most from it, by the share of the spread that they have.
struct Spread {
    std::vector<std::size_t> samples;  ///< frames
    Eigen::VectorXd values;   ///< sums of squares of distances, descending; what is noise is left out
    Eigen::MatrixXd vectors;  ///< of the samples, a column for each value
    double all = 0;           ///< the sum of the squares
};

/// Looks at positions alone.
[[nodiscard]] Spread spread_of(Moves& moves, const Capacity& capacity);

/// Returns the mean, and behind it the first `count` components, each of the length that makes its weights in
/// the samples a vector of length 1.
[[nodiscard]] Shapes components_of(Moves& moves, const Spread& spread, std::size_t count,
                                   const Capacity& capacity);

/// How much of each component each frame has, and how far frames are from their blends.
struct Weights {
    Eigen::MatrixXd of;              ///< a row for each frame, a column for each component
    std::vector<double> max_errors;  ///< by the number of components, from 0 on: the largest of all vertices
};

[[nodiscard]] Weights weights_of(Moves& moves, const Shapes& components);

}  // namespace goffer::clip
