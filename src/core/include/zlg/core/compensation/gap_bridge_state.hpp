#pragma once
// State of the gap bridge: ticks as it is given them and as it remembers them, the gaps that wait, and what is computed
// beside the half-periods, which is what is learnt of the motion and the estimates of switches.
//
// A half-period only asks, with a snapshot of the halves around the gap, and takes the answer in a tick that is a
// function of the asking one: so the angles are the same whenever between the two it was computed. What is learnt is
// read from the history, tick by tick up to the asking one. On a host that is done at once, on the gyro's processor
// between the interrupts.

#include <array>
#include <cstdint>

#include <zlg/core/common/maths.hpp>
#include <zlg/core/compensation/angle.hpp>
#include <zlg/core/compensation/gap_bridge_config.hpp>
#include <zlg/core/compensation/learnt_motion.hpp>
#include <zlg/core/compensation/polynomial_fit.hpp>
#include <zlg/core/compensation/switch_estimate.hpp>
#include <zlg/core/compensation/switch_light.hpp>
#include <zlg/core/records.hpp>

namespace zlg::core {

// What a half-tick was read as, where its counts are an angle: after the loop is closed, or before it where both beams
// are lit.
struct HalfReading {
    bool read = false;
    bool lit = false;             // in a gap
    std::int8_t sign = 1;         // bias_sign * mode
    float false_arcsec2 = -1.0F;  // variance of `false_arcsec`, by the noise of the light; negative: not measured
    double angle_arcsec = 0.0;    // without the bias; its false angle is in it
    double false_arcsec = 0.0;    // -s D of the recorded mean square of the detuning: what is to be subtracted

    friend bool operator==(const HalfReading&, const HalfReading&) = default;
};

// A tick as it was read.
struct TickReading {
    bool measured = true;     // false: a tick of a gap
    bool settled = true;      // re-lock is over: the tick shows the motion alone
    bool with_phase = false;  // the place within the count is known at both ends and in the middle
    double variance_arcsec2 = 0.0;
    double relock_variance_arcsec2 = 0.0;  // of the re-lock correction, a part of the whole
    std::array<HalfReading, 2> half{};     // of `automatic`

    friend bool operator==(const TickReading&, const TickReading&) = default;
};

// So many ticks of a gap, the last one being that which has it, have a known sum.
struct KnownSum {
    std::int32_t ticks = 0;  // 0: none
    bool is_rough = false;   // the motion around the gap may tell more (gap_known.hpp)
    double arcsec = 0.0;
    double variance_arcsec2 = 0.0;

    friend bool operator==(const KnownSum&, const KnownSum&) = default;
};

// One tick as measured, or the place of one in a gap.
struct TickInput : TickReading {
    double value_arcsec = 0.0;    // with the re-lock correction; in a gap what the counter read
    double relock_arcsec = 0.0;   // the correction in it
    double common_arcsec2 = 0.0;  // part of the variance that all ticks at an even rate have in common
    bool late = false;            // as it is recorded: the estimate of a gap that is due now was not ready
    std::int8_t mode = 1;
    std::int8_t sign = 1;  // bias_sign * mode in its first half
    std::uint32_t flags = 0;
    bool amend_previous = false;          // the previous, measured tick becomes final now
    double amend_arcsec = 0.0;            // to be added to its final value
    double amend_variance_arcsec2 = 0.0;  // to be added to its variance
    std::uint32_t amend_flags = 0;
    KnownSum known{};
    double known_drift_arcsec2 = 0.0;  // the part of its variance that the detuning makes
};

struct HistoryTick {
    TickReading read{};
    AngleRow row{};
    double share = 0.0;     // of a tick of a gap that is estimated: its part of what the angle of the gap is off by
    bool by_phase = false;  // the readings had the place within the count, by majority
    KnownSum known{};

