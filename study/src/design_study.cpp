#include <zlg/study/design_study.hpp>

#include <algorithm>
#include <cmath>

#include <zlg/design/substitution.hpp>
#include <zlg/design/substitution_noise.hpp>
#include <zlg/rig/wiring.hpp>

namespace zlg::study {
namespace {

constexpr double relock_tolerance_lambda = 0.01;
constexpr int relock_ticks_shown = 8;
constexpr int relock_ticks_at_most = 2000;
constexpr double relock_time_constants = 20.0;
constexpr int step_ticks = 20;

design::PerimeterLoop perimeter_loop(const config::Config& config) {
    // The electronic detector has no delay of its own; a sampled one averages over a period and acts after it.
    const bool sampled = config.perimeter.loop == config::Loop::digital;
    return {.tau_s = config.perimeter.tau_s,
            .delay_s = sampled ? 0.75 * config.gyro.tick_s : 0.0,
            .rc_s = config.piezo.rc_s};
}

design::RelockLoop relock_loop(const config::Config& config) {
    const bool exponential = config.perimeter.loop == config::Loop::exponential;
    const double lambda_per_v = 0.5 / config.piezo.half_wave_v;
    return {.tick_s = config.gyro.tick_s,
            .tau_s = config.perimeter.tau_s,
            .limit_lambda = exponential ? design::RelockLoop::none : config.perimeter.limit_lambda,
            .rc_s = exponential ? 0.0 : config.piezo.rc_s,
            .slew_lambda_s = exponential ? design::RelockLoop::none : config.piezo.slew_v_s * lambda_per_v,
            .delay_s = perimeter_loop(config).delay_s};
}

design::BiasLaw bias_law(const config::Gyro& gyro) {
    return {.scale_arcsec = gyro.scale_arcsec, .bias_hz = gyro.bias_hz, .chi = gyro.bias_chi};
}

design::MissCauses miss_causes(const config::Config& config) {
    design::MissCauses causes{.half_wave_v = config.piezo.half_wave_v,
                              .half_wave_error_ratio = std::abs(config.piezo.half_wave_error),
                              .range_v = config.piezo.range_max_v - config.piezo.range_min_v,
                              .dac_bits = static_cast<int>(config.piezo.dac_bits)};
    causes.hysteresis_stroke_v = std::max(causes.hysteresis_stroke_v, causes.half_wave_v);
    causes.dwell_s = std::max(config.switching.interval_s, causes.settling_s);
    return causes;
}

void add_relock(const config::Config& config, LoopLine& line) {
    design::RelockLoop loop = relock_loop(config);
    const double miss = config.perimeter.miss_lambda;
    const design::BiasLaw law = bias_law(config.gyro);
    const int ticks = static_cast<int>(
        std::clamp(relock_time_constants * loop.tau_s / loop.tick_s, 40.0, double{relock_ticks_at_most}));
    const auto trace = design::simulate_relock(loop, miss, ticks);
    const auto drift = design::false_drift_arcsec_s(law, trace, -1);
    for (double rate : drift) line.false_angle_arcsec += rate * config.gyro.tick_s;
    line.false_drift_arcsec_s.assign(drift.begin(), drift.begin() + relock_ticks_shown);
    line.false_angle_law_arcsec =
        design::false_angle_law_arcsec(design::bias_deficit_arcsec_s(law, miss), config.gyro.tick_s);
    line.relock_s = design::relock_time_s(loop, miss, relock_tolerance_lambda, ticks);
    line.step = design::step_response(loop, step_ticks);
    loop.limit_lambda = design::RelockLoop::none;
    loop.slew_lambda_s = design::RelockLoop::none;
    line.relock_linear_s = design::relock_time_s(loop, miss, relock_tolerance_lambda, ticks);
}

LoopLine loop_line(const config::Config& config) {
    LoopLine line;
    line.loop = perimeter_loop(config);
    line.margins = design::margins(line.loop);
    line.tick_over_tau = config.gyro.tick_s / config.perimeter.tau_s;
    line.stability_limit = design::sampled_stability_limit(1);
    line.miss = design::initial_miss(miss_causes(config));
    line.capture_lambda =
        design::capture_range_lambda(design::TwoModeDetector{.per_lambda = config.gyro.discriminator_per_lambda}, 0.0);
    add_relock(config, line);
    return line;
}

std::vector<design::Tone> oscillation(const config::Motion& motion) {
    if (motion.kind != config::MotionKind::sine && motion.kind != config::MotionKind::sum) return {{0.0, 0.0}};
    std::vector<design::Tone> tones;
    for (std::size_t k = 0; k < motion.amplitude_arcsec_s.size(); ++k)
        tones.push_back({std::abs(motion.amplitude_arcsec_s[k]), motion.frequency_hz[k]});
    return tones;
}

design::Points points_of(const config::Compensation& c) {
    return {.extrapolation = static_cast<int>(c.extrapolation_points),
            .before = static_cast<int>(c.points_before),
            .after = static_cast<int>(c.points_after)};
}

SubstitutionLine substitution_line(const config::Config& config, int order, int gap_ticks, const design::Tone& tone) {
    const design::Substitution s{
        .order = order, .n = gap_ticks, .points = points_of(config.compensation), .tick_s = config.gyro.tick_s};
    const auto response = design::ErrorResponse::of_sum(s);
    SubstitutionLine line{.order = order, .gap_ticks = gap_ticks, .frequency_hz = tone.frequency_hz};
    line.worst_arcsec = design::worst(response, tone).error_arcsec;
    line.rms_arcsec = design::rms_arcsec(response, tone);
    line.noise_gain = design::sum_gain(s, design::TickNoise::white);
    line.counter_arcsec =
        design::sum_gain(s, design::TickNoise::counter) * design::counter_tick_sigma_arcsec(config.gyro.scale_arcsec);
    line.total_arcsec = design::switch_error_as_printed_arcsec(line.rms_arcsec, line.counter_arcsec);
    return line;
}

int highest_order(const config::Compensation& c) {
    return static_cast<int>(std::min<std::int64_t>(4, c.points_before + c.points_after - 1));
}

std::vector<SubstitutionLine> substitution_lines(const config::Config& config) {
    std::vector<SubstitutionLine> lines;
    const int longest = std::max(5, static_cast<int>(config.switching.gap_ticks));
    for (const design::Tone& tone : oscillation(config.motion))
        for (int n = 1; n <= longest; ++n)
            for (int order = 0; order <= highest_order(config.compensation); ++order)
                lines.push_back(substitution_line(config, order, n, tone));
    return lines;
}

RunLine run_line(const config::Config& config, double run_s) {
    const design::DriftCase task = drift_case(config, run_s);
    RunLine line{.run_s = run_s};
    line.terms = design::corrected_terms(task, design::optimum(design::IntervalMethod::corrected, task).interval_s);
    line.half_first_segment = design::worst_case_optimum(task, design::FirstSegment::half);
    line.corrected_roots = design::corrected_roots(task);
    line.roots_as_printed = design::roots_as_printed(task);
    line.growing_interval_s = design::growing_interval_s(task, design::growth_best);
    line.growing_drift_arcsec_s = design::growing_drift_arcsec_s(task, design::growth_best);
    return line;
}

void add_order_map(const config::Config& config, DesignResult& result) {
    for (int k = 1; k <= 20; ++k) result.map_frequency_hz.push_back(k * 0.01 / config.gyro.tick_s);
    for (int k = -2; k <= 12; ++k) result.map_ratio.push_back(std::pow(10.0, 0.25 * k));
    const design::OrderQuestion question{.substitution = {.n = static_cast<int>(config.switching.gap_ticks),
                                                          .points = points_of(config.compensation),
                                                          .tick_s = config.gyro.tick_s},
                                         .highest_order = highest_order(config.compensation)};
    result.order_map = design::order_map(question, result.map_frequency_hz, result.map_ratio);
}

}  // namespace

design::DriftCase drift_case(const config::Config& config, double run_s) {
    const config::Drift& d = config.drift;
    return {.gyro = {.nonmagnetic_arcsec_s = d.nonmagnetic_arcsec_s,
                     .magnetic_arcsec_s = d.magnetic_arcsec_s,
                     .magnetic_thermal_arcsec_s = d.magnetic_thermal_arcsec_s,
                     .thermal_time_s = d.thermal_time_s},
            .switch_error_arcsec = config.design.switch_error_arcsec,
            .run_s = run_s};
}

double optimal_interval_s(const config::Config& config, double run_s) {
    return design::optimum(design::IntervalMethod::corrected, drift_case(config, run_s)).interval_s;
}

config::Config with_interval(config::Config config) {
    if (!config.switching.interval_optimal) return config;
    const std::int64_t ticks = rig::run_ticks(config, rig::motion(config));
    const double interval_s = optimal_interval_s(config, static_cast<double>(ticks) * config.gyro.tick_s);
    // Shorter than a switch takes it cannot be.
    const double shortest_s = static_cast<double>(config.switching.gap_ticks + 2) * config.gyro.tick_s;
    config.switching.interval_s = std::max(interval_s, shortest_s);
    config.switching.interval_optimal = false;
    return config;
}

DesignResult design_gyro(const config::Config& config) {
    DesignResult result;
    for (double run_s : config.design.run_lengths_s) {
        const design::DriftCase task = drift_case(config, run_s);
        for (design::IntervalMethod method : design::interval_methods)
            result.intervals.push_back(
                {run_s, method, design::optimum(method, task), design::sensitivity(method, task)});
        result.runs.push_back(run_line(config, run_s));
    }
    result.substitution = substitution_lines(config);
    add_order_map(config, result);
    result.loop = loop_line(config);
    return result;
}

}  // namespace zlg::study
