#pragma once
// The four-wave equations computed from their definitions: integrals by quadrature, the steady state by following the
// waves in time. Slow, and shares nothing with the product.

#include <zlg/twin/laser_config.hpp>

#include "quadrature.hpp"

namespace zlg::twin {

struct ReferenceLaser {
    std::array<double, 4> intensity{};  // left cw, left ccw, right cw, right ccw
    std::array<double, 4> pulling_hz{};
};

class ReferenceGas {
public:
    explicit ReferenceGas(const LaserConfig& config) : c_{config}, range_hz_{299792458.0 / config.perimeter_m} {
        gain_ = c_.gain_loss_ratio * c_.round_trip_loss_ratio / line(0.0, 0.0, 1.0);
    }

    // left_lambda, right_lambda  detunings of the two modes.
    [[nodiscard]] ReferenceLaser at(double left_lambda, double right_lambda, double field_g) const {
        const double z = c_.zeeman_hz_per_g * field_g;
        const std::array<Wave, 4> wave{{{left_lambda * range_hz_, z, 1.0},
                                        {left_lambda * range_hz_, -z, -1.0},
                                        {right_lambda * range_hz_, -z, 1.0},
                                        {right_lambda * range_hz_, z, -1.0}}};
        ReferenceLaser result;
        std::array<double, 4> net_gain{};
        std::array<std::array<double, 4>, 4> saturation{};
        for (std::size_t i = 0; i < 4; ++i) {
            net_gain[i] = gain_ * line(wave[i].hz, wave[i].shift_hz, wave[i].direction) - c_.round_trip_loss_ratio;
            result.pulling_hz[i] = -range_hz_ / (2.0 * std::numbers::pi) * 0.5 * gain_ * dispersion(wave[i]);
            for (std::size_t j = 0; j < 4; ++j) {
                const bool same_component = i == j || i + j == 3;
                saturation[i][j] =
                    gain_ * (same_component ? 1.0 : c_.opposite_sigma_coupling) * overlap(wave[i], wave[j]);
            }
        }
        result.intensity = followed(net_gain, saturation);
        if (c_.dispersion == Dispersion::unsaturated) return result;
        for (std::size_t i = 0; i < 4; ++i) {
            for (std::size_t j = 0; j < 4; ++j) {
                const double coupling = i == j || i + j == 3 ? 1.0 : c_.opposite_sigma_coupling;
                const double hole = coupling * result.intensity[j] * dispersion_of_hole(wave[i], wave[j]);
                result.pulling_hz[i] += range_hz_ / (2.0 * std::numbers::pi) * 0.5 * gain_ * hole;
            }
        }
        return result;
    }

private:
    struct Wave {
        double hz;
        double shift_hz;
        double direction;
    };

    // f averaged over velocities and isotopes; f(distance of the wave from isotope k's line, Doppler shift).
    template <class F> [[nodiscard]] double averaged(const F& f) const {
        const double ku = c_.doppler_half_width_hz;
        const double share[2] = {c_.upper_isotope_ratio, 1.0 - c_.upper_isotope_ratio};
        const double line_hz[2] = {0.5 * c_.isotope_shift_hz, -0.5 * c_.isotope_shift_hz};
        double sum = 0.0;
        for (int k = 0; k < 2; ++k) {
            const auto integrand = [&](double u) {
                return std::exp(-u * u) * std::numbers::inv_sqrtpi * f(line_hz[k], u * ku);
            };
            sum += share[k] * integral(integrand, -7.0, 7.0, 1e-14);
        }
        return sum;
    }

    [[nodiscard]] double height(const Wave& w, double line_hz, double doppler_hz) const {
        const double gamma = c_.homogeneous_half_width_hz;
        const double off = w.hz - line_hz - w.shift_hz - w.direction * doppler_hz;
        return gamma * gamma / (gamma * gamma + off * off);
    }

    [[nodiscard]] double line(double hz, double shift_hz, double direction) const {
        const Wave w{hz, shift_hz, direction};
        return averaged([&](double line_hz, double doppler_hz) { return height(w, line_hz, doppler_hz); });
    }

    [[nodiscard]] double dispersion(const Wave& w) const {
        const double gamma = c_.homogeneous_half_width_hz;
        return averaged([&](double line_hz, double doppler_hz) {
            const double off = w.hz - line_hz - w.shift_hz - w.direction * doppler_hz;
            return gamma * off / (gamma * gamma + off * off);
        });
    }

    // What the absence of the atoms that `burning` has saturated takes from the dispersion.
    [[nodiscard]] double dispersion_of_hole(const Wave& w, const Wave& burning) const {
        const double gamma = c_.homogeneous_half_width_hz;
        return averaged([&](double line_hz, double doppler_hz) {
            const double off = w.hz - line_hz - w.shift_hz - w.direction * doppler_hz;
            return height(burning, line_hz, doppler_hz) * gamma * off / (gamma * gamma + off * off);
        });
    }

    [[nodiscard]] double overlap(const Wave& a, const Wave& b) const {
        return averaged([&](double line_hz, double doppler_hz) {
            return height(a, line_hz, doppler_hz) * height(b, line_hz, doppler_hz);
        });
    }

    // Growth from equal small intensities until nothing changes any more, in steps that no wave outruns.
    [[nodiscard]] std::array<double, 4> followed(const std::array<double, 4>& net_gain,
                                                 const std::array<std::array<double, 4>, 4>& saturation) const {
        std::array<double, 4> intensity{0.1, 0.1, 0.1, 0.1};
        const double dt = 0.3 / c_.round_trip_loss_ratio;
        for (int step = 0; step < 400000; ++step) {
            std::array<double, 4> rate = net_gain;
            for (std::size_t i = 0; i < 4; ++i) {
                for (std::size_t j = 0; j < 4; ++j) rate[i] -= saturation[i][j] * intensity[j];
            }
            for (std::size_t i = 0; i < 4; ++i) intensity[i] *= std::exp(dt * rate[i]);
        }
        return intensity;
    }

    LaserConfig c_;
    double range_hz_;
    double gain_ = 1.0;
};

}  // namespace zlg::twin
