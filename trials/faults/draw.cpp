#include <algorithm>
#include <cmath>
#include <cstddef>

#include <zlg/numeric/draw.hpp>
#include <zlg/rig/laser_calibration.hpp>
#include <zlg/trials/fault_campaign.hpp>

namespace zlg::trials {
namespace {

constexpr double grace_s = 1.0;  // after a fault, in which a gyro may still be about to recover

// Of any kind, evenly in its logarithm.
constexpr double shortest_s = 1e-3;
constexpr double longest_s = 60.0;

constexpr double max_ramp_lambda = 4.0;

using numeric::Draw;

// Slow enough for the polynomial of a gap.
void set_motion(Draw& draw, config::Motion& motion) {
    const std::size_t kind = draw.below(3);
    motion.kind =
        kind == 0 ? config::MotionKind::rest : (kind == 1 ? config::MotionKind::constant : config::MotionKind::sine);
    if (kind == 1) {
        const double sign = draw.below(2) == 0 ? 1.0 : -1.0;
        motion.rate_arcsec_s = sign * std::pow(10.0, draw.within(1.0, 5.0));
    }
    motion.amplitude_arcsec_s = {draw.within(100.0, 3000.0)};
    motion.frequency_hz = {draw.within(0.05, 0.3)};
    motion.phase_deg = {draw.within(0.0, 360.0)};
}

config::Config random_gyro(Draw& draw, bool formula) {
    config::Config c;
    c.run.seed = draw.below(1'000'000'000);
    c.switching.interval_s = 2.0;
    c.perimeter.miss_lambda = 0.0;
    c.perimeter.loop = draw.below(2) == 0 ? config::Loop::analog : config::Loop::digital;
    if (formula && draw.below(3) == 0) c.perimeter.loop = config::Loop::exponential;
    c.perimeter.relock_halves = 4;
    if (c.perimeter.loop != config::Loop::exponential) {
        c.piezo.hysteresis = 0.12;
        c.piezo.creep_per_decade = 0.015;
        c.piezo.half_wave_error = draw.within(-0.02, 0.02);
    }
    set_motion(draw, c.motion);
    return c;
}

bool concerns_a_switch(twin::FaultKind kind) {
    return kind == twin::FaultKind::switch_wrong_mode || kind == twin::FaultKind::switch_no_mode;
}

twin::Fault drawn_fault(Draw& draw, twin::FaultKind kind, std::uint64_t seed) {
    twin::Fault fault = twin::random_fault(kind, draw.within(2.5, 4.5), seed);
    fault.duration_s = shortest_s * std::pow(longest_s / shortest_s, draw.within(0.0, 1.0));
    // Of a switch: the one at 4 s. What the perimeter gains stays, and the piezo has only so much of it.
    if (concerns_a_switch(kind)) {
        fault.at_s = 3.99;
        fault.duration_s = std::max(0.02, fault.duration_s);
    }
    if (kind == twin::FaultKind::perimeter_ramp)
        fault.size = std::copysign(std::min(std::abs(fault.size), max_ramp_lambda / fault.duration_s), fault.size);
    return fault;
}

double end_s(const twin::Fault& fault) { return fault.at_s + fault.duration_s; }

}  // namespace

FaultTrial random_trial(std::optional<twin::FaultKind> kind, std::uint64_t seed, config::Fidelity fidelity,
                        bool two_at_once) {
    Draw draw{seed};
    const bool averaged = fidelity == config::Fidelity::averaged;
    FaultTrial trial{.config = random_gyro(draw, averaged && kind && !two_at_once &&
                                                     twin::facts(*kind).acts_on == twin::FaultActs::elsewhere),
                     .watched_s = 4.0,
                     .end_s = 7.5};
    trial.config.gyro.fidelity = fidelity;
    if (!averaged) trial.config = rig::calibrated_by_laser(trial.config);
    if (!kind) return trial;
    trial.fault = drawn_fault(draw, *kind, seed);
    trial.watched_s = end_s(*trial.fault) + grace_s;
    if (two_at_once) {
        trial.other = drawn_fault(draw, twin::all_fault_kinds.at(draw.below(twin::n_fault_kinds)), seed + 1);
        trial.watched_s = std::max(trial.watched_s, end_s(*trial.other) + grace_s);
    }
    // Ends half-way between two switches.
    trial.end_s = 2.0 * std::ceil(0.5 * (trial.watched_s + 1.0)) + 1.5;
    return trial;
}

}  // namespace zlg::trials
