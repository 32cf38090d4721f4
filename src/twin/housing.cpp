#include "housing.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <utility>

#include <zlg/core/common/maths.hpp>

#include "faults/fault_perimeter.hpp"

namespace zlg::twin {
namespace {

// Integral of size sin^2(pi progress) from the start of the fault.
double turned_until_arcsec(const Fault& fault, double time_s) {
    const double part = progress(fault, time_s);
    const double swing = core::maths::sin(2.0 * std::numbers::pi * part) / (2.0 * std::numbers::pi);
    return 0.5 * fault.size * fault.duration_s * (part - swing);
}

// Mean of the coil's current from start_s to end_s over that without fault, in a half of this bias sign.
double bias_ratio(std::span<const Fault> active, int bias_sign, double start_s, double end_s) {
    double ratio = 1.0;
    for (const Fault& fault : active) {
        if (fault.kind == FaultKind::bias_lost) ratio *= 1.0 - fault.size * share(fault, start_s, end_s);
        if (fault.kind == FaultKind::bias_asymmetric)
            ratio *= 1.0 + bias_sign * fault.size * share(fault, start_s, end_s);
    }
    return ratio;
}

// Mean rate of counts that a constant field adds in the left mode and takes in the right one.
double field_counts_s(std::span<const Fault> active, double start_s, double end_s) {
    double sum = 0.0;
    for (const Fault& fault : active) {
        if (fault.kind == FaultKind::field_pulse) sum += fault.size * share(fault, start_s, end_s);
    }
    return sum;
}

// Rotation beyond the motion.
double turned_arcsec(std::span<const Fault> active, double start_s, double end_s) {
    double sum = 0.0;
    for (const Fault& fault : active) {
        if (fault.kind != FaultKind::overspeed) continue;
        sum += turned_until_arcsec(fault, end_s) - turned_until_arcsec(fault, start_s);
    }
    return sum;
}

constexpr double coil_plateau_a = 1.0;
constexpr double coil_adc_range_a = 2.0;
constexpr int coil_adc_bits = 12;

}  // namespace

// Simpson's rule on pieces of 200 us, or a twentieth of the loop's time constant, is good to 1e-7 of the false angle.
// What a fault does to the length has to be seen as well: four pieces for a period of a vibration, ten for a shock.
// With fewer the square of the detuning, which has twice the frequency, would be sampled at one phase only.
int pieces_per_sample(const TwinConfig& config) {
    double piece_s = std::min(200e-6, config.perimeter.tau_s / 20.0);
    for (const Fault& fault : config.faults) piece_s = std::min(piece_s, longest_piece_s(fault, config.vibration_hz));
    const double interval_s = 0.5 * config.gyro.tick_s / config.gyro.light_samples;
    const double wanted = std::ceil(interval_s / piece_s);
    const int pieces = static_cast<int>(std::clamp(wanted, 1.0, double{max_pieces_per_sample}));
    return pieces | 1;
}

Housing::Housing(const TwinConfig& config, std::shared_ptr<const ErrorSignal> signal)
    : config_{config},
      half_s_{0.5 * config.gyro.tick_s},
      half_ticks_{static_cast<std::uint64_t>(std::llround(half_s_ * timer_hz))},
      n_pieces_{pieces_per_sample(config)},
      adc_{config.piezo.range_min_v, config.piezo.range_max_v, config.piezo.adc_bits},
      perimeter_{config, 2 * n_pieces_ * config.gyro.light_samples, std::move(signal)},
      adc_noise_{config.seed, chance::Cause::adc},
      coil_adc_{-coil_adc_range_a, coil_adc_range_a, coil_adc_bits},
      coil_noise_{config.seed, chance::Cause::coil},
      photodiodes_{config.light},
      counter_limit_{config.counter_max_hz},
      warming_{half_s_, config.drift.thermal_time_s},
      faults_{config.faults},
      frame_faults_{config.seed} {
    warming_first_ = warming_end_ = warming_at(0);
    sensed_c_ = config_.gyro.reference_temperature_c + config_.gyro.temperature_rise_c * warming_first_;
    const double lag_s = config_.temperature.sensor_lag_s;
    sensor_gain_ = lag_s > 0.0 ? -core::maths::expm1(-half_s_ / lag_s) : 1.0;
}

double Housing::warming_at(std::uint64_t half) {
    const std::span<const CoursePoint> profile = config_.temperature.profile.points;
    if (profile.empty()) return warming_.at(half);
    const double now_c = between(profile, static_cast<double>(half) * half_s_);
    return (now_c - config_.gyro.reference_temperature_c) / config_.gyro.temperature_rise_c;
}

double Housing::drift_lambda(double warming, double shock_c) const {
    return config_.perimeter.expansion_lambda_per_c * config_.gyro.temperature_rise_c * (warming - warming_first_) +
           config_.perimeter.expansion_lambda_per_c * shock_c;
}

double Housing::half_wave_v(double warming) const {
    const double above_reference_c = config_.gyro.temperature_rise_c * warming + shock_end_c_;
    return config_.piezo.half_wave_v *
           (1.0 + config_.piezo.half_wave_temperature_coefficient_per_c * above_reference_c);
}

double Housing::half_wave_ratio_now() const { return half_wave_ratio(faults_.active(), start_s()); }

int Housing::bias_sign() const {
    return index_ % 2 == 0 ? config_.gyro.first_bias_sign : -config_.gyro.first_bias_sign;
}

double Housing::above_reference_c() const {
    return config_.gyro.temperature_rise_c * 0.5 * (warming_start_ + warming_end_) +
           0.5 * (shock_start_c_ + shock_end_c_);
}

double Housing::bias_growth() const { return (1.0 + bias_change(config_.gyro, above_reference_c())) * coil_ratio(); }

double Housing::coil_ratio() const { return bias_ratio(faults_.active(), bias_sign(), start_s(), end_s()); }

LightParts Housing::light_at(double since_start_s) const {
    return light_parts(faults_.active(), start_s() + since_start_s);
}

double Housing::turned_arcsec(double from_s, double to_s) const {
    return twin::turned_arcsec(faults_.active(), from_s, to_s);
}

double Housing::magnetic_arcsec_s() const {
    const double own_arcsec_s =
        config_.field.kind == FieldKind::none
            ? config_.drift.magnetic_arcsec_s +
                  config_.drift.magnetic_thermal_arcsec_s * 0.5 * (warming_start_ + warming_end_)
            : twin::magnetic_arcsec_s(config_.field, above_reference_c(), 0.5 * (start_s() + end_s()));
    return own_arcsec_s + config_.gyro.scale_arcsec * field_counts_s(faults_.active(), start_s(), end_s());
}

// Once for a half, however often it is entered.
void Housing::enter_faults() {
    if (faults_.is_empty()) return;
    faults_.enter(start_s(), end_s());
    const std::span<const Fault> active = faults_.active();
    const double opening_error = switch_error_lambda(active, start_s());
    is_faulty_ = faults_.moves_perimeter() || faults_.dims_light() || opening_error != 0.0;
    shock_start_c_ = faults_.settled_c() + warming_c(active, start_s());
    shock_end_c_ = faults_.settled_c() + warming_c(active, end_s());
    if (!is_faulty_) return;
    const auto n_steps = static_cast<std::size_t>(2 * n_pieces_ * config_.gyro.light_samples);
    const double step_s = half_s_ / static_cast<double>(n_steps);
    faulty_half_.length_lambda.resize(n_steps + 1);
    faulty_half_.light.resize(n_steps + 1);
    for (std::size_t k = 0; k <= n_steps; ++k) {
        const double time_s = start_s() + static_cast<double>(k) * step_s;
        faulty_half_.length_lambda[k] = faults_.settled_lambda() + length_lambda(active, time_s, config_.vibration_hz);
        faulty_half_.light[k] = light_parts(active, time_s);
    }
    faulty_half_.switch_error_lambda = opening_error;
}

void Housing::begin_half(const core::ActuatorFrame& actuator) {
    const double warming_next = warming_at(index_ + 1);
    enter_faults();
    const bool half_wave_changes = config_.piezo.half_wave_temperature_coefficient_per_c != 0.0 || !faults_.is_empty();
    if (half_wave_changes) perimeter_.take_half_wave(half_wave_v());
    perimeter_.begin_half(actuator, drift_lambda(warming_end_, shock_start_c_),
                          drift_lambda(warming_next, shock_end_c_), is_faulty_ ? &faulty_half_ : nullptr);
    warming_start_ = std::exchange(warming_end_, warming_next);
}

void Housing::end_half(const core::ActuatorFrame& actuator, std::uint64_t counter, std::int32_t offset_ticks,
                       TwinHalf& half) {
    core::SensorFrame& sensor = half.sensor;
    sensor.status = 0;
    sensor.sequence = static_cast<std::uint32_t>(index_);
    sensor.bias_sign = static_cast<std::int8_t>(bias_sign());
    sensor.timer_ticks = (index_ + 1) * half_ticks_ + static_cast<std::uint64_t>(std::int64_t{offset_ticks});
    sensor.counter = counter_limit_.shown(counter, half_s_ + (offset_ticks - offset_before_ticks_) / timer_hz);
    offset_before_ticks_ = offset_ticks;
    sensor.polarity = actuator.polarity;
    sensor.loop_closed = actuator.loop_closed;
    sensor.n_light = static_cast<std::uint8_t>(config_.gyro.light_samples);
    sensor.has_light_b = true;
    half.truth.perimeter_v = perimeter_.voltage_v();
    read_slow(sensor, half.truth.perimeter_v);
    photodiodes_.see(0.5 * (start_s() + end_s()), sensor);
    if (!faults_.is_empty()) frame_faults_.act(faults_.active(), index_, half_s_, sensor);
    ++index_;
}

void Housing::read_slow(core::SensorFrame& sensor, double perimeter_v) {
    const double noise_v = config_.piezo.adc_noise_v > 0.0 ? config_.piezo.adc_noise_v * adc_noise_.gauss(index_) : 0.0;
    sensor.piezo_v = adc_.quantised_v(perimeter_v + noise_v);
    const double noise_a = config_.coil_noise_a > 0.0 ? config_.coil_noise_a * coil_noise_.gauss(index_) : 0.0;
    sensor.coil_current_a = coil_adc_.quantised_v(sensor.bias_sign * coil_plateau_a * coil_ratio() + noise_a);
    const double block_c = temperature_c();
    sensed_c_ = sensor_gain_ < 1.0 ? sensed_c_ + sensor_gain_ * (block_c - sensed_c_) : block_c;
    sensor.temperature_c = sensed_c_ + config_.temperature.sensor_error_c;
}

double Housing::temperature_c() const {
    return config_.gyro.reference_temperature_c + config_.gyro.temperature_rise_c * warming_end_ + shock_end_c_;
}

double Housing::leap(std::int64_t halves) {
    index_ += static_cast<std::uint64_t>(halves);
    warming_start_ = warming_end_ = warming_.at(index_);
    return perimeter_.leap(halves, drift_lambda(warming_end_, shock_end_c_) + faults_.settled_lambda(),
                           half_wave_v(warming_end_));
}

std::int64_t Housing::halves_without_fault() const {
    if (!faults_.active().empty()) return 0;
    return static_cast<std::int64_t>(std::clamp((faults_.next_s() - start_s()) / half_s_, 0.0, 0x1p53));
}

double Housing::voltage_after(std::int64_t halves) {
    const double warming = warming_.at(index_ + static_cast<std::uint64_t>(halves));
    return perimeter_.voltage_after(drift_lambda(warming, shock_end_c_) + faults_.settled_lambda(),
                                    half_wave_v(warming));
}

}  // namespace zlg::twin
