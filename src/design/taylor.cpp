#include <zlg/design/taylor.hpp>

#include <cmath>
#include <numbers>

#include <boost/math/tools/roots.hpp>

#include "range_check.hpp"

namespace zlg::design {
namespace {

// pi nu x, the variable of eq (20).
double phase(const Tone& tone, double x_s) {
    require_finite("series", "amplitude_arcsec_s", tone.amplitude_arcsec_s);
    require_not_negative("series", "frequency_hz", tone.frequency_hz);
    require_finite("series", "x_s", x_s);
    return std::numbers::pi * tone.frequency_hz * x_s;
}

RateSeries odd_series(const Tone& tone, double x_s, double cubic) {
    const double u = phase(tone, x_s);
    const double a = tone.amplitude_arcsec_s;
    return {{0.0, 2.0 * a * u, 0.0, -cubic * a * u * u * u, 0.0, 4.0 / 15.0 * a * std::pow(u, 5)}};
}

}  // namespace

double RateSeries::sum() const { return power[0] + above(0); }

double RateSeries::above(int order) const {
    require(order >= 0 && order <= 5, "series", "order", order, "0..5");
    double terms = 0.0;
    for (int k = 5; k > order; --k) terms += power[k];
    return terms;
}

RateSeries series_at_zero_as_printed(const Tone& tone, double x_s) { return odd_series(tone, x_s, 1.0); }

RateSeries series_at_zero(const Tone& tone, double x_s) { return odd_series(tone, x_s, 4.0 / 3.0); }

RateSeries series_at_extremum(const Tone& tone, double x_s) {
    const double u = phase(tone, x_s);
    const double a = tone.amplitude_arcsec_s;
    return {{a, 0.0, -2.0 * a * u * u, 0.0, 2.0 / 3.0 * a * u * u * u * u, 0.0}};
}

double figure_time_s(int n, double tick_s) {
    require(n >= 1, "time of the figures", "n", n, "1 or more ticks");
    require_positive("time of the figures", "tick_s", tick_s);
    return 0.5 * (n + 1) * tick_s;
}

double highest_frequency_hz(const Substitution& substitution, double amplitude_arcsec_s, double limit_arcsec) {
    require_not_negative("highest frequency", "limit_arcsec", limit_arcsec);
    const auto response = ErrorResponse(substitution);
    const auto excess = [&](double f) {
        return worst(response, Tone{amplitude_arcsec_s, f}).error_arcsec - limit_arcsec;
    };
    const double band = 0.5 / substitution.tick_s;
    const int steps = static_cast<int>(std::ceil(128.0 * response.span_ticks()));
    double low = 0.0;
    for (int k = 1; k <= steps; ++k) {
        const double high = band * k / steps;
        if (!(excess(high) > 0.0)) {
            low = high;
            continue;
        }
        if (excess(low) >= 0.0) return low;
        std::uintmax_t calls = 200;
        return boost::math::tools::bisect(excess, low, high, boost::math::tools::eps_tolerance<double>(42), calls)
            .first;
    }
    return band;
}

}  // namespace zlg::design
