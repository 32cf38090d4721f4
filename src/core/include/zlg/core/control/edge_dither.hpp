#pragma once
// When the bias is reversed: laws that shift the edges so that backscatter leaves no dead zone.
//
// Each reversal pulls the beat's phase by an amount that depends on where in its turn it stands. With even edges it
// stands at the same place again and again, and a slow rotation is held. In cycles of the bias beat let p_k and q_k
// shift the reversal that begins, and the one that ends, the k-th half of positive bias:
//
//   paired  four periods with p = b, b + 1/2, b + 1/2, b, b random; q - p = +-1/4 in turn, first sign random
//   random  p random in each period; q - p = x, then -x, x random in +-1/2
//
// Paired pulls cancel within four periods as long as the gyro hardly turns meanwhile; random ones have no mean at any
// rate (but for the share rate/f0 by which a shift then misses a whole turn), and make a random walk. With the counter
// latched at the reversals the halves are unequal, L+ - L- = (2 q_k - p_k - p_(k+1))/f0: this much of the bias is left
// in the counts of a period, and is known in whole ticks of the timer.

#include <array>
#include <cstdint>

#include <zlg/core/methods.hpp>

namespace zlg::core {

struct EdgeDitherConfig {
    DitherMethod method = DitherMethod::automatic;
    std::uint64_t seed = 1;
    // One cycle of the bias beat; >= 1 and up to an eighth of a half, 1 % is good enough.
    double cycle_ticks = 1e7 / 60e3;
    double tick_s = 0.005;                // bias commutation period T, > 0
    double scale_arcsec = 3.263;          // per count, > 0
    std::int32_t rate_periods = 128;      // over which the rate is measured, 1..2^16
    double random_above_arcsec_s = 60.0;  // the law changes to `random` above, back to `paired` below;
    double paired_below_arcsec_s = 40.0;  // 0 <= below <= above
};

[[nodiscard]] constexpr bool is_allowed(const EdgeDitherConfig& c) noexcept {
    return c.cycle_ticks >= 1.0 && c.tick_s > 0.0 && c.scale_arcsec > 0.0 && c.rate_periods >= 1 &&
           c.rate_periods <= 1 << 16 && c.paired_below_arcsec_s >= 0.0 &&
           c.paired_below_arcsec_s <= c.random_above_arcsec_s;
}

enum class DitherLaw : unsigned char { paired, random };

// Counts of one measurement of the rate, by the sign of the bias beat.
struct RateCounts {
    std::array<double, 2> sum{};  // of negative and of positive sign
    std::array<std::int32_t, 2> n{};
    std::int32_t n_halves = 0;

    friend constexpr bool operator==(const RateCounts&, const RateCounts&) = default;
};

struct EdgeDitherState {
    std::uint64_t draws = 0;               // random numbers drawn
    DitherLaw law = DitherLaw::paired;     // of the group of four periods under way
    DitherLaw wanted = DitherLaw::paired;  // of the next, by the last measurement
    std::int32_t period = -1;              // 0..3 within a group of four; -1: before the first positive half
    double base = 0.0;                     // b, or p of this period [cycles]
    double swing = 0.0;                    // +-1/4, or x
    std::int32_t start_ticks = 0;          // shift of the reversal that begins the half under way
    std::int32_t end_ticks = 0;            // and of the one that will end it
    RateCounts counted;

    friend constexpr bool operator==(const EdgeDitherState&, const EdgeDitherState&) = default;
};

// The rate in the half just latched, by which the law is chosen.
struct RateReading {
    bool counted = false;  // the counts are those of this half, and are rotation and bias
    std::int64_t counts = 0;
    std::int8_t helicity = 1;  // that lased: +1 or -1; the bias beat has the sign of bias times helicity
};

// Advance by one half-period: the shift of the reversal that ends the half to come, in ticks of the timer; positive is
// later. No edge moves by more than 1.01 cycles.
//
// next_sign  of the bias in the half to come: +1 or -1, against that of the half just latched.
// method     `automatic` takes the law that the rate asks for; none: no edge moves.
// config     passed `is_allowed`.
//
// The rate is the mean of `rate_periods` periods, good to a count over their duration (5 arcsec/s at the defaults); the
// law changes between groups of four periods. A measurement with fewer than half of its counts leaves the law alone.
[[nodiscard]] std::int32_t step(const EdgeDitherConfig& config, EdgeDitherState& state, std::int8_t next_sign,
                                const RateReading& reading) noexcept;

}  // namespace zlg::core
