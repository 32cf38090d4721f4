#include <zlg/choice/trial.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

#include <zlg/config/schema.hpp>
#include <zlg/design/error.hpp>
#include <zlg/recorded/motion.hpp>
#include <zlg/study/resolved.hpp>
#include <zlg/study/run.hpp>

#include "ramps.hpp"

namespace zlg::choice {
namespace {

sweep::Description description_of(const Requirement& r, std::uint64_t seed, std::int64_t gyros) {
    sweep::Description d{.n_gyros = gyros, .seed = seed};
    d.parameters = r.tolerance;
    return d;
}

void add_switches(Trial& trial, const std::vector<study::SwitchError>& errors) {
    double sum_sq = 0.0, alternating = 0.0;
    for (const study::SwitchError& e : errors) {
        if (e.unrepaired) continue;
        ++trial.switches;
        alternating += e.window.sign_after * e.error_arcsec;
        sum_sq += e.error_arcsec * e.error_arcsec;
    }
    if (trial.switches == 0) return;
    const auto n = static_cast<double>(trial.switches);
    trial.alternating_arcsec = alternating / n;
    trial.switch_rms_arcsec =
        std::sqrt(std::max(0.0, sum_sq / n - trial.alternating_arcsec * trial.alternating_arcsec));
}

}  // namespace

Trial try_gyro(const Requirement& requirement, const config::Config& gyro, const IsStopped& is_stopped) {
    Trial trial;
    try {
        study::RunTask task{.config = study::resolved(gyro).config};
        if (requirement.angular_acceleration_arcsec_s2 > 0.0)
            task.motion = with_ramps(requirement, task.config, recorded::motion(task.config));
        task.variants.emplace();
        task.has_figures = false;
        task.on_progress = [&](double) {
            if (is_stopped && is_stopped()) throw Stopped{};
        };
        const study::RunResult result = study::run(task);
        const study::VariantResult& configured = result.variants.back();
        trial.error_arcsec = configured.angle_error_without_nonmagnetic_arcsec;
        add_switches(trial, configured.switches);
        const bool is_lost = result.tally.none_succeeded() || result.tally.lacks_many() || configured.unrepaired > 0;
        trial.state = is_lost || !std::isfinite(trial.error_arcsec) ? TrialState::lost : TrialState::good;
        if (is_lost) trial.reason = rig::sentence(result.tally);
    } catch (const config::ConfigError& error) {
        trial.reason = error.what();
    } catch (const design::DesignError& error) {
        trial.reason = error.what();
    }
    return trial;
}

Population::Population(const Requirement& requirement, std::uint64_t seed, std::int64_t gyros, Change change)
    : requirement_{requirement},
      description_{description_of(requirement, seed, gyros)},
      draws_{description_},
      change_{std::move(change)} {}

config::Config Population::gyro(std::int64_t number, const Candidate& candidate) const {
    config::Config config = requirement_.base;
    const std::vector<sweep::Value> values = draws_.values(number);
    for (std::size_t k = 0; k < values.size(); ++k)
        for (const std::string& key : requirement_.tolerance[k].keys)
            config::apply_pair(config, key, sweep::toml_of(values[k]), "drawn");
    config.run.seed = static_cast<std::uint64_t>(sweep::gyro_seed(description_, number));
    config = with(config, candidate);
    if (change_) change_(config);
    config::check(config);
    return config;
}

Trial Population::run(std::int64_t number, const Candidate& candidate, config::Fidelity fidelity,
                      const IsStopped& is_stopped) const {
    try {
        config::Config config = gyro(number, candidate);
        config.gyro.fidelity = fidelity;
        return try_gyro(requirement_, config, is_stopped);
    } catch (const config::ConfigError& error) {
        return {.state = TrialState::refused, .reason = error.what()};
    }
}

}  // namespace zlg::choice
