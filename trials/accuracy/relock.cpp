#include <array>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include <zlg/core/compensation/switch_light.hpp>
#include <zlg/numeric/parallel.hpp>

#include "bound.hpp"
#include "parts.hpp"
#include "synthetic/gyro.hpp"

namespace zlg::trials {
namespace {

// Half-ticks after the loop is closed.
constexpr int relock_halves = 40;

// One gyro at rest, one switch: the profile estimated from its light against the true decay.
SwitchError trial_of(const GyroLaw& law, std::uint64_t seed) {
    constexpr int halves_before = 4;
    SyntheticGyro gyro{law, {}, seed};
    for (int h = 0; h < halves_before; ++h) gyro.advance();
    gyro.open();
    for (int h = 0; h < 2 * law.gap_ticks; ++h) gyro.advance();

    const core::CompensationConstants constants{.light_noise = core::Wavelengths{law.light_noise_lambda},
                                                .light_samples = law.light_samples};
    const core::RelockProfileConfig config{.discriminator_per_lambda = synthetic_discriminator_per_lambda};
    core::SwitchLight state{.armed = true};
    std::array<double, relock_halves> per_lambda2{};
    SwitchError e{.sigma_arcsec = std::numeric_limits<double>::infinity()};
    for (std::size_t k = 0; k < per_lambda2.size(); ++k) {
        const SyntheticHalf half = gyro.advance();
        step(constants, config, state, half.record, half.light, true, static_cast<std::int64_t>(k), relock_halves);
        const int sign = half.record.bias_sign * half.record.mode;
        if (k == 0) e.sign = sign;
        per_lambda2[k] = -sign * law.chi * law.bias_hz * law.scale_arcsec * 0.5 * law.tick_s;
        e.error_arcsec -= half.false_arcsec;
    }
    const core::LightFit fit{state.sums, law.light_noise_lambda};
    if (!fit.is_known()) return e;
    double variance = 0.0;
    for (int k = 0; k < relock_halves; ++k) {
        const double a = per_lambda2[static_cast<std::size_t>(k)];
        e.error_arcsec += a * fit.angle(fit.half(k));
        for (int j = 0; j < relock_halves; ++j)
            variance += a * per_lambda2[static_cast<std::size_t>(j)] * fit.covariance(fit.half(k), fit.half(j));
    }
    e.sigma_arcsec = std::sqrt(variance);
    return e;
}

std::vector<GyroLaw> laws() {
    std::vector<GyroLaw> all;
    for (LoopShape loop : loop_shapes)
        for (double miss : {0.22, 0.1}) all.push_back({.miss_lambda = miss, .loop = loop});
    return all;
}

}  // namespace

std::vector<RelockFigures> measure_relock(const AccuracyTask& task) {
    const std::vector<GyroLaw> all = laws();
    const std::size_t trials = task.quick ? 1000 : 10000;
    std::vector<RelockFigures> figures(all.size());
    numeric::in_parallel(all.size(), task.threads, [&](std::size_t c) {
        std::vector<SwitchError> errors;
        for (std::size_t k = 0; k < trials; ++k) errors.push_back(trial_of(all[c], (task.seed << 40) + (c << 30) + k));
        figures[c] = {.name = fmt::format("{}, miss {}", loop_name(all[c].loop), all[c].miss_lambda),
                      .bound_arcsec = bound_of(all[c], {}).relock_arcsec,
                      .error = figures_of(errors)};
    });
    return figures;
}

}  // namespace zlg::trials
