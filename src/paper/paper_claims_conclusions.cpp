// The claims of the paper's abstract and conclusions.

#include <cmath>

#include <fmt/format.h>

#include <zlg/design/order_choice.hpp>
#include <zlg/design/switching_interval.hpp>

#include "paper_claims_parts.hpp"
#include "paper_readings.hpp"

namespace zlg::paper {
namespace {

using namespace design;
using enum Verdict;

// From this amplitude of the rate the parabola is better than the constant.
double crossing_arcsec_s(double frequency_hz) {
    const Substitution substitution;
    const auto ratio = design::crossing_ratio({.substitution = substitution}, 0, 2, frequency_hz);
    return ratio.value_or(std::nan("")) * paper_noise_arcsec / 3.0 / substitution.tick_s;
}

// How many times the drift of the gyro in one mode exceeds the least of the switched one.
double gain_of_switching(double run_s) {
    const design::DriftCase task = study::drift_case({}, run_s);
    const double one_mode =
        task.gyro.nonmagnetic_arcsec_s + design::magnetic_integral_arcsec(task.gyro, 0.0, run_s) / run_s;
    return one_mode / design::optimum(design::IntervalMethod::corrected, task).drift_arcsec_s;
}

double best_interval_s(double run_s) {
    return design::optimum(design::IntervalMethod::corrected, study::drift_case({}, run_s)).interval_s;
}

}  // namespace

std::vector<Claim> claims_of_abstract() {
    return {
        {"abstract", "A linear function is the most robust against noise and acceleration.", wrong,
         fmt::format(
             "The conclusions say that a constant has much less noise. Neither holds: in the corrected angle both "
             "are one estimator, line {:.2f} and constant {:.2f} ticks of noise, {:.2f} and {:.2f} arcsec in the "
             "oscillation. Against motion the parabola is more robust, {:.2f} arcsec.",
             noise_gain(Fit::interpolation, 1), noise_gain(Fit::interpolation, 0), worst_arcsec(Fit::interpolation, 1),
             worst_arcsec(Fit::interpolation, 0), worst_arcsec(Fit::interpolation, 2))},
    };
}

std::vector<Claim> claims_of_conclusions() {
    return {
        {"conclusion 1", "Processing after the switch reduces the error substantially.", agrees,
         fmt::format(
             "At the worst phase of the oscillation, over three ticks: constant {:.0f} before and {:.1f} arcsec after, "
             "parabola {:.0f} and {:.1f}.",
             worst_arcsec(Fit::extrapolation, 0), worst_arcsec(Fit::interpolation, 0),
             worst_arcsec(Fit::extrapolation, 2), worst_arcsec(Fit::interpolation, 2))},
        {"conclusion 2", "Constant and line err alike under oscillation, but the constant has much less noise.", wrong,
         fmt::format(
             "Alike in noise too, {:.2f} and {:.2f} ticks: one estimator. Less noise it has in the extrapolation only, "
             "{:.2f} against {:.2f} ticks, and that is replaced after the gap.",
             noise_gain(Fit::interpolation, 0), noise_gain(Fit::interpolation, 1), noise_gain(Fit::extrapolation, 0),
             noise_gain(Fit::extrapolation, 1))},
        {"conclusion 3", "For slow oscillation a constant is best, for fast a parabola, depending on noise.", agrees,
         fmt::format(
             "With {} arcsec of noise a tick and three lost ticks the parabola wins from {:.0f} deg/h at {:.0f} "
             "Hz, from {:.0f} deg/h at 5 Hz and from {:.0f} deg/h at 1 Hz, rms over random phase.",
             paper_noise_arcsec, crossing_arcsec_s(paper_oscillation.frequency_hz), paper_oscillation.frequency_hz,
             crossing_arcsec_s(5.0), crossing_arcsec_s(1.0))},
        {"closing", "The regime lowers the drift of the gyro by about an order of magnitude.", agrees,
         fmt::format(
             "At the best interval by {:.1f} times in {:.0f} s, {:.1f} times in an hour, {:.0f} times in ten hours.",
             gain_of_switching(600.0), 600.0, gain_of_switching(3600.0), gain_of_switching(36000.0))},
        {"closing", "The best interval is several minutes.", agrees,
         fmt::format("From {:.1f} minutes in {:.0f} s to {:.1f} in an hour and {:.1f} in ten hours.",
                     best_interval_s(600.0) / 60.0, 600.0, best_interval_s(3600.0) / 60.0,
                     best_interval_s(36000.0) / 60.0)},
    };
}

}  // namespace zlg::paper
