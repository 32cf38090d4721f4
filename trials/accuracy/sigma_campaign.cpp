#include <zlg/trials/sigma_campaign.hpp>

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <zlg/chance/draw.hpp>
#include <zlg/numeric/parallel.hpp>

#include "parts.hpp"
#include "trial.hpp"

namespace zlg::trials {
namespace {

using chance::Draw;

// A sigma that is right within a fifth: the square roots of these limits are 0.84 and 1.18.
constexpr double min_nev = 0.25;
constexpr double max_nev = 1.4;

using MakeMotion = MotionLaw (*)(Draw);

MotionLaw rest(Draw) { return {}; }

MotionLaw steady(Draw draw) {
    const double sign = draw.sign();
    return {.rate_arcsec_s = sign * draw.within_log(1e-3, 3e5)};
}

MotionLaw tone(Draw draw) {
    MotionLaw m{.rate_arcsec_s = 100.0 * (draw.uniform() - 0.5)};
    m.tones = {{draw.within_log(0.1, 80.0), draw.within_log(1.0, 1e5)}};
    return m;
}

// Whole ticks of 5 ms a period, or two periods: readings repeat.
MotionLaw repeating(Draw draw) {
    const double ticks = 4.0 + std::floor(77.0 * draw.uniform());
    return {.tones = {{(draw.uniform() < 0.5 ? 200.0 : 400.0) / ticks, draw.within_log(10.0, 3e4)}}};
}

MotionLaw twenty(Draw) { return {.tones = {{20.0, 12000.0}}}; }

MotionLaw band(Draw draw) { return {.bands = {{0.0, draw.within_log(0.5, 30.0), draw.within_log(1.0, 1e4)}}}; }

struct MotionClass {
    const char* name;
    MakeMotion make;
    int gyros;
    int switches;
    int min_start, max_start;  // ticks before the first switch
    bool with_phase = false;
};

constexpr MotionClass classes[] = {
    {"rest", rest, 400, 4, 1000, 1500},
    {"steady rate", steady, 400, 4, 1000, 1500},
    {"sine", tone, 400, 4, 1000, 1500},
    {"sine in step with the ticks", repeating, 400, 4, 1000, 1500},
    {"20.00 Hz, 12 000 \"/s", twenty, 400, 4, 1000, 1500},
    {"band", band, 400, 4, 1000, 1500},
    {"first gap: rest", rest, 600, 1, 10, 60},
    {"first gap: steady rate", steady, 600, 1, 10, 60},
    {"first gap: sine", tone, 600, 1, 10, 60},
    {"first gap: 20.00 Hz", twenty, 600, 1, 10, 60},
    {"first gap: band", band, 600, 1, 10, 60},
    {"first gap: band, 70 to 300 ticks", band, 600, 1, 70, 300},
    {"first gap: sine, by phase", tone, 600, 1, 10, 60, true},
    {"first gap: band, by phase", band, 600, 1, 10, 60, true},
};

const std::vector<std::string> without_miss{method_name::uncorrected_automatic};
const std::vector<std::string> with_miss{method_name::automatic_ticks, method_name::automatic};

GyroLaw draw_gyro(Draw draw) {
    GyroLaw g;
    g.scale_arcsec = draw.within_log(0.3, 4.35);
    g.bias_hz *= 3.263 / g.scale_arcsec * (1.0 + 0.01 * draw.uniform());
    g.gap_ticks = 1 + static_cast<int>(10.0 * draw.uniform());
    return g;
}

// By method, then by switch.
using Errors = std::vector<std::vector<SwitchError>>;

struct ErrorsOfGyro {
    Errors without, with;  // a miss
};

ErrorsOfGyro errors_of(const MotionClass& of, std::uint64_t seed) {
    const chance::Draws draws{.seed = seed, .cause = chance::Cause::sigma_gyro};
    SwitchTrial trial{
        .gyro = draw_gyro(draws.of("gyro")), .switches = of.switches, .interval_ticks = 600, .seed = seed};
    trial.motion = of.make(draws.of("motion"));
    if (of.with_phase) trial.gyro.photodiodes = {.reads = true, .learnt = true};
    trial.learn_ticks = of.min_start + static_cast<int>((of.max_start - of.min_start) * draws.of("start").uniform());
    const config::Config config = config_of(trial.gyro);
    ErrorsOfGyro errors;
    errors.with = run_trial(trial, methods_for(config, with_miss));
    trial.gyro.miss_lambda = 0.0;
    errors.without = run_trial(trial, methods_for(config, without_miss));
    return errors;
}

double ticks_nev(const std::vector<SwitchError>& errors) {
    double sum = 0.0;
    double n = 0.0;
    for (const SwitchError& e : errors) {
        sum += e.tick_squares;
        n += e.ticks_claimed;
    }
    return n > 0.0 ? sum / n : 0.0;
}

void gather(const MotionClass& of, const std::vector<ErrorsOfGyro>& gyros, const std::vector<std::string>& methods,
            Errors ErrorsOfGyro::*part, std::vector<SigmaFigures>& out) {
    for (std::size_t m = 0; m < methods.size(); ++m) {
        std::vector<SwitchError> all;
        for (const ErrorsOfGyro& e : gyros) all.insert(all.end(), (e.*part)[m].begin(), (e.*part)[m].end());
        out.push_back({.motion = of.name, .method = methods[m], .whole = figures_of(all), .ticks_nev = ticks_nev(all)});
    }
}

}  // namespace

std::vector<SigmaFigures> run_sigma_campaign(const SigmaTask& task) {
    std::vector<SigmaFigures> figures;
    for (std::size_t c = 0; c < std::size(classes); ++c) {
        const MotionClass& of = classes[c];
        const auto n = static_cast<std::size_t>(std::max(1.0, std::round(task.share * of.gyros)));
        std::vector<ErrorsOfGyro> gyros(n);
        numeric::in_parallel(n, task.threads, [&](std::size_t k) {
            gyros[k] = errors_of(of, (task.seed << 40) + (static_cast<std::uint64_t>(c) << 24) + k);
        });
        gather(of, gyros, without_miss, &ErrorsOfGyro::without, figures);
        gather(of, gyros, with_miss, &ErrorsOfGyro::with, figures);
    }
    return figures;
}

bool is_true(const SigmaFigures& f) {
    if (f.whole.n == 0 || f.whole.claimed != f.whole.n) return false;
    // Some sixty means are judged at once: three standard errors. One is that of a mean of squares whose true value is
    // the limit, of a normal law. Above, the scatter itself if it is larger, for gyros and motions differ: a few of
    // them make most of a mean.
    const double of_a_normal_law = std::sqrt(2.0 / static_cast<double>(f.whole.claimed));
    const double below = 3.0 * min_nev * of_a_normal_law;
    const double above = 3.0 * std::max(max_nev * of_a_normal_law, f.whole.nev_standard_error);
    return f.whole.nev > min_nev - below && f.whole.nev < max_nev + above;
}

std::string campaign_text(const std::vector<SigmaFigures>& figures) {
    std::string text =
        "| motion | method | switches | claimed | rms, \" | worst, \" | mean square of error over sigma | within 3 "
        "sigma, % | of the gap's ticks | |\n|---|---|---|---|---|---|---|---|---|---|\n";
    for (const SigmaFigures& f : figures)
        text += fmt::format("| {} | {} | {} | {} | {:.3f} | {:.2f} | {:.2f} | {:.1f} | {:.2f} | {} |\n", f.motion,
                            f.method, f.whole.n, f.whole.claimed, f.whole.rms_arcsec, f.whole.worst_arcsec, f.whole.nev,
                            100.0 * f.whole.within_3_sigma_ratio, f.ticks_nev, is_true(f) ? "" : "NO");
    return text;
}

}  // namespace zlg::trials
