#include <zlg/twin/discriminator_curve.hpp>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

#include <zlg/twin/laser_zones.hpp>

#include "refusal.hpp"

namespace zlg::twin {
namespace {

struct Knot {
    double signal;
    double detuning;
};

Knot knot(const FourWave& laser, double field_g, double detuning) {
    return {laser.at(detuning, field_g).discriminator(), detuning};
}

// The nearest mode changes at a quarter of a wavelength, and the signal is symmetric about it for equal isotopes.
constexpr double last_lambda = 0.25;
constexpr double step_lambda = 1e-4;

// Detunings from zero outwards in the direction `side`: an even grid, and every kink between.
std::vector<double> places(const FourWave& laser, double field_g, double side) {
    std::vector<double> result;
    const int n = static_cast<int>(std::lround(last_lambda / step_lambda));
    for (int k = 0; k <= n; ++k) result.push_back(side * last_lambda * k / n);
    const auto zones =
        laser_zones(laser, field_g, std::min(0.0, side * last_lambda), std::max(0.0, side * last_lambda));
    const auto nearer = [](double a, double b) { return std::abs(a) < std::abs(b); };
    for (std::size_t k = 1; k < zones.size(); ++k) {
        const double kink = zones[k].from_lambda;
        result.insert(std::upper_bound(result.begin(), result.end(), kink, nearer), kink);
    }
    return result;
}

// The points of the rising branch, outwards.
std::vector<Knot> branch(const FourWave& laser, double field_g, double side) {
    std::vector<Knot> points;
    for (const double place : places(laser, field_g, side)) {
        const Knot next = knot(laser, field_g, place);
        if (!points.empty()) {
            if (!(side * (next.signal - points.back().signal) > 0.0)) break;
            if (!(side * (next.detuning - points.back().detuning) > 0.0)) continue;
        }
        points.push_back(next);
    }
    return points;
}

// How far a chord from one point to another passes, in detuning, from the points between.
double chord_error(const std::vector<Knot>& points, std::size_t from, std::size_t to) {
    const Knot a = points[from];
    const Knot b = points[to];
    double worst = 0.0;
    for (std::size_t k = from + 1; k < to; ++k) {
        const double on_chord =
            a.detuning + (b.detuning - a.detuning) * (points[k].signal - a.signal) / (b.signal - a.signal);
        worst = std::max(worst, std::abs(on_chord - points[k].detuning));
    }
    return worst;
}

// The longest chords within the tolerance, one after the other.
std::vector<Knot> thinned(const std::vector<Knot>& points, double tolerance, double& worst) {
    std::vector<Knot> knots{points.front()};
    for (std::size_t from = 0; from + 1 < points.size();) {
        std::size_t to = from + 1;
        double error = 0.0;
        while (to + 1 < points.size()) {
            const double longer = chord_error(points, from, to + 1);
            if (longer > tolerance) break;
            error = longer;
            ++to;
        }
        worst = std::max(worst, error);
        knots.push_back(points[to]);
        from = to;
    }
    return knots;
}

}  // namespace

double DiscriminatorCurve::detuning_of(double signal_ratio) const {
    const auto above = std::upper_bound(signal.begin(), signal.end(), signal_ratio);
    if (above == signal.begin()) return detuning_lambda.front();
    if (above == signal.end()) return detuning_lambda.back();
    const auto k = static_cast<std::size_t>(above - signal.begin());
    const double part = (signal_ratio - signal[k - 1]) / (signal[k] - signal[k - 1]);
    return detuning_lambda[k - 1] + part * (detuning_lambda[k] - detuning_lambda[k - 1]);
}

DiscriminatorCurve discriminator_curve(const FourWave& laser, double field_g, double tolerance_lambda) {
    if (!(field_g > 0.0 && field_g <= 1e5)) {
        refuse("discriminator curve: field_g", field_g, "0 < field_g <= 1e5");
    }
    require_within("discriminator curve: tolerance_lambda", tolerance_lambda, 1e-6, 0.01);
    const std::vector<Knot> below = branch(laser, field_g, -1.0);
    const std::vector<Knot> above = branch(laser, field_g, 1.0);
    if (below.size() < 2 || above.size() < 2) {
        throw std::runtime_error(
            fmt::format("discriminator curve: signal does not grow at zero detuning and {} G", field_g));
    }
    DiscriminatorCurve curve;
    const auto add = [&](const Knot& k) {
        curve.signal.push_back(k.signal);
        curve.detuning_lambda.push_back(k.detuning);
    };
    std::vector<Knot> left = thinned(below, tolerance_lambda, curve.error_lambda);
    std::for_each(left.rbegin(), left.rend() - 1, add);
    const std::vector<Knot> right = thinned(above, tolerance_lambda, curve.error_lambda);
    std::for_each(right.begin(), right.end(), add);
    return curve;
}

}  // namespace zlg::twin
