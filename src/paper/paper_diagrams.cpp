// Figures 2 and 7: the perimeter loop, and the oscillation with the two places of a gap in it.

#include <cmath>
#include <numbers>

#include "paper_bridge.hpp"
#include "paper_curves.hpp"
#include "paper_parts.hpp"
#include "paper_text.hpp"

namespace zlg::paper {
namespace {

using namespace report;

// --- figure 2 --------------------------------------------------------------------------------------------------------

Diagram loop_diagram() {
    return {
        .id = "figure-2",
        .title = "Perimeter control with reversal of modes",
        .caption =
            "Solid: signals of the loop. Dashed: what the processor adds. Shaded: the processor, with its converters.",
        .height = 296,
        .boxes = {{.lines = {"Ring", "laser"}, .left = 7, .top = 6, .width = 120, .height = 174},
                  {.lines = {"Photodiode,", "amplifier"}, .left = 189, .top = 6, .width = 120, .height = 64},
                  {.lines = {"Synchronous", "detector"}, .left = 371, .top = 6, .width = 120, .height = 64},
                  {.lines = {"Integrator", "with", "limiter"}, .left = 553, .top = 6, .width = 120, .height = 284},
                  {.lines = {"Processor:", "switching, half-wave voltage"},
                   .left = 189,
                   .top = 116,
                   .width = 302,
                   .height = 64,
                   .shaded = true},
                  {.lines = {"Loop open", "or closed"}, .left = 371, .top = 226, .width = 120, .height = 64},
                  {.lines = {"Voltage", "amplifier"}, .left = 189, .top = 226, .width = 120, .height = 64},
                  {.lines = {"Piezo", "mirrors"}, .left = 7, .top = 226, .width = 120, .height = 64}},
        .arrows = {{.from = {127, 38}, .to = {189, 38}, .label = "light"},
                   {.from = {309, 38}, .to = {371, 38}},
                   {.from = {491, 38}, .to = {553, 38}},
                   {.from = {553, 258}, .to = {491, 258}},
                   {.from = {371, 258}, .to = {309, 258}},
                   {.from = {189, 258}, .to = {127, 258}},
                   {.from = {67, 226}, .to = {67, 180}, .label = "length"},
                   {.from = {127, 148}, .to = {189, 148}, .label = "counts", .dashed = true},
                   {.from = {249, 70}, .to = {249, 116}, .label = "ADC", .dashed = true},
                   {.from = {431, 116}, .to = {431, 70}, .label = "polarity", .dashed = true},
                   {.from = {431, 180}, .to = {431, 226}, .label = "open", .dashed = true},
                   {.from = {229, 226}, .to = {229, 180}, .label = "ADC", .label_left = true, .dashed = true},
                   {.from = {269, 180}, .to = {269, 226}, .label = "DAC", .dashed = true}}};
}

report::Table parts_table() {
    return {.caption =
                "What each block of the print is here. The perimeter can be left to the electronics of the twin or be "
                "ruled by the processor.",
            .header = {"block", "in the program"},
            .rows = {{"synchronous detector", "core, sync_detector; in the twin its analog counterpart"},
                     {"integrator", "twin, analog loop; core, perimeter_loop for a digital one"},
                     {"first input, opens the loop", "core, mode_switch"},
                     {"second input, voltage by DAC", "core, mode_switch, with the estimate of half_wave"},
                     {"when to switch", "core, switch_schedule"},
                     {"voltage amplifier, piezo", "twin, slew rate and time constant"}}};
}

// --- figure 7 --------------------------------------------------------------------------------------------------------

// The gap about a moment, as a stretch of the axis in ms.
report::Band gap_at(double middle_s, double tick_s, const char* name) {
    const double half_s = 0.5 * paper_gap_ticks * tick_s;
    return {1e3 * (middle_s - half_s), 1e3 * (middle_s + half_s), name};
}

Figure oscillation_figure(double tick_s) {
    const double frequency_hz = paper_frequency_hz(tick_s);
    const double period_s = 1.0 / frequency_hz;
    constexpr double end_periods = 1.0;
    Series rate{.name = "rate A sin 2\u03C0\u03BDt"};
    for (const double periods : evenly(-0.25, end_periods, 251)) {
        report::add_point(rate, 1e3 * periods * period_s,
                          paper_amplitude_arcsec_s * std::sin(2.0 * std::numbers::pi * periods));
    }
    Series ticks{.name = "mean over each tick, P/T", .mark = Mark::points};
    const double w = 2.0 * std::numbers::pi * frequency_hz;
    // A tick lies in the middle of the zero crossing.
    for (double t0_s = -2.5 * tick_s; t0_s + tick_s <= end_periods * period_s + 1e-9; t0_s += tick_s) {
        const double angle = paper_amplitude_arcsec_s / w * (std::cos(w * t0_s) - std::cos(w * (t0_s + tick_s)));
        report::add_point(ticks, 1e3 * (t0_s + 0.5 * tick_s), angle / tick_s);
    }
    return {.id = "figure-7",
            .title = "Oscillation of the case, and the two places of a gap in it",
            .caption = sentence(
                "Amplitude 12 000 deg/h, {} Hz, ticks of {} ms. A gap of three ticks, 1: where the rate passes "
                "zero, figures 8a and 9. 2: where it is at its extremum, figures 8b and 10.",
                frequency_hz, 1e3 * tick_s),
            .x_label = "time, ms",
            .y_label = "angular rate, deg/h",
            .series = {std::move(rate), std::move(ticks)},
            .bands = {gap_at(0.0, tick_s, "1"), gap_at(0.75 * period_s, tick_s, "2")}};
}

}  // namespace

PaperItem paper_figure_2() {
    return {
        .number = "figure 2",
        .section = {.heading = "Figure 2: perimeter control with reversal of modes",
                    .paragraphs =
                        {"At a switch the processor opens the loop, turns the polarity of the detector, and steps the "
                         "high voltage by the half-wave voltage that it has learnt; then it closes the loop again.",
                         "Agrees with print but for one number: a linear loop whose slow stage takes five periods T or "
                         "more cannot be back within the four ticks of tables 1 and 2. The twin's integrator is "
                         "limited, so its settling takes a time in proportion to the miss."},
                    .tables = {parts_table()},
                    .diagrams = {loop_diagram()}}};
}

PaperItem paper_figure_7(const PaperTask& task) {
    return {
        .number = "figure 7",
        .section = {
            .heading = "Figure 7: the oscillation, and where a gap may fall",
            .paragraphs = {"Agrees: the curve and the two places. Does not: the names. Place 1, in print of constant "
                           "angular velocity, is where the velocity changes fastest and the acceleration is constant; "
                           "place 2, in print of variable angular velocity, is where the velocity hardly changes.",
                           "The gyro does not sample the rate. A reading is the angle of a whole tick, and what a "
                           "polynomial has to follow is the points."},
            .figures = {oscillation_figure(task.config.gyro.tick_s)}}};
}

}  // namespace zlg::paper
