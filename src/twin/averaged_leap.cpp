// Leaps of the averaged gyro.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include <zlg/core/common/maths.hpp>

#include "averaged_gyro.hpp"

namespace zlg::twin {
namespace {

// Mean of 1 - exp(-t/T) from t0 to t1.
double mean_warming(double thermal_time_s, double start_s, double end_s) {
    const double length = (end_s - start_s) / thermal_time_s;
    return 1.0 + core::maths::exp(-start_s / thermal_time_s) * core::maths::expm1(-length) / length;
}

}  // namespace

std::string why_no_leap(const TwinConfig& config) {
    const std::array memories{std::pair{"piezo.hysteresis", config.piezo.hysteresis},
                              std::pair{"piezo.creep_per_decade", config.piezo.creep_per_decade},
                              std::pair{"piezo.mirror_hz", config.piezo.mirror_hz},
                              std::pair{"temperature.sensor_lag_s", config.temperature.sensor_lag_s}};
    for (const auto& [key, value] : memories)
        if (value != 0.0) return fmt::format("{} = {}", key, value);
    if (config.temperature.profile.is_given()) return "temperature.profile";
    if (config.gyro.bias_temperature_table.is_given()) return "gyro.bias_temperature_table";
    if (config.field.kind == FieldKind::sine) return "field.kind = \"sine\"";
    if (config.field.kind == FieldKind::file) return "field.kind = \"file\"";
    return {};
}

// What adds to the phase in halves start, start + 1, ... beside the walk.
struct AveragedGyro::Drifts {
    std::uint64_t start = 0;
    double rate_arcsec_s = 0.0;      // of both drifts
    double first_bias_cycles = 0.0;  // of a half of positive sign, at the start,
    double last_bias_cycles = 0.0;   // and at the end
};

std::int64_t AveragedGyro::quiet_halves() { return can_leap_ ? housing_.halves_without_fault() : 0; }

std::int64_t AveragedGyro::even_halves() {
    const double stays_s = field_stays_until_s(config_.field, housing_.start_s()) - housing_.start_s();
    return static_cast<std::int64_t>(std::min(stays_s / housing_.half_s(), 0x1p53));
}

// Mean of a stretch in which the field stays.
double AveragedGyro::magnetic_arcsec_s(double start_s, double end_s) const {
    const DriftConfig& d = config_.drift;
    const double warmed = mean_warming(d.thermal_time_s, start_s, end_s);
    if (config_.field.kind == FieldKind::none) return d.magnetic_arcsec_s + d.magnetic_thermal_arcsec_s * warmed;
    const double above_c = config_.gyro.temperature_rise_c * warmed + housing_.shock_c();
    return twin::magnetic_arcsec_s(config_.field, above_c, start_s);
}

Leap AveragedGyro::leap(std::int64_t halves, const LeapWay& way) {
    const std::uint64_t start = housing_.index();
    const double start_s = housing_.start_s();
    const double half_s = housing_.half_s();
    const Mode mode = housing_.perimeter().mode();
    const double hz_before = bias_hz();
    const std::uint64_t counter = counter_.value();
    Leap made{.halves = halves, .start_place = counter_.fraction(), .set_point_v = housing_.leap(halves)};
    const double end_s = housing_.start_s();
    const double lit =
        mode.helicity() * half_s * (1.0 - config_.gyro.bias_chi * mode.detuning_lambda * mode.detuning_lambda);
    const Drifts drifts{
        .start = start,
        .rate_arcsec_s = mode.helicity() * magnetic_arcsec_s(start_s, end_s) + config_.drift.nonmagnetic_arcsec_s,
        .first_bias_cycles = lit * hz_before,
        .last_bias_cycles = lit * bias_hz()};
    made.dtheta_arcsec = motion_.increment_arcsec(start_s, end_s);
    if (way.singly)
        pass_singly(drifts, made);
    else
        pass_over(drifts, made);
    if (way.noise.sigma_lambda > 0.0) add_detuning_noise(drifts, way.noise, made);
    made.counts = static_cast<std::int64_t>(counter_.value() - counter);
    housing_.count_on(counter_.value());
    made.rounding_arcsec = -config_.gyro.scale_arcsec * counter_.fraction();
    made.temperature_c = housing_.temperature_c() + config_.temperature.sensor_error_c;
    made.light_before = housing_.photodiodes().centred(start_s);
    made.light_after = housing_.photodiodes().centred(end_s);
    made.bias_ratio = hz_before != 0.0 ? bias_hz() / hz_before : 1.0;
    return made;
}

// Of a bias that grows evenly, b per half, the signs +, -, +, - leave -b n/2.
void AveragedGyro::pass_over(const Drifts& drifts, Leap& made) {
    const auto n = static_cast<double>(made.halves);
    const double walk =
        walk_of_half_arcsec_ * std::sqrt(n) * Noise{config_.seed, chance::Cause::leap}.gauss(drifts.start, 0);
    const double turned = made.dtheta_arcsec + drifts.rate_arcsec_s * n * housing_.half_s() + walk;
    const double growth = drifts.last_bias_cycles - drifts.first_bias_cycles;
    made.turned_counts = turned / config_.gyro.scale_arcsec - 0.5 * housing_.bias_sign() * growth;
    counter_.advance(made.turned_counts);
}

void AveragedGyro::add_detuning_noise(const Drifts& drifts, const DetuningNoise& noise, Leap& made) {
    const double lambda2 = noise.sigma_lambda * noise.sigma_lambda;
    const double kept = noise.kept * noise.kept;
    const double deviation = lambda2 * std::sqrt(2.0 * static_cast<double>(made.halves) * (1.0 - kept) / (1.0 + kept));
    const double cycles = drifts.first_bias_cycles * config_.gyro.bias_chi * deviation *
                          Noise{config_.seed, chance::Cause::leap, 2}.gauss(drifts.start, 0);
    made.turned_counts += cycles;
    counter_.advance(cycles);
}

void AveragedGyro::pass_singly(const Drifts& drifts, Leap& made) {
    const double half_s = housing_.half_s();
    const double scale = config_.gyro.scale_arcsec;
    const bool by_phase = config_.gyro.readout == Readout::phase;
    const Noise reading{config_.seed, chance::Cause::leap, 1};
    const double growth = (drifts.last_bias_cycles - drifts.first_bias_cycles) / static_cast<double>(made.halves);
    int sign = housing_.bias_sign();
    made.half.resize(static_cast<std::size_t>(made.halves));
    std::vector<double> turn(made.half.size());
    motion_.increments_arcsec(static_cast<double>(drifts.start) * half_s, half_s, turn);
    for (std::size_t k = 0; k < made.half.size(); ++k, sign = -sign) {
        const std::uint64_t half = drifts.start + k;
        const double walk = walk_of_half_arcsec_ > 0.0 ? walk_of_half_arcsec_ * walk_noise_.gauss(half) : 0.0;
        const double cycles = sign * (drifts.first_bias_cycles + growth * static_cast<double>(k)) +
                              (turn[k] + drifts.rate_arcsec_s * half_s + walk) / scale;
        const std::uint64_t before = counter_.value();
        counter_.advance(cycles);
        made.turned_counts += cycles;
        QuietHalf& one = made.half[k];
        one.counts = static_cast<std::int64_t>(counter_.value() - before);
        one.place = counter_.fraction();
        if (by_phase) one.place_deviate = reading.gauss(half, 0);
        one.bias_sign = static_cast<std::int8_t>(sign);
    }
}

}  // namespace zlg::twin
