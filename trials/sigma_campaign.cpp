#include <zlg/trials/sigma_campaign.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include <zlg/numeric/parallel.hpp>
#include <zlg/rig/wiring.hpp>

#include "accuracy_gyro.hpp"
#include "accuracy_parts.hpp"
#include "accuracy_statistics.hpp"
#include "accuracy_trial.hpp"

namespace zlg::trials {
namespace {

using core::BridgeMethod;
using core::RelockMethod;
using numeric::Draw;

constexpr double min_nev = 0.7;
constexpr double max_nev = 1.4;

struct GyroAndMotion {
    GyroLaw gyro;
    MotionLaw motion;
};

using MakeMotion = MotionLaw (*)(Draw&);

MotionLaw rest(Draw&) { return {}; }

MotionLaw steady(Draw& draw) {
    MotionLaw m;
    m.rate_arcsec_s = draw.sign() * draw.within_log(1e-3, 3e5);
    return m;
}

MotionLaw tone(Draw& draw) {
    MotionLaw m;
    m.rate_arcsec_s = 100.0 * (draw.uniform() - 0.5);
    m.tones = {{draw.within_log(0.1, 80.0), draw.within_log(1.0, 1e5)}};
    return m;
}

// Whole ticks of 5 ms a period, or two periods: readings repeat.
MotionLaw repeating(Draw& draw) {
    MotionLaw m;
    const double ticks = 4.0 + std::floor(77.0 * draw.uniform());
    m.tones = {{(draw.uniform() < 0.5 ? 200.0 : 400.0) / ticks, draw.within_log(10.0, 3e4)}};
    return m;
}

MotionLaw twenty(Draw&) {
    MotionLaw m;
    m.tones = {{20.0, 12000.0}};
    return m;
}

MotionLaw band(Draw& draw) {
    MotionLaw m;
    m.bands = {{0.0, draw.within_log(0.5, 30.0), draw.within_log(1.0, 1e4)}};
    return m;
}

struct MotionClass {
    const char* name;
    MakeMotion make;
    int gyros;
    int switches;
    int min_start, max_start;  // ticks before the first switch
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
};

struct Method {
    const char* name;
    RelockMethod relock;
    BridgeMethod bridge;
};

constexpr Method without_miss[] = {{"none, optimal", RelockMethod::none, BridgeMethod::optimal},
                                   {"none, auto", RelockMethod::none, BridgeMethod::automatic}};
constexpr Method with_miss[] = {{"mean square, optimal", RelockMethod::mean_square, BridgeMethod::optimal},
                                {"mean square, auto", RelockMethod::mean_square, BridgeMethod::automatic},
                                {"joint, optimal", RelockMethod::joint, BridgeMethod::optimal},
                                {"joint, auto", RelockMethod::joint, BridgeMethod::automatic}};

GyroLaw draw_gyro(Draw& draw) {
    GyroLaw g;
    g.scale_arcsec = draw.within_log(0.3, 4.35);
    g.bias_hz *= 3.263 / g.scale_arcsec * (1.0 + 0.01 * draw.uniform());
    g.gap_ticks = 1 + static_cast<int>(10.0 * draw.uniform());
    return g;
}

AccuracyMethod method_of(const GyroLaw& law, const Method& m) {
    config::Config c = config_of(law);
    c.drift.random_walk_arcsec_sqrt_s = 0.0;
    return {m.name, rig::compensation_config(c, m.relock, m.bridge)};
}

struct Errors {
    std::vector<std::vector<SwitchError>> without, with;  // by method
};

Errors errors_of(const MotionClass& of, std::uint64_t seed) {
    Draw draw{seed};
    GyroLaw gyro = draw_gyro(draw);
    const MotionLaw motion = of.make(draw);
    const int start = of.min_start + static_cast<int>((of.max_start - of.min_start) * draw.uniform());
    const auto run = [&](const auto& methods) {
        std::vector<AccuracyMethod> made;
        for (const Method& m : methods) made.push_back(method_of(gyro, m));
        return run_course({.gyro = gyro,
                           .motion = motion,
                           .switches = of.switches,
                           .learn_ticks = start,
                           .interval_ticks = 600,
                           .seed = seed},
                          made);
    };
    Errors errors;
    errors.with = run(with_miss);
    gyro.miss_lambda = 0.0;
    errors.without = run(without_miss);
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

template <class Methods>
void gather(const MotionClass& of, const std::vector<Errors>& gyros, const Methods& methods,
            std::vector<std::vector<SwitchError>> Errors::*part, std::vector<SigmaFigures>& out) {
    for (std::size_t m = 0; m < std::size(methods); ++m) {
        std::vector<SwitchError> all;
        for (const Errors& e : gyros) all.insert(all.end(), (e.*part)[m].begin(), (e.*part)[m].end());
        out.push_back(
            {.motion = of.name, .method = methods[m].name, .whole = figures_of(all), .ticks_nev = ticks_nev(all)});
    }
}

}  // namespace

std::vector<SigmaFigures> run_sigma_campaign(const SigmaTask& task) {
    std::vector<SigmaFigures> figures;
    for (std::size_t c = 0; c < std::size(classes); ++c) {
        const MotionClass& of = classes[c];
        const auto n = static_cast<std::size_t>(std::max(1.0, std::round(task.share * of.gyros)));
        std::vector<Errors> gyros(n);
        numeric::in_parallel(n, task.threads, [&](std::size_t k) {
            gyros[k] = errors_of(of, (task.seed << 40) + (static_cast<std::uint64_t>(c) << 24) + k);
        });
        gather(of, gyros, without_miss, &Errors::without, figures);
        gather(of, gyros, with_miss, &Errors::with, figures);
    }
    return figures;
}

bool is_true(const SigmaFigures& f) {
    if (f.whole.n == 0 || f.whole.claimed != f.whole.n) return false;
    const double chance = 2.0 * std::sqrt(2.0 / static_cast<double>(f.whole.claimed));
    return f.whole.nev > min_nev - chance && f.whole.nev < max_nev + chance;
}

std::string campaign_text(const std::vector<SigmaFigures>& figures) {
    std::string text =
        "| motion | method | switches | claimed | rms, \" | worst, \" | mean square of error over sigma | within 3 "
        "sigma, % "
        "| of the gap's ticks | |\n|---|---|---|---|---|---|---|---|---|---|\n";
    for (const SigmaFigures& f : figures)
        text += fmt::format("| {} | {} | {} | {} | {:.3f} | {:.2f} | {:.2f} | {:.1f} | {:.2f} | {} |\n", f.motion,
                            f.method, f.whole.n, f.whole.claimed, f.whole.rms_arcsec, f.whole.worst_arcsec, f.whole.nev,
                            100.0 * f.whole.within_3_sigma_ratio, f.ticks_nev, is_true(f) ? "" : "NO");
    return text;
}

}  // namespace zlg::trials
