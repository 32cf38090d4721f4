// One switch of modes: the perimeter of the gyro, and what its processor reads.

#include <cmath>
#include <limits>

#include <zlg/core/gyro_control.hpp>
#include <zlg/rig/laser_calibration.hpp>
#include <zlg/rig/wiring.hpp>
#include <zlg/twin/twin.hpp>

#include "parts.hpp"

namespace zlg::trials {
namespace {

using namespace report;

constexpr double before_ms = 10.0;
constexpr double after_ms = 40.0;
// Halves of the gyro that only shows the perimeter: so many to one of the other.
constexpr int fine = 20;

config::Config switching_gyro() {
    config::Config c;
    c.gyro.fidelity = config::Fidelity::laser;
    c.gyro.light_samples = 64;
    c.gyro.light_noise_lambda = 0.0;
    c.motion.kind = config::MotionKind::rest;
    c.switching.interval_s = 1.0;
    c.perimeter.miss_lambda = 0.0;
    c.piezo.half_wave_error = -0.1;
    return rig::calibrated_by_laser(c);
}

struct Half {
    core::ActuatorFrame command;  // in force during it
    core::SensorFrame sensor;
    core::HalfRecord record;
};

// Every half up to `after_ms` from the first opening of the loop, whose index is put into `opening`.
std::vector<Half> simulated(const config::Config& c, std::size_t& opening) {
    twin::Twin twin{rig::twin_config(c), rig::motion(c)};
    const core::GyroControlConfig control = rig::control_config(c);
    core::GyroControlState state = initial_state(control);
    core::ActuatorFrame command = initial_actuator(control);
    std::vector<Half> halves;
    const auto n_after = static_cast<std::size_t>(after_ms / (500.0 * c.gyro.tick_s));
    opening = std::numeric_limits<std::size_t>::max();
    while (opening == std::numeric_limits<std::size_t>::max() || halves.size() < opening + n_after) {
        const core::SensorFrame sensor = twin.advance(command).sensor;
        if (!command.loop_closed && opening > halves.size()) opening = halves.size();
        const core::GyroControlOutput out = step(control, state, sensor);
        halves.push_back({command, sensor, out.record});
        command = out.actuator;
    }
    return halves;
}

struct Panels {
    Figure volts;
    Figure detuning;
    Figure light;
    Figure counts;
};

Figure panel(std::string id, std::string title, std::string caption, std::string y_label, std::vector<Band> bands) {
    return {.id = std::move(id),
            .title = std::move(title),
            .caption = std::move(caption),
            .x_label = "time from the opening of the loop, ms",
            .y_label = std::move(y_label),
            .bands = std::move(bands)};
}

// The same commands to a gyro whose halves are short, so that their ends show the perimeter often.
void add_perimeter(const config::Config& c, const std::vector<Half>& halves, std::size_t opening, Panels& to) {
    twin::TwinConfig config = rig::twin_config(c);
    config.gyro.tick_s /= fine;
    config.gyro.light_samples = 2;
    twin::Twin twin{config, twin::Motion::rest()};
    Series volts = blank_series("");
    Series detuning = blank_series("");
    double last = 0.0;
    const double step_ms = 500.0 * config.gyro.tick_s;
    const double opening_ms = step_ms * fine * static_cast<double>(opening);
    double time_ms = -opening_ms;
    for (const Half& half : halves) {
        for (int k = 0; k < fine; ++k) {
            const twin::TwinTruth truth = twin.advance(half.command).truth;
            time_ms = time_ms + step_ms;
            if (time_ms < -before_ms - 1e-9) continue;
            add_point(volts, time_ms, truth.perimeter_v);
            if (std::abs(truth.detuning_end_lambda - last) > 0.25) {
                add_point(detuning, time_ms - 0.5 * step_ms, std::numeric_limits<double>::quiet_NaN());
            }
            last = truth.detuning_end_lambda;
            add_point(detuning, time_ms, last);
        }
    }
    to.volts.series = {std::move(volts)};
    to.detuning.series = {std::move(detuning)};
}

void add_readings(const std::vector<Half>& halves, std::size_t opening, double half_ms, Panels& to) {
    Series cw = blank_series("cw");
    Series ccw = blank_series("ccw");
    Series counts{.name = "", .mark = report::Mark::steps};
    for (std::size_t h = opening - static_cast<std::size_t>(before_ms / half_ms); h < halves.size(); ++h) {
        const double start_ms = half_ms * (static_cast<double>(h) - static_cast<double>(opening));
        const core::SensorFrame& seen = halves[h].sensor;
        for (std::size_t k = 0; k < seen.n_light; ++k) {
            const double time_ms = start_ms + half_ms * (static_cast<double>(k) + 0.5) / seen.n_light;
            add_point(cw, time_ms, 1e-3 * static_cast<double>(seen.light_a[k]));
            add_point(ccw, time_ms, 1e-3 * static_cast<double>(seen.light_b[k]));
        }
        add_point(counts, start_ms, static_cast<double>(halves[h].record.counts));
    }
    add_point(counts, after_ms, counts.y.back());
    to.light.series = {std::move(cw), std::move(ccw)};
    to.counts.series = {std::move(counts)};
}

Panels panels_of(double gap_ms) {
    const std::vector<Band> named{{0.0, gap_ms, "loop open"}};
    const std::vector<Band> bands{{0.0, gap_ms, ""}};
    return {
        panel("switch-volts", "Piezo voltage", "The step is commanded at 0.", "piezo, V", named),
        panel("switch-detuning", "Detuning", "Of the nearest mode: at a quarter of a wavelength it changes.",
              "detuning, wavelengths", bands),
        panel("switch-light", "Light of the beams",
              "In parts of the light at the centre without field; cw and ccw exchange with each reversal.",
              "light of a beam, parts of the centre", bands),
        panel("switch-counts", "Counts of each half",
              "Of alternate sign with the bias; the order of signs turns with the mode.", "counts in 2.5 ms", bands)};
}

}  // namespace

void add_switch(PhysicsPictures& made) {
    const config::Config c = switching_gyro();
    std::size_t opening = 0;
    const std::vector<Half> halves = simulated(c, opening);
    const double half_ms = 500.0 * c.gyro.tick_s;
    const double gap_ms = 2.0 * half_ms * static_cast<double>(c.switching.gap_ticks);
    Panels panels = panels_of(gap_ms);
    add_perimeter(c, halves, opening, panels);
    add_readings(halves, opening, half_ms, panels);

    const Series& detuning = panels.detuning.series[0];
    double hop_ms = 0.0;
    double miss = 0.0;
    for (std::size_t i = 0; i < detuning.x.size(); ++i) {
        if (std::isnan(detuning.y[i])) hop_ms = detuning.x[i];
        if (detuning.x[i] <= gap_ms + 1e-6) miss = detuning.y[i];
    }
    std::size_t usable = halves.size();
    while (halves[usable - 1].record.valid) --usable;
    made.pictures.push_back(
        {"switch",
         {std::move(panels.volts), std::move(panels.detuning), std::move(panels.light), std::move(panels.counts)}});
    read(made, "switch: nearest mode changes after", {hop_ms}, 1, "ms");
    read(made, "switch: every half valid again after", {half_ms * static_cast<double>(usable - opening)}, 1, "ms");
    read(made, "switch: miss at closing, U_lambda/2 taken 10 % too small", {std::abs(miss)}, 3, "wavelength");
}

}  // namespace zlg::trials
