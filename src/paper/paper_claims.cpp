// The claims about the laser and its perimeter loop, those of abstract and conclusions, and all claims in the order of
// the paper.

#include <cmath>

#include <zlg/design/perimeter_response.hpp>
#include <zlg/design/relock_loop.hpp>
#include <zlg/design/relock_tables.hpp>
#include <zlg/design/substitution_noise.hpp>
#include <zlg/design/switching_interval.hpp>

#include "paper_claims_parts.hpp"
#include "paper_parts.hpp"
#include "paper_trial.hpp"

namespace zlg::paper {
namespace {

using design::Fit;

// The miss whose false angle by the loop-independent law is that of the tables.
double miss_of_tables_lambda() {
    const config::Gyro gyro;
    const design::BiasLaw law{.scale_arcsec = gyro.scale_arcsec, .bias_hz = gyro.bias_hz, .chi = gyro.bias_chi};
    const double angle = design::summarise(design::measured_arcsec_s, {}).angle_arcsec;
    return std::sqrt(angle /
                     design::false_angle_law_arcsec(design::bias_deficit_arcsec_s(law, 1.0), design::table_tick_s));
}

// How long a loop without limits is on its way from there to 0.01 wavelengths.
double linear_relock_s(double tau_s, double miss_lambda) {
    const design::RelockLoop linear{.tau_s = tau_s,
                                    .limit_lambda = design::RelockLoop::none,
                                    .rc_s = 0.0,
                                    .slew_lambda_s = design::RelockLoop::none};
    return design::relock_time_s(linear, miss_lambda, 0.01, 200);
}

double phase_margin_deg(double tau_s) { return design::margins({.tau_s = tau_s}).phase_margin_deg; }

// From this amplitude of the rate the parabola is better than the constant.
double crossing_arcsec_s(double frequency_hz) {
    const design::Substitution substitution;
    const auto ratio = design::crossing_ratio(substitution, 0, 2, frequency_hz);
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

std::vector<Finding> claims_of_laser() {
    const config::Gyro gyro;
    const double miss = miss_of_tables_lambda();
    const double tick_s = design::table_tick_s;
    return {
        {"eq (1)", {}},
        {"eq (2)", {1e-3 * gyro.bias_hz, gyro.bias_chi, miss, 100.0 * gyro.bias_chi * miss * miss}},
        {"perimeter loop", {}},
        {"perimeter loop",
         {phase_margin_deg(5.0 * tick_s), phase_margin_deg(2.0 * tick_s), 5e3 * tick_s, miss,
          1e3 * linear_relock_s(5.0 * tick_s, miss), 1e3 * tick_s * design::table_ticks}},
    };
}

std::vector<Finding> claims_of_abstract() {
    return {
        {"abstract",
         {noise_gain(Fit::interpolation, 1), noise_gain(Fit::interpolation, 0), worst_arcsec(Fit::interpolation, 1),
          worst_arcsec(Fit::interpolation, 0), worst_arcsec(Fit::interpolation, 2)}},
    };
}

std::vector<Finding> claims_of_conclusions() {
    return {
        {"conclusion 1",
         {worst_arcsec(Fit::extrapolation, 0), worst_arcsec(Fit::interpolation, 0), worst_arcsec(Fit::extrapolation, 2),
          worst_arcsec(Fit::interpolation, 2)}},
        {"conclusion 2",
         {noise_gain(Fit::interpolation, 0), noise_gain(Fit::interpolation, 1), noise_gain(Fit::extrapolation, 0),
          noise_gain(Fit::extrapolation, 1)}},
        {"conclusion 3",
         {paper_noise_arcsec, crossing_arcsec_s(paper_oscillation.frequency_hz), paper_oscillation.frequency_hz,
          crossing_arcsec_s(5.0), crossing_arcsec_s(1.0)}},
        {"closing", {gain_of_switching(600.0), 600.0, gain_of_switching(3600.0), gain_of_switching(36000.0)}},
        {"closing",
         {best_interval_s(600.0) / 60.0, 600.0, best_interval_s(3600.0) / 60.0, best_interval_s(36000.0) / 60.0}},
    };
}

}  // namespace

std::vector<Finding> joined(std::initializer_list<Findings> parts) {
    std::vector<Finding> all;
    for (const Findings part : parts)
        for (Finding& finding : part()) all.push_back(std::move(finding));
    return all;
}

std::vector<Claim> paper_claims(const PaperTask&) {
    return claims_of(joined({claims_of_abstract, claims_of_laser, claims_of_drift, claims_of_relock,
                             claims_of_substitution, claims_of_conclusions}));
}

}  // namespace zlg::paper
