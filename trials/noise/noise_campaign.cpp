#include <zlg/trials/noise_campaign.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <tuple>
#include <utility>

#include <fmt/format.h>

#include <zlg/chance/draw.hpp>
#include <zlg/core/common/maths.hpp>

#include "low_passes.hpp"

namespace zlg::trials {
namespace {

using chance::Draw;
using chance::Draws;
using noise::FittedTerm;
using noise::NoiseKind;
using std::numbers::pi;

constexpr std::size_t n_kinds = 7;
constexpr std::size_t markov_time = 7, sine_frequency = 8, n_scores = 9;
constexpr std::array<const char*, n_scores> score_names{
    "quantisation",      "angle random walk",   "bias instability", "rate random walk",   "ramp",
    "Markov, deviation", "sinusoid, amplitude", "Markov, time",     "sinusoid, frequency"};

// One sample a second, angle random walk 1.
struct RandomGyro {
    std::array<bool, n_kinds> has{};
    std::array<double, n_kinds> value{};
    double time_s = 1.0;
    double frequency_hz = 0.1;
    LowPass filter;

    [[nodiscard]] bool of(NoiseKind kind) const { return has[static_cast<std::size_t>(kind)]; }
    double& size(NoiseKind kind) { return value[static_cast<std::size_t>(kind)]; }
    [[nodiscard]] double size(NoiseKind kind) const { return value[static_cast<std::size_t>(kind)]; }
};

RandomGyro random_gyro(const Draws& draws, double n) {
    RandomGyro g;
    Draw kinds = draws.of("kinds");
    for (bool& has : g.has) has = kinds.is_one_in(2);
    g.has[static_cast<std::size_t>(NoiseKind::angle_random_walk)] = true;
    if (g.of(NoiseKind::bias_instability) && g.of(NoiseKind::markov))
        g.has[static_cast<std::size_t>(draws.of("one of both").is_one_in(2) ? NoiseKind::bias_instability
                                                                            : NoiseKind::markov)] = false;
    g.size(NoiseKind::angle_random_walk) = 1.0;
    // 3 Q^2/tau^2 = 1/tau, K^2 tau/3 = 1/tau
    g.size(NoiseKind::quantisation) = std::sqrt(draws.of("quantisation").within_log(2.0, 16.0) / 3.0);
    const double crossing_s = draws.of("rate random walk").within_log(n / 1024.0, n / 64.0);
    g.size(NoiseKind::rate_random_walk) = std::sqrt(3.0) / crossing_s;
    const double lowest = g.of(NoiseKind::rate_random_walk) ? 2.0 / crossing_s : 32.0 / n;
    g.size(NoiseKind::bias_instability) = draws.of("bias instability").within(1.5, 3.0) * std::sqrt(lowest) / 0.664;
    g.time_s = draws.of("Markov, time").within_log(16.0, n / 256.0);
    g.size(NoiseKind::markov) = std::sqrt(draws.of("Markov, deviation").within(3.0, 30.0) / g.time_s);
    g.frequency_hz = draws.of("sinusoid, frequency").within_log(64.0 / n, 0.4);
    const noise::NoiseTerms noise{
        .angle_random_walk_arcsec_sqrt_s = 1.0,
        .bias_instability_arcsec_s = g.of(NoiseKind::bias_instability) ? g.size(NoiseKind::bias_instability) : 0.0,
        .rate_random_walk_arcsec_s_sqrt_s =
            g.of(NoiseKind::rate_random_walk) ? g.size(NoiseKind::rate_random_walk) : 0.0,
        .markov = {
            {.deviation_arcsec_s = g.of(NoiseKind::markov) ? g.size(NoiseKind::markov) : 0.0, .time_s = g.time_s}}};
    // A line of amplitude A stands against noise of the spectrum S by A^2 T/(2 S); a ramp against the noise of the
    // longest times.
    g.size(NoiseKind::sine) = draws.of("sinusoid, amplitude").within(6.0, 40.0) *
                              std::sqrt(2.0 * noise::rate_spectrum(noise, g.frequency_hz, 1.0) / n);
    g.size(NoiseKind::ramp) = draws.of("sign of the ramp").sign() * draws.of("ramp").within(6.0, 40.0) * 2.0 *
                              std::sqrt(noise::allan_variance(noise, n / 2.0)) / n;
    return g;
}

// Its terms are seen beyond 64 times the memory of its filter, about 0.16/bandwidth.
RandomGyro filtered_gyro(const Draws& draws, double& n) {
    RandomGyro g;
    const auto beside = draws.of("kinds").below(5);
    const bool walks = beside == 1 || beside >= 3, flickers = beside == 2 || beside == 3;
    n = std::floor(draws.of("samples").within_log(walks && flickers ? 1e5 : 1e4, 1e6));
    const double cut_hz =
        draws.of("bandwidth")
            .within_log(std::min(0.14, std::max(0.005, (walks && flickers ? 32.0 : 1.0) * 700.0 / n)), 0.15);
    g.filter = low_pass(static_cast<LowPassKind>(draws.of("filter").below(n_low_passes)), cut_hz);
    const double visible_s = g.filter.bandwidth_hz > 0.0 ? 64.0 * 0.16 / cut_hz : 64.0;
    // Where the white noise meets what is beside it; a rate random walk beside bias instability meets its floor later.
    const double later = walks && flickers ? draws.of("second crossing").within_log(8.0, 32.0) : 1.0;
    const double crossing_s = draws.of("crossing").within_log(std::max(visible_s, n / 1024.0), n / 64.0 / later);
    for (const auto& [kind, has, size] :
         {std::tuple{NoiseKind::angle_random_walk, true, 1.0},
          std::tuple{NoiseKind::rate_random_walk, walks, std::sqrt(3.0 / later) / crossing_s},
          std::tuple{NoiseKind::bias_instability, flickers, 1.0 / (0.664 * std::sqrt(crossing_s))},
          std::tuple{NoiseKind::ramp, beside == 4, 30.0 / (crossing_s * std::sqrt(n))}}) {
        g.has[static_cast<std::size_t>(kind)] = has;
        g.size(kind) = has ? size : 0.0;
    }
    return g;
}

// Means over the samples of an exponentially correlated rate: value and integral together.
void add_markov(std::vector<double>& rates, double deviation, double time_s, Draw draw) {
    const double a = core::maths::exp(-1.0 / time_s), loss = -core::maths::expm1(-1.0 / time_s);
    const double end_variance = loss * (1.0 + a);
    const double both = time_s * loss * loss;
    const double integral_variance = time_s * time_s * (2.0 / time_s - 3.0 + 4.0 * a - a * a);
    // For long times the difference of nearly equal numbers: to first order.
    const double inside = time_s > 1e3 ? 1.0 / (6.0 * time_s) : integral_variance - both * both / end_variance;
    double b = draw.normal();
    for (double& r : rates) {
        const double end = std::sqrt(end_variance) * draw.normal();
        r += deviation *
             (b * time_s * loss + both / end_variance * end + std::sqrt(std::max(0.0, inside)) * draw.normal());
        b = a * b + end;
    }
}

std::vector<double> simulate(const RandomGyro& g, std::size_t n, const Draws& draws) {
    std::vector<double> rates(n, 0.0);
    Draw white = draws.of("angle random walk");
    for (double& r : rates) r += white.normal();
    pass(g.filter, rates);
    if (g.of(NoiseKind::quantisation)) {
        Draw draw = draws.of("quantisation");
        double before = draw.normal();
        for (double& r : rates) {
            const double now = draw.normal();
            r += g.size(NoiseKind::quantisation) * (now - before);
            before = now;
        }
    }
    // 1/f is the sum of such processes with times an octave apart, from far below a sample on.
    std::uint32_t octave = chance::thing_of("bias instability");
    if (g.of(NoiseKind::bias_instability))
        for (double t = 1.0 / 64.0; t < 200.0 * static_cast<double>(n); t *= 2.0)
            add_markov(rates, g.size(NoiseKind::bias_instability) * std::sqrt(std::numbers::ln2 / pi), t,
                       Draw{draws.seed, draws.cause, draws.trial, octave++});
    if (g.of(NoiseKind::rate_random_walk)) {
        Draw draw = draws.of("rate random walk");
        double rate = 0.0;
        for (double& r : rates) {
            const double end = draw.normal(), within = draw.normal();
            r += rate + g.size(NoiseKind::rate_random_walk) * (0.5 * end + within / std::sqrt(12.0));
            rate += g.size(NoiseKind::rate_random_walk) * end;
        }
    }
    if (g.of(NoiseKind::markov)) add_markov(rates, g.size(NoiseKind::markov), g.time_s, draws.of("Markov"));
    const double phase = draws.of("phase of the sinusoid").within(0.0, 2.0 * pi), x = pi * g.frequency_hz;
    for (std::size_t k = 0; k < n; ++k) {
        const double t = static_cast<double>(k) + 0.5;
        if (g.of(NoiseKind::ramp)) rates[k] += g.size(NoiseKind::ramp) * t;
        if (g.of(NoiseKind::sine))
            rates[k] += g.size(NoiseKind::sine) * core::maths::sin(x) / x * core::maths::cos(2.0 * x * t + phase);
    }
    return rates;
}

void add_error(TermScore& score, double error) {
    score.mean += error;
    score.mean_square += error * error;
    score.within_1 += std::abs(error) < 1.0 ? 1.0 : 0.0;
    score.within_2 += std::abs(error) < 2.0 ? 1.0 : 0.0;
}

// The sine of the gyro is the line within two resolution widths of it; any other line is false.
void add_errors(const RandomGyro& g, const noise::NoiseFit& fit, double n, std::vector<TermScore>& scores) {
    std::array<bool, n_kinds> found{}, false_found{};
    for (const FittedTerm& t : fit.fitted) {
        if (!t.found) continue;
        const auto kind = static_cast<std::size_t>(t.kind);
        const bool is_line = t.kind == NoiseKind::sine;
        const bool is_it = g.has[kind] && (!is_line || std::abs(t.second - g.frequency_hz) < 2.0 / n);
        (is_it ? found : false_found)[kind] = true;
        if (!is_it) continue;
        add_error(scores[kind], (t.value - g.value[kind]) / t.sigma);
        if (is_line) add_error(scores[sine_frequency], (t.second - g.frequency_hz) / t.second_sigma);
        if (t.kind == NoiseKind::markov) add_error(scores[markov_time], (t.second - g.time_s) / t.second_sigma);
    }
    for (std::size_t kind = 0; kind < n_kinds; ++kind) {
        scores[kind].present += g.has[kind] ? 1 : 0;
        scores[kind].found += found[kind] ? 1 : 0;
        scores[kind].absent += g.has[kind] ? 0 : 1;
        scores[kind].false_found += false_found[kind] ? 1 : 0;
    }
    for (const FittedTerm& t : fit.fitted) {
        const auto kind = static_cast<std::size_t>(t.kind);
        if (t.found || !std::isfinite(t.limit)) continue;
        ++scores[kind].limits;
        scores[kind].limits_hold += !g.has[kind] || t.limit >= std::abs(g.value[kind]) ? 1 : 0;
    }
}

void judge_bandwidth(const RandomGyro& g, const noise::NoiseFit& fit, NoiseCampaign& campaign) {
    const FittedTerm& white = fit.fitted[static_cast<std::size_t>(NoiseKind::angle_random_walk)];
    const bool has = g.filter.bandwidth_hz > 0.0, found = std::isfinite(white.second);
    TermScore& score = campaign.bandwidth;
    score.present += has ? 1 : 0;
    score.absent += has ? 0 : 1;
    score.found += has && found ? 1 : 0;
    score.false_found += !has && found ? 1 : 0;
    if (!has || !found) return;
    add_error(score, (white.second - g.filter.bandwidth_hz) / white.second_sigma);
    campaign.bandwidths_within_10 += std::abs(white.second / g.filter.bandwidth_hz - 1.0) < 0.1 ? 1 : 0;
}

// The fit of the rates in another unit and at another rate, brought back.
noise::NoiseFit fit_in(double unit, double rate_hz, std::vector<double>& rates) {
    for (double& r : rates) r *= unit;
    noise::NoiseFit fit = noise::fit_noise_in_place(rates, rate_hz);
    // Of a coefficient the power of the rate in its unit, by kind.
    constexpr std::array<double, n_kinds> powers{-1.0, -0.5, 0.0, 0.5, 1.0, 0.0, 0.0};
    for (FittedTerm& t : fit.fitted) {
        const double scale =
            unit * core::maths::exp(powers.at(static_cast<std::size_t>(t.kind)) * core::maths::log(rate_hz));
        for (double* value : {&t.value, &t.sigma, &t.limit}) *value /= scale;
        for (double* value : {&t.second, &t.second_sigma}) *value /= rate_hz;
    }
    return fit;
}

}  // namespace

NoiseCampaign run_noise_campaign(const NoiseCampaignTask& task) {
    NoiseCampaign campaign;
    for (const char* name : score_names) campaign.terms.push_back({.name = name});
    for (int k = 0; k < task.n_gyros; ++k) {
        const auto trial = static_cast<std::uint64_t>(k);
        auto n = static_cast<double>(task.n_samples);
        const Draws draws{task.seed, chance::Cause::noise_gyro, trial};
        const RandomGyro gyro = task.filters ? filtered_gyro(draws, n) : random_gyro(draws, n);
        std::vector<double> rates =
            simulate(gyro, static_cast<std::size_t>(n), {task.seed, chance::Cause::noise_record, trial});
        const auto fit =
            task.filters ? fit_in(draws.of("unit").within_log(1e-4, 1e4), draws.of("rate").within_log(0.01, 1e4), rates)
                         : noise::fit_noise_in_place(rates, 1.0);
        judge_bandwidth(gyro, fit, campaign);
        add_errors(gyro, fit, n, campaign.terms);
        campaign.low_probability += fit.probability < 0.05 ? 1.0 / task.n_gyros : 0.0;
    }
    for (const auto& [second, first] :
         {std::pair{markov_time, NoiseKind::markov}, std::pair{sine_frequency, NoiseKind::sine}}) {
        const TermScore& of = campaign.terms[static_cast<std::size_t>(first)];
        campaign.terms[second].present = of.present;
        campaign.terms[second].found = of.found;
    }
    const auto take_means = [](TermScore& score) {
        for (double* sum : {&score.mean, &score.mean_square, &score.within_1, &score.within_2})
            *sum /= std::max(1, score.found);
    };
    std::ranges::for_each(campaign.terms, take_means);
    take_means(campaign.bandwidth);
    return campaign;
}

std::string campaign_text(const NoiseCampaign& campaign) {
    std::string text =
        "| term | there | found | not there | found falsely | mean error/sigma | mean square | within 1 | within 2 | "
        "limits | that hold |\n|---|---|---|---|---|---|---|---|---|---|---|\n";
    const auto add = [&text](const TermScore& s) {
        text += fmt::format("| {} | {} | {} | {} | {} | {:.2f} | {:.2f} | {:.3f} | {:.3f} | {} | {} |\n", s.name,
                            s.present, s.found, s.absent, s.false_found, s.mean, s.mean_square, s.within_1, s.within_2,
                            s.limits, s.limits_hold);
    };
    std::ranges::for_each(campaign.terms, add);
    if (campaign.bandwidth.present > 0) {
        add(campaign.bandwidth);
        text += fmt::format("\nOf {} bandwidths {} are within 10 %.\n", campaign.bandwidth.found,
                            campaign.bandwidths_within_10);
    }
    return text + fmt::format("\nGoodness below 0.05 in {:.3f} of the fits.\n", campaign.low_probability);
}

}  // namespace zlg::trials
