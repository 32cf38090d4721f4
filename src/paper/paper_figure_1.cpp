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

// A gyro whose perimeter is held at one detuning, at rest or in slow rotation.
class HeldGyro {
public:
    HeldGyro(const config::Config& config, double detuning_lambda, double rate_arcsec_s = 0.0)
        : twin_{twin_config(config), twin::Motion::sines(rate_arcsec_s, {})} {
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

Series law_of_bias(const config::Gyro& gyro) {
    Series law{.name = "f\u2080(1 \u2212 \u03C7 \u0394\u03BB\u00B2), eq (2)"};
    for (int k = -40; k <= 40; ++k)
        add_point(law, 0.005 * k, 1e-3 * gyro.bias_hz * (1.0 - gyro.bias_chi * 2.5e-5 * k * k));
    return law;
}

Series counted_bias(const config::Config& config) {
    constexpr int ticks = 40;
    // At rest every tick would be rounded alike: 0.382 counts of rotation in a tick spread the rounding evenly.
    const double rate_arcsec_s = 0.381966 * config.gyro.scale_arcsec / config.gyro.tick_s;
    Series seen{.name = "counted on the twin", .mark = Mark::points};
    for (int k = -4; k <= 4; ++k) {
        HeldGyro gyro{config, 0.05 * k, rate_arcsec_s};
        twin::TwinHalf half = gyro.advance();
        double counts = 0.0;
        for (int i = 0; i < 2 * ticks; ++i) {
            const core::SensorFrame before = half.sensor;
            half = gyro.advance();
            counts += half.sensor.bias_sign * counts_between(before, half.sensor);
        }
        add_point(seen, half.truth.detuning_end_lambda, 1e-3 * std::abs(counts) / (ticks * config.gyro.tick_s));
    }
    return seen;
}

}  // namespace

PaperItem paper_figure_1(const PaperTask& task) {
    const config::Config& c = task.config;
    PaperItem item =
        item_of("figure 1", {}, {},
                {beat_figure(c),
                 worded({.id = "figure-1-light", .series = {light_of(c, 0.05), light_of(c, 0.0), light_of(c, -0.05)}}),
                 worded({.id = "figure-1-frequency", .series = {law_of_bias(c.gyro), counted_bias(c)}})});
    item.section.diagrams = {report::diagram_of(figure_1_svg)};
    return item;
}

PaperItem paper_figure_2() {
    PaperItem item = item_of("figure 2", {}, {table_of("figure 2.table", {})}, {});
    item.section.diagrams = {report::diagram_of(figure_2_svg)};
    return item;
}

}  // namespace zlg::paper
