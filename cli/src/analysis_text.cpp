#include "analysis_text.hpp"

#include <array>
#include <cmath>

#include <fmt/format.h>

#include <zlg/noise/noise_units.hpp>
#include <zlg/study/term_text.hpp>

#include "output.hpp"

namespace zlg::cli {
namespace {

using study::AxisResult;

// tdev is an angle.
std::string unit_of(const deviations::DeviationCurve& curve, const config::Analysis& config) {
    return curve.kind == deviations::DeviationKind::tdev ? "arcsec" : study::shown_unit(config.unit);
}

double shown(const deviations::DeviationCurve& curve, const config::Analysis& config, double value) {
    return curve.kind == deviations::DeviationKind::tdev ? value : study::shown_rate(config.unit, value);
}

std::string head_text(const config::Analysis& config, const AxisResult& axis) {
    const double span_s = static_cast<double>(axis.n_samples) / axis.rate_hz;
    std::string text = fmt::format("{}: {}, {:g} Hz\n  {} samples, {:.6g} s, {} known, {} gaps\n", printable(axis.name),
                                   axis.holds, axis.rate_hz, axis.n_samples, span_s, axis.n_known, axis.n_gaps);
    for (const std::string& doubt : axis.doubts) text += fmt::format("  doubt: {}\n", printable(doubt));
    const auto in_unit = [&config](double x) { return study::shown_rate(config.unit, x); };
    text += fmt::format("  mean rate   {} {}\n",
                        study::with_error(in_unit(axis.mean_arcsec_s), in_unit(axis.mean_sigma_arcsec_s)),
                        study::shown_unit(config.unit));
    return text;
}

// In the order of deviations::TotalBias.
constexpr std::array bias_texts{"bias of mirroring removed", "bias of mirroring removed as published",
                                "as computed, with the bias of mirroring"};

std::string curve_text(const config::Analysis& config, const deviations::DeviationCurve& curve) {
    const bool is_total = deviations::is_total(curve.kind);
    std::string text = fmt::format(
        "  {}, {}{}{}; intervals of {:g} %\n  {:>12} {:>10} {:>12} {:>12} {:>12} {:>9} {:>6}{}\n",
        deviations::name_of(curve.kind), unit_of(curve, config), is_total ? ", " : "",
        is_total ? bias_texts.at(static_cast<std::size_t>(curve.total_bias)) : "", 100.0 * curve.confidence, "tau, s",
        "n", "sigma", "low", "high", "edf", "noise", is_total ? fmt::format(" {:>12}", "as computed") : "");
    for (const auto& p : curve.points) {
        text += fmt::format("  {:>12.6g} {:>10} {:>12.5g} {:>12.5g} {:>12.5g} {:>9.4g} {:>6}", p.tau_s, p.terms,
                            shown(curve, config, p.deviation), shown(curve, config, p.low),
                            shown(curve, config, p.high), p.law.edf, fmt::format("f^{}", p.noise));
        text += is_total ? fmt::format(" {:>12.5g}\n", shown(curve, config, p.as_computed)) : "\n";
    }
    return text;
}

std::string fit_text(const AxisResult& axis) {
    if (!axis.fit) return fmt::format("  no terms are fitted: {}\n", axis.no_fit);
    std::string text = "  fitted terms\n";
    for (const auto& term : axis.fit->fitted) {
        const std::string where =
            term.found && std::isfinite(term.read_at_s) ? fmt::format("   read at {:.4g} s", term.read_at_s) : "";
        text += fmt::format("    {:<24} {}{}\n", noise::name_of(term.kind), study::value_text(term), where);
    }
    text += fmt::format("    chi-square {:.3g} of {} degrees of freedom, probability {:.2g}\n", axis.fit->chi2,
                        axis.fit->dof, axis.fit->probability);
    if (axis.fit->model_error > 0.0)
        text +=
            fmt::format("    each variance allowed an error of {:g} % beside chance\n", 100.0 * axis.fit->model_error);
    if (!axis.fit->describes)
        text += "    these terms do not describe the record: it was moved, or has noise of another kind\n";
    return text;
}

std::string readout_text(const config::Analysis& config, const AxisResult& axis) {
    if (axis.readouts.empty()) return "";
    std::string text = fmt::format("  readouts of {}\n", deviations::name_of(axis.allan.kind));
    for (const auto& r : axis.readouts)
        text += fmt::format("    {:<44} tau {:>10.5g} s   {:.4g} {}\n", r.what, r.tau_s,
                            study::shown_rate(config.unit, r.deviation_arcsec_s), study::shown_unit(config.unit));
    return text;
}

std::string estimate_text(const char* what, const numeric::Estimate& e, const char* unit) {
    return fmt::format("    {:<24} {}\n", what, study::value_text(e, unit));
}

std::string modes_text(const AxisResult& axis) {
    if (!axis.modes || axis.modes->segments.size() < 2) return "";
    const noise::ModeSplit& m = *axis.modes;
    std::string text = fmt::format("  modes: {} segments\n", m.segments.size());
    text += estimate_text("non-magnetic drift", m.nonmagnetic_arcsec_s, "deg/h");
    text += estimate_text("magnetic, at the start", m.magnetic_arcsec_s, "deg/h");
    text += estimate_text("its growth by warming", m.magnetic_thermal_arcsec_s, "deg/h");
    text += estimate_text("time of the warming", m.thermal_time_s, "s");
    const auto& s = m.statistics;
    if (s.n > 0)
        text += fmt::format(
            "    error per switch{}, arcsec: {} switches, mean {}, alternating {:.3g}, rms {:.3g}, max {:.3g}\n",
            axis.fit && axis.fit->describes && axis.fit->terms.sines.empty() ? "" : " (with the motion in the gaps)",
            s.n, study::with_error(s.mean_arcsec, s.mean_sigma_arcsec), s.mean_by_mode_arcsec, s.rms_arcsec,
            s.max_arcsec);
    return text;
}

std::string earth_text(const config::Analysis& config, const study::AnalysisResult& result) {
    std::string text;
    for (const auto& line : result.earth)
        text += fmt::format("{}: norm of the mean rates of {} axes {} deg/h; the Earth's rate is {:.3f}\n", line.group,
                            line.n_axes, study::with_error(line.norm_arcsec_s, line.sigma_arcsec_s),
                            study::earth_rate_arcsec_s);
    if (config.latitude_deg)
        text += fmt::format(
            "at latitude {:g} deg the Earth turns {:.3f} deg/h about the vertical, and about a horizontal "
            "axis up to {:.3f}\n",
            *config.latitude_deg, study::earth_vertical_arcsec_s(*config.latitude_deg),
            study::earth_horizontal_arcsec_s(*config.latitude_deg));
    return text;
}

std::string presumed_text(const study::PresumedNoise& presumed) {
    const noise::DataSheet sheet = noise::data_sheet(presumed.terms);
    return fmt::format("{} presumes {:.4g} deg/sqrt(h) and {:.4g} deg/h/sqrt(h)\n", printable(presumed.name),
                       sheet.angle_random_walk_deg_sqrt_h, sheet.rate_random_walk_deg_h_sqrt_h);
}

std::string table_text(const study::TableResult& test) {
    const calibration::RateTable& r = test.table;
    std::string text =
        fmt::format("{}: {}\n  {} stages of a rate table\n", printable(test.name), test.holds, r.stages.size());
    text += fmt::format("  {:>16} {:>18} {:>12} {:>10} {:>14}\n", "input, deg/h", "output, units/s", "sigma", "n",
                        "residual, ppm");
    for (const auto& s : r.stages)
        text += fmt::format("  {:>16.8g} {:>18.10g} {:>12.3g} {:>10} {:>14.4g}\n", s.input_arcsec_s, s.output,
                            s.output_sigma, s.n_samples, s.residual_ppm);
    text += estimate_text("scale factor", r.scale_factor, "units/arcsec");
    text += estimate_text("its inverse", r.arcsec_per_unit, "arcsec/unit");
    text += estimate_text("bias", r.bias_arcsec_s, "deg/h");
    text += estimate_text("asymmetry", r.asymmetry_ppm, "ppm");
    return text + fmt::format("    {:<24} {:.3g} ppm rms, {:.3g} largest\n    {:<24} {:.3g} deg/h\n\n", "nonlinearity",
                              r.nonlinearity_ppm, r.largest_residual_ppm, "difference at one input",
                              r.hysteresis_arcsec_s);
}

}  // namespace

std::string analysis_text(const config::Analysis& config, const study::AnalysisResult& result) {
    std::string text;
    for (const AxisResult& axis : result.axes) {
        text += head_text(config, axis);
        for (const auto& curve : axis.curves) text += curve_text(config, curve);
        text += readout_text(config, axis) + fit_text(axis) + modes_text(axis) + "\n";
    }
    for (const auto& test : result.tables) text += table_text(test);
    if (result.presumed) text += presumed_text(*result.presumed);
    return text + earth_text(config, result);
}

}  // namespace zlg::cli
