#pragma once
// What is computed beside the half-periods: what is learnt of the motion, and the estimates of switches.
//
// A half-period only asks, with a snapshot of the halves around the gap, and takes the answer in a tick that is a
// function of the asking one: so the angles are the same whenever between the two it was computed. What is learnt is
// read from the history, tick by tick up to the asking one. On a host that is done at once, on the gyro's processor
// between the interrupts.

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

inline constexpr int most_late_ticks = 48;

struct SwitchPlan {
    bool is_solvable = false;  // points on both sides, and enough of them
    HalfLight light = HalfLight::none;
    double magnetic_arcsec = 0.0;  // that the points have lost, of mode +1
    // Square of what lit halves that were refused are off by: as much may each half of the gap that was not read have
    // turned.
    double unread_arcsec2 = 0.0;
    SwitchWindow window{};
    int n_late = 0;  // ticks behind the window that the light corrects

    friend bool operator==(const SwitchPlan&, const SwitchPlan&) = default;
};

// For one that is late nobody waits any more.
enum class JobState : unsigned char { free, asked, done, late };

struct SwitchJob {
    JobState state = JobState::free;  // handed over (handover.hpp)
    bool learnt = false;              // by a motion that is known
    std::int64_t gap = -1;            // its first tick
    std::int64_t asked_at = 0;        // tick; those before it are what is learnt
    SwitchPlan plan{};
    RelockScale scale{};
    SwitchEstimate found{};
    // Of ticks behind the window, what the light alone says that they were turned by, for a first half of positive
    // sign.
    std::array<float, most_late_ticks> late_arcsec{}, late_arcsec2{};

    friend bool operator==(const SwitchJob&, const SwitchJob&) = default;
};

// Switches whose estimate is asked for or waits to be taken. More at a time are bridged by the polynomial.
inline constexpr int most_jobs = 2;

// Who calls `work`: a half-period at its end, or the background. The angles are the same.
struct Worker {
    bool is_background = false;

    friend constexpr bool operator==(const Worker&, const Worker&) noexcept { return true; }
};

struct BackgroundWork {
    Worker worker{};
    std::uint32_t n_ticks = 0;  // that may be learnt, as they are counted; handed over
    std::uint32_t n_late = 0;   // estimates that were not there when they were due, wraps
    std::array<SwitchJob, most_jobs> job{};
    LearntMotion motion{};
    EstimateRoom room{};

    friend bool operator==(const BackgroundWork&, const BackgroundWork&) = default;
};

}  // namespace zlg::core
