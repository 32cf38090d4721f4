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
      fringe_photodiodes_{config_},
      walk_noise_{config.seed, NoiseCause::random_walk},
      dark_noise_{config.seed, NoiseCause::dark_counts},
      counter_{NoiseStream{config.seed, NoiseCause::start_phase}.uniform()} {}

TwinHalf AveragedGyro::advance(const core::ActuatorFrame& actuator) {
    housing_.begin_half(actuator);
    const int bias_sign = housing_.bias_sign();
    TwinHalf half;
    const BiasArea area = live_through_half(bias_sign, half);
    count(area, bias_sign, half);
    half.truth.rounding_arcsec = -config_.gyro.scale_arcsec * counter_.fraction();
    see_fringe(bias_sign, half);
    housing_.end_half(actuator, counter_.value(), 0, half);
    return half;
}

// Step through the light samples: each at the middle of its interval, all of the bias on the way.
BiasArea AveragedGyro::live_through_half(int bias_sign, TwinHalf& half) {
    Perimeter& perimeter = housing_.perimeter();
    const int n_pieces = housing_.n_pieces();
    const int n_samples = config_.gyro.light_samples;
    const double piece_s = housing_.half_s() / (n_pieces * n_samples);
    const bool light_is_faulty = housing_.light_is_faulty();
    BiasArea area;
    garbage_cycles_ = 0.0;
    Mode start = perimeter.mode();
    area.subtract_edge(start, config_.gyro.bias_edge_s);
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
    area.subtract_edge(start, config_.gyro.bias_edge_s);
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

    const double signed_hz = bias_sign * plateau_hz();
    const double false_cycles = -signed_hz * config_.gyro.bias_chi * area.shaped_square();
    half.truth.false_relock_arcsec = config_.gyro.scale_arcsec * false_cycles;

    const double lit_part = half.truth.lit ? 1.0 : area.lit_s() / half_s;
    double seen_arcsec = lit_part * half.truth.dtheta_arcsec + housing_.magnetic_arcsec_s() * area.helicity_s() +
                         config_.drift.nonmagnetic_arcsec_s * lit_part * half_s;
    if (config_.drift.random_walk_arcsec_sqrt_s > 0.0) {
        half.truth.random_walk_arcsec =
            config_.drift.random_walk_arcsec_sqrt_s * std::sqrt(half_s) * walk_noise_.gauss();
        seen_arcsec += half.truth.random_walk_arcsec;
    }
    counter_.advance(signed_hz * area.shaped_s() + false_cycles + garbage_cycles_ +
                     seen_arcsec / config_.gyro.scale_arcsec);
}

double AveragedGyro::plateau_hz() const { return bias_hz() / (1.0 - config_.gyro.bias_edge_s / config_.gyro.tick_s); }

// A count is a fringe, and the comparators stand where the phase does.
void AveragedGyro::see_fringe(int bias_sign, TwinHalf& half) {
    const Mode mode = housing_.perimeter().mode();
    const double half_s = housing_.half_s();
    LatchedBeat beat{.turns = counter_.fraction(), .quarter = static_cast<std::uint64_t>(4.0 * counter_.fraction())};
    if (mode.two_way()) {
        const LightParts left = housing_.light_is_faulty() ? housing_.light_at(half_s) : LightParts{};
        beat.amplitude = std::sqrt(left.a * left.b);
        beat.plateau_hz = bias_sign * mode.helicity() * plateau_hz();
        beat.rotation_hz = half.truth.dtheta_arcsec / config_.gyro.scale_arcsec / half_s;
    }
    fringe_photodiodes_.sample(beat, half.sensor);
}

}  // namespace zlg::twin
