#include "averaged_gyro.hpp"

#include <cmath>
#include <cstddef>
#include <utility>

namespace zlg::twin {

AveragedGyro::AveragedGyro(const TwinConfig& config, Motion motion)
    : config_{config},
      motion_{std::move(motion)},
      housing_{config_},
      photodiodes_{config_},
      walk_noise_{config.seed, NoiseCause::random_walk},
      dark_noise_{config.seed, NoiseCause::dark_counts},
      counter_{NoiseStream{config.seed, NoiseCause::start_phase}.uniform()} {}

TwinHalf AveragedGyro::advance(const core::ActuatorFrame& actuator) {
    housing_.begin_half(actuator);
    const int bias_sign = housing_.bias_sign();
    TwinHalf half;
    const BiasArea area = live_through_half(bias_sign, half);
    count(area, bias_sign, half);
    half.truth.rounding_arcsec = -config_.scale_arcsec * counter_.fraction();
    housing_.end_half(actuator, counter_.value(), 0, half);
    return half;
}

// Step through the light samples: each at the middle of its interval, all of the bias on the way.
BiasArea AveragedGyro::live_through_half(int bias_sign, TwinHalf& half) {
    Perimeter& perimeter = housing_.perimeter();
    const int n_pieces = housing_.n_pieces();
    const int n_samples = config_.light_samples;
    const double piece_s = housing_.half_s() / (n_pieces * n_samples);
    const bool light_is_faulty = housing_.light_is_faulty();
    BiasArea area;
    garbage_cycles_ = 0.0;
    Mode start = perimeter.mode();
    area.subtract_edge(start, config_.bias_edge_s);
    for (int sample = 0; sample < n_samples; ++sample) {
        for (int piece = 0; piece < n_pieces; ++piece) {
            const int place = sample * n_pieces + piece;
            perimeter.step();
            const Mode middle = perimeter.mode();
            if (piece == n_pieces / 2) {
                const LightParts left = light_is_faulty ? housing_.light_at((place + 0.5) * piece_s) : LightParts{};
                const Photodiodes::Beams beams = photodiodes_.sample(middle, bias_sign, left);
                half.sensor.light_a[static_cast<std::size_t>(sample)] = beams.a;
                half.sensor.light_b[static_cast<std::size_t>(sample)] = beams.b;
            }
            perimeter.step();
            const Mode end = perimeter.mode();
            const bool is_dark = light_is_faulty && housing_.light_at((place + 0.5) * piece_s).is_dark();
            if (is_dark || !area.add(start, middle, end, piece_s)) {
                half.truth.lit = false;
                garbage_cycles_ += piece_s * bias_hz() * (2.0 * dark_noise_.uniform() - 1.0);
            }
            start = end;
        }
    }
    area.subtract_edge(start, config_.bias_edge_s);
    half.truth.detuning_end_lambda = start.detuning_lambda;
    return area;
}

//   cycles = sign p int helicity (1 - chi dl^2) shape dt + (rotation + drift)/scale
//
// Rotation is counted for the lit part of the half only: in the rest the counter shows garbage.
void AveragedGyro::count(const BiasArea& area, int bias_sign, TwinHalf& half) {
    const double half_s = housing_.half_s();
    half.truth.dtheta_arcsec = motion_.increment_arcsec(housing_.start_s(), housing_.end_s()) +
                               housing_.turned_arcsec(housing_.start_s(), housing_.end_s());

    const double plateau_hz = bias_sign * bias_hz() / (1.0 - config_.bias_edge_s / config_.tick_s);
    const double false_cycles = -plateau_hz * config_.bias_chi * area.shaped_square();
    half.truth.false_relock_arcsec = config_.scale_arcsec * false_cycles;

    const double lit_part = half.truth.lit ? 1.0 : area.lit_s() / half_s;
    double seen_arcsec = lit_part * half.truth.dtheta_arcsec + housing_.magnetic_arcsec_s() * area.helicity_s() +
                         config_.nonmagnetic_arcsec_s * lit_part * half_s;
    if (config_.random_walk_arcsec_sqrt_s > 0.0) {
        seen_arcsec += config_.random_walk_arcsec_sqrt_s * std::sqrt(half_s) * walk_noise_.gauss();
    }
    counter_.advance(plateau_hz * area.shaped_s() + false_cycles + garbage_cycles_ +
                     seen_arcsec / config_.scale_arcsec);
}

}  // namespace zlg::twin
