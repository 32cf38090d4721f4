// The piezo alone: its loop, its creep, and the misses that both leave to a processor that learns.

#include <cmath>
#include <numbers>

#include <zlg/core/common/maths.hpp>
#include <zlg/core/records.hpp>
#include <zlg/rig/closed_loop.hpp>
#include <zlg/rig/wiring.hpp>
#include <zlg/twin/twin.hpp>

#include "parts.hpp"

namespace zlg::trials {
namespace {

using namespace report;

constexpr double middle_v = 150.0;
constexpr double hysteresis = 0.12;
constexpr double creep_per_decade = 0.015;
constexpr double half_wave_v = 40.0;

// The perimeter with the loop open, moved by one set-point a half, and how long it is.
class OpenLoopPerimeter {
public:
    explicit OpenLoopPerimeter(const twin::TwinConfig& config) : twin_{config, twin::Motion::rest()} {}

    struct Place {
        double volts = 0.0;
        double length_lambda = 0.0;  // from the start
    };

    Place move(double volts) {
        core::ActuatorFrame frame;
        frame.loop_closed = false;
        frame.set_point_v[0] = volts;
        const twin::TwinTruth truth = twin_.advance(frame).truth;
        length_ += std::remainder(truth.detuning_end_lambda - last_, 0.5);
        last_ = truth.detuning_end_lambda;
        return {truth.perimeter_v, length_};
    }

private:
    twin::Twin twin_;
    double last_ = 0.0;
    double length_ = 0.0;
};

twin::TwinConfig quiet() {
    twin::TwinConfig c;
    c.perimeter.miss_lambda = 0.0;
    c.gyro.temperature_rise_c = 0.0;
    c.gyro.light_samples = 4;
    return c;
}

// To a voltage by steps of a volt, and then a while for the stage to get there.
Series driven(OpenLoopPerimeter& perimeter, double from_v, double to_v, std::string name) {
    Series s = blank_series(std::move(name));
    const int n = static_cast<int>(std::lround(std::abs(to_v - from_v)));
    const OpenLoopPerimeter::Place start = perimeter.move(from_v);
    add_point(s, start.volts, start.length_lambda);
    for (int k = 1; k <= n + 8; ++k) {
        const double volts = from_v + (to_v - from_v) * std::min(k, n) / n;
        const OpenLoopPerimeter::Place place = perimeter.move(volts);
        if (k <= n && k % 5 != 0) continue;
        add_point(s, place.volts, place.length_lambda);
    }
    return s;
}

void append(Series& to, const Series& more) {
    to.x.insert(to.x.end(), more.x.begin(), more.x.end());
    to.y.insert(to.y.end(), more.y.begin(), more.y.end());
}

double at(const Series& s, double volts) {
    for (std::size_t i = 1; i < s.x.size(); ++i) {
        if ((s.x[i - 1] - volts) * (s.x[i] - volts) > 0.0) continue;
        return s.y[i - 1] + (volts - s.x[i - 1]) / (s.x[i] - s.x[i - 1]) * (s.y[i] - s.y[i - 1]);
    }
    return std::nan("");
}

Figure loops(PhysicsPictures& made) {
    twin::TwinConfig config = quiet();
    config.piezo.hysteresis = hysteresis;
    OpenLoopPerimeter perimeter{config};
    Series first = driven(perimeter, middle_v, 300.0, "first move");
    Series down = driven(perimeter, 300.0, 0.0, "full range");
    const Series up = driven(perimeter, 0.0, 300.0, "");
    append(down, up);
    (void)driven(perimeter, 300.0, middle_v, "");
    Series small = driven(perimeter, middle_v, middle_v - half_wave_v, "a switch there and back");
    append(small, driven(perimeter, middle_v - half_wave_v, middle_v, ""));
    const double width = at(down, middle_v) - at(up, middle_v);
    read(made, "loop of the full range: width over height", {width / (up.y.back() - up.y.front())}, 3);
    return {.id = "piezo-loop",
            .title = "Hysteresis of the piezo",
            .caption = "Change of the perimeter against voltage, 12 % hysteresis of the 300 V loop, no creep.",
            .x_label = "voltage, V",
            .y_label = "perimeter, wavelengths",
            .series = {std::move(down), std::move(first), std::move(small)}};
}

Figure creep(PhysicsPictures& made) {
    twin::TwinConfig config = quiet();
    config.piezo.creep_per_decade = creep_per_decade;
    OpenLoopPerimeter perimeter{config};
    Series seen = blank_series("after a step of 40 V");
    Series law = blank_series("1.5 % a decade", Mark::line, true);
    const double half_s = 0.5 * config.gyro.tick_s;
    constexpr double from_s = 0.02;
    double next_s = from_s;
    double at_1_s = 0.0;
    double at_100_s = 0.0;
    for (std::int64_t h = 1; half_s * static_cast<double>(h) < 1000.5; ++h) {
        const double growth = 100.0 * (perimeter.move(middle_v + half_wave_v).length_lambda / 0.5 - 1.0);
        const double time_s = half_s * static_cast<double>(h);
        if (time_s < 1.0 + 0.5 * half_s) at_1_s = growth;
        if (time_s < 100.0 + 0.5 * half_s) at_100_s = growth;
        if (time_s < next_s) continue;
        next_s *= core::maths::exp(0.05 * core::maths::log(10.0));
        add_point(seen, time_s, growth);
    }
    for (const double time_s : {seen.x.front(), seen.x.back()}) {
        add_point(law, time_s, at_1_s + 100.0 * creep_per_decade * (core::maths::log(time_s) / std::numbers::ln10));
    }
    read(made, "creep from 1 s to 100 s, a decade", {0.5 * (at_100_s - at_1_s)}, 2, "% of the step");
    return {.id = "piezo-creep",
            .title = "Creep of the piezo",
            .caption = "What the perimeter has more than the half wavelength that the step is worth, no hysteresis.",
            .x_label = "time from the command, s",
            .y_label = "beyond the step, % of it",
            .series = {std::move(seen), std::move(law)},
            .log_x = true};
}

// True detuning at the end of each gap.
Series misses(double error, int n) {
    config::Config c;
    c.motion.kind = config::MotionKind::rest;
    c.perimeter.miss_lambda = 0.0;
    c.piezo.hysteresis = hysteresis;
    c.piezo.creep_per_decade = creep_per_decade;
    c.piezo.mirror_hz = 5000.0;
    c.piezo.half_wave_error = error;
    rig::ClosedLoop loop{c, rig::motion(c)};
    Series found = blank_series(fmt::format("U_lambda/2 wrong by {:.0f} % at first", 100.0 * error), Mark::points);
    double before = 0.0;
    bool open = false;
    while (static_cast<int>(found.x.size()) < n) {
        const rig::LoopHalf half = loop.advance();
        if (open && half.record.loop_closed)
            add_point(found, static_cast<double>(found.x.size()) + 1.0, std::abs(before));
        open = !half.record.loop_closed;
        before = half.truth.detuning_end_lambda;
    }
    return found;
}

}  // namespace

void add_piezo(PhysicsPictures& made) {
    Figure loop = loops(made);
    Figure growth = creep(made);
    made.pictures.push_back({"piezo", {std::move(loop), std::move(growth)}});
}

void add_misses(PhysicsPictures& made) {
    Figure figure{.id = "misses",
                  .title = "Misses over the first switches",
                  .caption =
                      "Detuning at the end of the gap, 90 s between switches, hysteresis 12 % of the 300 V loop, "
                      "creep 1.5 % a decade, mirror at 5 kHz.",
                  .x_label = "switch",
                  .y_label = "miss, wavelengths",
                  .log_y = true};
    std::vector<double> first;
    std::vector<double> tenth;
    for (const double error : {0.0, 0.05, 0.2}) {
        figure.series.push_back(misses(error, 10));
        first.push_back(figure.series.back().y.front());
        tenth.push_back(figure.series.back().y.back());
    }
    read(made, "miss of the first switch, U_lambda/2 wrong by 0, 5, 20 %", first, 3, "wavelength");
    read(made, "miss of the tenth switch", tenth, 3, "wavelength");
    made.pictures.push_back({"misses", {std::move(figure)}});
}

}  // namespace zlg::trials
