// SPDX-License-Identifier: MIT
#pragma once

#include "rest.hpp"

#include <goffer/fit/refine.hpp>

#include <algorithm>
#include <span>
#include <vector>

namespace goffer::fit {

/// Heights counted in rows: a piecewise linear function, with its inverse.
class RowScale {
public:
    /// `stretches`: one or more, in their range.
    explicit RowScale(std::span<const Stretch> stretches) {
        double z = 0, row = 0;
        for (const Stretch& stretch : stretches) {
            const double rows = 2 * rows_of_fold * stretch.folds;
            pieces_.push_back({z, row, rows / stretch.length});
            z += stretch.length;
            row += rows;
        }
        rows_ = row;
    }

    [[nodiscard]] double row(double z) const {
        const Piece& piece = piece_at(z);
        return piece.row + (z - piece.z) * piece.rate;
    }

    /// The height of a row. All of a stretch without folds is one row, whose height is the upper end.
    [[nodiscard]] double height(double row) const {
        const Piece& piece = last_before([row](const Piece& p) { return p.row <= row && p.rate > 0; });
        return piece.rate > 0 ? piece.z + (row - piece.row) / piece.rate : piece.z;
    }

    /// Whether wrinkles may show at a height from `low` to `high`: there are folds, and it is not all so
    /// close to where the first or last of them ends that they have faded.
    [[nodiscard]] bool has_folds(double low, double high) const {
        constexpr double faded = 1.3;  // rows
        const double first = row(low), last = row(high);
        if (!(last > faded && first < rows_ - faded)) return false;
        return last > first || piece_at(low).rate > 0;
    }

private:
    struct Piece {
        double z, row, rate;
    };

    [[nodiscard]] const Piece& piece_at(double z) const {
        return last_before([z](const Piece& p) { return p.z <= z; });
    }

    template <class Begun>
    [[nodiscard]] const Piece& last_before(Begun begun) const {
        const auto found = std::find_if(pieces_.rbegin(), pieces_.rend(), begun);
        return found != pieces_.rend() ? *found : pieces_.front();
    }

    std::vector<Piece> pieces_;
    double rows_ = 0;
};

}  // namespace goffer::fit
