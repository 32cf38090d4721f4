#include <algorithm>
#include <cmath>
#include <cstddef>

#include <zlg/chance/draw.hpp>
#include <zlg/rig/laser_calibration.hpp>
#include <zlg/trials/fault_campaign.hpp>

namespace zlg::trials {
namespace {

constexpr double grace_s = 1.0;  // after a fault, in which a gyro may still be about to recover

// Of any kind, evenly in its logarithm.
constexpr double shortest_s = 1e-3;
constexpr double longest_s = 60.0;
constexpr double longest_of_bench_s = 300.0;

constexpr double max_ramp_lambda = 4.0;

using chance::Draws;

// Slow enough for the polynomial of a gap.
void set_motion(const Draws& draws, config::Motion& motion) {
    const std::size_t kind = draws.of("motion.kind").below(3);
    motion.kind =
        kind == 0 ? config::MotionKind::rest : (kind == 1 ? config::MotionKind::constant : config::MotionKind::sine);
    if (kind == 1) {
        chance::Draw rate = draws.of("motion.rate_arcsec_s");
        const double sign = rate.sign();
        motion.rate_arcsec_s = sign * rate.within_log(1e1, 1e5);
    }
    motion.amplitude_arcsec_s = {draws.of("motion.amplitude_arcsec_s").within(100.0, 3000.0)};
    motion.frequency_hz = {draws.of("motion.frequency_hz").within(0.05, 0.3)};
    motion.phase_deg = {draws.of("motion.phase_deg").within(0.0, 360.0)};
}

// Of one gyro in three the motion is the default one, of one in four a sway with the vibration of its base.
void set_bench(const Draws& draws, config::Config& c) {
    if (draws.of("fast motion").is_one_in(3)) c.motion = {};
    if (draws.of("sway and vibration").is_one_in(4)) {
        c.motion = {.kind = config::MotionKind::sum};
        c.motion.amplitude_arcsec_s = {draws.of("sway.amplitude_arcsec_s").within(1e3, 2e4),
                                       draws.of("vibration.amplitude_arcsec_s").within(100.0, 5000.0)};
        c.motion.frequency_hz = {draws.of("sway.frequency_hz").within(0.1, 2.0),
                                 draws.of("vibration.frequency_hz").within(20.0, 90.0)};
        c.motion.phase_deg = {0.0, 90.0};
    }
    if (draws.of("gyro.readout").is_one_in(3)) c.gyro.readout = config::Readout::phase;
    c.light.gain_b = draws.of("light.gain_b").within_log(0.7, 1.4);
    c.light.gain_drift_per_h = draws.of("light.gain_drift_per_h").within(-0.05, 0.05);
    c.light.offset_a = draws.of("light.offset_a").within(-0.01, 0.01);
    c.light.offset_b = draws.of("light.offset_b").within(-0.01, 0.01);
    c.light.power_decay_per_h = draws.of("light.power_decay_per_h").within(0.0, 1.0);
}

config::Config random_gyro(const Draws& draws, bool formula) {
    config::Config c;
    c.run.seed = draws.of("run.seed").below(1'000'000'000);
    c.switching.interval_s = 2.0;
    c.perimeter.miss_lambda = 0.0;
    c.perimeter.loop = draws.of("perimeter.loop").is_one_in(2) ? config::Loop::analog : config::Loop::digital;
    if (formula && draws.of("exponential loop").is_one_in(3)) c.perimeter.loop = config::Loop::exponential;
    c.perimeter.relock_halves = 4;
    if (c.perimeter.loop != config::Loop::exponential) {
        c.piezo.hysteresis = 0.12;
        c.piezo.creep_per_decade = 0.015;
        c.piezo.half_wave_error = draws.of("piezo.half_wave_error").within(-0.02, 0.02);
    }
    set_motion(draws, c.motion);
    return c;
}

bool concerns_a_switch(twin::FaultKind kind) {
    return kind == twin::FaultKind::switch_wrong_mode || kind == twin::FaultKind::switch_no_mode;
}

twin::Fault drawn_fault(const Draws& draws, twin::FaultKind kind, Surroundings surroundings) {
    const bool on_bench = surroundings == Surroundings::bench;
    const double at_s = on_bench && draws.of("from power-up").is_one_in(5) ? 0.0 : draws.of("at_s").within(2.5, 4.5);
    twin::Fault fault = twin::random_fault(kind, at_s, draws.of("seed of the fault").bits());
    fault.duration_s = draws.of("duration_s").within_log(shortest_s, on_bench ? longest_of_bench_s : longest_s);
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
                        bool many_at_once, Surroundings surroundings) {
    const Draws draws{.seed = seed, .cause = chance::Cause::fault_trial};
    const bool averaged = fidelity == config::Fidelity::averaged;
    FaultTrial trial{.config = random_gyro(draws, averaged && kind && !many_at_once &&
                                                      twin::facts(*kind).acts_on == twin::FaultActs::elsewhere),
                     .watched_s = 4.0,
                     .end_s = 7.5};
    const bool on_bench = surroundings == Surroundings::bench;
    if (on_bench) set_bench(draws, trial.config);
    trial.config.gyro.fidelity = fidelity;
    if (!averaged) trial.config = rig::calibrated_by_laser(trial.config);
    if (!kind) return trial;
    trial.fault = drawn_fault(draws, *kind, surroundings);
    trial.watched_s = end_s(*trial.fault) + grace_s;
    const std::size_t n_others = !many_at_once ? 0 : (on_bench ? 1 + draws.of("other faults").below(5) : 1);
    for (std::uint32_t k = 1; k <= n_others; ++k) {
        const Draws of_other{.seed = seed, .cause = chance::Cause::fault_trial, .trial = k};
        const Draws& of_kind = k == 1 ? draws : of_other;
        const std::size_t kind_of_other = of_kind.of("kind of the other fault").below(twin::n_fault_kinds);
        trial.others.push_back(drawn_fault(of_other, twin::all_fault_kinds.at(kind_of_other), surroundings));
        trial.watched_s = std::max(trial.watched_s, end_s(trial.others.back()) + grace_s);
    }
    // Ends half-way between two switches.
    trial.end_s = 2.0 * std::ceil(0.5 * (trial.watched_s + 1.0)) + 1.5;
    return trial;
}

}  // namespace zlg::trials
