#include "laser_gyro.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include <zlg/core/common/maths.hpp>

#include "laser/laser.hpp"

namespace zlg::twin {
namespace {

constexpr double level = 1000.0;  // of a photodiode at the centre; any unit, only ratios of light mean anything

// A detuning that wanders by less adds less than 1e-4 rad to the mean of its ends and middle.
constexpr double steady_lambda = 1e-4;
constexpr double calm_lambda = 5e-3;
constexpr int n_calm_stretches = 4;

// Half of a reversal as one chord errs, by trial on gases of 15 to 50 G, by less than
//
//   slip (0.1 bend + 0.15 signal^2)
//
// where the slip is that of the reversal, the bend what the bias departs from the chord by in the middle times the
// time, and the signal how unequal the waves are: the coupling grows with its square.
constexpr double per_bend = 0.1;
constexpr double per_signal_sq = 0.15;
constexpr double allowed_edge_rad = 1e-5;

double largest_field_g(const TwinConfig& c) {
    const TemperatureSpan span = temperature_span(c.gyro, c.temperature);
    const std::span<const CoursePoint> table = c.gyro.bias_temperature_table.points;
    double hottest = std::max({0.0, bias_change(c.gyro, span.least_c), bias_change(c.gyro, span.most_c)});
    for (const CoursePoint& point : table) hottest = std::max(hottest, point.value);
    double most = 1.0;  // of the current over its own
    for (const Fault& fault : c.faults) {
        if (fault.kind == FaultKind::thermal_shock && table.empty())
            hottest += std::abs(c.gyro.bias_temperature_coefficient_per_c * fault.size);
        if (fault.kind == FaultKind::bias_asymmetric) most *= 1.0 + std::abs(fault.size);
    }
    // What 400 deg/s shift the lines by, where that is little.
    const double rotation_hz = 1.44e6 / (c.gyro.scale_arcsec * counts_per_turn(c.laser.quadrature));
    const double rotation_ratio = 0.5 * rotation_hz / (c.laser.zeeman_hz_per_g * c.laser.bias_field_g);
    return c.laser.bias_field_g * ((1.0 + hottest) * most + std::min(0.1, rotation_ratio)) * (1.0 + 1e-9);
}

// A reversal that would meet its neighbour is none.
void check_offset(std::int32_t offset_ticks, double half_s, double edge_s) {
    const double max_ticks = 0.5 * (half_s - edge_s) * timer_hz;
    if (std::abs(static_cast<double>(offset_ticks)) <= max_ticks) return;
    throw std::invalid_argument(fmt::format("actuator frame: edge_offset_ticks is {}, allowed is within +-{}",
                                            offset_ticks, std::floor(max_ticks)));
}

}  // namespace

LaserGyro::LaserGyro(const TwinConfig& config, Motion motion)
    : config_{config},
      motion_{std::move(motion)},
      fringe_arcsec_{config.gyro.scale_arcsec * counts_per_turn(config.laser.quadrature)},
      table_{config.laser, largest_field_g(config)},
      signal_{std::make_shared<const ErrorSignal>(table_, config.laser.bias_field_g)},
      housing_{config_, signal_},
      course_{2 * housing_.n_pieces() * config.gyro.light_samples, housing_.half_s()},
      beats_{config_.laser, config_.seed, table_},
      fringe_photodiodes_{config_},
      // The difference of two beams has sqrt(2) times the noise of one, over a sum of two levels.
      light_noise_{std::sqrt(2.0) * level * std::abs(signal_->averaged().discriminator_per_lambda) *
                   config.gyro.light_noise_lambda},
      light_stream_{config.seed, chance::Cause::light},
      quantum_noise_{config.seed, chance::Cause::quantum} {}

const TwinHalf& LaserGyro::advance(const core::ActuatorFrame& actuator) {
    const BiasHalf bias = enter(actuator);
    half_.truth = {};
    take_light(bias, half_.sensor);
    live_through_half(bias, half_.truth);
    see_fringe(half_);
    offset_ticks_ = actuator.edge_offset_ticks;
    housing_.end_half(actuator, beats_.latch(), offset_ticks_, half_);
    return half_;
}

// Warming scales the field: light and bias change together, the bias nearly in proportion.
BiasHalf LaserGyro::enter(const core::ActuatorFrame& actuator) {
    const double half_s = housing_.half_s();
    check_offset(actuator.edge_offset_ticks, half_s, config_.gyro.bias_edge_s);
    housing_.begin_half(actuator);
    course_.live(housing_.perimeter());
    const double plateau_g = config_.laser.bias_field_g * housing_.bias_growth();
    if (plateau_g != reference_.plateau_g) take_reference(plateau_g);
    return {housing_.bias_sign() * plateau_g, config_.gyro.bias_edge_s, offset_ticks_ / timer_hz,
            half_s + actuator.edge_offset_ticks / timer_hz};
}

void LaserGyro::take_reference(double plateau_g) {
    const auto bias_hz = [&](double part) { return table_.at(0.0, part * plateau_g).left.bias_hz; };
    reference_.plateau_g = plateau_g;
    reference_.plateau_hz = bias_hz(1.0);
    reference_.whole_edge_hz = mean_of({bias_hz(0.0), bias_hz(0.5), reference_.plateau_hz});
    const double lock_hz = std::max(config_.laser.lock_in_left_hz, config_.laser.lock_in_right_hz);
    const double tau = 2.0 * std::numbers::pi;
    reference_.slip_rad = tau * lock_hz * std::sqrt(0.5 * config_.gyro.bias_edge_s / std::abs(reference_.plateau_hz));
    reference_.bend_rad = tau * 0.5 * config_.gyro.bias_edge_s * std::abs(bias_hz(0.5) - 0.5 * reference_.plateau_hz);
    for (std::size_t k = 0; k < n_edge_pieces; ++k) {
        const double from = static_cast<double>(k) / n_edge_pieces;
        const double to = static_cast<double>(k + 1) / n_edge_pieces;
        reference_.edge_hz[k] = mean_of({bias_hz(from), bias_hz(0.5 * (from + to)), bias_hz(to)});
    }
}

// Each sample at the middle of its interval.
void LaserGyro::take_light(const BiasHalf& bias, core::SensorFrame& sensor) {
    const auto n_pieces = static_cast<std::size_t>(housing_.n_pieces());
    const auto n_samples = static_cast<std::size_t>(config_.gyro.light_samples);
    const double interval_s = housing_.half_s() / config_.gyro.light_samples;
    const double per_intensity = level / table_.exact().centre_intensity();
    std::array<double, 2 * core::max_light_samples> noise{};  // of beam A, then of beam B
    if (light_noise_ > 0.0) light_stream_.gauss(housing_.index(), std::span{noise}.first(2 * n_samples));
    const auto seen = [&](double intensity, double deviate) {
        return static_cast<float>(per_intensity * intensity + light_noise_ * deviate);
    };
    for (std::size_t k = 0; k < n_samples; ++k) {
        const double time_s = (static_cast<double>(k) + 0.5) * interval_s;
        const LaserLight light = table_.at(course_.after_step((2 * k + 1) * n_pieces), bias.at(time_s));
        const LightParts left = housing_.light_is_faulty() ? housing_.light_at(time_s) : LightParts{};
        sensor.light_a[k] = seen(left.a * light.cw(), noise[k]);
        sensor.light_b[k] = seen(left.b * light.ccw(), noise[n_samples + k]);
    }
}

void LaserGyro::live_through_half(const BiasHalf& bias, TwinTruth& truth) {
    truth.dtheta_arcsec = turned_arcsec(housing_.start_s(), housing_.end_s());
    truth.detuning_end_lambda = housing_.perimeter().mode().detuning_lambda;
    rotation_hz_ = truth.dtheta_arcsec / fringe_arcsec_ / housing_.half_s();
    followed_ = 0;
    live_edge(bias, true, truth);
    live_plateau(bias, truth);
    beats_.diffuse(housing_.half_s(), quantum_noise_.gauss(housing_.index(), 0),
                   quantum_noise_.gauss(housing_.index(), 1));
    live_edge(bias, false, truth);
}

void LaserGyro::see_fringe(TwinHalf& half) {
    const Signals z = beats_.signals();
    fringe_photodiodes_.sample(housing_.index(),
                               {.turns = core::maths::atan2(z.s, z.c) / (2.0 * std::numbers::pi),
                                .amplitude = housing_.power() * core::maths::hypot(z.s, z.c),
                                .quarter = beats_.beats().latch_quarters(),
                                .plateau_hz = housing_.bias_sign() * followed_ * reference_.plateau_hz,
                                .rotation_hz = rotation_hz_},
                               half.sensor);
}

// One chord is good enough.
bool LaserGyro::edge_is_calm(double at_s, double plateau_g) const {
    const LaserLight light = table_.at(course_.at(at_s), plateau_g);
    const bool is_one_mode = light.lit() == 3U || light.lit() == 12U;
    const double signal = light.discriminator();
    const double error_rad = reference_.slip_rad * (per_bend * reference_.bend_rad + per_signal_sq * signal * signal);
    return is_one_mode && error_rad <= allowed_edge_rad;
}

// The half of a reversal, from zero field or to it.
void LaserGyro::live_edge(const BiasHalf& bias, bool rising, TwinTruth& truth) {
    if (!(bias.half_edge_s() > 0.0)) return;
    const double start_s = rising ? bias.start_s() : bias.plateau_end_s();
    const bool is_calm = edge_is_calm(start_s, bias.plateau_g());
    const std::size_t n = is_calm ? 1 : n_edge_pieces;
    const double piece_s = bias.half_edge_s() / static_cast<double>(n);
    const double drive_hz = common_hz(start_s, start_s + bias.half_edge_s());
    for (std::size_t k = 0; k < n; ++k) {
        Stretch s = stretch(start_s + static_cast<double>(k) * piece_s, piece_s, drive_hz);
        for (std::size_t i = 0; i < s.field_g.size(); ++i) {
            const double part = (static_cast<double>(k) + 0.5 * static_cast<double>(i)) / static_cast<double>(n);
            s.field_g[i] = bias.plateau_g() * (rising ? part : 1.0 - part);
        }
        const double reference_hz = is_calm ? reference_.whole_edge_hz : reference_.edge_hz[rising ? k : n - 1 - k];
        account(beats_.edge(s), reference_hz, piece_s, truth);
    }
}

void LaserGyro::live_plateau(const BiasHalf& bias, TwinTruth& truth) {
    const double start_s = bias.plateau_start_s();
    const double plateau_s = bias.plateau_end_s() - start_s;
    if (!(plateau_s > 0.0)) return;
    const double drive_hz = common_hz(start_s, bias.plateau_end_s());
    const PerimeterCourse::Ends ends = course_.ends();
    const double spread_lambda = ends.most_lambda - ends.least_lambda;
    int n = 1;
    if (spread_lambda > steady_lambda) n = n_calm_stretches;
    if (spread_lambda > calm_lambda || housing_.light_is_faulty()) n = housing_.n_pieces() * config_.gyro.light_samples;
    const double piece_s = plateau_s / n;
    for (int k = 0; k < n; ++k) {
        Stretch s = stretch(start_s + k * piece_s, piece_s, drive_hz);
        s.field_g.fill(bias.plateau_g());
        account(beats_.plateau(s), reference_.plateau_hz, piece_s, truth);
    }
}

// In the garbage of a half that followed no beat, or one after the other, detuning has no share that could be
// separated.
void LaserGyro::account(const Followed& followed, double reference_hz, double duration_s, TwinTruth& truth) {
    if (followed_ == 0) followed_ = followed.helicity;
    if (followed.helicity == 0 || followed.helicity != followed_) {
        truth.lit = false;
        return;
    }
    const double undetuned_hz = housing_.bias_sign() * followed.helicity * reference_hz;
    truth.false_relock_arcsec += fringe_arcsec_ * (followed.bias_hz - undetuned_hz) * duration_s;
}

Stretch LaserGyro::stretch(double from_s, double duration_s, double drive_hz) const {
    Stretch s;
    s.perimeter_lambda = {course_.at(from_s), course_.at(from_s + 0.5 * duration_s), course_.at(from_s + duration_s)};
    s.duration_s = duration_s;
    s.common_hz = drive_hz;
    // gyro.scale_arcsec is what an undetuned turn counts, with what the gas takes from it.
    const double pull = signal_->averaged().scale_pull;
    s.pulled_hz = rotation_hz_ * pull / (1.0 - pull);
    s.rotation_g = 0.5 * (rotation_hz_ + s.pulled_hz) / config_.laser.zeeman_hz_per_g;
    s.helicity_hz = housing_.magnetic_arcsec_s() / fringe_arcsec_;
    if (housing_.light_is_faulty()) {
        const LightParts left = housing_.light_at(from_s + 0.5 * duration_s);
        s.cw_part = left.a;
        s.ccw_part = left.b;
    }
    return s;
}

double LaserGyro::common_hz(double from_s, double to_s) const {
    const double start_s = housing_.start_s();
    const double rate_arcsec_s = turned_arcsec(start_s + from_s, start_s + to_s) / (to_s - from_s);
    return (rate_arcsec_s + config_.drift.nonmagnetic_arcsec_s) / fringe_arcsec_;
}

double LaserGyro::turned_arcsec(double from_s, double to_s) const {
    return motion_.increment_arcsec(from_s, to_s) + housing_.turned_arcsec(from_s, to_s);
}

}  // namespace zlg::twin
