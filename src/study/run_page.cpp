#include <zlg/study/run_page.hpp>

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <zlg/report/figure.hpp>
#include <zlg/report/number_text.hpp>

namespace zlg::study {
namespace {

using namespace report;

report::Table variant_table(const RunResult& result) {
    report::Table table{.caption =
                            "Drift is the least-squares slope of the angle error. The error of a switch is final minus "
                            "true angle from the first blind tick to the end of the re-lock; its mean is taken with "
                            "the sign of the false drift, which alternates from switch to switch.",
                        .header = {"variant", "what it is", "drift, \"/s", "angle error at the end, \"",
                                   "error per switch, mean, \"", "rms, \"", "max, \""}};
    for (const VariantResult& v : result.variants) {
        const auto error = [&v](double SwitchStatistics::*member) {
            return v.switch_error ? short_number((*v.switch_error).*member) : "-";
        };
        table.rows.push_back(report::row(v.name, v.meaning, v.drift_arcsec_s, v.angle_error_arcsec,
                                         error(&SwitchStatistics::mean_arcsec), error(&SwitchStatistics::rms_arcsec),
                                         error(&SwitchStatistics::max_arcsec)));
    }
    return table;
}

Figure sawtooth_figure(const config::Config& config, const RunResult& result) {
    Figure f = report::blank_figure(
        "angle-error", "Angle error against time",
        fmt::format("In one mode the magnetic drift adds up without end. Switched every {} s, its sign follows "
                    "the helicity of the mode: the error is a sawtooth of amplitude interval x magnetic drift, "
                    "on a slow slope that is the non-magnetic drift.",
                    short_number(config.switching.interval_s)),
        "time, s", "final minus true angle, arcsec");
    if (const auto* v = result.variant("one_mode")) f.series.push_back(curve_of(*v, "one mode"));
    if (const auto* v = result.variant("configured"))
        f.series.push_back(curve_of(*v, "switched, compensated as configured"));
    return f;
}

Figure methods_figure(const RunResult& result) {
    Figure f = report::blank_figure(
        "compensations", "The switched gyro under different compensations",
        "The same records, compensated in different ways. What a method leaves at each switch adds up like a "
        "random walk on top of the sawtooth, for the sign of the false drift alternates.",
        "time, s", "final minus true angle, arcsec");
    for (const char* name : {"relock_frequency", "relock_mean_square", "bridge_constant", "configured"})
        if (const auto* v = result.variant(name)) f.series.push_back(curve_of(*v, name));
    return f;
}

report::Band gap_band(const RunResult& result, double ticks_to_x) {
    report::Band band{.x0 = 0.0, .x1 = 0.0, .name = "gap"};
    bool found = false;
    for (const MagnifiedTick& t : result.magnified) {
        if (t.measured) continue;
        if (!found) band.x0 = static_cast<double>(t.tick) * ticks_to_x;
        band.x1 = static_cast<double>(t.tick + 1) * ticks_to_x;
        found = true;
    }
    return band;
}

Figure magnified_figure(const RunResult& result) {
    Figure f = report::blank_figure(
        "one-switch", "One switch, tick by tick",
        "Each point is the angle of one tick. In the gap the counter reads nonsense; the gyro delivers an "
        "extrapolation in real time and an interpolation as soon as the other side is known. One tick then "
        "carries the difference, so that no angle is lost. After the gap the reading is still wrong while "
        "the perimeter settles: the final value is corrected for it.",
        "tick", "angle of the tick, arcsec");
    Series read = blank_series("as read", Mark::points);
    Series delivered = blank_series("delivered in real time", Mark::line, true);
    Series final_value = blank_series("final", Mark::points);
    Series truth = blank_series("true");
    for (const MagnifiedTick& t : result.magnified) {
        const double x = static_cast<double>(t.tick) + 0.5;
        // What the blind counter read would only stretch the axis.
        if (t.measured) add_point(read, x, t.read_arcsec);
        add_point(delivered, x, t.dtheta_arcsec);
        add_point(final_value, x, t.final_arcsec);
        add_point(truth, x, t.true_arcsec);
    }
    f.series = {std::move(truth), std::move(delivered), std::move(final_value), std::move(read)};
    f.bands.push_back(gap_band(result, 1.0));
    return f;
}

Figure detuning_figure(const RunResult& result) {
    Figure f = report::blank_figure(
        "detuning", "Detuning of the perimeter through the switch",
        "While the loop is open the perimeter travels half a wavelength, from the middle of one mode to that "
        "of the other. Closed again, the loop removes what is left; the bias, and with it the reading, is "
        "false by the square of the detuning until then.",
        "time, ms", "detuning, wavelengths");
    Series truth = blank_series("true, at the end of each half");
    Series seen = blank_series("measured, mean of each half", Mark::points);
    const double half_ms = 500.0 * result.tick_s;
    const std::int64_t t0 = result.magnified.empty() ? 0 : result.magnified.front().tick;
    for (const MagnifiedTick& t : result.magnified) {
        for (unsigned h = 0; h < 2; ++h) {
            const double start_ms = (2.0 * static_cast<double>(t.tick - t0) + h) * half_ms;
            add_point(truth, start_ms + half_ms, t.true_detuning_lambda[h]);
            add_point(seen, start_ms + 0.5 * half_ms, t.measured ? t.detuning_lambda[h] : std::nan(""));
        }
    }
    f.series = {std::move(truth), std::move(seen)};
    report::Band band = gap_band(result, 1.0);
    band.x0 = (band.x0 - static_cast<double>(t0)) * 2.0 * half_ms;
    band.x1 = (band.x1 - static_cast<double>(t0)) * 2.0 * half_ms;
    f.bands.push_back(band);
    return f;
}

Figure piezo_figure(const RunResult& result) {
    Figure f = report::blank_figure(
        "piezo", "Piezo voltage through the switch",
        "The processor steps the high voltage by the half-wave voltage it has learnt from earlier switches; "
        "the amplifier follows at its slew rate; the loop does the rest.",
        "time, ms", "piezo voltage, V");
    Series volts = blank_series("piezo, by ADC");
    const double half_ms = 500.0 * result.tick_s;
    std::size_t half = 0;
    for (const MagnifiedTick& t : result.magnified)
        for (double v : t.piezo_v) add_point(volts, static_cast<double>(++half) * half_ms, v);
    f.series = {std::move(volts)};
    return f;
}

Figure histogram_figure(const RunResult& result) {
    Figure f =
        report::blank_figure("switch-errors", "Errors per switch",
                             "How often an error of a given size is left at a switch, by method of re-lock and bridge.",
                             "error of a switch, arcsec", "switches");
    for (const char* name : {"bridge_constant", "configured"}) {
        const VariantResult* v = result.variant(name);
        if (!v) continue;
        std::vector<double> errors;
        for (const SwitchError& e : v->switches) errors.push_back(e.error_arcsec);
        const int n_bins = std::clamp(static_cast<int>(2.0 * std::sqrt(static_cast<double>(errors.size()))), 5, 40);
        f.series.push_back(report::histogram(name, errors, n_bins));
    }
    return f;
}

Figure switch_error_figure(const RunResult& result) {
    Figure f = report::blank_figure(
        "errors-in-time", "Error of each switch, as configured",
        "Final minus true angle of every switch. The bars are the standard deviation that the compensation "
        "itself claims for the gap: rounding, light noise and random walk, with the motion taken as a "
        "polynomial of the bridge's order.",
        "time, s", "error of a switch, arcsec");
    Series errors = blank_series("error, with the claimed standard deviation", Mark::points);
    for (const SwitchLine& line : result.switches) {
        if (!std::isfinite(line.true_error_arcsec)) continue;
        add_point(errors, static_cast<double>(line.tick) * result.tick_s, line.true_error_arcsec);
        errors.y_error.push_back(line.sigma_arcsec);
    }
    f.series = {std::move(errors)};
    return f;
}

report::Table relock_table(const RunResult& result) {
    report::Table table{
        .caption =
            "True false drift on the ticks after the loop is closed, averaged over the switches, with the "
            "sign that makes it positive.",
        .header = {"tick after the gap"},
        .rows = {{"false drift, deg/h"}}};
    for (std::size_t i = 0; i < result.relock_false_drift_deg_h.size(); ++i) {
        table.header.push_back(fmt::format("{}", i + 1));
        table.rows[0].push_back(fmt::format("{:.0f}", result.relock_false_drift_deg_h[i]));
    }
    return table;
}

report::Section switch_section(const RunResult& result) {
    report::Section section{
        .heading = "A switch, magnified",
        .paragraphs = {"Switching takes the perimeter from one longitudinal mode to the next, of opposite "
                       "circular polarisation. On the way there is no light in both directions and the gyro "
                       "is blind; just after it, the bias is not yet what it should be and the gyro lies."}};
    if (!result.relock_false_drift_deg_h.empty()) section.tables.push_back(relock_table(result));
    section.figures = {magnified_figure(result), detuning_figure(result), piezo_figure(result)};
    return section;
}

}  // namespace

Series curve_of(const VariantResult& v, std::string name) {
    return {.name = std::move(name), .x = v.curve.t_s, .y = v.curve.error_arcsec};
}

report::Page run_page(const config::Config& config, const RunResult& result) {
    report::Page page{
        .title = "A Zeeman laser gyro in the quasi-four-frequency regime",
        .lead = fmt::format("{} s of simulated operation, ticks of {} ms, modes switched every {} s: {} switches. "
                            "1 \"/s is 1 deg/h.",
                            short_number(static_cast<double>(result.ticks) * result.tick_s),
                            short_number(1e3 * result.tick_s), short_number(config.switching.interval_s),
                            result.switches.size())};
    std::vector<std::string> paragraphs = result.warnings;
    if (result.tally.failed > 0) paragraphs.push_back(rig::sentence(result.tally));
    paragraphs.emplace_back(
        "Every row below compensates the records of one and the same run of the digital twin; only one_mode is a run "
        "of its own.");
    page.sections.push_back({.heading = "Result",
                             .paragraphs = std::move(paragraphs),
                             .tables = {variant_table(result)},
                             .figures = {sawtooth_figure(config, result), methods_figure(result)}});
    if (!result.magnified.empty()) page.sections.push_back(switch_section(result));
    if (!result.switches.empty())
        page.sections.push_back(
            {.heading = "All switches",
             .paragraphs = {"The histogram shows the spread of what is left after compensation. The file of "
                            "switches lists each of them with its claimed and its true error."},
             .figures = {histogram_figure(result), switch_error_figure(result)}});
    return page;
}

}  // namespace zlg::study
