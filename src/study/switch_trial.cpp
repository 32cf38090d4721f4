#include <zlg/study/switch_trial.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <vector>

#include <zlg/config/schema.hpp>
#include <zlg/recorded/motion.hpp>
#include <zlg/rig/wiring.hpp>
#include <zlg/study/compensated_run.hpp>

namespace zlg::study {
namespace {

constexpr std::size_t n_learning = 8;  // switches
constexpr std::size_t n_judged = 20;
constexpr std::array interval_ratios{1.0, 1.37, 1.73};
constexpr std::int64_t min_switches = 4;
constexpr int averaged_ticks = 40;
constexpr double max_ticks = 20'000.0;  // for a loop so slow that its switches would take hours

config::Config on_trial(config::Config config) {
    config.drift.magnetic_arcsec_s = 0.0;
    config.drift.magnetic_thermal_arcsec_s = 0.0;
    config.drift.nonmagnetic_arcsec_s = 0.0;
    config.faults = {};
    config.switching.interval_optimal = false;
    config.switching.schedule = config::Schedule::fixed;
    config.switching.first_segment = config::FirstSegment::full;
    config.compensation.magnetic = core::MagneticMethod::none;
    config.run.duration_s.reset();
    return config;
}

// Ticks of a trial, of what the motion holds.
std::int64_t trial_ticks(const config::Config& config) {
    const double wanted_s = (n_learning + n_judged + 1) * config.switching.interval_s;
    const double available_s = recorded::motion(config).duration_s();
    const double ticks = std::min(wanted_s, available_s) / config.gyro.tick_s * (1.0 - 1e-12);
    return static_cast<std::int64_t>(std::min(ticks, max_ticks));
}

bool phase_is_known(const config::Config& config) { return config.gyro.fidelity != config::Fidelity::laser; }

// What stays in the angle for ever, where the roundings of the counter are not known and the errors of the meter hold
// that of the last tick: the step between the means before the gap and after the re-lock.
std::vector<SwitchError> lasting(const ErrorMeter& run) {
    const std::vector<double>& angle = run.curve().error_arcsec;  // after each tick
    const auto mean = [&](std::int64_t from) {
        const auto first = angle.begin() + static_cast<std::ptrdiff_t>(from);
        return std::accumulate(first, first + averaged_ticks, 0.0) / averaged_ticks;
    };
    std::vector<SwitchError> steps;
    for (SwitchError e : run.switches()) {
        const std::int64_t before = e.window.first_tick - averaged_ticks;
        const std::int64_t after = e.window.last_tick + 1;
        if (before < 0 || after + averaged_ticks > static_cast<std::int64_t>(angle.size())) continue;
        e.error_arcsec = mean(after) - mean(before);
        steps.push_back(e);
    }
    return steps;
}

struct Judged {
    std::vector<SwitchError> errors;

    void add(const config::Config& config) {
        const ErrorMeter run = compensated_run(config, trial_ticks(config), 1);
        const std::vector<SwitchError> all = phase_is_known(config) ? run.switches() : lasting(run);
        // A short motion file leaves no room for learning.
        const std::size_t skipped = all.size() > 2 * n_learning ? n_learning : 0;
        errors.insert(errors.end(), all.begin() + static_cast<std::ptrdiff_t>(skipped), all.end());
    }
};

// What the gyro would have walked in the same ticks. What walks in fidelity laser is lock-in, part of every reading.
double walk_arcsec2(const config::Config& config, const SwitchWindow& window) {
    if (!phase_is_known(config)) return 0.0;
    const double walk = config.drift.random_walk_arcsec_sqrt_s;
    const auto ticks = static_cast<double>(window.last_tick + 1 - window.first_tick);
    return walk * walk * ticks * config.gyro.tick_s;
}

SwitchTrial statistics_of(const config::Config& config, const std::vector<SwitchError>& errors) {
    SwitchTrial trial{.switches = static_cast<std::int64_t>(errors.size())};
    if (trial.switches < min_switches) return trial;
    const auto n = static_cast<double>(errors.size());
    for (const SwitchError& e : errors) trial.alternating_arcsec += e.window.sign_after * e.error_arcsec / n;
    double sum_sq = 0.0;
    double walk_sum_4 = 0.0;
    for (const SwitchError& e : errors) {
        const double own = e.error_arcsec - e.window.sign_after * trial.alternating_arcsec;
        const double walk = walk_arcsec2(config, e.window);
        sum_sq += own * own - walk;
        walk_sum_4 += walk * walk;
    }
    const double scatter = std::sqrt(2.0 * walk_sum_4);
    trial.is_resolved = sum_sq >= scatter;
    // No switch is better than a thousandth of a count, or the interval would have no least.
    const double least = 1e-3 * config.gyro.scale_arcsec;
    trial.rms_arcsec = std::max(std::sqrt(std::max(sum_sq, scatter) / (n - 1.0)), least);
    return trial;
}

}  // namespace

double shortest_interval_s(const config::Config& config) {
    const core::ModeSwitchConfig made = rig::control_config(on_trial(config)).mode_switch;
    const auto ticks = static_cast<double>(made.gap_ticks + config.compensation.relock_ticks + 2 * made.settle_ticks);
    return ticks * config.gyro.tick_s;
}

SwitchTrial try_switches(const config::Config& config) {
    config::Config trial = on_trial(config);
    const core::ModeSwitchConfig made = rig::control_config(trial).mode_switch;
    const double base_s =
        std::max(2.0 * shortest_interval_s(config),
                 static_cast<double>(made.gap_ticks + 2 * made.lock_timeout_ticks) * trial.gyro.tick_s);
    if (max_ticks * trial.gyro.tick_s < 2.0 * min_switches * base_s) return {};
    Judged judged;
    for (const double ratio : interval_ratios) {
        trial.switching.interval_s = ratio * base_s;
        judged.add(trial);
    }
    return statistics_of(trial, judged.errors);
}

std::string_view text(SwitchErrorSource source) {
    // In the order of the enumerators.
    constexpr std::array<std::string_view, 4> texts{
        "as design.switch_error_arcsec says", "as tried on the twin",
        "all that a trial on the twin resolves beside drift.random_walk_arcsec_sqrt_s",
        "the default of design.switch_error_arcsec, for fewer than 4 switches could be tried on the twin"};
    return texts.at(static_cast<std::size_t>(source));
}

SwitchCost switch_cost(const config::Config& config) {
    if (config::is_given(config, "design.switch_error_arcsec"))
        return {config.design.switch_error_arcsec, SwitchErrorSource::given};
    const SwitchTrial trial = try_switches(config);
    if (trial.switches < min_switches) return {config.design.switch_error_arcsec, SwitchErrorSource::presumed};
    return {trial.rms_arcsec, trial.is_resolved ? SwitchErrorSource::tried : SwitchErrorSource::unresolved};
}

double switch_error_arcsec(const config::Config& config) { return switch_cost(config).error_arcsec; }

}  // namespace zlg::study
