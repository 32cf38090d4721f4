#pragma once
// How the angle scatters over 1, 2, 4, ... ticks: two-sample (Allan) variance of the increments, and whether a gyro at
// rest can scatter so.
//
//   A(n) = <(P_{k+1} - P_k)^2>/2,  P_k the counts of n ticks
//
// A constant rate drops out. Each reading of the counter is rounded once and stands in both neighbours: 1/4 count^2 for
// every n. A random walk adds its variance in n ticks. A gyro that is moved shows more at the scale of the motion.

#include <array>
#include <cstdint>

namespace zlg::calibration {

inline constexpr int scatter_scales = 12;  // up to 2048 ticks

class AngleScatter {
public:
    // The next tick does not follow the last one: no pair is made across the break.
    void interrupt();
    // Counts of the next tick.
    void take(std::int64_t counts);
    void add(const AngleScatter& other);

    [[nodiscard]] std::int64_t pairs(int scale) const { return pairs_[static_cast<std::size_t>(scale)]; }
    // A(2^scale), counts^2; 0 without pairs.
    [[nodiscard]] double variance(int scale) const;

private:
    struct Level {
        double half = 0.0;      // counts of the first of the two blocks that make one of the next level
        double previous = 0.0;  // counts of the block before
        bool has_half = false;
        bool has_previous = false;
    };
    std::array<Level, scatter_scales> level_{};
    std::array<std::int64_t, scatter_scales> pairs_{};
    std::array<double, scatter_scales> sum_{};
};

struct RestCheck {
    bool at_rest = true;
    double worst_ratio = 1.0;  // measured over expected variance, at the scale where it is farthest from 1
    std::int64_t worst_ticks = 1;
};

// Compare with rounding and a random walk of `walk_counts2_per_tick`.
//
// Counters of a quiet gyro may show less than a quarter of a count (their rounding is then one and the same reading
// after reading), so less than expected is reported only where the walk should dominate.
[[nodiscard]] RestCheck check_rest(const AngleScatter& scatter, double walk_counts2_per_tick);

}  // namespace zlg::calibration
