#pragma once
// From event to event: what control and compensation are after halves that were not simulated one by one.
//
// A quiet half, with the loop locked and nothing wrong, leaves the control as it was but for its clocks, the slow means
// that follow warming and light, and what a digital loop has followed; and the compensation but for its clock, the
// angle, the filter of the magnetic drift and what it learns of the motion. Around every event halves are simulated one
// by one.

#include <cstdint>
#include <string>

#include <zlg/config/config.hpp>
#include <zlg/core/gyro_compensation.hpp>
#include <zlg/core/gyro_control.hpp>
#include <zlg/twin/leap.hpp>
#include <zlg/twin/motion.hpp>

namespace zlg::rig {

// How many ticks around an event are simulated half by half.
struct LeapPlan {
    std::int64_t start_ticks = 0;   // from the start
    std::int64_t after_ticks = 0;   // in a row, closed and valid, before the first leap
    std::int64_t before_ticks = 0;  // before the next event
    std::int64_t learn_ticks = 0;   // and before those so many are told half by half: compensation learns the motion
    bool all_singly = false;        // all are told, for the drift is followed
    twin::DetuningNoise noise{};    // of a digital loop
};

// start   the balance of the light is a mean over 400 ticks (light_balance.hpp), and twice as long is simulated; by
// phase five
//         times, in which the ellipse is learnt again and again
// after   the longest window behind a gap, twelve time constants of the loop for what its miss leaves, and the ticks in
//         which a half of it is still judged or corrected
// before  the longest window before a gap, and twelve time constants
// noise   the loop u <- u - g (dl + e), e the noise of a mean of samples and of the converter's steps, settles at
//         sigma^2 = e^2 g/(2 - g), and keeps 1 - g of it
// learn   the time in which what is learnt of the motion is forgotten to 1/e (gap_bridge_state.hpp)
[[nodiscard]] LeapPlan leap_plan(const config::Config& config, const core::GyroControlConfig& control,
                                 const core::GyroCompensationConfig& compensation, const twin::Motion& motion);

// Why every half of a gyro of fidelity `events` is simulated; empty where it takes closed-form steps.
[[nodiscard]] std::string why_lived(const config::Config& config, const twin::Motion& motion);

// The tick before which the loop opens next, if the control stays quiet in its mode; 2^62 where none is due.
//
// tick  that begins now.
[[nodiscard]] std::int64_t next_opening(const core::SwitchScheduleConfig& config,
                                        const core::SwitchScheduleState& state, std::int64_t tick, std::int8_t mode);

// Locked, and nothing wrong, for so long as the plan wants; at the border of two ticks.
[[nodiscard]] bool is_quiet(const LeapPlan& plan, const core::GyroControlState& state);

// A leap of the twin as control and compensation see it.
struct Leap : twin::Leap {
    std::int8_t mode = 1;        // that lases
    double before_c = 0.0;       // temperature at its start
    std::int32_t parts = 0;      // of a count beyond the counts: 1/65536
    std::int32_t end_parts = 0;  // by phase the place at its end, 0..65535
    bool has_place = false;
    bool learns = true;  // the motion, of halves that are told

    [[nodiscard]] std::int64_t ticks() const { return halves / 2; }
};

// The angle between the readings at both ends. By phase they err alike: the noise of the first reading, which the last
// half before the leap has shown, goes over to the second.
//
// last  record before it.
[[nodiscard]] Leap leap_of(twin::Leap&& leap, const core::HalfRecord& last);

void leap(const core::GyroControlConfig& config, core::GyroControlState& state, const Leap& leap);

// The state has no row that is still open, and no gap (drain).
//
// return  the angle of the leap, arcsec.
double leap(const core::GyroCompensationConfig& config, core::GyroCompensationState& state, const Leap& leap);

}  // namespace zlg::rig