    friend bool operator==(const HistoryTick&, const HistoryTick&) = default;
};

// Its halves show the motion alone.
[[nodiscard]] inline bool is_settled(const HistoryTick& entry) noexcept {
    const TickReading& read = entry.read;
    return read.measured && read.settled && is_finite(read.variance_arcsec2) && read.half[0].read &&
           read.half[1].read && (!entry.by_phase || read.with_phase);
}

// How the false angles of halves are taken off.
enum class HalfLight : unsigned char {
    none,     // nothing is taken off
    spline,   // the fit of the samples
    records,  // the recorded mean square of each half
    ticks     // the paper's correction of the tick is in its value
};

inline constexpr int most_late_ticks = 48;

// For one that is late nobody waits any more.
enum class JobState : unsigned char { free, asked, done, late };

struct SwitchJob {
    JobState state = JobState::free;  // handed over (handover.hpp)
    bool learnt = false;              // by a motion that is known
    std::int64_t asked_at = 0;        // tick; those before it are what is learnt
    HalfLight light = HalfLight::none;
    double magnetic_arcsec = 0.0;  // that the points have lost, of mode +1
    // Square of what lit halves that were refused are off by: as much may each half of the gap that was not read have
    // turned.
    double unread_arcsec2 = 0.0;
    SwitchWindow window{};
    RelockScale scale{};
    SwitchEstimate found{};
    // Ticks behind the window that the light corrects: what it alone says that they were turned by, for a first half of
    // positive sign.
    int n_late = 0;
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

// Gaps that wait for the ticks after them, each of one tick and one more.
inline constexpr int max_pending_gaps = (most_final_delay_ticks - max_polynomial_gap) / 2 + 1;
// A row leaves it when the next tick takes its place; the longest window is shorter.
inline constexpr int history_ticks = most_final_delay_ticks;
static_assert(ticks_before_estimate + max_estimated_gap + most_relock_ticks < history_ticks);

// Age at which what is learnt of the motion counts 1/e, in ticks: a quarter of a minute of 5 ms.
inline constexpr double forget_ticks = 3000.0;

// Where a gap lies.
struct Gap {
    bool has_before = false;  // a measured tick precedes it
    std::int8_t mode_before = 1;
    bool moves = false;                       // the loop is open in it, and the perimeter moves
    double variance_arcsec2 = -1.0;           // of its angle, if it is estimated and nothing else with it
    std::int64_t first_tick = 0, n = 0;       // n: ticks so far
    ExactSum final_minus_delivered_arcsec{};  // of a gap that is too long
    std::int64_t known_ticks = 0;             // whose sums are known
    double known_variance_arcsec2 = 0.0;      // of all these together

    friend bool operator==(const Gap&, const Gap&) = default;
};

// The present gap.
struct OpenGap {
    bool open = false;
    Gap gap{};
    double constant_arcsec = 0.0;  // mean of the extrapolation points: all that a gap that is too long gets

    friend bool operator==(const OpenGap&, const OpenGap&) = default;
};

// A gap that is over and waits for the ticks after it, and then for the tick in which its correction is due.
struct PendingGap {
    Gap gap{};
    std::int64_t due_tick = 0;
    std::int16_t ready_before = 0;  // ticks; before that tick its last point lies
    std::int8_t sign_after = 1, mode_after = 1;
    std::int8_t job = -1;  // that estimates it; -1: none
    bool is_reported = false;
    ExactSum correction_arcsec{};  // pending: final minus delivered, of the gap and of the ticks that it amended

    friend bool operator==(const PendingGap&, const PendingGap&) = default;
};

struct GapBridgeState {
    std::int64_t next_tick = 0, next_final = 0;
    OpenGap gap{};
    int n_pending = 0;
    // Magnetic drift in a tick of mode +1 that is still in the values, as far as it is known. The points of a gap lose
    // it, for at the gap it steps: an estimate across it would take the step for a false angle or for motion.
    double magnetic_arcsec = 0.0;
    double magnetic_variance_arcsec2 = 0.0;
    double common_arcsec2 = 0.0;          // of the last measured tick, as in TickInput
    bool with_phase = false;              // the readings have the place within the count (note_phase)
    ExactSum rounding_residual_arcsec{};  // sum of the rounding errors of the corrections so far
    MotionSpread spread{};
    SwitchLight light{};
    RelockScale scale{};
    BackgroundWork background{};
    std::array<PendingGap, max_pending_gaps> pending{};
    std::array<HistoryTick, history_ticks> history{};

    friend bool operator==(const GapBridgeState&, const GapBridgeState&) = default;
};

// Of a state, or of one that is only read.
[[nodiscard]] auto& at(auto& state, std::int64_t tick) noexcept {
    return state.history[static_cast<std::size_t>(tick % history_ticks)];
}

}  // namespace zlg::core
