// Figures 1 and 2: drawings, and the bias and the detuning signal as signals of the twin.

#include <cmath>

#include <zlg/report/number_text.hpp>
#include <zlg/rig/wiring.hpp>
#include <zlg/twin/twin.hpp>

#include "paper_files.hpp"
#include "paper_parts.hpp"
#include "paper_words.hpp"

namespace zlg::paper {
namespace {

using namespace report;

// A gyro at rest whose perimeter is held at one detuning.
class HeldGyro {
public:
    HeldGyro(const config::Config& config, double detuning_lambda) : twin_{twin_config(config), twin::Motion::rest()} {
        const double middle_v = 0.5 * (config.piezo.range_min_v + config.piezo.range_max_v);
        actuator_.set_point_v[0] = middle_v + 2.0 * config.piezo.half_wave_v * detuning_lambda;
        // The high-voltage stage takes some milliseconds to get there. The next half has the sign of the first.
        for (int half = 0; half < settling_halves; ++half) (void)twin_.advance(actuator_);
    }

    twin::TwinHalf advance() { return twin_.advance(actuator_); }

private:
    static constexpr int settling_halves = 201;

    static twin::TwinConfig twin_config(const config::Config& config) {
        twin::TwinConfig c = rig::twin_config(config);
        c.perimeter.loop = twin::Loop::digital;
        c.perimeter.miss_lambda = 0.0;
        c.gyro.temperature_rise_c = 0.0;
        return c;
    }

    twin::Twin twin_;
    core::ActuatorFrame actuator_{};
};

constexpr int shown_halves = 6;

// Counts between two readings. The counter wraps; as a signed number the difference does not.
double counts_between(const core::SensorFrame& before, const core::SensorFrame& after) {
    return static_cast<double>(static_cast<std::int64_t>(after.counter - before.counter));
}

Figure beat_figure(const config::Config& config) {
    Series beat{.name = "mean over the half", .mark = Mark::steps};
    HeldGyro gyro{config, 0.0};
    const double half_s = 0.5 * config.gyro.tick_s;
    core::SensorFrame before = gyro.advance().sensor;
    for (int half = 0; half < shown_halves; ++half) {
        const core::SensorFrame after = gyro.advance().sensor;
        add_point(beat, 1e3 * half_s * half, 1e-3 * counts_between(before, after) / half_s);
        before = after;
    }
    add_point(beat, 1e3 * half_s * shown_halves, beat.y.back());
    return worded({.id = "figure-1-beat", .series = {std::move(beat)}});
}

Series light_of(const config::Config& config, double detuning_lambda) {
    Series s{.name = "on the centre"};
    if (detuning_lambda != 0.0)
        s.name = fmt::format("{}{} wavelengths", detuning_lambda > 0.0 ? "+" : "\u2212", std::abs(detuning_lambda));
    HeldGyro gyro{config, detuning_lambda};
    (void)gyro.advance();  // so that the halves shown have the signs of those of the counter
    const double half_ms = 500.0 * config.gyro.tick_s;
    for (int half = 0; half < shown_halves; ++half) {
        const core::SensorFrame sensor = gyro.advance().sensor;
        for (std::size_t k = 0; k < sensor.n_light; ++k) {
            const double sum = double{sensor.light_a[k]} + double{sensor.light_b[k]};
            add_point(s, half_ms * (half + (static_cast<double>(k) + 0.5) / sensor.n_light),
                      100.0 * (double{sensor.light_a[k]} - double{sensor.light_b[k]}) / sum);
        }
    }
    return s;
}

}  // namespace

PaperItem paper_figure_1(const PaperTask& task) {
    const config::Config& c = task.config;
    PaperItem item = item_of(
        "figure 1", {}, {},
        {beat_figure(c),
         worded({.id = "figure-1-light", .series = {light_of(c, 0.05), light_of(c, 0.0), light_of(c, -0.05)}})});
    item.section.diagrams = {report::diagram_of(figure_1_svg)};
    return item;
}

PaperItem paper_figure_2() {
    PaperItem item = item_of("figure 2", {}, {table_of("figure 2.table", {})}, {});
    item.section.diagrams = {report::diagram_of(figure_2_svg)};
    return item;
}

}  // namespace zlg::paper
