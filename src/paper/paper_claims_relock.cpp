// The claims about the false drift after re-lock.

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include <zlg/config/config.hpp>
#include <zlg/design/initial_miss.hpp>
#include <zlg/design/relock_loop.hpp>
#include <zlg/design/relock_tables.hpp>

#include "paper_claims_parts.hpp"

namespace zlg::paper {
namespace {

using design::Decay;
using design::TickDrifts;
using enum Verdict;

constexpr double tick_s = design::table_tick_s;

// A loop as (10) has it, for formulas that presume one: 3.5 ticks, the twin's exponential mode.
constexpr double tau_ticks = 3.5;
const design::RelockModel exponential{Decay::exponential, 34100.0, tau_ticks* tick_s, 0.0};

design::RelockFit fit(Decay decay) { return design::fit_relock(decay, design::measured_arcsec_s); }

double greatest_difference(const TickDrifts& a, const TickDrifts& b) {
    double greatest = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) greatest = std::max(greatest, std::abs(a[i] - b[i]));
    return greatest;
}

// Angle that a correction leaves on a fitted loop.
double left_arcsec(const design::RelockFit& of, const TickDrifts& corrected) {
    double sum = 0.0;
    for (std::size_t i = 0; i < corrected.size(); ++i) sum += tick_s * (of.drift_arcsec_s[i] - corrected[i]);
    return sum;
}

double left_by_frequency_arcsec(bool with_first_tick) {
    const design::RelockFit loop = fit(Decay::slew_tail);
    TickDrifts corrected = design::corrected_by_frequency_arcsec_s(loop.model);
    if (!with_first_tick) corrected[0] = 0.0;
    return left_arcsec(loop, corrected);
}

double left_by_detuning_arcsec() {
    const design::RelockFit loop = fit(Decay::slew_tail);
    return left_arcsec(loop, design::corrected_by_detuning_arcsec_s(loop.model));
}

// --- the loop --------------------------------------------------------------------------------------------------------

Claim miss_claim() {
    const config::Config gyro;
    constexpr double known_to = 0.01;
    const design::InitialMiss miss =
        design::initial_miss({.half_wave_v = gyro.piezo.half_wave_v, .half_wave_error_ratio = known_to});
    const double needed = gyro.perimeter.miss_lambda;
    return {"before eq (10)",
            "The miss of a switch is the error of the half-wave voltage, a step of the DAC and the hysteresis of the "
            "piezos.",
            not_supported,
            fmt::format(
                "With the voltage known to {:.0f} %, usual piezos, and creep as a fourth cause they add up to {:.3f} "
                "wavelengths at worst. The tables need about {:.2f}, an error of {:.0f} V of {:.0f}: no routine "
                "switch.",
                100.0 * known_to, miss.worst_lambda, needed, design::voltage_of_miss_v(needed, gyro.piezo.half_wave_v),
                gyro.piezo.half_wave_v)};
}

Claim exponential_claim() {
    const auto tau = design::local_time_constants_s(design::measured_arcsec_s);
    return {"eq (10)", "After the loop is closed the detuning decays exponentially.", not_supported,
            fmt::format(
                "The tables say otherwise: their time constant would fall from {:.1f} to {:.1f} and {:.1f} ms. Rms of "
                "the best fits: exponential {:.0f}, constant slew {:.0f}, slew with exponential tail {:.0f}, "
                "critically damped second order {:.0f} deg/h.",
                1e3 * tau[0], 1e3 * tau[1], 1e3 * tau[2], fit(Decay::exponential).rms_arcsec_s,
                fit(Decay::slew).rms_arcsec_s, fit(Decay::slew_tail).rms_arcsec_s, fit(Decay::critical).rms_arcsec_s)};
}

// --- by frequency ----------------------------------------------------------------------------------------------------

Claim frequency_formula_claim() {
    const double q = std::exp(-1.0 / tau_ticks);
    const double printed = std::pow(std::exp(-1.0 / tau_ticks - 1.0), 2.0);
    const double exact =
        greatest_difference(design::corrected_by_frequency_arcsec_s(exponential), design::drift_arcsec_s(exponential));
    return {
        "eq (11)", "Four formulas for the false drift of tick i from the measured bias frequency.", misprint,
        fmt::format("chi, a minus sign and a factor 1/T are missing, the root is the 2(i-1)-th, and twice the 1 stands "
                    "in the exponent: at tau = {} T the squared bracket is {:.4f}, printed {:.4f}. Put right they are "
                    "one, drift = (f_i - f0) (1 - q)/(1 + q), which needs no chi and on an exponential loop errs by "
                    "{:.3f} deg/h.",
                    tau_ticks, (1.0 - q) * (1.0 - q), printed, exact)};
}

Claim first_tick_claim() {
    return {"eq (11)", "By frequency the correction can begin with the second tick only.", not_supported,
            fmt::format(
                "Tick 1 is corrected one tick later, with the q of tick 2. On the loop fitted to the tables it takes "
                "what is left from {:.1f} to {:.1f} arcsec.",
                left_by_frequency_arcsec(false), left_by_frequency_arcsec(true))};
}

Claim half_difference_claim() {
    const double acceleration =
        2.0 * std::numbers::pi * paper_oscillation.frequency_hz * paper_oscillation.amplitude_arcsec_s;
    return {"after eq (11)", "Half the difference of the two halves' frequencies is the bias, whatever the rotation.",
            agrees,
            fmt::format(
                "Right at a constant rate. Of an angular acceleration a quarter of a tick's worth leaks in: {:.0f} "
                "\"/s at the worst phase of {:.0f} \"/s and {:.0f} Hz. The detuning signal is immune.",
                0.25 * tick_s * acceleration, paper_oscillation.amplitude_arcsec_s, paper_oscillation.frequency_hz)};
}

Claim table_1_claim() {
    const auto raw = design::summarise(design::measured_arcsec_s, {});
    const auto left = design::summarise(design::measured_arcsec_s, design::table1_computed_arcsec_s);
    const design::RelockFit loop = fit(Decay::slew_tail);
    const TickDrifts by = design::corrected_by_frequency_arcsec_s(loop.model);
    return {"table 1", "Corrected by frequency, the false angle falls from 43 to 27 arcsec, or from 22 to 7.", misprint,
            fmt::format(
                "The sums are {:.1f}, {:.1f}, {:.1f} and {:.1f} arcsec; the mean of {} is printed as 1362. The misfit "
                "is that of a loop that slews: fitted, it predicts {:.0f}, {:.0f} and {:.0f} deg/h left on ticks 2 "
                "to 4.",
                raw.angle_arcsec, left.angle_arcsec, raw.angle_without_first_arcsec, left.angle_without_first_arcsec,
                left.mean_arcsec_s, loop.drift_arcsec_s[1] - by[1], loop.drift_arcsec_s[2] - by[2],
                loop.drift_arcsec_s[3] - by[3])};
}

// --- by detuning -----------------------------------------------------------------------------------------------------

// Mean detuning of the first half of a tick as (12) has it in print.
double mean_as_printed(int tick) {
    return 2.0 * tau_ticks * (1.0 - std::exp(-0.5 / tau_ticks)) * std::exp(-0.5 * (tick - 1) / tau_ticks);
}

Claim exponents_claim() {
    const auto right = [](int tick) { return design::half_means(exponential, 2 * (tick - 1)).d; };
    return {"eq (12)", "Mean detunings of both halves of tick i, falling by half a tick's decay from tick to tick.",
            wrong,
            fmt::format(
                "The exponents are (i-1)T/tau and (2i-1)T/2tau. Right for tick 1 only: at tau = {} T the first half "
                "of tick 2 has {:.3f} of the miss, not {:.3f}, and that of tick 4 {:.3f}, not {:.3f}.",
                tau_ticks, right(2), mean_as_printed(2), right(4), mean_as_printed(4))};
}

Claim ratio_claim() {
    return {"eq (13)", "Decay and miss follow from the ratio of the two halves' mean detunings.", agrees,
            fmt::format(
                "Right, lambda_1 being the detuning of tick 1: on an exponential loop the drift comes out to {:.3f} "
                "deg/h, and on the slewing loop fitted to the tables {:.2f} arcsec in all are left. Unlike (11), "
                "(13) needs the product chi f0, which (11) lacks in print.",
                greatest_difference(design::corrected_by_detuning_arcsec_s(exponential),
                                    design::drift_arcsec_s(exponential)),
                left_by_detuning_arcsec())};
}

Claim table_2_claim() {
    const auto left = design::summarise(design::measured_arcsec_s, design::table2_computed_arcsec_s);
    return {"table 2", "Corrected by detuning, 3.3 arcsec are left.", agrees,
            fmt::format(
                "The mean is {:.1f} deg/h and the sum {:.2f} arcsec, helped by residuals of both signs: their rms is "
                "{:.0f} deg/h.",
                left.mean_arcsec_s, left.angle_arcsec, left.rms_arcsec_s)};
}

Claim better_claim() {
    return {
        "after table 2", "The detuning signal corrects best, because it can begin with the first tick.", agrees,
        fmt::format("It does correct best, but begins no earlier than (11) can. What matters is the model of the loop, "
                    "which (13) hardly needs: on the fitted loop {:.2f} arcsec are left, by (11) with tick 1 {:.1f}. "
                    "Mean squares of the detuning need no model at all.",
                    left_by_detuning_arcsec(), left_by_frequency_arcsec(true))};
}

Claim sign_claim() {
    const config::Gyro gyro;
    const double deficit = design::bias_deficit_arcsec_s({gyro.scale_arcsec, gyro.bias_hz, gyro.bias_chi},
                                                         config::Perimeter{}.miss_lambda);
    return {
        "tables 1 and 2, eq (3)", "The false angles of the switches add up.", not_supported,
        fmt::format("The bias keeps its phase while the helicity changes, so the false angles of consecutive switches "
                    "have opposite signs and cancel in pairs. One is about T/4 times the loss of bias at the closing, "
                    "whatever the loop: {:.1f} arcsec at the miss of the tables.",
                    design::false_angle_law_arcsec(deficit, tick_s))};
}

}  // namespace

std::vector<Claim> claims_of_relock() {
    return {
        miss_claim(),
        exponential_claim(),
        frequency_formula_claim(),
        first_tick_claim(),
        half_difference_claim(),
        table_1_claim(),
        {"before eq (12)", "The mean detunings follow from eq (3).", misprint,
         "From (10), the decay of the detuning; (3) is the drift budget."},
        exponents_claim(),
        ratio_claim(),
        table_2_claim(),
        better_claim(),
        sign_claim(),
    };
}

}  // namespace zlg::paper
