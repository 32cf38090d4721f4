#pragma once
// The bias as the counter shows it, half against half: whether it is there, and of which helicity.
//
//   b_h = beat_sign_h (n_h - n_(h-1))/2,  beat_sign = bias_sign * helicity commanded, -beat_sign in the half before
//
// Rotation leaves only its change from one half to the next in b, the bias all of itself: b is near its own mean where
// the mode commanded lases, near minus that where the other one does, and near 0 where there is no bias.

#include <cstdint>

#include <zlg/core/control/monitor_limits.hpp>

namespace zlg::core {

struct BiasMonitorState {
    // Halves in a row that were counted, up to now, each of the other sign than the one before.
    std::int32_t n_known = 0;
    std::int8_t beat_sign = 1;  // of the last of them
    double counts = 0.0;        // of it, of the one before,
    double counts_before = 0.0;
    double counts_long_before = 0.0;  // and of the one before that
    double bias_counts = 0.0;         // b of a settled gyro, learnt and followed
    std::int32_t n_learnt = 0;        // up to 32, when it counts as learnt
    double steady_counts = 0.0;       // mean of b since it is out of its band and steady,
    std::int32_t n_steady = 0;        // for so many halves
    std::int32_t n_reversed = 0;      // halves in a row in which b was that of the other helicity

    friend constexpr bool operator==(const BiasMonitorState&, const BiasMonitorState&) = default;
};

struct BiasMonitorOutput {
    bool judged = false;     // this half and the one before were counted, and the bias is known
    bool in_band = false;    // b is what it should be: there is a beat, thus light both ways, and the counts are its
    bool reversed = false;   // in this half and the last ones the other helicity lased than was commanded
    bool lost = false;       // less than half of the bias
    bool near_rate = false;  // the rotation nearly cancels the bias in this half: the static lock-in zone
    double deficit_ratio = 0.0;  // what b lacks, over the bias; 0 where it is not known finely
};

// Advance by one half-period.
//
// The mean of b is learnt from the first settled halves, whatever was presumed, and followed in some seconds. In a
// settled gyro b may be off by a twelfth of it and twice what the last change of the rotation moved it; else by a half.
// A b of the right sign that is off, but steady for a second, is the new mean; one that is nearer to what was presumed
// after 32 halves: the mean was then learnt from a faulty bias. Less than a quarter of what is presumed is never
// learnt.
//
// counted  the counts are those of this half, a whole number.
// settled  closed and locked: the bias is not weakened by detuning.
// latency  none for a change of the counts in one half; `reversed`: four halves.
[[nodiscard]] BiasMonitorOutput step(const MonitorLimits& limits, BiasMonitorState& state, bool counted, double counts,
                                     std::int8_t beat_sign, bool settled) noexcept;

}  // namespace zlg::core
