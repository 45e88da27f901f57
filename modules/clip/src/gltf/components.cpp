// SPDX-License-Identifier: MIT
#include "components.hpp"

#include <goffer/mesh/mesh.hpp>

#include <glm/geometric.hpp>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <string>

namespace goffer::clip {

namespace {

using Eigen::Index;

/// Displacements of positions, a column for each of `samples`.
Eigen::MatrixXd shifts(Moves& moves, std::span<const std::size_t> samples) {
    const std::size_t entries = moves.rest().entries();
    Eigen::MatrixXd block(static_cast<Index>(3 * entries), static_cast<Index>(samples.size()));
    for (Index column = 0; column < block.cols(); ++column) {
        moves.read(samples[static_cast<std::size_t>(column)], false);
        for (std::size_t i = 0; i < entries; ++i) {
            const glm::dvec3 shift = moves.shift(i);
            for (int c = 0; c < 3; ++c) block(static_cast<Index>(3 * i) + c, column) = shift[c];
        }
    }
    return block;
}

/// The inner products of all pairs of samples, block by block: all but those of the first block are read
/// once for each block before them.
Eigen::MatrixXd gram_of(Moves& moves, std::span<const std::size_t> samples, std::size_t block) {
    const auto count = static_cast<Index>(samples.size());
    Eigen::MatrixXd gram(count, count);
    for (std::size_t a = 0; a < samples.size(); a += block) {
        const Eigen::MatrixXd rows = shifts(moves, samples.subspan(a, std::min(block, samples.size() - a)));
        const auto at = static_cast<Index>(a);
        gram.block(at, at, rows.cols(), rows.cols()).noalias() = rows.transpose() * rows;
        for (std::size_t b = a + block; b < samples.size(); b += block) {
            const Eigen::MatrixXd columns =
                shifts(moves, samples.subspan(b, std::min(block, samples.size() - b)));
            const auto to = static_cast<Index>(b);
            gram.block(at, to, rows.cols(), columns.cols()).noalias() = rows.transpose() * columns;
            gram.block(to, at, columns.cols(), rows.cols()) =
                gram.block(at, to, rows.cols(), columns.cols()).transpose();
        }
    }
    return gram;
}

std::vector<std::size_t> evenly_spaced(std::size_t frames, std::size_t count) {
    std::vector<std::size_t> samples;
    samples.reserve(count);
    for (std::size_t i = 0; i < count; ++i)
        samples.push_back(count == 1 ? 0 : i * (frames - 1) / (count - 1));
    return samples;
}

}  // namespace

Capacity::Capacity(std::uint64_t memory, std::size_t entries, std::size_t frames) {
    const std::uint64_t per_component = 6 * sizeof(float) * entries, per_frame = 6 * sizeof(double) * entries;
    samples = static_cast<std::size_t>(std::sqrt(static_cast<double>(memory) / 8 / (4 * sizeof(double))));
    samples = std::min({samples, frames, most_samples});
    block = static_cast<std::size_t>(std::min<std::uint64_t>(memory / 4 / (2 * per_frame), samples));
    // The mean is one more. Weights are there as doubles and as floats.
    const std::uint64_t by_shapes = memory / 2 / per_component,
                        by_weights = memory / 8 / (frames * (sizeof(double) + sizeof(float)));
    components = static_cast<std::size_t>(std::min(by_shapes, by_weights));
    if (components < 2 || block < 1 || samples < std::min<std::size_t>(frames, 2)) {
        const std::uint64_t least =
            std::max({8 * per_frame, 4 * per_component, 16 * frames * (sizeof(double) + sizeof(float)),
                      std::uint64_t{4096}});
        throw mesh::Error("the clip's targets cannot be found in " + std::to_string(memory) +
                          " bytes; allow " + std::to_string(least) + " or more, or take fewer frames");
    }
}

Spread spread_of(Moves& moves, const Capacity& capacity) {
    Spread spread;
    spread.samples = evenly_spaced(moves.count(), capacity.samples);
    Eigen::MatrixXd gram = gram_of(moves, spread.samples, capacity.block);
    const double before = gram.trace();
    // From inner products of displacements to those of differences from their mean.
    const Eigen::RowVectorXd means = gram.colwise().mean();
    const double mean = means.mean();
    gram.rowwise() -= means;
    gram.colwise() -= means.transpose();
    gram.array() += mean;
    spread.all = std::max(0.0, gram.trace());
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(gram);
    const Eigen::VectorXd values = solver.eigenvalues().reverse();
    const double noise = std::max(1e-14 * before, moves.rest().noise());
    Index rank = 0;
    while (rank < values.size() && values[rank] > noise) ++rank;
    spread.values = values.head(rank);
    spread.vectors = solver.eigenvectors().rowwise().reverse().leftCols(rank);
    return spread;
}

Shapes components_of(Moves& moves, const Spread& spread, std::size_t count, const Capacity& capacity) {
    Shapes out(moves.rest(), count + 1);
    auto matrix = out.matrix();
    Shapes block(moves.rest(), capacity.block);
    for (std::size_t first = 0; first < spread.samples.size(); first += capacity.block) {
        const std::size_t size = std::min(capacity.block, spread.samples.size() - first);
        for (std::size_t s = 0; s < size; ++s) {
            moves.read(spread.samples[first + s], true);
            moves.copy(block.positions(s), block.normals(s));
        }
        Eigen::MatrixXf shares(static_cast<Index>(size), matrix.cols());
        shares.col(0).setConstant(1.0f / static_cast<float>(spread.samples.size()));
        shares.rightCols(static_cast<Index>(count)) =
            spread.vectors
                .block(static_cast<Index>(first), 0, static_cast<Index>(size), static_cast<Index>(count))
                .cast<float>();
        matrix.noalias() += block.matrix().leftCols(static_cast<Index>(size)) * shares;
    }
    return out;
}

Weights weights_of(Moves& moves, const Shapes& components) {
    const auto rows = static_cast<Index>(3 * moves.rest().entries());
    const auto matrix = components.matrix();
    const Index count = matrix.cols() - 1;
    Weights out{Eigen::MatrixXd(static_cast<Index>(moves.count()), count),
                std::vector<double>(static_cast<std::size_t>(count) + 1, 0.0)};
    Eigen::VectorXd left(rows);
    const auto note = [&](Index number) {
        double most = 0;
        for (Index i = 0; i < rows; i += 3) most = std::max(most, left.segment<3>(i).squaredNorm());
        double& known = out.max_errors[static_cast<std::size_t>(number)];
        known = std::max(known, std::sqrt(most));
    };
    for (std::size_t f = 0; f < moves.count(); ++f) {
        moves.read(f, false);
        for (Index row = 0; row < rows; row += 3) {
            const glm::dvec3 shift = moves.shift(static_cast<std::size_t>(row / 3));
            for (int c = 0; c < 3; ++c) left[row + c] = shift[c];
        }
        left -= matrix.col(0).head(rows).cast<double>();
        note(0);
        for (Index k = 0; k < count; ++k) {
            const auto shape = matrix.col(k + 1).head(rows).cast<double>();
            const double weight = shape.dot(left) / shape.squaredNorm();
            out.of(static_cast<Index>(f), k) = weight;
            left -= weight * shape;
            note(k + 1);
        }
    }
    return out;
}

}  // namespace goffer::clip
