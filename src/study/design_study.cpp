#include <zlg/study/design_study.hpp>

#include <algorithm>

#include <zlg/design/error.hpp>
#include <zlg/recorded/motion.hpp>
#include <zlg/rig/refusal.hpp>
#include <zlg/rig/wiring.hpp>
#include <zlg/study/gyro_drift.hpp>
#include <zlg/study/switch_trial.hpp>

#include "design_parts.hpp"

namespace zlg::study {
namespace {

RunLine run_line(const config::Config& config, double switch_error, double run_s) {
    const design::DriftCase task = drift_case(config, run_s);
    RunLine line{.run_s = run_s};
    line.best = best_interval(config, switch_error, run_s);
    line.terms = design::corrected_terms(task, design::optimum(design::IntervalMethod::corrected, task).interval_s);
    line.half_first_segment = design::worst_case_optimum(task, design::FirstSegment::half);
    line.corrected_roots = design::corrected_roots(task);
    line.roots_as_printed = design::roots_as_printed(task);
    return line;
}

}  // namespace

design::DriftCase drift_case(const config::Config& config, double run_s) {
    return {.gyro = gyro_drift(config), .switch_error_arcsec = config.design.switch_error_arcsec, .run_s = run_s};
}

design::Optimum best_interval(const config::Config& config, double switch_error_arcsec, double run_s) {
    design::DriftCase task = drift_case(config, run_s);
    task.switch_error_arcsec = switch_error_arcsec;
    return design::expected_optimum(task, config.switching.first_segment);
}

config::Config with_interval(config::Config config, double switch_error_arcsec) {
    if (!config.switching.interval_optimal) return config;
    const std::int64_t ticks = rig::run_ticks(config, recorded::motion(config));
    const double run_s = static_cast<double>(ticks) * config.gyro.tick_s;
    const double interval_s = best_interval(config, switch_error_arcsec, run_s).interval_s;
    config.switching.interval_s = std::max(interval_s, shortest_interval_s(config));
    config.switching.interval_optimal = false;
    return config;
}

namespace {

DesignResult designed(const config::Config& config) {
    if (config.drift.magnetic_arcsec_s == 0.0 && config.drift.magnetic_thermal_arcsec_s == 0.0)
        throw design::DesignError{
            "drift.magnetic_arcsec_s and drift.magnetic_thermal_arcsec_s are both 0: without a magnetic drift there is "
            "nothing to switch for; allowed is any other pair"};
    DesignResult result;
    const SwitchCost cost = switch_cost(config);
    result.switch_error_is_given = cost.source == SwitchErrorSource::given;
    result.switch_error_source = text(cost.source);
    result.switch_error_arcsec = cost.error_arcsec;
    for (double run_s : config.design.run_lengths_s) {
        const design::DriftCase task = drift_case(config, run_s);
        for (design::IntervalMethod method : design::interval_methods)
            result.intervals.push_back({run_s, method, design::optimum(method, task)});
        result.runs.push_back(run_line(config, result.switch_error_arcsec, run_s));
    }
    result.substitution = substitution_lines(config);
    result.loop = loop_line(config);
    return result;
}

}  // namespace

DesignResult design_gyro(const config::Config& config) {
    try {
        return designed(config);
    } catch (const design::DesignError& error) {
        throw design::DesignError{rig::named(config, error.what())};
    }
}

}  // namespace zlg::study
