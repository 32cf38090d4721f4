#pragma once
// What is computed beside the half-periods: the folds of what was learnt, and the estimates of switches.
//
// A half-period only asks, with a snapshot of all that the answer depends on, and takes the answer at a half that is a function of
// the asking one: so the angles are the same whenever between the two it was computed. On a host that is at once, on the gyro's
// processor between the interrupts.

#include <array>
#include <cstdint>

#include <zlg/core/compensation/learnt_motion.hpp>
#include <zlg/core/compensation/switch_estimate.hpp>

namespace zlg::core {

// How the false angles of halves are taken off.
enum class HalfLight : unsigned char {
    none,     // nothing is taken off
    spline,   // the fit of the samples
    records,  // the recorded mean square of each half
    ticks     // the paper's correction of the tick is in its value
};

// A tick behind the window: what the light alone says that it was turned by, for a first half of positive sign.
struct LateTick {
    double false_arcsec = 0.0;
    double variance_arcsec2 = 0.0;

    friend bool operator==(const LateTick&, const LateTick&) = default;
};

inline constexpr int most_late_ticks = 48;

// What a row of the window stands for.
struct RowPlace {
    std::int16_t tick = 0;  // the first one, where it is several, counted from the first one of the gap
    std::int8_t n_ticks = 1;
    std::int8_t half = -1;  // of that tick; -1: all of it

    friend bool operator==(const RowPlace&, const RowPlace&) = default;
};

struct SwitchPlan {
    bool is_solvable = false;  // points on both sides, and enough of them
    HalfLight light = HalfLight::none;
    // Square of what lit halves that were refused are off by: as much may each half of the gap that was not read have turned.
    double unread_arcsec2 = 0.0;
    SwitchWindow window{};
    std::array<RowPlace, most_window_rows> place{};
    int n_late = 0;  // ticks behind the window that the light corrects

    friend bool operator==(const SwitchPlan&, const SwitchPlan&) = default;
};

struct SwitchJob {
    std::int64_t gap = -1;      // first tick of the gap; -1: the place is free
    std::int64_t asked_at = 0;  // half
    bool done = false;
    bool late = false;    // nobody waits for it any more
    bool learnt = false;  // by a motion that is known
    SwitchPlan plan{};
    RelockScale scale{};
    SwitchEstimate found{};
    std::array<LateTick, most_late_ticks> late_tick{};

    friend bool operator==(const SwitchJob&, const SwitchJob&) = default;
};

// Switches whose estimate is asked for or waits to be taken. More at a time are bridged by the polynomial.
inline constexpr int most_jobs = 2;

struct BackgroundWork {
    std::array<SwitchJob, most_jobs> job{};
    EstimateRoom room{};

    friend bool operator==(const BackgroundWork&, const BackgroundWork&) = default;
};

// Windows from which on the learnt motion is known.
inline constexpr double few_windows = 25.0;

// All that was asked for, in the order of asking.
void work(const CompensationConstants& gyro, LearntMotion& motion, BackgroundWork& background) noexcept;

}  // namespace zlg::core
