// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <functional>

namespace goffer::fit {

/// A part of a computation: takes its steps to shares of the whole, and tells these to `listener`, unless
/// that is empty.
class Share {
public:
    /// The part takes the time from `first` to `last`, shares of that of the whole. `listener` must outlive
    /// it.
    Share(const std::function<void(double)>& listener, double first, double last)
        : listener_(listener), first_(first), last_(last) {}

    /// Says that `done` of `steps` steps are done. Thread-safe if the listener is.
    void tell(std::size_t done, std::size_t steps) const {
        if (listener_) listener_(at(done, steps));
    }

    /// The part that step `i` of `steps` equal ones takes.
    [[nodiscard]] Share step(std::size_t i, std::size_t steps) const {
        return {listener_, at(i, steps), at(i + 1, steps)};
    }

private:
    [[nodiscard]] double at(std::size_t done, std::size_t steps) const {
        return first_ + (last_ - first_) * static_cast<double>(done) / static_cast<double>(steps);
    }

    const std::function<void(double)>& listener_;
    double first_, last_;
};

}  // namespace goffer::fit
