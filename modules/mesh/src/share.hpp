// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <limits>

/// How readers say how much of their work is done.

namespace goffer::mesh {

/// Passes shares on to a caller's function, a few hundred at most, each larger than the one before.
class Listener {
public:
    static constexpr double steps = 256;  ///< how many shares are passed on

    /// `tell` may be empty; it must outlive the listener.
    explicit Listener(const std::function<void(double)>& tell) : tell_(tell) {}

    [[nodiscard]] bool wants_to_know() const { return static_cast<bool>(tell_); }

    /// Passes on `share` if it is a step ahead of the last one, or 1.
    void hear(double share) {
        share = std::min(share, 1.0);
        if (!tell_ || share <= last_ || (share < 1 && share < last_ + 1 / steps)) return;
        last_ = share;
        tell_(share);
    }

private:
    const std::function<void(double)>& tell_;
    double last_ = 0;
};

/// A stretch of the work, from one share of the whole to another. A plain value; that of nobody's work is as
/// quick as none.
class Share {
public:
    Share() = default;                    ///< nobody is told
    explicit Share(Listener& listener) {  ///< all of the work
        if (listener.wants_to_know()) listener_ = &listener;
    }

    /// The stretch between two shares of this one, which takes so many steps.
    [[nodiscard]] Share part(double from, double to, std::uint64_t steps = 1) const {
        Share part;
        if (!listener_) return part;
        part.listener_ = listener_;
        part.from_ = from_ + (to_ - from_) * from;
        part.to_ = from_ + (to_ - from_) * to;
        part.steps_ = std::max(steps, std::uint64_t{1});
        part.next_ = 0;
        return part;
    }

    [[nodiscard]] bool is_heard() const { return listener_ != nullptr; }

    /// Says that `done` of the steps are done. Costs a comparison, as a rule.
    void at(std::uint64_t done) {
        if (done >= next_) say(done);
    }

private:
    void say(std::uint64_t done) {
        const double all = static_cast<double>(steps_);
        listener_->hear(from_ + (to_ - from_) * std::min(static_cast<double>(done) / all, 1.0));
        const double step = std::min(all / (Listener::steps * (to_ - from_)), all);
        next_ = done + std::max(static_cast<std::uint64_t>(step), std::uint64_t{1});
    }

    static constexpr std::uint64_t never = std::numeric_limits<std::uint64_t>::max();

    Listener* listener_ = nullptr;
    double from_ = 0, to_ = 1;
    std::uint64_t steps_ = 1, next_ = never;
};

}  // namespace goffer::mesh
