// The compensation after a leap.

#include <cmath>
#include <cstddef>
#include <utility>

#include <zlg/core/common/handover.hpp>
#include <zlg/rig/leap.hpp>

namespace zlg::rig {
namespace {

// Readings of two halves, as the compensation makes them of their records.
struct TickAngles {
    double first_arcsec = 0.0;
    double second_arcsec = 0.0;

    [[nodiscard]] double sum() const { return first_arcsec + second_arcsec; }
};

// Counts and places of a half without the bias.
class HalfReader {
public:
    HalfReader(const core::GyroCompensationConfig& c, const core::GyroCompensationState& s, const Leap& leap)
        : scale_{c.gyro.scale.value()},
          noise_{leap.has_place ? c.gyro.fringe_noise_counts : -1.0},
          bias_arcsec_{s.bias_arcsec * leap.mode},
          place_{leap.start_place} {}

    double arcsec(const twin::QuietHalf& half) {
        double counts = static_cast<double>(half.counts);
        if (noise_ >= 0.0) {
            const double place = half.place + noise_ * half.place_deviate;
            counts += place - place_;
            place_ = place;
        }
        return scale_ * counts - half.bias_sign * bias_arcsec_;
    }

private:
    double scale_;
    double noise_;
    double bias_arcsec_;
    double place_;
};

bool learns(const core::GyroCompensationConfig& c, const core::GyroCompensationState& s) {
    const core::GapBridgeConfig bridge = bridge_of(c);
    const core::LearntMotion& motion = s.bridge.background.motion;
    return is_estimated(bridge) && motion.with_phase == s.bridge.with_phase && motion.moments.length > 0;
}

void learn(core::GapBridgeState& bridge, std::int64_t tick, const TickAngles& angles) {
    core::LearntMotion& motion = bridge.background.motion;
    if (motion.moments.step_halves == 2) {
        add(motion, 2 * tick + 1, true, angles.sum(), core::forget_ticks);
    } else {
        add(motion, 2 * tick, true, angles.first_arcsec, core::forget_ticks);
        add(motion, 2 * tick + 1, true, angles.second_arcsec, core::forget_ticks);
    }
    add(bridge.spread, true, angles.first_arcsec, angles.second_arcsec, core::forget_ticks);
}

// Tick by tick, as they are told.
//
// return  what the magnetic drift takes off.
double pass_singly(const core::GyroCompensationConfig& c, core::GyroCompensationState& s, const Leap& leap,
                   bool follows_drift) {
    HalfReader reader{c, s, leap};
    const bool is_learnt = leap.learns && learns(c, s);
    double subtracted = 0.0;
    std::int64_t tick = s.bridge.next_tick;
    for (std::size_t k = 0; k + 1 < leap.half.size(); k += 2, ++tick) {
        TickAngles angles{.first_arcsec = reader.arcsec(leap.half[k]),
                          .second_arcsec = reader.arcsec(leap.half[k + 1])};
        if (follows_drift) {
            const double due = step(c.gyro, c.magnetic, s.magnetic, {true, leap.mode, angles.sum()});
            angles.first_arcsec -= 0.5 * due;
            angles.second_arcsec -= 0.5 * due;
            subtracted += due;
        }
        if (is_learnt) learn(s.bridge, tick, angles);
    }
    return subtracted;
}

// What is learnt of the motion ends where it is not learnt in a leap.
void pass_clock(core::GapBridgeState& bridge, const Leap& leap) {
    core::LearntMotion& motion = bridge.background.motion;
    if (leap.half.empty() || !leap.learns) {
        if (motion.moments.length > 0) add(motion, 2 * bridge.next_tick, false, 0.0, core::forget_ticks);
        bridge.spread.goes_on = false;
    }
    bridge.next_tick += leap.ticks();
    bridge.next_final = bridge.next_tick;
    motion.next_tick = bridge.next_tick;
    core::hand_over(bridge.background.n_ticks, static_cast<std::uint32_t>(bridge.next_tick));
}

}  // namespace

Leap leap_of(twin::Leap&& passed, const core::HalfRecord& last) {
    Leap made{{std::move(passed)}};
    made.mode = last.mode;
    made.before_c = last.temperature_c;
    made.has_place = has_fringe(last);
    if (!made.has_place) return made;
    const std::int64_t start = static_cast<std::int64_t>(last.fringe);
    const std::int64_t end = start + std::llround(made.turned_counts * core::count_parts);
    made.counts = end >> 16;
    made.end_parts = static_cast<std::int32_t>(end & 0xffff);
    made.parts = made.end_parts - static_cast<std::int32_t>(start);
    return made;
}

double leap(const core::GyroCompensationConfig& c, core::GyroCompensationState& s, const Leap& leap) {
    const double scale = c.gyro.scale.value();
    const double read = scale * core::counts_and_parts(leap.counts, leap.parts);
    const bool follows_drift =
        c.magnetic.method != core::MagneticMethod::none || s.bridge.with_phase || s.magnetic.started;
    double subtracted = 0.0;
    if (!leap.half.empty())
        subtracted = pass_singly(c, s, leap, follows_drift);
    else if (follows_drift)
        subtracted = core::leap(c.gyro, c.magnetic, s.magnetic, leap.ticks(), read);
    if (leap.has_place) s.border = core::Border{leap.end_parts};
    s.bias_arcsec *= leap.bias_ratio;
    pass_clock(s.bridge, leap);
    s.angle.add(leap.counts, scale, read - subtracted, leap.parts);
    return read - subtracted;
}

}  // namespace zlg::rig
