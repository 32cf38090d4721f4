#include "validate.hpp"

#include <cmath>
#include <cstddef>
#include <limits>
#include <stdexcept>

#include <fmt/format.h>

#include <zlg/core/records.hpp>

#include "laser/laser.hpp"

namespace zlg::twin {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

[[noreturn]] void refuse(const char* key, double value, const std::string& allowed) {
    throw std::invalid_argument(fmt::format("{} is {}, allowed is {}", key, value, allowed));
}

void require_finite(const char* key, double value) {
    if (!std::isfinite(value)) refuse(key, value, "a finite number");
}

void require_positive(const char* key, double value) {
    if (!(value > 0.0 && value < infinity)) refuse(key, value, "finite and > 0");
}

void require_not_negative(const char* key, double value) {
    if (!(value >= 0.0 && value < infinity)) refuse(key, value, "finite and >= 0");
}

void require_within(const char* key, double value, double min, double max) {
    if (!(value >= min && value <= max)) refuse(key, value, fmt::format("{}..{}", min, max));
}

void validate_bias(const TwinConfig& c) {
    // Half a microsecond is five ticks of the 10 MHz timer; beyond 1000 s the steps would be coarse.
    require_within("gyro.tick_s", c.tick_s, 1e-6, 1000.0);
    require_within("gyro.scale_arcsec", c.scale_arcsec, 1e-6, 1e6);
    require_within("gyro.bias_hz", c.bias_hz, 0.0, 1e12);
    require_not_negative("gyro.bias_chi", c.bias_chi);
    if (!(c.bias_edge_s >= 0.0 && c.bias_edge_s < 0.5 * c.tick_s)) {
        refuse("gyro.bias_edge_s", c.bias_edge_s,
               fmt::format("0 <= gyro.bias_edge_s < gyro.tick_s/2 = {}", 0.5 * c.tick_s));
    }
    if (c.first_bias_sign != 1 && c.first_bias_sign != -1) refuse("gyro.first_bias_sign", c.first_bias_sign, "1 or -1");
    require_finite("gyro.bias_temperature_coefficient_per_c", c.bias_temperature_coefficient_per_c);
    require_finite("gyro.reference_temperature_c", c.reference_temperature_c);
    require_finite("gyro.temperature_rise_c", c.temperature_rise_c);
}

void validate_light_and_drift(const TwinConfig& c) {
    require_within("gyro.light_samples", c.light_samples, 1, core::max_light_samples);
    require_not_negative("gyro.light_noise_lambda", c.light_noise_lambda);
    if (!(std::abs(c.discriminator_per_lambda) > 0.0 && std::isfinite(c.discriminator_per_lambda)))
        refuse("gyro.discriminator_per_lambda", c.discriminator_per_lambda, "finite and not 0");
    require_finite("drift.magnetic_arcsec_s", c.magnetic_arcsec_s);
    require_finite("drift.magnetic_thermal_arcsec_s", c.magnetic_thermal_arcsec_s);
    require_positive("drift.thermal_time_s", c.thermal_time_s);
    require_finite("drift.nonmagnetic_arcsec_s", c.nonmagnetic_arcsec_s);
    require_not_negative("drift.random_walk_arcsec_sqrt_s", c.random_walk_arcsec_sqrt_s);
}

// Beyond these the play operators could not give the loop asked for, or creep would rival the stroke itself.
constexpr double max_hysteresis = 0.4;
constexpr double max_creep_per_decade = 0.05;

bool has_ideal_piezo(const TwinConfig& c) {
    return c.hysteresis == 0.0 && c.creep_per_decade == 0.0 && c.mirror_hz == 0.0;
}

void validate_piezo_mirror(const TwinConfig& c) {
    require_within("piezo.hysteresis", c.hysteresis, 0.0, max_hysteresis);
    require_within("piezo.hysteresis_stroke_v", c.hysteresis_stroke_v, 1e-3 * c.half_wave_v, 1e3 * c.half_wave_v);
    require_within("piezo.creep_per_decade", c.creep_per_decade, 0.0, max_creep_per_decade);
    if (!(c.mirror_hz == 0.0)) require_within("piezo.mirror_hz", c.mirror_hz, 100.0, 1e6);
    require_within("piezo.mirror_damping", c.mirror_damping, 1e-3, 0.999);
    if (has_ideal_piezo(c)) return;
    if (c.loop == LoopKind::exponential) {
        throw std::invalid_argument(
            "the exponential loop presumes an ideal piezo: allowed is piezo.hysteresis, piezo.creep_per_decade "
            "and piezo.mirror_hz = 0");
    }
    // A third half-wave is room for what hysteresis and creep take away.
    if (c.miss_lambda > 0.0 && !(c.range_max_v - c.range_min_v >= 3.0 * c.half_wave_v)) {
        refuse("piezo.half_wave_v", c.half_wave_v,
               fmt::format("<= (piezo.range_max_v - piezo.range_min_v)/3 = {} where perimeter.miss_lambda > 0 and the "
                           "piezo is not ideal",
                           (c.range_max_v - c.range_min_v) / 3.0));
    }
}

// A length of 1e6 wavelengths still resolves a detuning to 1e-10.
constexpr double max_travel_lambda = 1e6;

void validate_perimeter(const TwinConfig& c) {
    // Shorter than a microsecond the loop would be stiff against its steps.
    require_within("perimeter.tau_s", c.tau_s, 1e-6, 1e9);
    require_within("piezo.rc_s", c.rc_s, 1e-6, 1e9);
    require_positive("perimeter.limit_lambda", c.limit_lambda);
    if (!(c.miss_lambda >= 0.0 && c.miss_lambda < two_way_limit_lambda)) {
        refuse("perimeter.miss_lambda", c.miss_lambda,
               fmt::format("0 <= perimeter.miss_lambda < {}", two_way_limit_lambda));
    }
    require_finite("perimeter.expansion_lambda_per_c", c.expansion_lambda_per_c);
    require_within("perimeter.expansion_lambda_per_c * gyro.temperature_rise_c",
                   c.expansion_lambda_per_c * c.temperature_rise_c, -max_travel_lambda, max_travel_lambda);
}

// At either end of the warming.
void validate_half_wave(const TwinConfig& c, const char* key, double half_wave_v, double range_v) {
    require_within(key, half_wave_v, 0.5 * range_v / max_travel_lambda, infinity);
    // Only a range of two half-waves holds a place short of a mode of either helicity at any temperature.
    if (c.miss_lambda > 0.0 && !(range_v >= 2.0 * half_wave_v)) {
        refuse(key, half_wave_v,
               fmt::format("<= (piezo.range_max_v - piezo.range_min_v)/2 = {} where perimeter.miss_lambda > 0",
                           0.5 * range_v));
    }
}

void validate_piezo(const TwinConfig& c) {
    require_finite("piezo.range_min_v", c.range_min_v);
    require_finite("piezo.range_max_v", c.range_max_v);
    const double range_v = c.range_max_v - c.range_min_v;
    if (!(range_v > 0.0 && range_v < infinity)) {
        refuse("piezo.range_max_v", c.range_max_v, fmt::format("finite and > piezo.range_min_v = {}", c.range_min_v));
    }
    require_positive("piezo.half_wave_v", c.half_wave_v);
    require_finite("piezo.half_wave_temperature_coefficient_per_c", c.half_wave_temperature_coefficient_per_c);
    const double warm_half_wave_v =
        c.half_wave_v * (1.0 + c.half_wave_temperature_coefficient_per_c * c.temperature_rise_c);
    validate_half_wave(c, "piezo.half_wave_v", c.half_wave_v, range_v);
    validate_half_wave(
        c, "piezo.half_wave_v * (1 + piezo.half_wave_temperature_coefficient_per_c * gyro.temperature_rise_c)",
        warm_half_wave_v, range_v);
    require_positive("piezo.slew_v_s", c.slew_v_s);
    require_within("piezo.dac_bits", c.dac_bits, 1, 24);
    require_within("piezo.adc_bits", c.adc_bits, 1, 24);
    require_not_negative("piezo.adc_noise_v", c.adc_noise_v);
}

// The members of the others do nothing in the averaged model.
void validate_laser(const TwinConfig& c) {
    if (c.fidelity == Fidelity::averaged) return;
    if (c.fidelity != Fidelity::laser) refuse("gyro.fidelity", static_cast<int>(c.fidelity), "averaged or laser");
    validate(c.laser);
    validate(c.beats);
    require_positive("laser.bias_field_g", c.laser.bias_field_g);
    const double warm = 1.0 + c.bias_temperature_coefficient_per_c * c.temperature_rise_c;
    require_within("1 + gyro.bias_temperature_coefficient_per_c * gyro.temperature_rise_c", warm, 1e-3, 1e3);
}

void validate_fault(const Fault& fault, LoopKind loop) {
    if (static_cast<std::size_t>(fault.kind) >= n_fault_kinds) {
        refuse("fault kind", static_cast<double>(fault.kind), fmt::format("0..{}", n_fault_kinds - 1));
    }
    const FaultFacts& known = facts(fault.kind);
    const auto key = [&](const char* name) { return fmt::format("fault {}: faults.{}", known.name, name); };
    require_within(key("at_s").c_str(), fault.at_s, 0.0, 1e9);
    require_within(key("duration_s").c_str(), fault.duration_s, 0.0, 1e9);
    require_within(key("size").c_str(), fault.size, known.size.least, known.size.most);
    if (loop != LoopKind::exponential || known.acts_on == FaultActs::elsewhere) return;
    throw std::invalid_argument(fmt::format(
        "fault {}: the exponential loop is a formula that no light or length moves: allowed is loop analog or "
        "external",
        known.name));
}

void validate_faults(const TwinConfig& c) {
    require_not_negative("coil_noise_a", c.coil_noise_a);
    if (!(c.counter_max_hz > 0.0)) refuse("gyro.counter_max_hz", c.counter_max_hz, "> 0");
    require_within("faults.vibration_hz", c.vibration_hz, 1e-3, 1e6);
    for (const Fault& fault : c.faults) validate_fault(fault, c.loop);
}

void validate_loop(LoopKind loop) {
    if (loop == LoopKind::analog || loop == LoopKind::exponential || loop == LoopKind::external) return;
    refuse("perimeter.loop", static_cast<int>(loop), "analog, exponential or external");
}

}  // namespace

void validate(const TwinConfig& config) {
    validate_bias(config);
    validate_light_and_drift(config);
    validate_loop(config.loop);
    validate_perimeter(config);
    validate_piezo(config);
    validate_piezo_mirror(config);
    validate_laser(config);
    validate_faults(config);
}

}  // namespace zlg::twin
