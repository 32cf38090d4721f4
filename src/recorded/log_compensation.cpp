#include <zlg/recorded/log_compensation.hpp>

#include <fmt/format.h>

#include <zlg/config/log_settings.hpp>
#include <zlg/logs/error.hpp>
#include <zlg/rig/asked_compensation.hpp>
#include <zlg/rig/wiring.hpp>

namespace zlg::recorded {
namespace {

using core::RelockMethod;

void require_column(bool is_there, const char* column, const char* method, const std::string& log_name) {
    if (!is_there)
        throw config::ConfigError{
            fmt::format("compensation.relock = \"{}\" needs the column {}, which {} lacks; "
                        "allowed without it: \"none\", \"frequency\"",
                        method, column, log_name)};
}

RelockMethod relock_of(const config::Config& config, const logs::RawHeader& log, const std::string& log_name) {
    if (!config.compensation.relock && !log.has_detuning_sq) return RelockMethod::none;
    const RelockMethod asked = rig::asked_relock(config);
    if (asked == RelockMethod::detuning) require_column(log.has_detuning, "detuning_lambda", "detuning", log_name);
    if (asked == RelockMethod::mean_square)
        require_column(log.has_detuning_sq, "detuning_sq_lambda2", "mean_square", log_name);
    if (asked == RelockMethod::joint) require_column(log.has_detuning_sq, "detuning_sq_lambda2", "joint", log_name);
    return asked;
}

void add_curves(const config::Config& config, const logs::RawHeader& log, const std::string& log_name,
                LogCompensation& made) {
    const config::Config recorded = as_recorded(config, log.settings, log_name);
    const double slope = recorded.gyro.discriminator_per_lambda;
    const config::Perimeter& with = recorded.perimeter;
    const config::Perimeter& asked = config.perimeter;
    core::CompensationConstants& gyro = made.compensation.gyro;
    const bool has_own = !with.discriminator_signal.empty();
    gyro.record_curve = has_own ? core::DiscriminatorCurve{} : rig::discriminator_curve(config, slope);
    gyro.control_curve = has_own ? rig::discriminator_curve(recorded, slope) : core::DiscriminatorCurve{};
    const bool is_another = with.discriminator_signal != asked.discriminator_signal ||
                            with.discriminator_detuning_lambda != asked.discriminator_detuning_lambda;
    if (has_own && is_another && !asked.discriminator_signal.empty())
        made.warnings.push_back(
            fmt::format("{}: its detunings were read through a discriminator curve of its own; the other "
                        "one, of perimeter.discriminator_signal, is not applied to them",
                        log_name));
}

// What the user ought to know where neither a log nor a configuration has said it.
std::string presumed(const config::Config& config, const logs::RawHeader& log, RelockMethod relock,
                     const std::string& log_name) {
    std::vector<std::string_view> keys{"gyro.bias_hz", "drift.random_walk_arcsec_sqrt_s"};
    if (log.has_temperature) keys.push_back("gyro.bias_temperature_coefficient_per_c");
    if (log.has_edge_offset) keys.push_back("gyro.bias_edge_s");
    if (relock != RelockMethod::none && relock != RelockMethod::frequency) {
        keys.insert(keys.end(), {"gyro.bias_chi", "gyro.light_noise_lambda"});
        // Who gives chi alone says that the loss is a parabola.
        if (!config::is_given(config, "gyro.bias_chi")) keys.push_back("gyro.bias_chi_higher");
    }
    if (relock == RelockMethod::joint && log.light_samples > 0) keys.push_back("gyro.discriminator_per_lambda");
    const std::string list = config::not_given(config, keys);
    return list.empty() ? list
                        : fmt::format("{}: presumed, given by neither log nor configuration: {}", log_name, list);
}

core::Hertz timer_of(const config::Config& config, const logs::RawHeader& log) {
    const config::Gyro& g = config.gyro;
    if (!(g.bias_edge_s < 0.5 * g.tick_s))
        throw config::ConfigError{
            fmt::format("gyro.bias_edge_s = {}: allowed is below half of gyro.tick_s = {}, where edges are shifted",
                        g.bias_edge_s, g.tick_s)};
    if (!(log.timer_hz >= 1.0 && log.timer_hz <= 1e15))
        throw config::ConfigError{
            fmt::format("timer_hz = {}: allowed is 1..1e15, where there are edge_offset_ticks", log.timer_hz)};
    return core::Hertz{log.timer_hz};
}

}  // namespace

config::Config config_of_log(const config::Config& said, const config::Settings& of_log, const std::string& path,
                             bool scale_is_used) {
    config::Settings settings;
    config::Config config;
    try {
        settings = config::checked_log_settings(of_log, path);
        config::apply_log(config, settings, path);
    } catch (const config::ConfigError& error) {
        throw logs::FormatError{error.what()};
    }
    for (const auto& [key, value] : config::to_settings(said))
        if (said.given.contains(key)) config::apply_pair(config, key, value, "the configuration");
    config::require_log_facts(config, path, scale_is_used);
    config::check_compensation(config);
    config::check_against_log(config, settings, path);
    return config;
}

LogCompensation log_compensation(const config::Config& config, const logs::RawHeader& log,
                                 const std::string& log_name) {
    const RelockMethod relock = relock_of(config, log, log_name);
    LogCompensation made{.config = config,
                         .compensation = rig::compensation_config(config, relock, config.compensation.bridge)};
    made.lacks_detuning = !config.compensation.relock && relock == RelockMethod::none;
    made.compensation.relock.presumes = made.lacks_detuning;
    made.config.compensation.relock = relock;
    if (const auto note = config::former_keys_note(log.settings, log_name)) made.notes.push_back(*note);
    made.presumed = presumed(config, log, relock, log_name);
    if (relock == RelockMethod::joint && log.light_samples == 0)
        made.notes.push_back(
            fmt::format("{}: holds no light samples; compensation.relock = \"joint\" takes the mean "
                        "squares of the detuning instead",
                        log_name));
    add_curves(config, log, log_name, made);
    if (log.has_edge_offset) made.compensation.gyro.timer = timer_of(config, log);
    return made;
}

config::Config as_recorded(config::Config config, const config::Settings& log_settings, const std::string& log_name) {
    config.perimeter = {};
    config::apply_log(config, config::checked_log_settings(log_settings, log_name), log_name);
    return config;
}

void require_a_tick(const rig::Replay& replay, const std::string& log_name) {
    if (replay.halves() < 2)
        throw logs::FormatError{fmt::format("{}: holds no whole tick, which is two half-periods", log_name)};
}

}  // namespace zlg::recorded
