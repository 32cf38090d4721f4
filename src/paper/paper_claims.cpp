// The claims about the laser and its perimeter loop, and all claims in the order of the paper.

#include <cmath>

#include <fmt/format.h>

#include <zlg/design/perimeter_response.hpp>
#include <zlg/design/relock_loop.hpp>
#include <zlg/design/relock_tables.hpp>

#include "paper_claims_parts.hpp"
#include "paper_parts.hpp"

namespace zlg::paper {
namespace {

using enum Verdict;

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

}  // namespace

std::vector<Claim> joined(std::initializer_list<Claims> parts) {
    std::vector<Claim> all;
    for (const Claims part : parts)
        for (Claim& claim : part()) all.push_back(std::move(claim));
    return all;
}

std::vector<Claim> claims_of_laser() {
    const config::Gyro gyro;
    const double miss = miss_of_tables_lambda();
    const double tick_s = design::table_tick_s;
    return {
        {"eq (1)", "The modulation of the light is proportional to the detuning and inverse to the Zeeman shift.",
         wrong,
         "The formula has the dimension of a length, and its inverse dependence goes the wrong way: without a shift "
         "there is no modulation at all. To first order it is proportional to detuning times shift, A_I = 4 a dl "
         "(c/perimeter) Dnu. All that is used of it is the proportionality to the detuning and the sign, that of the "
         "helicity."},
        {"eq (2)", "The bias frequency falls with the square of the detuning.", agrees,
         fmt::format(
             "Right, with detuning in wavelengths of the perimeter and chi without unit. With {:.0f} kHz and chi {} "
             "the angle measured in table 1 asks for a miss of {:.2f} wavelengths and a loss of {:.0f} % of the bias.",
             1e-3 * gyro.bias_hz, gyro.bias_chi, miss, 100.0 * gyro.bias_chi * miss * miss)},
        {"perimeter loop", "The signal of the synchronous detector has twice the frequency of the bias commutation.",
         wrong,
         "The part that carries the detuning changes its sign with the bias, so it has the commutation frequency 1/T. "
         "The double frequency is what is left in the middle of the mode."},
        {"perimeter loop",
         "For stability the time constant of the first stage must be at least five periods of its input signal.",
         not_supported,
         fmt::format("Five periods give a phase margin of {:.0f} degrees, which is ample; two still give {:.0f}. But a "
                     "linear loop of {:.0f} ms comes from {:.2f} to 0.01 wavelengths in {:.0f} ms, and in the tables "
                     "it is there within four ticks, {:.0f} ms. What was measured is rather a loop that slews.",
                     phase_margin_deg(5.0 * tick_s), phase_margin_deg(2.0 * tick_s), 5e3 * tick_s, miss,
                     1e3 * linear_relock_s(5.0 * tick_s, miss), 1e3 * tick_s * design::table_ticks)},
    };
}

std::vector<Claim> paper_claims(const PaperTask&) {
    return joined({claims_of_abstract, claims_of_laser, claims_of_drift, claims_of_relock, claims_of_substitution,
                   claims_of_conclusions});
}

}  // namespace zlg::paper
