#include <cmath>
#include <memory>

#include <fmt/format.h>

#include <zlg/core/common/maths_kernels.hpp>
#include <zlg/trials/magnetic_gate.hpp>

namespace zlg::trials {
namespace {

using chance::Draw;

constexpr double tick_s = 0.005;

BaseRate sine(double amplitude, double frequency_hz, double phase) {
    return
        [=](double t_s, int) { return amplitude * core::maths::sincos_turns_kernel(frequency_hz * t_s + phase).sin; };
}

// Changes its sign every half-period.
BaseRate square(double amplitude, double frequency_hz, double phase) {
    return [=](double t_s, int) {
        const double turns = frequency_hz * t_s + phase;
        return turns - std::floor(turns) < 0.5 ? amplitude : -amplitude;
    };
}

// Gauss and Markov: correlated over `time_s`; infinite: a random walk of sigma a root second.
BaseRate wandering(double sigma, double time_s, const Draw& numbers) {
    const auto draw = std::make_shared<Draw>(numbers);
    const bool walks = !std::isfinite(time_s);
    const auto rate = std::make_shared<double>(walks ? 0.0 : sigma * draw->normal());
    const double step = sigma * std::sqrt(walks ? tick_s : 2.0 * tick_s / time_s);
    return [=](double, int) { return *rate += step * draw->normal() - (walks ? 0.0 : *rate * tick_s / time_s); };
}

// Changes its sign at random, after `time_s` on average.
BaseRate telegraph(double amplitude, double time_s, const Draw& numbers) {
    const auto draw = std::make_shared<Draw>(numbers);
    const auto rate = std::make_shared<double>(amplitude);
    return [=](double, int) { return draw->uniform() < tick_s / time_s ? *rate = -*rate : *rate; };
}

// Turns of up to 90 degrees in 3 to 8 s, a minute apart, and a rough road.
BaseRate vehicle(const Draw& numbers) {
    struct State {
        Draw draw;
        double left_s = 0.0, rate = 0.0;
    };
    const auto s = std::make_shared<State>(State{.draw = numbers});
    return [s](double, int) {
        if ((s->left_s -= tick_s) <= 0.0) {
            const bool turns = s->rate == 0.0;
            s->left_s = turns ? 3.0 + 5.0 * s->draw.uniform() : 2.0 + 60.0 * s->draw.exponential();
            s->rate = turns ? (s->draw.uniform() - 0.5) * 2.0 * 90.0 * 3600.0 / s->left_s : 0.0;
        }
        return s->rate + 1500.0 * s->draw.normal();
    };
}

// To and fro by `angle_arcsec`, a step of 2 s in every half-period.
BaseRate stepping_table(double angle_arcsec, double frequency_hz, double phase) {
    return [=](double t_s, int) {
        const double halves = 2.0 * (frequency_hz * t_s + phase);
        const double whole = std::floor(halves);
        if ((halves - whole) / (2.0 * frequency_hz) >= 2.0) return 0.0;
        return std::fmod(whole, 2.0) == 0.0 ? angle_arcsec / 2.0 : -angle_arcsec / 2.0;
    };
}

void add_at_random(std::vector<MovingBase>& all) {
    for (const double amplitude : {0.5, 2.0, 5.0, 10.0})
        for (const double hz : {0.5, 0.05, 0.011, 0.003})
            all.push_back({fmt::format("oscillation of {} arcsec/s at {} Hz", amplitude, hz), [=](Draw r, auto) {
                               const double ratio = r.within(0.8, 1.2);
                               return sine(amplitude, hz * ratio, r.uniform());
                           }});
    for (const double sigma : {0.01, 0.1, 1.0, 10.0})
        all.push_back({fmt::format("random walk of the rate, {} arcsec/s a root second", sigma),
                       [=](Draw r, auto) { return wandering(sigma, INFINITY, r); }});
    for (const double sigma : {0.1, 1.0, 10.0, 100.0, 1000.0})
        for (const double time_s : {5.0, 60.0, 600.0})
            all.push_back({fmt::format("random rate of {} arcsec/s over {} s", sigma, time_s),
                           [=](Draw r, auto) { return wandering(sigma, time_s, r); }});
    for (const double amplitude : {0.5, 5.0, 50.0, 1000.0})
        all.push_back({fmt::format("{} arcsec/s that turn their sign at random, after 45 s on average", amplitude),
                       [=](Draw r, auto) { return telegraph(amplitude, 45.0, r); }});
}

void add_in_step(std::vector<MovingBase>& all, const MagneticGate& gate) {
    const bool varied = gate.schedule != core::ScheduleKind::fixed;
    // A schedule that is not fixed leaves out a thirty-second of its interval on average.
    const double mean_s = varied ? gate.interval_s * 31.0 / 32.0 : gate.interval_s;
    const double hz = 0.5 / mean_s;
    const double start = gate.first_segment == core::FirstSegment::half ? 0.25 : 0.0;
    const auto phase_of = [=](std::uint64_t seed) { return start + (seed % 2 == 0 ? 0.5 : 0.0); };
    const auto add_waves = [&](const char* name, const auto& wave, double medium) {
        for (const double a : {0.5, 1.0, 2.0, 5.0, 10.0, medium, 100.0, 1000.0})
            all.push_back({fmt::format("in step: {} of {} arcsec/s", name, a),
                           [=](const Draw&, std::uint64_t seed) { return wave(a, hz, phase_of(seed)); }});
        for (const double a : {1.0, 10.0, 100.0})
            for (const double ratio : {1.001, 0.995, 1.02, 0.95})
                all.push_back({fmt::format("near step: {} of {} arcsec/s, {} of that frequency", name, a, ratio),
                               [=](const Draw&, std::uint64_t seed) { return wave(a, hz * ratio, phase_of(seed)); }});
    };
    add_waves("sine", sine, 25.0);
    add_waves("square wave", square, 30.0);
    for (const double a : {1.0, 10.0, 100.0})
        for (const double shift : {0.05, 0.15})
            all.push_back({fmt::format("square wave of {} arcsec/s, {} of a period late", a, shift),
                           [=](const Draw&, std::uint64_t seed) { return square(a, hz, phase_of(seed) - shift); }});
    for (const double a : {20.0, 1000.0})
        for (const double shift : {0.0, 0.1, 0.25, 0.42})
            all.push_back(
                {fmt::format("turntable, {} arcsec to and fro in step, {} of a period late", a, shift),
                 [=](const Draw&, std::uint64_t seed) { return stepping_table(a, hz, phase_of(seed) - shift); }});
    for (const double a : {0.5, 2.0, 10.0, 100.0})
        all.push_back({fmt::format("{} arcsec/s times the mode", a), [=](const Draw&, std::uint64_t seed) {
                           const double signed_a = seed % 2 == 0 ? -a : a;
                           return [=](double, int mode) { return signed_a * mode; };
                       }});
}

}  // namespace

std::vector<MovingBase> moving_bases(const MagneticGate& gate) {
    std::vector<MovingBase> all{
        {"rest", [](const Draw&, auto) { return sine(0.0, 0.0, 0.0); }},
        {"15 arcsec/s", [](const Draw&, auto) { return [](double, int) { return 15.0; }; }},
        {"coning: 3 arcsec/s that oscillate by 1 in 600 s",
         [](Draw r, auto) {
             const BaseRate slow = sine(1.0, 1.0 / 600.0, r.uniform());
             return [=](double t_s, int mode) { return 3.0 + slow(t_s, mode); };
         }},
        {"vehicle", [](Draw r, auto) { return vehicle(r); }},
    };
    for (const double hz : {20.06, 7.03})
        all.push_back({fmt::format("12 000 arcsec/s at {} Hz", hz),
                       [=](Draw r, auto) { return sine(12000.0, hz, r.uniform()); }});
    add_at_random(all);
    add_in_step(all, gate);
    return all;
}

}  // namespace zlg::trials
