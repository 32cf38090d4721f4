// Figure 7: the oscillation with the two places of a gap in it.

#include <cmath>
#include <numbers>

#include <zlg/report/number_text.hpp>

#include "paper_bridge.hpp"
#include "paper_curves.hpp"
#include "paper_parts.hpp"
#include "paper_words.hpp"

namespace zlg::paper {
namespace {

using namespace report;

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
    return worded({.id = "figure-7",
                   .series = {std::move(rate), std::move(ticks)},
                   .bands = {gap_at(0.0, tick_s, "1"), gap_at(0.75 * period_s, tick_s, "2")}},
                  {frequency_hz, 1e3 * tick_s});
}

}  // namespace

PaperItem paper_figure_7(const PaperTask& task) {
    return item_of("figure 7", {}, {}, {oscillation_figure(task.config.gyro.tick_s)});
}

}  // namespace zlg::paper
