#pragma once
// Half-periods at the end of a gap in which both beams were already lit and steady in the new mode: their counts are good, at
// a detuning that the light tells.
//
//   y' = y + s D,  D = chi f0 K (T/2) m       as after closing (joint_relock.hpp); m: mean square of the record    (1)
//
// The errors of D are those of the light, independent from half to half, and one that all these halves have in common, since
// they are at nearly the same detuning: of the detuning that is read far from the centre, and of the square law itself,
//
//   common standard deviation of D:  sqrt((0.015 D)^2 + chi^2 f0^2 K^2 (T/2)^2 (2 dl 0.002)^2)                      (2)
//
// Used are the halves that reach up to the end of the gap without a break, up to 16. A half that is recorded as lit but was
// not alternates with the bias in another way than its neighbours do. The second difference of three corrected halves in a
// row is therefore compared with that of the learnt motion: a triple beyond the limit removes its first half and all before.
// What it is off by may be a rotation as well, and so may what the difference of the outer two, in which the common error
// cancels, exceeds three standard deviations by: each half of the gap without a point may hold as much.

#include <array>
#include <cstdint>

#include <zlg/core/common/maths.hpp>
#include <zlg/core/compensation/border.hpp>
#include <zlg/core/compensation/compensation_constants.hpp>
#include <zlg/core/compensation/optimal_bridge.hpp>
#include <zlg/core/records.hpp>

namespace zlg::core {

inline constexpr int max_lit_halves = 16;

struct LitHalf {
    double value_arcsec = 0.0;       // as read, without the bias
    double correction_arcsec = 0.0;  // s D of (1), to be added
    double variance_arcsec2 = 0.0;   // of it, by the noise of the light
    double common_arcsec = 0.0;      // standard deviation (2), with the sign s

    friend bool operator==(const LitHalf&, const LitHalf&) = default;
};

struct LitHalvesState {
    std::int64_t end_tick = -1;  // the first one behind them
    int n = 0;                   // in a row, up to the end
    std::int8_t mode = 1;
    double turned_arcsec2 =
        0.0;  // square of a rotation beside them that is not that of the motion, as they show it; 0: none
    bool first_is_whole = false;  // until the end of the gap: the first one is read to a count alone
    bool starts_even = false;     // the reversal before the next half is not shifted
    std::array<LitHalf, max_lit_halves> half{};

    friend bool operator==(const LitHalvesState&, const LitHalvesState&) = default;
};

// One tick, with what is known of the motion and of the bias.
struct LitTick {
    const HalfRecord& first;
    const HalfRecord& second;
    Border start{};  // of its first half
    std::int64_t tick = 0;
    double bias_arcsec = 0.0;  // that a positive bias adds to a half; 0: not known, nothing is used
    // Variance of the difference of two half-ticks of the motion between which another one lies; infinite: not known.
    double difference_arcsec2 = infinity;
    bool with_phase = false;  // halves without a place within the count at both ends are no points
};

// Variance of the second difference of three half-ticks in a row. The covariance is that of half-ticks.
[[nodiscard]] double second_difference_arcsec2(const MotionCovariance& covariance) noexcept;

// A tick of a gap.
//
// begins            it is the first one.
// motion_arcsec2    second_difference_arcsec2 of the motion.
void add_gap_tick(const CompensationConstants& gyro, LitHalvesState& state, const LitTick& tick, bool begins,
                  double motion_arcsec2) noexcept;

// The first measured tick after the gap.
//
// drift_arcsec  that is subtracted from it: half of it is subtracted from each half.
void end_gap(const CompensationConstants& gyro, LitHalvesState& state, const LitTick& tick, double motion_arcsec2,
             double drift_arcsec) noexcept;

}  // namespace zlg::core
