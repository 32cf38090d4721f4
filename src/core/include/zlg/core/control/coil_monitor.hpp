#pragma once
// The current of the bias coil: whether it is the same in both signs, and the same as always.
//
// A current that is a part p larger in one sign than in the other leaves p of the bias in the angle of every tick. The
// counter cannot distinguish this from rotation, the current can.

#include <array>
#include <cstddef>
#include <cstdint>

#include <zlg/core/control/monitor_limits.hpp>

namespace zlg::core {

struct CoilMonitorState {
    std::array<double, 2> level_a{};   // size of the current in halves of negative and of positive sign
    std::array<double, 2> first_a{};   // the first that were learnt
    double spread = 0.0;               // mean size of a half's deviation from it, ratio
    double deviation = 0.0;            // of the last half, ratio
    double odd = 0.0;                  // smoothed half difference of two halves, positive sign less negative
    double even = 0.0;                 // smoothed deviation
    std::int32_t n_learnt = 0;         // halves, up to `learning_halves`
    std::array<double, 2> steady_a{};  // means since it is off and steady,
    std::int32_t n_steady = 0;         // for so many halves

    friend constexpr bool operator==(const CoilMonitorState&, const CoilMonitorState&) = default;
};

struct CoilMonitorOutput {
    bool off = false;         // the current is not what it was
    bool unbalanced = false;  // in this half, or between the signs: the counts of a tick hold bias
};

// Advance by one half-period that was received.
//
// The two signs may never differ by more than one per cent of the current, or of its first readings by two deviations
// more; a current that differs so is not learnt.
//
// Two halves in a row may differ by the tolerance, or by eight standard deviations of such a difference where that is
// more; half their difference, smoothed over eight halves, by half the tolerance, or two deviations. A change that is
// the same in both signs for a second is accepted as the new level, because it cancels in the angle; one after which
// the signs are more alike than those that were learnt is accepted as well. The loss of more than half of the current
// is never accepted, unless the remaining current is the one that was learnt first.
//
// sign     of the bias in this half, +1 or -1.
// current  less than a microampere and what is not finite are no measurement until a level is learnt; then 0 is a loss.
[[nodiscard]] CoilMonitorOutput step(const MonitorLimits& limits, CoilMonitorState& state, int sign,
                                     double current_a) noexcept;

}  // namespace zlg::core
