#include <zlg/twin/discriminator_range.hpp>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include <fmt/format.h>

#include <zlg/twin/laser_zones.hpp>

#include "refusal.hpp"

namespace zlg::twin {
namespace {

// The nearest mode changes at a quarter of a wavelength, and the signal is symmetric about it for equal isotopes.
constexpr double last_lambda = 0.25;
constexpr double step_lambda = 1e-4;

// Detunings outwards in the direction `side`: an even grid, and every kink between.
std::vector<double> places(const FourWave& laser, double field_g, double side) {
    std::vector<double> result;
    const int n = static_cast<int>(std::lround(last_lambda / step_lambda));
    for (int k = 1; k <= n; ++k) result.push_back(side * last_lambda * k / n);
    const auto zones =
        laser_zones(laser, field_g, std::min(0.0, side * last_lambda), std::max(0.0, side * last_lambda));
    const auto nearer = [](double a, double b) { return std::abs(a) < std::abs(b); };
    for (std::size_t k = 1; k < zones.size(); ++k) {
        const double kink = zones[k].from_lambda;
        result.insert(std::upper_bound(result.begin(), result.end(), kink, nearer), kink);
    }
    return result;
}

// The last place outwards up to which the signal rises.
double end_of_rise(const FourWave& laser, double field_g, double side) {
    const auto signal = [&](double detuning) { return laser.at(detuning, field_g).discriminator(); };
    double end = 0.0;
    double risen = signal(end);
    for (const double place : places(laser, field_g, side)) {
        const double next = signal(place);
        if (!(side * (next - risen) > 0.0)) break;
        end = place;
        risen = next;
    }
    if (end == 0.0)
        throw std::runtime_error(
            fmt::format("discriminator range: signal does not grow at zero detuning and {} G", field_g));
    return end;
}

}  // namespace

DiscriminatorRange discriminator_range(const FourWave& laser, double field_g) {
    if (!(field_g > 0.0 && field_g <= 1e5)) refuse("discriminator range: field_g", field_g, "0 < field_g <= 1e5");
    return {end_of_rise(laser, field_g, -1.0), end_of_rise(laser, field_g, 1.0)};
}

}  // namespace zlg::twin
