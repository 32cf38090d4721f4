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

#include <array>
#include <cstddef>
#include <cstdint>

#include <zlg/core/records.hpp>

namespace zlg::core {

// A mean over up to so many ticks, then an exponential one: 30 s of 5 ms ticks.
inline constexpr double coil_mean_ticks = 6000.0;

inline constexpr std::size_t n_recent_means = 5;

struct MeanAsymmetry {
    double ratio = 0.0;
    double n_ticks = 0.0;  // that it holds; 0: none

    friend constexpr bool operator==(const MeanAsymmetry&, const MeanAsymmetry&) = default;
};

struct CoilAsymmetryState {
    MeanAsymmetry usual{};                        // where there is no change
    MeanAsymmetry change{};                       // since the last change; none: there is none
    std::array<double, n_recent_means> recent{};  // exponential means over 4, 16 .. 1024 ticks
    std::size_t turn = 0;                         // the one of the longer means that was moved last
    double return_sq = 0.0;                       // how much better than `change` the last ticks fit `usual`
    double last_ratio = 0.0;
    double variance = 0.0;  // of the reading of one tick, by the differences of neighbours
    double repeated = 0.0;  // share of ticks that read the same as the one before
    double n_differences = 0.0;
    std::int32_t n_unknown = 0;  // ticks in a row without both readings

    friend constexpr bool operator==(const CoilAsymmetryState&, const CoilAsymmetryState&) = default;
};

// By which the bias of a tick does not cancel; zeros where no change is seen.
struct CoilAsymmetry {
    double ratio = 0.0;     // eps, beyond the usual
    double variance = 0.0;  // of that
};

// Advance by one tick.
//
// A change is seen where an exponential mean over 4, 16, 64, 256 or 1024 ticks is 6 standard deviations from the mean before
// it; from there on eps is averaged anew. It is over where the ticks fit the usual value better, by the cumulative sum of
// their likelihoods, or where the new level is within 2 standard deviations of it. An asymmetry that was there from the
// start is the usual one. One that gets smaller is taken for the end of a fault, and is the usual one from then on.
//
// return   nothing in the first 64 ticks, in the first two of a change, where the current has not been read for 400 ticks,
//          and where the noise of the readings is too small against the steps of their converter to be averaged.
[[nodiscard]] CoilAsymmetry step(CoilAsymmetryState& state, const HalfRecord& first, const HalfRecord& second) noexcept;

}  // namespace zlg::core
