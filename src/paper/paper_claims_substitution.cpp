// The claims about the substitution of the gap.

#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include <zlg/config/config.hpp>
#include <zlg/design/relock_tables.hpp>
#include <zlg/design/taylor.hpp>

#include "paper_claims_parts.hpp"

namespace zlg::paper {
namespace {

using design::Fit;
using enum Verdict;

constexpr double tick_s = design::table_tick_s;
constexpr double amplitude_arcsec_s = paper_oscillation.amplitude_arcsec_s;
constexpr double oscillation_hz = paper_oscillation.frequency_hz;

double highest_hz(int order) {
    return design::highest_frequency_hz({Fit::interpolation, order, paper_gap_ticks}, amplitude_arcsec_s,
                                        paper_switch_error_arcsec);
}

std::vector<Claim> claims_before_the_fit() {
    const config::Config gyro;
    const double slew_v_s = gyro.piezo.slew_v_s;
    const double half_wave_v = gyro.piezo.half_wave_v;
    const double lsb = gyro.gyro.scale_arcsec;
    return {
        {"before eq (14)", "Without light in both directions the gyro is blind for 5 to 15 ms.", agrees,
         fmt::format("Plausible: a stage that slews {:.0f} V/ms takes {:.0f} ms for a half-wave of {:.0f} V. The "
                     "twin's gap is {} ticks, {:.0f} ms.",
                     1e-3 * slew_v_s, 1e3 * half_wave_v / slew_v_s, half_wave_v, gyro.switching.gap_ticks,
                     1e3 * tick_s * static_cast<double>(gyro.switching.gap_ticks))},
        {"before eq (14)", "The sampling theorem asks for ten samples in a period.", not_supported,
         fmt::format("It asks for two. Ten is a rule for polynomials: with three lost ticks, {:.0f} deg/h and {:.0f} "
                     "arcsec the quadratic goes to {:.1f} Hz, {:.0f} samples in a period, the constant to {:.1f} Hz.",
                     amplitude_arcsec_s, paper_switch_error_arcsec, highest_hz(2), 1.0 / (tick_s * highest_hz(2)),
                     highest_hz(0))},
        {"before eq (14)", "The noise of a tick is at most half a count.", wrong,
         fmt::format("Half a count is the most that one reading of the counter errs. A tick is the difference of two, "
                     "so it errs by up to a whole count, {:.2f} arcsec, with a triangular distribution of sigma "
                     "{:.2f}. The errors of neighbours are correlated and do not add up.",
                     lsb, design::counter_tick_sigma_arcsec(lsb))},
    };
}

// False angles of the ticks after a gap that a correction leaves.
std::vector<double> left_arcsec(const design::TickDrifts& computed) {
    std::vector<double> left;
    for (const double rate : design::summarise(design::measured_arcsec_s, computed).residual_arcsec_s)
        left.push_back(tick_s * rate);
    return left;
}

// What they do to the sum through a constant and through a parabola.
std::string through_fits(const design::TickDrifts& computed) {
    const auto of_order = [&](int order) {
        return std::abs(
            design::relock_through_fit_arcsec({Fit::interpolation, order, paper_gap_ticks}, left_arcsec(computed)));
    };
    return fmt::format("{:.1f} and {:.1f} arcsec", of_order(0), of_order(2));
}

std::vector<Claim> claims_of_procedure() {
    const double motion = worst_arcsec(Fit::interpolation, 2);
    const double noise = paper_noise_arcsec * noise_gain(Fit::interpolation, 2);
    const double relock = std::abs(design::relock_residual_arcsec({}, left_arcsec(design::table2_computed_arcsec_s)));
    return {
        {"eqs (14), (16) to (18)", "Extrapolate in the gap, interpolate after it, deliver the difference in one tick.",
         agrees,
         fmt::format("Right, signs included. What stays is the error of the interpolation alone: at the worst phase of "
                     "the oscillation constant, line and parabola extrapolate three ticks with {:.0f}, {:.0f} and "
                     "{:.0f} arcsec, and whichever was used, a quadratic interpolation ends with {:.1f}.",
                     worst_arcsec(Fit::extrapolation, 0), worst_arcsec(Fit::extrapolation, 1),
                     worst_arcsec(Fit::extrapolation, 2), motion)},
        {"eq (15)", "The left side of the interpolation is the predicted value.", misprint,
         "It is P_k, the value by both sides; the predicted one is that of (14). Eq (16) needs the two apart."},
        {"eq (15)", "The fit takes the first two ticks after the loop is closed.", not_supported,
         fmt::format("They are ticks 1 and 2 of the tables, the falsest of all; no order of the two corrections is "
                     "given. Into the sum of a constant and of a parabola they bring {} uncorrected, {} after table 1 "
                     "and {} after table 2. Re-lock must be corrected first.",
                     through_fits({}), through_fits(design::table1_computed_arcsec_s),
                     through_fits(design::table2_computed_arcsec_s))},
        {"eq (19)", "The greatest error of a switch is the root of the squares of motion and noise.", agrees,
         fmt::format("Right if both are rms or both 3 sigma. It omits what re-lock leaves: {:.1f} and {:.1f} arcsec of "
                     "motion and noise make {:.1f}, with the {:.1f} that table 2 leaves {:.1f} arcsec.",
                     motion, noise, design::switch_error_as_printed_arcsec(motion, noise), relock,
                     design::switch_error_arcsec(motion, noise, relock))},
        {"after eq (19)", "A constant and a line give the same, as the mean of a line is that of its four points.",
         agrees,
         fmt::format("Right of the sum over the gap, {:.2f} arcsec each at the worst phase. The reason is the symmetry "
                     "of the points about the gap; equally spaced they are not.",
                     worst_arcsec(Fit::interpolation, 1))},
    };
}

std::vector<Claim> claims_of_series() {
    constexpr double x_s = 0.003;
    const double phase = 2.0 * std::numbers::pi * oscillation_hz * x_s;
    const double half_gap = std::numbers::pi * oscillation_hz * tick_s * paper_gap_ticks;
    return {
        {"eq (20), t = 0", "Series of the oscillation about a zero crossing.", misprint,
         fmt::format("The cubic term has a coefficient of 4/3, not 1. {:.0f} ms from the crossing the rate is {:.0f} "
                     "deg/h, {:.0f} by the series, {:.0f} as printed.",
                     1e3 * x_s, amplitude_arcsec_s * std::sin(phase),
                     design::series_at_zero(paper_oscillation, x_s).sum(),
                     design::series_at_zero_as_printed(paper_oscillation, x_s).sum())},
        {"eq (20), extremum", "Series of the oscillation about its extremum.", agrees,
         fmt::format("{:.0f} ms from it the rate is {:.1f} deg/h, {:.1f} by the series.", 1e3 * x_s,
                     amplitude_arcsec_s * std::cos(phase), design::series_at_extremum(paper_oscillation, x_s).sum())},
        {"figures 7 to 10", "About t = 0 the angular velocity is constant, about the extremum it varies.", wrong,
         fmt::format(
             "The other way round. In a gap of three ticks about t = 0 the rate goes from {:.0f} to {:.0f} "
             "deg/h at nearly constant acceleration; about the extremum it falls by {:.0f} deg/h only, and it is "
             "the acceleration that varies.",
             -amplitude_arcsec_s * std::sin(half_gap), amplitude_arcsec_s * std::sin(half_gap),
             amplitude_arcsec_s * (1.0 - std::cos(half_gap)))},
    };
}

// A gap whose middle is a zero crossing: its response is real, so that it has no error.
double error_at_zero_arcsec() {
    const auto response = design::ErrorResponse({Fit::interpolation, 2, paper_gap_ticks});
    return std::abs(response(oscillation_hz).imag()) * amplitude_arcsec_s;
}

std::vector<Claim> claims_of_figures_8_to_10() {
    const auto part = [](int n) { return design::figure_time_s(n, tick_s) * oscillation_hz; };
    const auto list = [](int order) {
        return fmt::format("{:.1f}, {:.1f} and {:.1f} arcsec", worst_arcsec(Fit::interpolation, order, 1),
                           worst_arcsec(Fit::interpolation, order, 2), worst_arcsec(Fit::interpolation, order, 3));
    };
    return {
        {"figures 8 to 10", "The region of varying acceleration is the most dangerous.", agrees,
         fmt::format("It is the worst phase, {:.2f} arcsec for a constant and {:.2f} for a parabola over three ticks. "
                     "A gap with its middle at the zero crossing errs by {:.2f} arcsec.",
                     worst_arcsec(Fit::interpolation, 0), worst_arcsec(Fit::interpolation, 2), error_at_zero_arcsec())},
        {"figures 8 to 10", "Gaps of 0.1, 0.15 and 0.2 of a period are one, two and three ticks.", misprint,
         fmt::format("At {:.0f} Hz three ticks are {:.1f} of a period. The three numbers are half of a gap and one "
                     "tick: {:.2f}, {:.2f} and {:.2f}.",
                     oscillation_hz, paper_gap_ticks * tick_s * oscillation_hz, part(1), part(2), part(3))},
        {"figures 9 and 10", "A line serves up to 0.1 of a period, a parabola up to 0.2.", not_supported,
         fmt::format("By the paper's own {:.0f} arcsec per switch neither does: over one, two and three ticks constant "
                     "and line leave {}, the parabola {}.",
                     paper_switch_error_arcsec, list(0), list(2))},
    };
}

std::vector<Claim> claims_of_noise() {
    const auto ratio = [](Fit fit, int order, int n) { return design::sigma_ratio_to_constant({fit, order, n}); };
    return {
        {"figure 11", "The noise of the constant is A sqrt(n)/2 at 3 sigma.", wrong,
         fmt::format("That would be so if the substituted ticks erred independently. They share one mean, so their sum "
                     "has n A/2: {:.1f} arcsec over three ticks, not {:.2f}.",
                     design::constant_noise_arcsec(paper_noise_arcsec, paper_gap_ticks),
                     design::constant_noise_as_printed_arcsec(paper_noise_arcsec, paper_gap_ticks))},
        {"figure 11", "The noise of a line is 1.8 to 2.5 times that of a constant, of a parabola 8 to 35 times.",
         not_supported,
         fmt::format("No one reading gives both. In the corrected angle over one to three ticks: line {:.2f} to "
                     "{:.2f}, parabola {:.2f} to {:.2f}. In the extrapolation: line {:.2f} to {:.2f}, parabola {:.2f} "
                     "to {:.1f}.",
                     ratio(Fit::interpolation, 1, 1), ratio(Fit::interpolation, 1, 3), ratio(Fit::interpolation, 2, 1),
                     ratio(Fit::interpolation, 2, 3), ratio(Fit::extrapolation, 1, 1), ratio(Fit::extrapolation, 1, 3),
                     ratio(Fit::extrapolation, 2, 1), ratio(Fit::extrapolation, 2, 3))},
        {"after figure 11", "The total error of a switch is computed by (8).", misprint,
         "By (19); (8) is the condition for the best interval."},
    };
}

}  // namespace

std::vector<Claim> claims_of_substitution() {
    return joined(
        {claims_before_the_fit, claims_of_procedure, claims_of_series, claims_of_figures_8_to_10, claims_of_noise});
}

}  // namespace zlg::paper
