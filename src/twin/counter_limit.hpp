#pragma once
// The fastest that a counter follows: fringes beyond that rate are lost.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace zlg::twin {

class CounterLimit {
public:
    // max_hz  infinite: it follows everything.
    explicit CounterLimit(double max_hz) : max_hz_{max_hz} {}

    // What the counter shows after so much time, when an ideal one would show `counter`.
    std::uint64_t shown(std::uint64_t counter, double elapsed_s) {
        const auto counts = static_cast<std::int64_t>(counter - ideal_);
        ideal_ = counter;
        const double most = std::ceil(max_hz_ * elapsed_s);
        const auto limit = most < 0x1p62 ? static_cast<std::int64_t>(most) : std::numeric_limits<std::int64_t>::max();
        shown_ += static_cast<std::uint64_t>(std::clamp(counts, -limit, limit));
        return shown_;
    }

    // Follow it over halves in which no fringe is lost.
    void skip(std::uint64_t counter) {
        shown_ += counter - ideal_;
        ideal_ = counter;
    }

private:
    double max_hz_;
    std::uint64_t ideal_ = 0;
    std::uint64_t shown_ = 0;
};

}  // namespace zlg::twin
