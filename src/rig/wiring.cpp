#include <zlg/rig/wiring.hpp>

#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include <zlg/config/schema.hpp>
#include <zlg/rig/refusal.hpp>

#include "bias_wiring.hpp"
#include "fault_wiring.hpp"

namespace zlg::rig {
namespace {

using config::ConfigError;

twin::Motion sines(const config::Motion& m) {
    std::vector<twin::Sine> sines;
    for (std::size_t k = 0; k < m.amplitude_arcsec_s.size(); ++k)
        sines.push_back({m.amplitude_arcsec_s[k], m.frequency_hz[k], m.phase_deg[m.phase_deg.size() == 1 ? 0 : k]});
    return twin::Motion::sines(m.rate_arcsec_s, std::move(sines));
}

void refuse_unread(const char* key, const config::Course& course) {
    if (!course.path.empty() && course.points.empty())
        throw ConfigError{
            fmt::format("{} = {}: no files are read here; allowed is [[time, value], ...]", key, course.path)};
}

}  // namespace

twin::Motion motion(const config::Config& config) {
    const config::Motion& m = config.motion;
    switch (m.kind) {
        case config::MotionKind::rest: return twin::Motion::rest();
        case config::MotionKind::constant: return twin::Motion::sines(m.rate_arcsec_s, {});
        case config::MotionKind::sine:
        case config::MotionKind::sum: return sines(m);
        case config::MotionKind::file:
            throw ConfigError{
                "motion.kind = \"file\": no files are read here; allowed are \"rest\", \"constant\", \"sine\", "
                "\"sum\""};
    }
    return twin::Motion::rest();
}

std::int64_t run_ticks(const config::Config& config, const twin::Motion& motion) {
    const double tick_s = config.gyro.tick_s;
    const double available_s = motion.duration_s();
    const double asked_s =
        config.run.duration_s.value_or(std::isfinite(available_s) ? available_s : default_duration_s);
    // A part of a tick in 1e9 is rounding, not a run that is too long.
    if (asked_s > available_s + 1e-9 * tick_s + 1e-12 * available_s)
        throw ConfigError{
            fmt::format("run.duration_s = {}: {} holds {} s of motion", asked_s, config.motion.path, available_s)};
    if (const config::Field& field = config.field;
        field.kind == config::FieldKind::file && !field.course.points.empty())
        if (const double last_s = field.course.points.back().at_s; asked_s > last_s)
            throw ConfigError{
                fmt::format("run.duration_s = {}: {} holds {} s of the field", asked_s, field.course.path, last_s)};
    const double ticks = std::floor(asked_s / tick_s * (1.0 + 1e-12) + 1e-9);
    if (!(ticks >= 1.0))
        throw ConfigError{fmt::format("run.duration_s = {}: allowed is at least one tick, {} s", asked_s, tick_s)};
    return static_cast<std::int64_t>(ticks);
}

twin::TwinConfig twin_config(const config::Config& config) {
    check(config);
    refuse_unread("gyro.bias_temperature_table", config.gyro.bias_temperature_table);
    refuse_unread("temperature.profile", config.temperature.profile);
    if (config.field.kind == config::FieldKind::file) refuse_unread("field.course", config.field.course);
    return {.seed = config.run.seed,
            .gyro = config.gyro,
            .drift = config.drift,
            .temperature = config.temperature,
            .field = config.field,
            .perimeter = config.perimeter,
            .piezo = config.piezo,
            .light = config.light,
            .photodiodes = config.photodiodes,
            .laser = config.laser,
            .counter_max_hz = counter_max_hz(config.gyro),
            .faults = faults_of(config)};
}

core::DiscriminatorCurve discriminator_curve(const config::Config& config, double slope_per_lambda) {
    const config::Perimeter& p = config.perimeter;
    std::vector<double> apparent_lambda = p.discriminator_signal;
    for (double& x : apparent_lambda) x /= std::abs(slope_per_lambda);
    const auto curve = core::discriminator_curve(apparent_lambda, p.discriminator_detuning_lambda);
    if (check(curve) != core::CurveFault::none)
        throw ConfigError{named(
            config,
            fmt::format(
                "perimeter.discriminator_detuning_lambda: {} numbers, perimeter.discriminator_signal: {}, "
                "gyro.discriminator_per_lambda = {}: make no curve; allowed are as many of each, {} at "
                "most on a side of 0, of the same sign and growing, of signals and detunings up to 1e3 wavelengths",
                p.discriminator_detuning_lambda.size(), p.discriminator_signal.size(), slope_per_lambda,
                core::max_side_nodes))};
    return curve;
}

config::Config without_switching(config::Config config) {
    // The longest interval that the schema allows, and no run is longer.
    config.switching.schedule = config::Schedule::fixed;
    config.switching.interval_s = 1e9;
    return config;
}

}  // namespace zlg::rig
