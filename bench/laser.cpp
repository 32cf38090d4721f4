// A laser gyro in multiples of real time, and its optical phase against fixed-step RK4 and Boost.odeint on the same
// equation at equal accuracy, all in one run.

#include <algorithm>
#include <cmath>
#include <complex>
#include <vector>

#include <fmt/format.h>
#include <zlg/config/config.hpp>
#include <zlg/rig/closed_loop.hpp>
#include <zlg/rig/wiring.hpp>
#include <zlg/twin/laser_table.hpp>
#include <zlg/twin/slip_phase.hpp>

#include <laser/laser_beats.hpp>

#include "laser_phases.hpp"
#include "paired.hpp"

namespace {

using namespace zlg;
using namespace zlg::bench;

constexpr Error allowed{.tick_rad = 1e-4, .edge_rad = 1e-5};
constexpr int n_pairs = 6;
volatile double sink = 0.0;  // what is computed must not be left out

double times_real_time(int ticks, double seconds) { return ticks * tick_s / seconds; }

constexpr twin::LaserConfig beat_config{.lock_in_left_hz = lock_hz, .lock_in_right_hz = lock_hz};

// In one piece, as in the twin while the perimeter is controlled.
void advance(twin::LaserBeats& beats, const Part& part) {
    twin::Stretch s{.duration_s = part.duration_s, .common_hz = rate_hz};
    s.field_g = {part.from_g, 0.5 * (part.from_g + part.to_g), part.to_g};
    (void)(part.is_edge() ? beats.edge(s) : beats.plateau(s));
}

// From wherever the phase stands, tick by tick.
Error error_of_twin(const twin::LaserTable& table) {
    twin::LaserBeats beats{beat_config, 1, table};
    Error worst;
    for (int tick = 0; tick < 12; ++tick) {
        const twin::Turns start = beats.beats().left();
        const TickPhases phases = exact_tick(table.exact(), start.part_rad());
        for (const Part& part : tick_parts) {
            const twin::Turns before = beats.beats().left();
            advance(beats, part);
            if (!part.is_edge()) continue;
            const double turned = exact(table.exact(), part, before.part_rad()) - before.part_rad();
            worst.edge_rad = std::max(worst.edge_rad, std::abs(tau * beats.beats().left().minus(before) - turned));
        }
        const double turned = phases.back() - phases.front();
        worst.tick_rad = std::max(worst.tick_rad, std::abs(tau * beats.beats().left().minus(start) - turned));
    }
    return worst;
}

void run_twin_phases(const twin::LaserTable& table, int n) {
    twin::LaserBeats beats{beat_config, 1, table};
    for (int tick = 0; tick < n; ++tick) {
        for (const Part& part : tick_parts) advance(beats, part);
    }
    sink = beats.beats().left().part;
}

// The coarsest of ever finer settings that is as good as asked for.
template <class MakeStep>
double coarsest(const std::vector<TickPhases>& ticks, double start, const Error& asked, const MakeStep& make) {
    double setting = start;
    while (!error_of(ticks, make(setting)).is_within(asked) && setting > 1e-12 * start) setting *= 0.9;
    return setting;
}

// How many times faster the twin's phases are.
template <class Step>
double compare(const char* name, const std::vector<TickPhases>& ticks, const twin::LaserTable& table, double setting,
               const Step& step) {
    constexpr int n_twin = 10'000;
    constexpr int n_other = 50;
    const auto other = [&] {
        double psi = 0.3;
        for (int tick = 0; tick < n_other; ++tick) {
            for (const Part& part : tick_parts) psi = std::remainder(step(part, psi), tau);
        }
        sink = psi;
    };
    const Paired t = paired(n_pairs, other, [&] { run_twin_phases(table, n_twin); });
    const double ratio = t.ratio * n_twin / n_other;
    const Error error = error_of(ticks, step);
    fmt::print("{:<32}{:>10.1e}{:>12.1e}{:>13.1e}{:>13.0f}{:>14.1f}\n", name, setting, error.tick_rad, error.edge_rad,
               times_real_time(n_other, t.work_s), ratio);
    return ratio;
}

// Both contenders at an accuracy; the twin's advantage over RK4.
double compare_at(const Error& asked, const std::vector<TickPhases>& ticks, const twin::LaserTable& table) {
    const auto by_rk4 = [&](double step_s) {
        return [&, step_s](const Part& part, double psi) { return rk4(table, part, psi, step_s); };
    };
    const auto by_dopri5 = [&](double tolerance_rad) {
        return [&, tolerance_rad](const Part& part, double psi) { return dopri5(table, part, psi, tolerance_rad); };
    };
    const double step_s = coarsest(ticks, 2e-5, asked, by_rk4);
    const double ratio = compare("RK4, step in s", ticks, table, step_s, by_rk4(step_s));
    const double tolerance_rad = coarsest(ticks, 1e-2, asked, by_dopri5);
    compare("odeint dopri5, tolerance in rad", ticks, table, tolerance_rad, by_dopri5(tolerance_rad));
    return ratio;
}

template <class Phase, class Reverse>
void run_reversals(Phase& phase, int ticks, twin::Coupling coupling, const Reverse& reverse) {
    constexpr double bias_hz = 60430.0;
    for (int tick = 0; tick < ticks; ++tick) {
        for (const double sign : {1.0, -1.0}) {
            phase.plateau(rate_hz + sign * bias_hz, coupling, plateau_s);
            reverse(phase, rate_hz + sign * bias_hz, rate_hz - sign * bias_hz);
        }
    }
    sink = phase.value().part;
}

// Two plateaus and two reversals a tick, by the closed form of the slip and by the exact stepper.
double slip_formula() {
    constexpr int n = 200'000;
    const twin::Coupling c = twin::Backscatter::equal(lock_hz, 0.7).coupling(1.0, 1.0);
    const auto by_formula = [&](twin::SlipPhase& phase, double from_hz, double to_hz) {
        (void)phase.reversal(from_hz, to_hz, c, 2.0 * half_edge_s);
    };
    const auto exactly = [&](twin::BeatPhase& phase, double from_hz, double to_hz) {
        phase.ramp(from_hz, to_hz, c, 2.0 * half_edge_s);
    };
    const auto slips = [&] {
        twin::SlipPhase phase;
        run_reversals(phase, n, c, by_formula);
    };
    const auto beats = [&] {
        twin::BeatPhase phase;
        run_reversals(phase, n, c, exactly);
    };
    // After one tick from the same phase; the ripple f_L/f cos psi, by which the exact phase differs, is no error.
    double worst = 0.0;
    const auto ripple = [&](const twin::Turns& psi) {
        return (c * std::polar(1.0, psi.part_rad())).real() / (rate_hz + 60430.0) / tau;
    };
    for (int k = 0; k < 64; ++k) {
        twin::Turns start;
        start.add(k / 64.0);
        twin::Turns smooth = start;
        smooth.add(-ripple(start));
        twin::BeatPhase phase{start};
        twin::SlipPhase slip{smooth};
        run_reversals(phase, 1, c, exactly);
        run_reversals(slip, 1, c, by_formula);
        worst = std::max(worst, tau * std::abs(slip.value().minus(phase.value()) + ripple(phase.value())));
    }
    const Paired t = paired(n_pairs, slips, beats);
    fmt::print("{:<32}{:>10}{:>12.1e}{:>13}{:>13.0f}\n", "phases at constant light: slip", "", worst, "",
               times_real_time(n, t.work_s));
    fmt::print("{:<32}{:>10}{:>12}{:>13}{:>13.0f}\n", "phases at constant light: exact", "", "", "",
               times_real_time(n, t.reference_s));
    return times_real_time(n, t.work_s);
}

// The twin alone, and the twin with the control that shifts its reversals.
Paired whole_gyro(int n_halves) {
    config::Config config;
    config.gyro.fidelity = config::Fidelity::laser;
    config.gyro.dither = core::DitherMethod::automatic;
    const auto alone = [&] {
        twin::Twin twin{rig::twin_config(config), rig::motion(config)};
        const core::ActuatorFrame actuator = initial_actuator(rig::control_config(config));
        for (int h = 0; h < n_halves; ++h) sink = twin.advance(actuator).truth.perimeter_v;
    };
    const auto controlled = [&] {
        rig::ClosedLoop loop{config, rig::motion(config)};
        for (int h = 0; h < n_halves; ++h) sink = loop.advance().record.piezo_v;
    };
    return paired(n_pairs, controlled, alone);
}

}  // namespace

