// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

namespace goffer::fit {

/// Sets of numbers 0, 1, .., each alone until it is joined with another.
class DisjointSets {
public:
    explicit DisjointSets(std::size_t count = 0) : parent_(count) {
        std::iota(parent_.begin(), parent_.end(), 0u);
    }

    /// Adds the next number, and returns it.
    std::uint32_t add() {
        parent_.push_back(static_cast<std::uint32_t>(parent_.size()));
        return parent_.back();
    }
    void join(std::uint32_t a, std::uint32_t b) { parent_[set_of(a)] = set_of(b); }

    /// Returns the number that stands for the set that `i` is in. Shortens the way to it.
    [[nodiscard]] std::uint32_t set_of(std::uint32_t i) {
        while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
        return i;
    }

private:
    std::vector<std::uint32_t> parent_;
};

}  // namespace goffer::fit
