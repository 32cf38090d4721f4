#pragma once
// What the two signs of the coil's current tell of a false rotation.
//
// With a current of 1 + eps in positive halves and 1 - eps in negative ones the bias does not cancel in a tick:
//
//   false angle = mode K T f eps
//
// One tick reads eps with the noise of its two readings, worth as much as the rounding of the counter or more; averages over
// seconds tell hundredths of a per cent. A constant error of the readings looks the same, so only a change counts: what eps
// is beyond its mean of the time before.
//
// A change of the readings is one of the current or one of the sensor. The counts tell which: one of the current turns the
// gyro by mode K T f eps more in each tick than before, and the other way after a switch; one of the sensor by nothing.

#include <array>
#include <cstddef>
#include <cstdint>

#include <zlg/core/records.hpp>

namespace zlg::core {

// A mean over up to so many ticks, then an exponential one: 2 min of 5 ms ticks.
inline constexpr double coil_mean_ticks = 24000.0;

inline constexpr std::size_t n_recent_means = 5;

struct MeanAsymmetry {
    double ratio = 0.0;
    double turned_arcsec = 0.0;  // in a tick, smoothed
    double n_ticks = 0.0;        // that it holds; 0: none

    friend constexpr bool operator==(const MeanAsymmetry&, const MeanAsymmetry&) = default;
};

// Exponential means over 4, 16 .. 1024 ticks.
struct RecentAsymmetry {
    double ratio = 0.0;
    double turned_arcsec = 0.0;
    double turned_variance_arcsec2 = 0.0;  // of `turned_arcsec` about the usual one, while there is no change

    friend constexpr bool operator==(const RecentAsymmetry&, const RecentAsymmetry&) = default;
};

struct CoilAsymmetryState {
    MeanAsymmetry usual{};   // where there is no change
    MeanAsymmetry change{};  // since the last change; none: there is none
    std::array<RecentAsymmetry, n_recent_means> recent{};
    std::size_t turn = 0;    // the one of the longer means that was moved last
    double return_sq = 0.0;  // how much better than `change` the last ticks fit `usual`
    double last_ratio = 0.0;
    double variance = 0.0;  // of the reading of one tick, by the differences of neighbours
    double repeated = 0.0;  // share of ticks that read the same as the one before
    double n_differences = 0.0;
    std::array<double, 2> turned_arcsec{};  // of a tick, smoothed once and twice
    double n_turned = 0.0;       // measured ticks of this mode in `change.turned_arcsec`; below 0: those to wait for
    double odds_before = 1.0;    // of a change of the current against one of the sensor, by the modes before
    double odds = 1.0;           // with this mode
    double changed_ticks = 0.0;  // since the change was first seen
    std::int32_t n_unknown = 0;  // ticks in a row without both readings
    std::int8_t mode = 0;        // of the last tick
    bool is_signed = false;      // the readings alternate with the bias

    friend constexpr bool operator==(const CoilAsymmetryState&, const CoilAsymmetryState&) = default;
};

// What a tick turned.
struct CoilTick {
    bool measured = false;
    std::int8_t mode = 1;
    double value_arcsec = 0.0;
    double variance_arcsec2 = 0.0;  // of the reading
    double per_ratio_arcsec = 0.0;  // mode K T f
};

// By which the bias of a tick does not cancel; zeros where no change is seen.
struct CoilAsymmetry {
    double ratio = 0.0;     // eps, beyond the usual, times the probability that it is one of the current
    double variance = 0.0;  // of that
};

// Advance by one tick.
//
// A change is seen where an exponential mean over 4, 16, 64, 256 or 1024 ticks is 6 standard deviations from the mean before
// it; from there on eps is averaged anew. It is over where the ticks fit the usual value better, by the cumulative sum of
// their likelihoods, or where the new level is within 2 standard deviations of it. An asymmetry that was there from the
// start is the usual one. One that gets smaller is taken for the end of a fault, and is the usual one from then on.
//
// Whether it is one of the current is decided by the mean turn since then against the usual one, with the variance that such
// means had before (Student's distribution of 3 degrees: motions have rare large steps). Both are as probable before. With
// the odds against the current beyond 1000, the new level is the usual one: the sensor has changed.
//
// return   nothing in the first 64 ticks, in the first two of a change, where the current has not been read for 400 ticks,
//          and where the noise of the readings is too small against the steps of their converter to be averaged.
[[nodiscard]] CoilAsymmetry step(CoilAsymmetryState& state, const HalfRecord& first, const HalfRecord& second,
                                 const CoilTick& tick) noexcept;

}  // namespace zlg::core
