#include <zlg/design/perimeter_response.hpp>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

#include <boost/math/tools/roots.hpp>

#include "range_check.hpp"

namespace zlg::design {
namespace {

using std::numbers::pi;

void check(const PerimeterLoop& loop) {
    constexpr auto where = "perimeter loop";
    require_positive(where, "tau_s", loop.tau_s);
    require_not_negative(where, "delay_s", loop.delay_s);
    require_not_negative(where, "rc_s", loop.rc_s);
    require(loop.mirror_hz > 0.0, where, "mirror_hz", loop.mirror_hz, "a number above 0, or infinity");
    require_positive(where, "mirror_zeta", loop.mirror_zeta);
}

// Denominator of the mirror, (1 - u^2) + 2 i zeta u with u = w/w_m; 1 for a rigid one.
std::complex<double> mirror(const PerimeterLoop& loop, double w) {
    const double u = w / (2.0 * pi * loop.mirror_hz);
    return {1.0 - u * u, 2.0 * loop.mirror_zeta * u};
}

// Bisection to 48 bits between ends of opposite sign.
template <class F> double root(F f, double low, double high) {
    std::uintmax_t calls = 300;
    const auto [a, b] = boost::math::tools::bisect(f, low, high, boost::math::tools::eps_tolerance<double>(48), calls);
    return 0.5 * (a + b);
}

double phase(const PerimeterLoop& loop, double w) {
    return -0.5 * pi - w * loop.delay_s - std::atan(w * loop.rc_s) - std::arg(mirror(loop, w));
}

double gain(const PerimeterLoop& loop, double w) {
    return 1.0 / (w * loop.tau_s * std::hypot(1.0, w * loop.rc_s) * std::abs(mirror(loop, w)));
}

// |L|^-2 = tau^2 v (1 + v RC^2) ((1 - v/m)^2 + 4 zeta^2 v/m), v = w^2, m = w_m^2: its extrema in v, two at most, bound
// the stretches on which |L| is monotone.
std::vector<double> extrema(const PerimeterLoop& loop) {
    if (std::isinf(loop.mirror_hz)) return {};
    const double m = std::pow(2.0 * pi * loop.mirror_hz, 2);
    const double r = loop.rc_s * loop.rc_s * m;
    const double k = 4.0 * loop.mirror_zeta * loop.mirror_zeta - 2.0;
    // With s = v/m: s (1 + r s)(1 + k s + s^2), and its slope.
    const auto slope = [&](double s) { return 1.0 + s * (2.0 * (k + r) + s * (3.0 * (1.0 + k * r) + s * 4.0 * r)); };
    std::vector<double> found;
    constexpr int n_steps = 20000;
    for (int i = 0; i < n_steps; ++i) {  // beyond s = 2 every factor grows
        const double low = 2.0 * i / n_steps;
        const double high = 2.0 * (i + 1) / n_steps;
        if ((slope(low) > 0.0) != (slope(high) > 0.0)) found.push_back(std::sqrt(m * root(slope, low, high)));
    }
    return found;
}

// All w with |L| = 1, ascending.
std::vector<double> crossovers(const PerimeterLoop& loop) {
    const auto excess = [&](double w) { return std::log(gain(loop, w)); };
    auto edges = extrema(loop);
    double low = 1e-6 / loop.tau_s;
    double high = std::max(1.0 / loop.tau_s, edges.empty() ? 0.0 : edges.back());
    while (excess(high) > 0.0) high *= 2.0;
    edges.push_back(2.0 * high);
    std::vector<double> found;
    for (const double edge : edges) {
        if (edge > low && (excess(low) > 0.0) != (excess(edge) > 0.0)) found.push_back(root(excess, low, edge));
        low = edge;
    }
    return found;
}

// Crossings of -180, -540, ... degrees: up to the first above which |L| only falls.
void find_gain_margin(const PerimeterLoop& loop, Margins& m) {
    const auto peaks = extrema(loop);
    const double last_peak = peaks.empty() ? 0.0 : peaks.back();
    double low = 1e-9 / loop.tau_s;
    double high = 1.0 / loop.tau_s;
    for (double turn = -pi;; turn -= 2.0 * pi) {
        while (phase(loop, high) > turn) {
            high *= 2.0;
            if (high > 1e15 / loop.tau_s) return;
        }
        const double w = root([&](double x) { return phase(loop, x) - turn; }, low, high);
        const double margin = 1.0 / gain(loop, w);
        if (margin < m.gain_margin) {
            m.gain_margin = margin;
            m.limit_rad_s = w;
        }
        if (w > last_peak) return;
        low = w;
    }
}

double distance_to_half_turn(double phase_rad) { return std::abs(std::remainder(phase_rad + pi, 2.0 * pi)); }

}  // namespace

Margins margins(const PerimeterLoop& loop) {
    check(loop);
    Margins m;
    find_gain_margin(loop, m);
    m.stable = m.gain_margin > 1.0;
    const auto unity = crossovers(loop);
    m.crossover_rad_s = unity.front();
    double nearest = m.stable ? pi : pi + phase(loop, unity.back());
    if (m.stable) {
        for (const double w : unity) nearest = std::min(nearest, distance_to_half_turn(phase(loop, w)));
    }
    m.phase_margin_deg = nearest * 180.0 / pi;
    return m;
}

double sampled_stability_limit(int delay_samples) {
    require(delay_samples >= 0 && delay_samples <= 1000, "sampled loop", "delay_samples", delay_samples, "0..1000");
    return 2.0 * std::sin(pi / (2.0 * (2.0 * delay_samples + 1.0)));
}

}  // namespace zlg::design