int main() {
    const twin::LaserTable table{twin::LaserConfig{}, field_g};
    std::vector<TickPhases> ticks;
    for (int k = 0; k < 8; ++k) ticks.push_back(exact_tick(table.exact(), tau * k / 8.0));

    constexpr int n = 100'000;
    const Error own = error_of_twin(table);
    const double own_s = seconds([&] { run_twin_phases(table, n); });
    fmt::print("{:<32}{:>10}{:>12}{:>13}{:>13}{:>14}\n", "phases of a tick of 5 ms", "setting", "rad a tick",
               "rad an edge", "x real time", "twin's times");
    fmt::print("{:<32}{:>10}{:>12.1e}{:>13.1e}{:>13.0f}{:>14}\n", "twin", "", own.tick_rad, own.edge_rad,
               times_real_time(n, own_s), 1);
    double at_least = compare_at(allowed, ticks, table);
    at_least = std::min(at_least, compare_at(own, ticks, table));
    const double slip = slip_formula();

    constexpr int n_halves = 100'000;
    const Paired gyro = whole_gyro(n_halves);
    const double twin = times_real_time(n_halves / 2, gyro.reference_s);
    fmt::print("whole twin, 16 light samples: {:.0f} times real time\n", twin);
    fmt::print("closed loop, shifted reversals: {:.0f} times real time\n", times_real_time(n_halves / 2, gyro.work_s));
    fmt::print("allowed: {:.0e} rad a tick, {:.0e} an edge; phases 20 times RK4; slip 1000, twin 300 times real time\n",
               allowed.tick_rad, allowed.edge_rad);
    return own.is_within(allowed) && at_least >= 20.0 && slip >= 1000.0 && twin >= 300.0 ? 0 : 1;
}
