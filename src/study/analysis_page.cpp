#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <zlg/noise/noise_units.hpp>
#include <zlg/report/number_text.hpp>
#include <zlg/study/analyze.hpp>
#include <zlg/study/how_made.hpp>
#include <zlg/study/term_text.hpp>

#include "analysis_view.hpp"

namespace zlg::study {
namespace {

using namespace report;

report::Table curve_table(const View& v, const deviations::DeviationCurve& curve) {
    const bool is_angle = curve.kind == deviations::DeviationKind::tdev;
    const auto shown = [&](double deviation) { return is_angle ? deviation : v.shown(deviation); };
    report::Table t{.caption = fmt::format(
                        "{}, {}; intervals of {:g} %, n differences each; edf: equivalent degrees of "
                        "freedom; last the spectrum of the rate.",
                        deviations::name_of(curve.kind), is_angle ? "arcsec" : v.unit(), 100.0 * curve.confidence),
                    .header = {"tau, s", "n", "deviation", "low", "high", "edf", "noise"}};
    if (curve.kind == deviations::DeviationKind::totdev) {
        t.caption += " As computed: with the bias of mirroring, which is taken out of the deviation.";
        t.header.emplace_back("as computed");
    }
    const std::size_t step = std::max<std::size_t>(1, curve.points.size() / 30);
    for (std::size_t k = 0; k < curve.points.size(); k += step) {
        const auto& p = curve.points[k];
        t.rows.push_back({short_number(p.tau_s), fmt::format("{}", p.terms), fmt::format("{:.4g}", shown(p.deviation)),
                          fmt::format("{:.4g}", shown(p.low)), fmt::format("{:.4g}", shown(p.high)),
                          short_number(p.law.edf), fmt::format("f^{}", p.noise)});
        if (curve.kind == deviations::DeviationKind::totdev)
            t.rows.back().push_back(fmt::format("{:.4g}", shown(p.as_computed)));
    }
    return t;
}

report::Table term_table(const View& v) {
    report::Table t{.caption = fmt::format(
                        "Fitted terms with one standard error; below: 95 %. Chi-square {:.3g} of {} degrees of "
                        "freedom, probability {:.2g}; each variance allowed an error of {:g} % beside chance.",
                        v.axis.fit->chi2, v.axis.fit->dof, v.axis.fit->probability, 100.0 * v.axis.fit->model_error),
                    .header = {"term", "value, continuous", "read at tau, s"}};
    if (v.axis.fit->from_tau_s > 1.5 / v.axis.rate_hz)
        t.caption +=
            fmt::format(" Averaging times below {:.4g} s left free: the sensor's filter or rounding rules them.",
                        v.axis.fit->from_tau_s);
    for (const noise::FittedTerm& term : v.axis.fit->fitted)
        t.rows.push_back({std::string{noise::name_of(term.kind)}, value_text(term),
                          term.found && std::isfinite(term.read_at_s) ? short_number(term.read_at_s) : "-"});
    return t;
}

// What a processor's model of one sample needs.
report::Table discrete_table(const View& v) {
    const noise::NoiseTerms& terms = v.axis.fit->terms;
    const noise::DiscreteNoise d = noise::discrete_noise(terms, v.axis.rate_hz);
    report::Table t{.caption = fmt::format("The same terms, discrete: standard deviations of one sample at {:g} Hz.",
                                           v.axis.rate_hz),
                    .header = {"quantity", "value"}};
    const auto add = [&t](const char* what, double value, const char* unit) {
        if (value != 0.0) t.rows.push_back({what, fmt::format("{:.4g} {}", value, unit)});
    };
    add("error of an angle (quantisation)", d.angle_error_arcsec, "arcsec");
    add("white part of a rate (angle random walk)", d.white_rate_arcsec_s, "deg/h");
    add("white part of an increment", d.white_increment_arcsec, "arcsec");
    add("step of the bias (rate random walk)", d.walk_step_arcsec_s, "deg/h");
    add("growth from sample to sample (ramp)", d.ramp_step_arcsec_s, "deg/h");
    for (std::size_t k = 0; k < d.markov_factor.size(); ++k) {
        t.rows.push_back({"factor of the exponentially correlated part", fmt::format("{:.8g}", d.markov_factor[k])});
        add("its step", d.markov_step_arcsec_s[k], "deg/h");
    }
    return t;
}

report::Table readout_table(const View& v) {
    report::Table t{
        .caption = fmt::format("Readouts of the measured Allan deviation, {}.", deviations::name_of(v.axis.allan.kind)),
        .header = {"where", "tau, s", "deviation, " + v.unit()}};
    for (const Readout& r : v.axis.readouts)
        t.rows.push_back({r.what, short_number(r.tau_s), fmt::format("{:.4g}", v.shown(r.deviation_arcsec_s))});
    return t;
}

report::Table mode_table(const View& v) {
    const noise::ModeSplit& m = *v.axis.modes;
    report::Table t{.caption = "Drift by mode, and the errors of the switches as of a gyro at rest.",
                    .header = {"quantity", "value"},
                    .rows = {{"non-magnetic drift", value_text(m.nonmagnetic_arcsec_s, "deg/h")},
                             {"magnetic drift at the start", value_text(m.magnetic_arcsec_s, "deg/h")},
                             {"its growth by warming", value_text(m.magnetic_thermal_arcsec_s, "deg/h")},
                             {"time of the warming", value_text(m.thermal_time_s, "s")}}};
    const auto& s = m.statistics;
    if (s.n > 0) {
        t.rows.push_back({"switches", fmt::format("{}", s.n)});
        t.rows.push_back({"error per switch, mean", with_error(s.mean_arcsec, s.mean_sigma_arcsec) + " arcsec"});
        t.rows.push_back({"alternating with the mode", short_number(s.mean_by_mode_arcsec) + " arcsec"});
        t.rows.push_back(
            {"rms, largest", fmt::format("{}, {} arcsec", short_number(s.rms_arcsec), short_number(s.max_arcsec))});
    }
    return t;
}

report::Table temperature_table(const noise::BiasTemperature& found) {
    report::Table t{
        .caption = fmt::format("What follows the temperature, {:.4g} to {:.4g} C, about its mean, {:.6g} C{}.",
                               found.least_c, found.most_c, found.mean_c,
                               found.order > 0 ? "; taken out before the terms are fitted" : ": nothing"),
        .header = {"quantity", "value"}};
    const auto add = [&t](const char* what, const std::vector<numeric::Estimate>& all, const char* unit) {
        for (std::size_t k = 0; k < all.size(); ++k)
            t.rows.push_back({k == 0 ? fmt::format("{} at the mean temperature", what)
                                     : fmt::format("its change by the temperature, order {}", k),
                              value_text(all[k], k == 0 ? unit : fmt::format("{}/C^{}", unit, k))});
    };
    add("bias", found.bias, "deg/h");
    add("scale factor", found.scale, "deg/deg");
    t.rows.push_back({"hysteresis, warming less cooling", value_text(found.hysteresis_arcsec_s, "deg/h")});
    return t;
}

std::string summary(const View& v) {
    return fmt::format(
        "{}, {:g} Hz: {} samples, {} s, {} known, {} gaps; mean rate {} {}.", v.axis.holds, v.axis.rate_hz,
        v.axis.n_samples, short_number(static_cast<double>(v.axis.n_samples) / v.axis.rate_hz), v.axis.n_known,
        v.axis.n_gaps, with_error(v.shown(v.axis.mean_arcsec_s), v.shown(v.axis.mean_sigma_arcsec_s)), v.unit());
}

// A logarithmic axis needs something above zero; tdev is an angle and has a table only.
bool can_be_drawn(const deviations::DeviationCurve& curve) {
    const bool is_rate = curve.kind != deviations::DeviationKind::tdev;
    return is_rate && std::ranges::any_of(curve.points, [](const auto& p) { return p.deviation > 0.0; });
}

bool was_moved(const AxisResult& axis) { return axis.fit && (!axis.fit->describes || !axis.fit->terms.sines.empty()); }

// The terms, and the curves from which they come.
report::Section section_of(const View& v) {
    report::Section s{.heading = v.axis.name, .paragraphs = {summary(v)}};
    for (const std::string& warning : v.axis.warnings) s.paragraphs.push_back(warning + ".");
    if (v.axis.fit && !v.axis.fit->describes)
        s.paragraphs.push_back(
            "The fitted terms do not describe the record: it was moved, or has noise of another kind. Their errors are "
            "widened accordingly.");
    if (v.axis.fit)
        s.tables.push_back(term_table(v));
    else
        s.paragraphs.push_back("No terms are fitted: " + v.axis.no_fit + ".");
    if (v.axis.temperature) s.tables.push_back(temperature_table(*v.axis.temperature));
    if (can_be_drawn(v.axis.curves.front())) s.figures.push_back(sigma_figure(v));
    s.figures.push_back(course_figure(v));
    if (!v.axis.spectrum.density.empty()) s.figures.push_back(spectrum_figure(v));
    return s;
}

report::Section mode_section(const View& v) {
    report::Section s{.heading = "Modes of " + v.axis.name};
    if (was_moved(v.axis))
        s.paragraphs.push_back("The gyro was moved: the errors per switch hold the motion in the gaps too.");
    s.tables = {mode_table(v)};
    if (!v.axis.modes->points.empty()) s.figures.push_back(split_figure(v));
    if (!v.axis.modes->switches.empty()) s.figures.push_back(switch_figure(v));
    return s;
}

report::Section number_section(const View& v) {
    report::Section s{.heading = "Numbers of " + v.axis.name};
    if (v.axis.fit) s.tables.push_back(discrete_table(v));
    if (!v.axis.readouts.empty()) s.tables.push_back(readout_table(v));
    for (const deviations::DeviationCurve& curve : v.axis.curves) s.tables.push_back(curve_table(v, curve));
    return s;
}

report::Section earth_section(const AnalysisResult& result) {
    report::Section s{.heading = "Mean rates"};
    report::Table t{.caption = "Mean rates, with what the fitted noise lets them differ by.",
                    .header = {"axis", "mean, deg/h"}};
    for (const AxisResult& axis : result.axes)
        t.rows.push_back({axis.name, with_error(axis.mean_arcsec_s, axis.mean_sigma_arcsec_s)});
    for (const EarthLine& line : result.earth)
        t.rows.push_back({fmt::format("norm of {} axes; the Earth: {:.3f}", line.n_axes, earth_rate_arcsec_s),
                          with_error(line.norm_arcsec_s, line.sigma_arcsec_s)});
    s.tables.push_back(std::move(t));
    return s;
}

report::Section table_section(const config::Analysis& config, const TableResult& test, std::size_t index) {
    const calibration::RateTable& r = test.table;
    report::Section s{.heading = test.name, .paragraphs = {test.holds + "."}};
    for (const std::string& warning : test.warnings) s.paragraphs.push_back(warning + ".");
    s.tables.push_back(
        {.caption = "Straight line through all stages by least squares, as IEEE Std 647 has it.",
         .header = {"quantity", "value"},
         .rows = {{"scale factor, units per arcsec", with_error(r.scale_factor.value, r.scale_factor.sigma)},
                  {"arcsec per unit", with_error(r.arcsec_per_unit.value, r.arcsec_per_unit.sigma)},
                  {"bias", value_text(r.bias_arcsec_s, "deg/h")},
                  {"asymmetry", value_text(r.asymmetry_ppm, "ppm")},
                  {"nonlinearity, rms", short_number(r.nonlinearity_ppm) + " ppm"},
                  {"largest residual", short_number(r.largest_residual_ppm) + " ppm"},
                  {"largest difference at one input", short_number(r.hysteresis_arcsec_s) + " deg/h"}}});
    if (test.temperature) s.tables.push_back(temperature_table(*test.temperature));
    report::Table stages{
        .caption = "Stages; residuals in ppm of the output at the largest input.",
        .header = {"input, " + shown_unit(config.unit), "output, units/s", "its sigma", "samples", "residual, ppm"}};
    for (const calibration::TableStage& stage : r.stages)
        stages.rows.push_back({fmt::format("{:.6g}", shown_rate(config.unit, stage.input_arcsec_s)),
                               fmt::format("{:.9g}", stage.output), short_number(stage.output_sigma),
                               fmt::format("{}", stage.n_samples), short_number(stage.residual_ppm)});
    s.figures.push_back(residual_figure(config, r, test.name, index));
    s.tables.push_back(std::move(stages));
    return s;
}

}  // namespace

calibration::RateTableOptions table_options(const config::Analysis& config, double rate_hz, std::size_t n) {
    const double settling = std::min(std::ceil(config.table_settling_s * rate_hz), static_cast<double>(n));
    return {.settling_samples = static_cast<std::int64_t>(settling), .earth_arcsec_s = config.table_earth_arcsec_s};
}

report::Figure residual_figure(const config::Analysis& config, const calibration::RateTable& table,
                               const std::string& of, std::size_t index) {
    Figure f = report::blank_figure(fmt::format("residuals-{}", index + 1), "Residuals of " + of,
                                    "Output less the straight line.", "input, " + shown_unit(config.unit),
                                    "residual, ppm of the largest output");
    Series points = blank_series("stages", Mark::points);
    for (const calibration::TableStage& stage : table.stages)
        add_point(points, shown_rate(config.unit, stage.input_arcsec_s), stage.residual_ppm);
    f.series = {std::move(points)};
    return f;
}

std::vector<report::Figure> axis_figures(const config::Analysis& config, const AxisResult& axis, std::size_t index) {
    const View v{.config = config, .axis = axis, .index = index};
    std::vector<report::Figure> figures{course_figure(v)};
    if (!axis.curves.empty() && can_be_drawn(axis.curves.front())) figures.push_back(sigma_figure(v));
    if (!axis.modes || axis.modes->segments.size() < 2) return figures;
    if (!axis.modes->points.empty()) figures.push_back(split_figure(v));
    if (!axis.modes->switches.empty()) figures.push_back(switch_figure(v));
    return figures;
}

report::Page analysis_page(const config::Analysis& config, const AnalysisResult& result) {
    report::Page page{
        .title = "Noise of recorded gyros",
        .verdict = analysis_verdict(config, result),
        .lead = "Deviations, fitted noise terms, drift by mode and errors of switches of what was recorded."};
    std::vector<std::string> names;
    for (std::size_t k = 0; k < result.axes.size(); ++k) {
        const View v{.config = config, .axis = result.axes[k], .index = k};
        page.sections.push_back(section_of(v));
        if (v.axis.modes && v.axis.modes->segments.size() > 1) page.sections.push_back(mode_section(v));
        page.sections.push_back(number_section(v));
        names.push_back(v.axis.name);
    }
    for (std::size_t k = 0; k < result.tables.size(); ++k) {
        page.sections.push_back(table_section(config, result.tables[k], k));
        names.push_back(result.tables[k].name);
    }
    if (!result.axes.empty()) page.sections.push_back(earth_section(result));
    config::Config asked;
    asked.analysis = config;
    page.sections.push_back(result.made ? *result.made : how_made("zlg analyze FILE...", names, "", asked));
    return page;
}

}  // namespace zlg::study
