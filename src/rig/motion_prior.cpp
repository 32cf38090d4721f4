#include "motion_prior.hpp"

#include <cmath>
#include <numbers>

namespace zlg::rig {
namespace {

// Lines that stand for a band; a hundredth of a period apart over the longest distance in a window.
constexpr int lines_in_band = 2000;

// White part of a prior's variance: without it a counter of very small steps leaves a matrix that cannot be inverted.
constexpr double white_part = 1e-9;

void add_line(core::Window& prior, double variance_arcsec2_s2, double frequency_hz, double half_s) {
    const double x = std::numbers::pi * frequency_hz * half_s;
    const double mean = x > 0.0 ? std::sin(x) / x : 1.0;
    const double variance = variance_arcsec2_s2 * half_s * half_s * mean * mean;
    for (std::size_t k = 0; k < prior.size(); ++k) prior[k] += variance * std::cos(2.0 * x * static_cast<double>(k));
}

}  // namespace

core::Window motion_prior(const config::Compensation& c, double tick_s) {
    core::Window prior{};
    const double half_s = 0.5 * tick_s;
    if (c.prior == config::MotionPrior::lines) {
        for (std::size_t i = 0; i < c.prior_line_hz.size(); ++i)
            add_line(prior, 0.5 * c.prior_line_arcsec_s[i] * c.prior_line_arcsec_s[i], c.prior_line_hz[i], half_s);
    } else {
        const double each = c.prior_rate_arcsec_s * c.prior_rate_arcsec_s / lines_in_band;
        for (int i = 0; i < lines_in_band; ++i)
            add_line(prior, each, (i + 0.5) / lines_in_band * c.prior_band_hz, half_s);
    }
    prior[0] *= 1.0 + white_part;
    return prior;
}

}  // namespace zlg::rig
