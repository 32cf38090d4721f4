// The claims about the false drift after re-lock.

#include <algorithm>
#include <cmath>
#include <numbers>

#include <zlg/config/config.hpp>
#include <zlg/design/initial_miss.hpp>
#include <zlg/design/relock_loop.hpp>
#include <zlg/design/relock_tables.hpp>

#include "paper_claims_parts.hpp"

namespace zlg::paper {
namespace {

using namespace design;

// A loop as (10) has it, for formulas that presume one: 3.5 ticks, the twin's exponential mode.
constexpr double tau_ticks = 3.5;
const design::RelockModel exponential{Decay::exponential, 34100.0, tau_ticks* table_tick_s, 0.0};

design::RelockFit fit(Decay decay) { return design::fit_relock(decay, measured_arcsec_s); }

// Greatest error of a correction on an exponential loop.
double greatest_error(const TickDrifts& corrected) {
    double greatest = 0.0;
    for (const double left : summarise(corrected, design::drift_arcsec_s(exponential)).residual_arcsec_s)
        greatest = std::max(greatest, std::abs(left));
    return greatest;
}

// What the corrections leave on the loop that explains the tables.
struct FittedLoop {
    design::RelockFit loop = fit(Decay::slew_tail);
    design::TableSummary by_frequency =
        summarise(loop.drift_arcsec_s, design::corrected_by_frequency_arcsec_s(loop.model));
    design::TableSummary by_detuning =
        summarise(loop.drift_arcsec_s, design::corrected_by_detuning_arcsec_s(loop.model));

    // As the paper has it, which leaves tick 1 as it is.
    [[nodiscard]] double from_tick_2_arcsec() const {
        return by_frequency.angle_without_first_arcsec + table_tick_s * loop.drift_arcsec_s[0];
    }
};

std::vector<Finding> claims_of_loop() {
    const config::Config gyro;
    constexpr double known_to = 0.01;
    const double half_wave_v = gyro.piezo.half_wave_v;
    const double needed = gyro.perimeter.miss_lambda;
    const auto miss = design::initial_miss({.half_wave_v = half_wave_v, .half_wave_error_ratio = known_to});
    const auto tau = design::local_time_constants_s(measured_arcsec_s);
    return {
        {"before eq (10)",
         {100.0 * known_to, miss.worst_lambda, needed, design::voltage_of_miss_v(needed, half_wave_v), half_wave_v}},
        {"eq (10)",
         {1e3 * tau[0], 1e3 * tau[1], 1e3 * tau[2], fit(Decay::exponential).rms_arcsec_s, fit(Decay::slew).rms_arcsec_s,
          fit(Decay::slew_tail).rms_arcsec_s, fit(Decay::critical).rms_arcsec_s}},
    };
}

std::vector<Finding> claims_of_frequency() {
    const FittedLoop fitted;
    const double q = std::exp(-1.0 / tau_ticks);
    const double amplitude = paper_oscillation.amplitude_arcsec_s;
    const double acceleration = 2.0 * std::numbers::pi * paper_oscillation.frequency_hz * amplitude;
    const auto raw = summarise(measured_arcsec_s, {});
    const auto left = summarise(measured_arcsec_s, design::table1_computed_arcsec_s);
    const TickDrifts& predicted = fitted.by_frequency.residual_arcsec_s;
    return {
        {"eq (11)",
         {tau_ticks, (1.0 - q) * (1.0 - q), std::pow(std::exp(-1.0 / tau_ticks - 1.0), 2.0),
          greatest_error(design::corrected_by_frequency_arcsec_s(exponential))}},
        {"eq (11)", {fitted.from_tick_2_arcsec(), fitted.by_frequency.angle_arcsec}},
        {"after eq (11)", {0.25 * table_tick_s * acceleration, amplitude, paper_oscillation.frequency_hz}},
        {"table 1",
         {raw.angle_arcsec, left.angle_arcsec, raw.angle_without_first_arcsec, left.angle_without_first_arcsec,
          left.mean_arcsec_s, predicted[1], predicted[2], predicted[3]}},
    };
}

// Mean detuning of the first half of a tick: by (10), and as (12) has it in print.
double mean_detuning(int tick) { return design::half_means(exponential, 2 * (tick - 1)).d; }
double mean_as_printed(int tick) {
    return 2.0 * tau_ticks * (1.0 - std::exp(-0.5 / tau_ticks)) * std::exp(-0.5 * (tick - 1) / tau_ticks);
}

std::vector<Finding> claims_of_detuning() {
    const FittedLoop fitted;
    const config::Config gyro;
    const double deficit = design::bias_deficit_arcsec_s(
        {gyro.gyro.scale_arcsec, gyro.gyro.bias_hz, gyro.gyro.bias_chi}, gyro.perimeter.miss_lambda);
    const auto left = summarise(measured_arcsec_s, design::table2_computed_arcsec_s);
    return {
        {"before eq (12)", {}},
        {"eq (12)", {tau_ticks, mean_detuning(2), mean_as_printed(2), mean_detuning(4), mean_as_printed(4)}},
        {"eq (13)",
         {greatest_error(design::corrected_by_detuning_arcsec_s(exponential)), fitted.by_detuning.angle_arcsec}},
        {"table 2", {left.mean_arcsec_s, left.angle_arcsec, left.rms_arcsec_s}},
        {"after table 2", {fitted.by_detuning.angle_arcsec, fitted.by_frequency.angle_arcsec}},
        {"tables 1 and 2, eq (3)", {design::false_angle_law_arcsec(deficit, table_tick_s)}},
    };
}

}  // namespace

std::vector<Finding> claims_of_relock() { return joined({claims_of_loop, claims_of_frequency, claims_of_detuning}); }

}  // namespace zlg::paper
