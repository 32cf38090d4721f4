#include "averaged_gyro.hpp"

#include <cmath>
#include <cstddef>
#include <span>
#include <utility>

#include "laser/laser.hpp"

namespace zlg::twin {

AveragedGyro::AveragedGyro(const TwinConfig& config, Motion motion)
    : config_{config},
      can_leap_{why_no_leap(config).empty()},
      motion_{std::move(motion)},
      plateau_over_mean_{1.0 / (1.0 - config.gyro.bias_edge_s / config.gyro.tick_s)},
      walk_of_half_arcsec_{config.drift.random_walk_arcsec_sqrt_s * std::sqrt(0.5 * config.gyro.tick_s)},
      housing_{config_},
      course_{2 * housing_.n_pieces() * config.gyro.light_samples, housing_.half_s()},
      photodiodes_{config_},
      fringe_photodiodes_{config_},
      walk_noise_{config.seed, chance::Cause::random_walk},
      dark_noise_{config.seed, chance::Cause::dark_counts},
      counter_{Noise{config.seed, chance::Cause::start_phase}.uniform(0, 0)} {}

const TwinHalf& AveragedGyro::advance(const core::ActuatorFrame& actuator) {
    housing_.begin_half(actuator);
    course_.live(housing_.perimeter());
    const int bias_sign = housing_.bias_sign();
    const bool is_steady = is_lit_in_one_mode();
    half_.truth = {};
    take_light(bias_sign, is_steady, half_.sensor);
    half_.truth.detuning_end_lambda = housing_.perimeter().mode().detuning_lambda;
    const BiasArea area = bias_area(is_steady, half_.truth);
    count(area, bias_sign, half_);
    half_.truth.rounding_arcsec = -config_.gyro.scale_arcsec * counter_.fraction();
    see_fringe(bias_sign, half_);
    housing_.end_half(actuator, counter_.value(), 0, half_);
    return half_;
}

bool AveragedGyro::is_lit_in_one_mode() const {
    if (housing_.light_is_faulty()) return false;
    // The loop is linear only where light of both directions lases.
    if (course_.was_linear()) return true;
    const PerimeterCourse::Ends ends = course_.ends();
    const Mode least = lasing_mode(ends.least_lambda);
    const Mode most = lasing_mode(ends.most_lambda);
    return least.centre_half_lambda == most.centre_half_lambda && least.two_way() && most.two_way();
}

// Each sample at the middle of its interval.
void AveragedGyro::take_light(int bias_sign, bool is_steady, core::SensorFrame& sensor) {
    const auto n_pieces = static_cast<std::size_t>(housing_.n_pieces());
    const auto n_samples = static_cast<std::size_t>(config_.gyro.light_samples);
    const std::span a = std::span{sensor.light_a}.first(n_samples);
    const std::span b = std::span{sensor.light_b}.first(n_samples);
    photodiodes_.begin_half(housing_.index());
    if (is_steady) {
        photodiodes_.see(housing_.perimeter().mode(), bias_sign, course_.nodes(), n_pieces, a, b);
        return;
    }
    const double interval_s = housing_.half_s() / config_.gyro.light_samples;
    for (std::size_t k = 0; k < n_samples; ++k) {
        const Mode mode = lasing_mode(course_.after_step((2 * k + 1) * n_pieces));
        const LightParts left =
            housing_.light_is_faulty() ? housing_.light_at((static_cast<double>(k) + 0.5) * interval_s) : LightParts{};
        const Photodiodes::Beams beams = photodiodes_.sample(k, mode, bias_sign, left);
        a[k] = beams.a;
        b[k] = beams.b;
    }
}

// Of a steady half by the mean square of its detuning; of another piece by piece.
BiasArea AveragedGyro::bias_area(bool is_steady, TwinTruth& truth) {
    const std::span<const double> nodes = course_.nodes();
    const Mode start = lasing_mode(nodes.front());
    garbage_cycles_ = 0.0;
    BiasArea area{config_.gyro.bias_chi_higher};
    area.subtract_edge(start, config_.gyro.bias_edge_s);
    if (is_steady)
        area.add_whole(start, nodes, housing_.half_s());
    else
        add_pieces(area, truth);
    area.subtract_edge(housing_.perimeter().mode(), config_.gyro.bias_edge_s);
    return area;
}

void AveragedGyro::add_pieces(BiasArea& area, TwinTruth& truth) {
    const std::span<const double> nodes = course_.nodes();
    const double piece_s = housing_.half_s() / (housing_.n_pieces() * config_.gyro.light_samples);
    Mode start = lasing_mode(nodes.front());
    for (std::size_t k = 0; k + 2 < nodes.size(); k += 2) {
        const Mode end = lasing_mode(nodes[k + 2]);
        const double middle_s = 0.5 * static_cast<double>(k + 1) * piece_s;
        const bool is_dark = housing_.light_is_faulty() && housing_.light_at(middle_s).is_dark();
        if (is_dark || !area.add(start, lasing_mode(nodes[k + 1]), end, piece_s)) {
            truth.lit = false;
            garbage_cycles_ += piece_s * bias_hz() *
                               (2.0 * dark_noise_.uniform(housing_.index(), static_cast<std::uint32_t>(k)) - 1.0);
        }
        start = end;
    }
}

//   cycles = sign p int helicity (1 - chi dl^2 - h) shape dt + (rotation + drift)/scale
//
// Rotation is counted for the lit part of the half only: in the rest the counter shows garbage.
void AveragedGyro::count(const BiasArea& area, int bias_sign, TwinHalf& half) {
    const double half_s = housing_.half_s();
    half.truth.dtheta_arcsec = motion_.increment_arcsec(housing_.start_s(), housing_.end_s()) +
                               housing_.turned_arcsec(housing_.start_s(), housing_.end_s());

    const double signed_hz = bias_sign * plateau_hz();
    const double false_cycles =
        -signed_hz * config_.gyro.bias_chi * area.shaped_square() - signed_hz * area.shaped_higher();
    half.truth.false_relock_arcsec = config_.gyro.scale_arcsec * false_cycles;

    const double lit_part = half.truth.lit ? 1.0 : area.lit_s() / half_s;
    double seen_arcsec = lit_part * half.truth.dtheta_arcsec + housing_.magnetic_arcsec_s() * area.helicity_s() +
                         config_.drift.nonmagnetic_arcsec_s * lit_part * half_s;
    if (walk_of_half_arcsec_ > 0.0) {
        half.truth.random_walk_arcsec = walk_of_half_arcsec_ * walk_noise_.gauss(housing_.index());
        seen_arcsec += half.truth.random_walk_arcsec;
    }
    counter_.advance(signed_hz * area.shaped_s() + false_cycles + garbage_cycles_ +
                     seen_arcsec / config_.gyro.scale_arcsec);
}

double AveragedGyro::plateau_hz() const { return bias_hz() * plateau_over_mean_; }

// A count is a fringe, and the comparators stand where the phase does.
void AveragedGyro::see_fringe(int bias_sign, TwinHalf& half) {
    const Mode mode = housing_.perimeter().mode();
    const double half_s = housing_.half_s();
    LatchedBeat beat{.turns = counter_.fraction(), .quarter = static_cast<std::uint64_t>(4.0 * counter_.fraction())};
    if (mode.two_way()) {
        const LightParts left = housing_.light_is_faulty() ? housing_.light_at(half_s) : LightParts{};
        beat.amplitude = housing_.power() * std::sqrt(left.a * left.b);
        beat.plateau_hz = bias_sign * mode.helicity() * plateau_hz();
        beat.rotation_hz = half.truth.dtheta_arcsec / config_.gyro.scale_arcsec / half_s;
    }
    fringe_photodiodes_.sample(housing_.index(), beat, half.sensor);
}

}  // namespace zlg::twin
