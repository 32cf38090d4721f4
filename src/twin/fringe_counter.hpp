#pragma once
// Free-running counter of fringes.
//
// The phase is kept as whole cycles and a fraction, so a month of counting rounds no coarser than the first second.

#include <cmath>
#include <cstdint>
#include <stdexcept>

#include <fmt/format.h>

namespace zlg::twin {

class FringeCounter {
public:
    explicit FringeCounter(double start_fraction) : fraction_{start_fraction} {}

    // Let the phase advance; the counter shows its whole part and wraps.
    //
    // errors  std::overflow_error where one half brings more than a 64-bit counter can tell.
    void advance(double cycles) {
        if (!(std::abs(cycles) < max_cycles)) {
            throw std::overflow_error(fmt::format(
                "fringe counter: {} cycles in one half-period, allowed is |cycles| < {}", cycles, max_cycles));
        }
        const double whole = std::floor(cycles);
        whole_ += static_cast<std::uint64_t>(static_cast<std::int64_t>(whole));
        fraction_ += cycles - whole;
        if (fraction_ >= 1.0) {
            fraction_ -= 1.0;
            ++whole_;
        }
    }

    [[nodiscard]] std::uint64_t value() const { return whole_; }

    // Of the phase, what the counter does not show: 0..1.
    [[nodiscard]] double fraction() const { return fraction_; }

private:
    // Half of what int64 holds: a difference of two readings is then never ambiguous.
    static constexpr double max_cycles = 4.6e18;

    std::uint64_t whole_ = 0;
    double fraction_;  // in [0, 1)
};

}  // namespace zlg::twin
