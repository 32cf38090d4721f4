// The magnetic estimator on bases that move: what is left of the sawtooth with it and without, in Markdown.
//
// A gyro with 0.7 arcsec/s that grow by 0.7 with 3000 s, a random walk of 0.14 arcsec/sqrt(s) and counts of 3.263 arcsec.
// Only the magnetic part of the angle is judged, over the last two intervals of runs that end at draw.

#include <cmath>
#include <cstdint>
#include <functional>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include <zlg/core/compensation/magnetic_drift.hpp>
#include <zlg/numeric/draw.hpp>

#include "command.hpp"

namespace {

using namespace zlg::core;

constexpr double tick_s = 0.005;
constexpr double count_arcsec = 3.263;

using zlg::numeric::Draw;

using Rate = std::function<double(double t_s)>;

struct Base {
    std::string name;
    std::function<Rate(Draw&)> make;
};

Rate sine(double amplitude, double frequency_hz, double phase) {
    return [=](double t_s) { return amplitude * std::sin(2.0 * std::numbers::pi * (frequency_hz * t_s + phase)); };
}

// Gauss and Markov: correlated over `time_s`; infinite: a random walk of sigma a root second.
Rate wandering(double sigma, double time_s, std::uint64_t seed) {
    const auto draw = std::make_shared<Draw>(Draw{seed});
    const bool walks = !std::isfinite(time_s);
    const auto rate = std::make_shared<double>(walks ? 0.0 : sigma * draw->normal());
    const double step = sigma * std::sqrt(walks ? tick_s : 2.0 * tick_s / time_s);
    return [=](double) { return *rate += step * draw->normal() - (walks ? 0.0 : *rate * tick_s / time_s); };
}

// Turns of up to 90 degrees in 3 to 8 s, a minute apart, and a rough road.
Rate vehicle(std::uint64_t seed) {
    struct State {
        Draw draw;
        double left_s = 0.0, rate = 0.0;
    };
    const auto s = std::make_shared<State>(State{.draw = Draw{seed}});
    return [s](double) {
        if ((s->left_s -= tick_s) <= 0.0) {
            const bool turns = s->rate == 0.0;
            s->left_s = turns ? 3.0 + 5.0 * s->draw.uniform() : 2.0 - 60.0 * std::log(1.0 - s->draw.uniform());
            s->rate = turns ? (s->draw.uniform() - 0.5) * 2.0 * 90.0 * 3600.0 / s->left_s : 0.0;
        }
        return s->rate + 1500.0 * s->draw.normal();
    };
}

std::vector<Base> bases() {
    std::vector<Base> all{{"rest", [](Draw&) { return sine(0.0, 0.0, 0.0); }},
                          {"15 arcsec/s", [](Draw&) { return [](double) { return 15.0; }; }},
                          {"coning: 3 arcsec/s that oscillate by 1 in 600 s",
                           [](Draw& r) {
                               const Rate slow = sine(1.0, 1.0 / 600.0, r.uniform());
                               return [=](double t_s) { return 3.0 + slow(t_s); };
                           }},
                          {"vehicle", [](Draw& r) { return vehicle(r.bits()); }}};
    for (const double hz : {20.06, 7.03})
        all.push_back(
            {fmt::format("12 000 arcsec/s at {} Hz", hz), [=](Draw& r) { return sine(12000.0, hz, r.uniform()); }});
    for (const double amplitude : {0.5, 2.0, 5.0, 10.0})
        for (const double hz : {0.5, 0.05, 0.011, 0.003})
            all.push_back({fmt::format("oscillation of {} arcsec/s at {} Hz", amplitude, hz),
                           [=](Draw& r) { return sine(amplitude, hz * (0.8 + 0.4 * r.uniform()), r.uniform()); }});
    for (const double sigma : {0.01, 0.1, 1.0, 10.0})
        all.push_back({fmt::format("random walk of the rate, {} arcsec/s a root second", sigma),
                       [=](Draw& r) { return wandering(sigma, INFINITY, r.bits()); }});
    for (const double sigma : {0.1, 1.0, 10.0, 100.0})
        for (const double time_s : {5.0, 60.0, 600.0})
            all.push_back({fmt::format("random rate of {} arcsec/s over {} s", sigma, time_s),
                           [=](Draw& r) { return wandering(sigma, time_s, r.bits()); }});
    return all;
}

struct Sums {
    double without_sq = 0.0, with_sq = 0.0, sigma_sq = 0.0, error_sq = 0.0, trust = 0.0;
    std::int64_t n = 0;
};

void run(const Base& base, double interval_s, double run_s, std::uint64_t seed, Sums& sums) {
    Draw draw{seed};
    const Rate rate = base.make(draw);
    const CompensationConstants constants;
    const MagneticDriftConfig config{.method = MagneticMethod::estimate};
    MagneticDriftState state;
    const auto interval = std::llround(interval_s / tick_s);
    const auto end = std::llround((run_s + 2.0 * interval_s * draw.uniform()) / tick_s);
    double magnetic = 0.0, residual = 0.0, angle = 0.0, read = 0.0, drift = 0.0;
    for (std::int64_t k = 0; k < end; ++k) {
        const double t_s = static_cast<double>(k) * tick_s;
        const std::int64_t segment = (k + interval / 2) / interval;
        const bool measured = segment == 0 || (k + interval / 2) % interval > 2;
        const auto mode = static_cast<std::int8_t>(segment % 2 == 0 ? 1 : -1);
        drift = 0.7 + 0.7 * (1.0 - std::exp(-t_s / 3000.0));
        const double turned = mode * drift * tick_s;
        angle += rate(t_s) * tick_s + turned + 0.14 * std::sqrt(tick_s) * draw.normal();
        const double now = count_arcsec * std::floor(angle / count_arcsec);
        const double subtracted = step(constants, config, state, {measured, mode, now - read});
        read = now;
        if (measured) magnetic += turned;
        if (measured) residual += turned;
        residual -= subtracted;
        if (k < end - 2 * interval || k % 200 != 0) continue;
        sums.without_sq += magnetic * magnetic;
        sums.with_sq += residual * residual;
        ++sums.n;
    }
    sums.sigma_sq += state.filter.covariance[of_drift][of_drift];
    sums.error_sq += (state.filter.estimate[of_drift] - drift) * (state.filter.estimate[of_drift] - drift);
    sums.trust += state.trust;
}

}  // namespace

