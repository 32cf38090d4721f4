#include <zlg/twin/averaged_laser.hpp>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

#include "refusal.hpp"

namespace zlg::twin {
namespace {

constexpr int n_fit = 200;

double signal(const FourWave& laser, double field_g, double detuning) {
    return laser.at(detuning, field_g).discriminator();
}

constexpr double slope_step_lambda = 1e-3;
constexpr double farthest_lambda = 0.2;  // from the centre that the averaged laws are expanded about

bool runs_both_ways(const FourWave& laser, double field_g, double detuning) {
    return laser.at(detuning, field_g).left.two_way();
}

[[noreturn]] void refuse_light(double field_g) {
    throw std::runtime_error(
        fmt::format("averaged laser: at {} G there are no equal beams with light both ways for {} wavelength around, "
                    "more of cw above and less below",
                    field_g, 2.0 * slope_step_lambda));
}

// Where the beams are equal: from the centre downhill, then by halving.
double settled(const FourWave& laser, double field_g) {
    const double at_centre = signal(laser, field_g, 0.0);
    const double towards = at_centre > 0.0 ? -slope_step_lambda : slope_step_lambda;
    const auto is_passed = [&](double dl) { return !(signal(laser, field_g, dl) * at_centre > 0.0); };
    double before = 0.0;
    double beyond = towards;
    for (; !is_passed(beyond); beyond += towards) {
        if (!(std::abs(beyond) < farthest_lambda) || !runs_both_ways(laser, field_g, beyond)) refuse_light(field_g);
        before = beyond;
    }
    while (std::abs(beyond - before) > 1e-13) {
        const double middle = 0.5 * (before + beyond);
        (is_passed(middle) ? beyond : before) = middle;
    }
    const double root = 0.5 * (before + beyond);
    for (const double side : {-2.0, 2.0}) {
        const double dl = root + side * slope_step_lambda;
        // Beyond the zero the signal has the sign of the side: the loop is drawn to it, and not away.
        if (!runs_both_ways(laser, field_g, dl) || !(side * signal(laser, field_g, dl) > 0.0)) refuse_light(field_g);
    }
    return std::abs(root) < 1e-12 ? 0.0 : root;
}

// Central difference of fourth order: 1e-9 of error where the signal varies over some hundredths of a wavelength.
double slope(const FourWave& laser, double field_g, double at_lambda) {
    constexpr double h = slope_step_lambda;
    const auto difference = [&](double d) {
        return signal(laser, field_g, at_lambda + d) - signal(laser, field_g, at_lambda - d);
    };
    return (8.0 * difference(h) - difference(2.0 * h)) / (12.0 * h);
}

void fit_chi(const FourWave& laser, double field_g, double range_lambda, AveragedLaser& result) {
    const auto place = [&](int k) { return range_lambda * k / n_fit; };
    const auto deficit = [&](int k) { return 1.0 - laser.at(place(k), field_g).left.bias_hz / result.bias_hz; };
    double product = 0.0;
    double square = 0.0;
    for (int k = -n_fit; k <= n_fit; ++k) {
        const double dl_sq = place(k) * place(k);
        product += deficit(k) * dl_sq;
        square += dl_sq * dl_sq;
    }
    result.bias_chi = product / square;
    for (int k = -n_fit; k <= n_fit; ++k) {
        result.bias_residual_ratio =
            std::max(result.bias_residual_ratio, std::abs(deficit(k) - result.bias_chi * place(k) * place(k)));
    }
}

// Rotation moves a wave from its line as a field moves the line from the wave: half of the beat is a Zeeman shift.
double scale_pull(const FourWave& laser, double field_g) {
    const double step_g = 1e-3 * field_g;
    const double change_hz =
        laser.at(0.0, field_g + step_g).left.bias_hz - laser.at(0.0, field_g - step_g).left.bias_hz;
    return change_hz / (2.0 * step_g * 2.0 * laser.config().zeeman_hz_per_g);
}

}  // namespace

AveragedLaser averaged_laser(const FourWave& laser, double field_g, double fit_range_lambda) {
    require_within("averaged laser: field_g", field_g, 1e-6, 1e5);
    require_within("averaged laser: fit_range_lambda", fit_range_lambda, 0.001, 0.25);
    const LaserLight centre = laser.at(0.0, field_g);
    if (!centre.left.two_way()) {
        throw std::runtime_error(
            fmt::format("averaged laser: at {} G the mode at zero detuning is not lit both ways", field_g));
    }
    AveragedLaser result;
    result.bias_hz = centre.left.bias_hz;
    fit_chi(laser, field_g, fit_range_lambda, result);
    result.settled_lambda = settled(laser, field_g);
    result.discriminator_per_lambda = slope(laser, field_g, result.settled_lambda);
    result.scale_pull = scale_pull(laser, field_g);
    return result;
}

}  // namespace zlg::twin
