#include <algorithm>
#include <cmath>
#include <limits>

#include <zlg/design/substitution_noise.hpp>
#include <zlg/recorded/motion.hpp>
#include <zlg/rig/wiring.hpp>

#include "design_parts.hpp"

namespace zlg::study {
namespace {

using design::Substitution;

// What the motion leaves in the angle of a gap.
struct MotionError {
    double frequency_hz = std::numeric_limits<double>::quiet_NaN();
    double worst_arcsec = 0.0;
    double rms_arcsec = 0.0;
};

// A recorded motion, tick by tick: the gap is laid at every place of the record.
MotionError on_record(const Substitution& s, const std::vector<double>& tick_arcsec) {
    const std::vector<int> at = design::positions(s);
    const std::vector<double> weight = design::sum_weights(s);
    const auto before = static_cast<std::size_t>(1 - at.front());
    const auto after = static_cast<std::size_t>(std::max(at.back(), s.n));
    MotionError error;
    double sum_sq = 0.0;
    std::size_t n = 0;
    for (std::size_t origin = before; origin + after < tick_arcsec.size(); ++origin, ++n) {
        double e = 0.0;
        for (std::size_t k = 0; k < at.size(); ++k)
            e += weight[k] * tick_arcsec[static_cast<std::size_t>(static_cast<std::ptrdiff_t>(origin) + at[k])];
        for (int j = 1; j <= s.n; ++j) e -= tick_arcsec[origin + static_cast<std::size_t>(j)];
        error.worst_arcsec = std::max(error.worst_arcsec, std::abs(e));
        sum_sq += e * e;
    }
    error.rms_arcsec = n > 0 ? std::sqrt(sum_sq / static_cast<double>(n)) : std::numeric_limits<double>::quiet_NaN();
    return error;
}

std::vector<double> recorded_ticks(const config::Config& config) {
    const twin::Motion motion = recorded::motion(config);
    std::vector<double> ticks(static_cast<std::size_t>(rig::run_ticks(config, motion)));
    for (std::size_t k = 0; k < ticks.size(); ++k)
        ticks[k] = motion.increment_arcsec(static_cast<double>(k) * config.gyro.tick_s,
                                           static_cast<double>(k + 1) * config.gyro.tick_s);
    return ticks;
}

std::vector<design::Tone> tones_of(const config::Motion& motion) {
    if (motion.kind != config::MotionKind::sine && motion.kind != config::MotionKind::sum) return {{0.0, 0.0}};
    std::vector<design::Tone> tones;
    for (std::size_t k = 0; k < motion.amplitude_arcsec_s.size(); ++k)
        tones.push_back({std::abs(motion.amplitude_arcsec_s[k]), motion.frequency_hz[k]});
    return tones;
}

std::vector<MotionError> on_tones(const Substitution& s, const std::vector<design::Tone>& tones) {
    const auto response = design::ErrorResponse(s);
    std::vector<MotionError> errors;
    for (const design::Tone& tone : tones)
        errors.push_back(
            {tone.frequency_hz, design::worst(response, tone).error_arcsec, design::rms_arcsec(response, tone)});
    if (tones.size() > 1)
        errors.push_back({.worst_arcsec = design::worst_bound_arcsec(response, tones),
                          .rms_arcsec = design::rms_arcsec(response, tones)});
    return errors;
}

// Directly in the angle, and through the points after the gap.
double relock_arcsec(const Substitution& s, const RelockResidual& residual) {
    if (!residual.random) return std::abs(design::relock_residual_arcsec(s, residual.tick_arcsec));
    double variance = 0.0;
    for (std::size_t k = 0; k < residual.tick_arcsec.size(); ++k) {
        std::vector<double> one(residual.tick_arcsec.size(), 0.0);
        one[k] = residual.tick_arcsec[k];
        const double e = design::relock_residual_arcsec(s, one);
        variance += e * e;
    }
    return std::sqrt(variance);
}

SubstitutionLine line_of(const config::Config& config, const Substitution& s, const MotionError& error,
                         const RelockResidual& residual) {
    SubstitutionLine line{.order = s.order,
                          .gap_ticks = s.n,
                          .frequency_hz = error.frequency_hz,
                          .worst_arcsec = error.worst_arcsec,
                          .rms_arcsec = error.rms_arcsec};
    line.noise_gain = design::sum_gain(s, design::TickNoise::white);
    line.counter_arcsec =
        design::sum_gain(s, design::TickNoise::counter) * design::counter_tick_sigma_arcsec(config.gyro.scale_arcsec);
    line.relock_arcsec = relock_arcsec(s, residual);
    line.total_arcsec = design::switch_error_arcsec(line.rms_arcsec, line.counter_arcsec, line.relock_arcsec);
    return line;
}

}  // namespace

design::Points points_of(const config::Compensation& c) {
    return {.extrapolation = static_cast<int>(c.extrapolation_points),
            .before = static_cast<int>(c.points_before),
            .after = static_cast<int>(c.points_after)};
}

int highest_order(const config::Compensation& c) {
    return static_cast<int>(std::min<std::int64_t>(4, c.points_before + c.points_after - 1));
}

std::vector<SubstitutionLine> substitution_lines(const config::Config& config) {
    const bool recorded = config.motion.kind == config::MotionKind::file;
    const std::vector<double> ticks = recorded ? recorded_ticks(config) : std::vector<double>{};
    const std::vector<design::Tone> tones = tones_of(config.motion);
    const RelockResidual residual = relock_residual(config);
    std::vector<SubstitutionLine> lines;
    const int longest = std::max(5, static_cast<int>(config.switching.gap_ticks));
    for (int n = 1; n <= longest; ++n) {
        for (int order = 0; order <= highest_order(config.compensation); ++order) {
            const Substitution s{
                .order = order, .n = n, .points = points_of(config.compensation), .tick_s = config.gyro.tick_s};
            for (const MotionError& error : recorded ? std::vector{on_record(s, ticks)} : on_tones(s, tones))
                lines.push_back(line_of(config, s, error, residual));
        }
    }
    return lines;
}

}  // namespace zlg::study
