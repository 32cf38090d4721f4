#include <zlg/twin/twin.hpp>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include "averaged_gyro.hpp"
#include "faults/fault_perimeter.hpp"
#include "faults/fault_plan.hpp"
#include "gyro.hpp"
#include "housing.hpp"
#include "laser_gyro.hpp"
#include "refusal.hpp"

namespace zlg::twin {
namespace {

bool has_ideal_piezo(const PiezoConfig& z) {
    return z.hysteresis == 0.0 && z.creep_per_decade == 0.0 && z.mirror_hz == 0.0;
}

void validate_piezo_mirror(const TwinConfig& c) {
    const PiezoConfig& z = c.piezo;
    require_within("piezo.hysteresis_stroke_v", z.hysteresis_stroke_v, 1e-3 * z.half_wave_v, 1e3 * z.half_wave_v);
    if (has_ideal_piezo(z)) return;
    if (c.perimeter.loop == Loop::exponential) {
        throw std::invalid_argument(
            "the exponential loop presumes an ideal piezo: allowed is piezo.hysteresis, piezo.creep_per_decade "
            "and piezo.mirror_hz = 0");
    }
    // A third half-wave is room for what hysteresis and creep take away.
    if (c.perimeter.miss_lambda > 0.0 && !(z.range_max_v - z.range_min_v >= 3.0 * z.half_wave_v)) {
        refuse("piezo.half_wave_v", z.half_wave_v,
               fmt::format("<= (piezo.range_max_v - piezo.range_min_v)/3 = {} where perimeter.miss_lambda > 0 and the "
                           "piezo is not ideal",
                           (z.range_max_v - z.range_min_v) / 3.0));
    }
}

// A length of 1e6 wavelengths still resolves a detuning to 1e-10.
constexpr double max_travel_lambda = 1e6;

// At either end of the warming.
void validate_half_wave(const TwinConfig& c, const char* key, double half_wave_v) {
    const double range_v = c.piezo.range_max_v - c.piezo.range_min_v;
    require_within(key, half_wave_v, 0.5 * range_v / max_travel_lambda, std::numeric_limits<double>::infinity());
    // Only a range of two half-waves holds a place short of a mode of either helicity at any temperature.
    if (c.perimeter.miss_lambda > 0.0 && !(range_v >= 2.0 * half_wave_v)) {
        refuse(key, half_wave_v,
               fmt::format("<= (piezo.range_max_v - piezo.range_min_v)/2 = {} where perimeter.miss_lambda > 0",
                           0.5 * range_v));
    }
}

void validate_perimeter(const TwinConfig& c) {
    const double rise_c = c.gyro.temperature_rise_c;
    require_within("perimeter.expansion_lambda_per_c * gyro.temperature_rise_c",
                   c.perimeter.expansion_lambda_per_c * rise_c, -max_travel_lambda, max_travel_lambda);
    validate_half_wave(c, "piezo.half_wave_v", c.piezo.half_wave_v);
    validate_half_wave(
        c, "piezo.half_wave_v * (1 + piezo.half_wave_temperature_coefficient_per_c * gyro.temperature_rise_c)",
        c.piezo.half_wave_v * (1.0 + c.piezo.half_wave_temperature_coefficient_per_c * rise_c));
    validate_piezo_mirror(c);
}

void require_bias_sign(const GyroConfig& gyro, double warmed_c, const char* by) {
    require_within(fmt::format("1 + gyro.bias_temperature_coefficient_per_c * {}", by),
                   1.0 + gyro.bias_temperature_coefficient_per_c * warmed_c, 1e-3, 1e3);
}

// A field that warming turns over would turn the sign of the bias with it, which no sign of the commutator says. What
// thermal shocks come to after each of them, stays; the gyro's own rise may not have begun then, or be over.
void validate_warmed_bias(const GyroConfig& gyro, std::span<const Fault> in_order) {
    for (const CoursePoint& point : gyro.bias_temperature_table.points)
        require_within("1 + a change of gyro.bias_temperature_table", 1.0 + point.value, 1e-3, 1e3);
    const double rise_c = gyro.temperature_rise_c;
    require_bias_sign(gyro, rise_c, "gyro.temperature_rise_c");
    double shocks_c = 0.0;
    for (std::size_t k = 0; k < in_order.size(); ++k) {
        if (in_order[k].kind == FaultKind::thermal_shock) shocks_c += in_order[k].size;
        if (k + 1 < in_order.size() && in_order[k + 1].at_s == in_order[k].at_s) continue;
        require_bias_sign(gyro, shocks_c, "thermal shocks");
        require_bias_sign(gyro, rise_c + shocks_c, "(gyro.temperature_rise_c + thermal shocks)");
    }
}

// The same that warming is held to, at both ends of a profile.
void validate_profile(const TwinConfig& c) {
    if (c.temperature.profile.points.empty()) return;
    if (c.gyro.temperature_rise_c == 0.0)
        refuse("gyro.temperature_rise_c", 0.0,
               "any but 0 where temperature.profile is given: drift.magnetic_thermal_arcsec_s is the drift by it");
    const TemperatureSpan span = temperature_span(c.gyro, c.temperature);
    require_within("perimeter.expansion_lambda_per_c * (most - least of temperature.profile)",
                   c.perimeter.expansion_lambda_per_c * (span.most_c - span.least_c), -max_travel_lambda,
                   max_travel_lambda);
    for (const double above_c : {span.least_c, span.most_c}) {
        require_bias_sign(c.gyro, above_c, "(temperature.profile - gyro.reference_temperature_c)");
        validate_half_wave(c,
                           "piezo.half_wave_v * (1 + piezo.half_wave_temperature_coefficient_per_c * "
                           "(temperature.profile - gyro.reference_temperature_c))",
                           c.piezo.half_wave_v * (1.0 + c.piezo.half_wave_temperature_coefficient_per_c * above_c));
    }
}

// Each that acts costs its part of every half.
void validate_overlap(std::span<const Fault> in_order) {
    std::vector<double> ends_s;
    for (const Fault& fault : in_order) {
        std::erase_if(ends_s, [&](double end_s) { return end_s <= fault.at_s; });
        ends_s.push_back(fault.at_s + fault.duration_s);
        if (ends_s.size() <= max_faults_at_once) continue;
        throw std::invalid_argument(
            fmt::format("faults: more than {0} act at once at {1:.6g} s; allowed are {0}, or fewer of "
                        "faults.random_per_hour",
                        max_faults_at_once, fault.at_s));
    }
}

void validate_fault(const Fault& fault, Loop loop) {
    const FaultFacts& known = facts(fault.kind);
    require_within(fmt::format("fault {}: faults.size", known.name), fault.size, known.size.least, known.size.most);
    if (loop != Loop::exponential || known.acts_on == FaultActs::elsewhere) return;
    throw std::invalid_argument(
        fmt::format("fault {}: the exponential loop is a formula that no light or length moves: allowed is "
                    "perimeter.loop analog or digital",
                    known.name));
}

// The twin takes a half in so many pieces at most.
void validate_quickest(const TwinConfig& c) {
    const double piece_s = 0.5 * c.gyro.tick_s / c.gyro.light_samples / max_pieces_per_sample;
    for (const Fault& fault : c.faults) {
        if (longest_piece_s(fault, c.vibration_hz) >= piece_s) continue;
        if (fault.kind == FaultKind::vibration)
            refuse("faults.vibration_hz", c.vibration_hz,
                   fmt::format("<= {} with this gyro.tick_s and gyro.light_samples", std::floor(0.25 / piece_s)));
        throw std::invalid_argument(fmt::format(
            "fault {}: faults.duration_s is {}, allowed is 0 or >= {} with this gyro.tick_s and gyro.light_samples",
            facts(fault.kind).name, fault.duration_s, std::ceil(1e10 * piece_s) / 1e9));
    }
}

// Refuse what the arithmetic cannot carry.
//
// errors  std::invalid_argument: the key that the member has in a configuration, value, allowed.
void validate(const TwinConfig& config) {
    validate_perimeter(config);
    validate_quickest(config);
    const FaultPlan plan{config.faults};
    validate_overlap(plan.all());
    validate_warmed_bias(config.gyro, plan.all());
    validate_profile(config);
    if (config.gyro.fidelity == Fidelity::laser) validate(config.laser);  // the section does nothing in the other
    for (const Fault& fault : config.faults) validate_fault(fault, config.perimeter.loop);
}

std::unique_ptr<Gyro> make_gyro(const TwinConfig& config, Motion motion) {
    validate(config);
    if (config.gyro.fidelity == Fidelity::laser) return std::make_unique<LaserGyro>(config, std::move(motion));
    return std::make_unique<AveragedGyro>(config, std::move(motion));
}

}  // namespace

Twin::Twin(const TwinConfig& config, Motion motion) : gyro_{make_gyro(config, std::move(motion))} {}
Twin::~Twin() = default;
Twin::Twin(Twin&&) noexcept = default;
Twin& Twin::operator=(Twin&&) noexcept = default;

const TwinHalf& Twin::advance(const core::ActuatorFrame& actuator) { return gyro_->advance(actuator); }
std::int64_t Twin::quiet_halves() { return gyro_->quiet_halves(); }
std::int64_t Twin::even_halves() { return gyro_->even_halves(); }
double Twin::voltage_after(std::int64_t halves) { return gyro_->voltage_after(halves); }
Leap Twin::leap(std::int64_t halves, const LeapWay& way) { return gyro_->leap(halves, way); }

}  // namespace zlg::twin