int main(int argc, char** argv) {
    double interval_s = 45.0;
    double run_s = 3600.0;
    int seeds = 10;
    CLI::App app{"The magnetic estimator on bases that move", "zlg_magnetic_gate"};
    app.add_option("INTERVAL_S", interval_s)->check(CLI::PositiveNumber);
    app.add_option("RUN_S", run_s)->check(CLI::PositiveNumber);
    app.add_option("SEEDS", seeds)->check(CLI::PositiveNumber);
    return zlg::trials::run_command(app, argc, argv, [&] {
        fmt::print(
            "| base | without, arcsec rms | with | ratio | sigma of the drift, arcsec/s | its error | trust |\n"
            "|---|---|---|---|---|---|---|\n");
        for (const Base& base : bases()) {
            Sums s;
            for (int seed = 1; seed <= seeds; ++seed) run(base, interval_s, run_s, static_cast<std::uint64_t>(seed), s);
            const auto n = static_cast<double>(s.n);
            fmt::print("| {} | {:.2f} | {:.2f} | {:.3f} | {:.3f} | {:.3f} | {:.3f} |\n", base.name,
                       std::sqrt(s.without_sq / n), std::sqrt(s.with_sq / n), std::sqrt(s.with_sq / s.without_sq),
                       std::sqrt(s.sigma_sq / seeds), std::sqrt(s.error_sq / seeds), s.trust / seeds);
        }
        return 0;
    });
}
