#include <cmath>

#include <zlg/noise/noise_units.hpp>
#include <zlg/study/term_text.hpp>

#include "analysis_text.hpp"

namespace zlg::cli {
namespace {

using nlohmann::json;
using study::AxisResult;

json number(double x) { return std::isfinite(x) ? json(x) : json(nullptr); }

json curve_json(const deviations::DeviationCurve& curve) {
    json points = json::array();
    const bool is_total = deviations::is_total(curve.kind);
    for (const auto& p : curve.points) {
        points.push_back({{"tau_s", p.tau_s},
                          {"m", p.m},
                          {"deviation", number(p.deviation)},
                          {"low", number(p.low)},
                          {"high", number(p.high)},
                          {"n", p.terms},
                          {"edf", number(p.law.edf)},
                          {"noise", p.noise}});
        if (is_total) points.back()["as_computed"] = number(p.as_computed);
    }
    json j{{"kind", deviations::name_of(curve.kind)},
           {"unit", curve.kind == deviations::DeviationKind::tdev ? "arcsec" : "arcsec/s"},
           {"confidence", curve.confidence},
           {"points", points}};
    if (is_total) j["total_bias"] = deviations::name_of(curve.total_bias);
    return j;
}

json term_json(const noise::FittedTerm& term) {
    const study::ShownTerm in = study::shown_term(term.kind);
    json j{{"term", noise::name_of(term.kind)},
           {"found", term.found},
           {"unit", noise::unit_of(term.kind)},
           {"value", number(term.value)},
           {"sigma", number(term.sigma)},
           {"limit_95", number(term.limit)},
           {"read_at_s", number(term.read_at_s)},
           {"shown",
            {{"unit", in.unit},
             {"value", number(term.value * in.factor)},
             {"sigma", number(term.sigma * in.factor)},
             {"limit_95", number(term.limit * in.factor)}}}};
    if (term.kind == noise::NoiseKind::markov)
        j["time_s"] = number(term.second), j["time_sigma_s"] = number(term.second_sigma);
    if (term.kind == noise::NoiseKind::sine)
        j["frequency_hz"] = number(term.second), j["frequency_sigma_hz"] = number(term.second_sigma);
    return j;
}

// Without sinusoids and Markov terms, for which a data sheet has no line.
json sheet_json(const noise::NoiseTerms& terms) {
    const noise::DataSheet s = noise::data_sheet(terms);
    return {{"quantisation_arcsec", s.quantisation_arcsec},
            {"angle_random_walk_deg_sqrt_h", s.angle_random_walk_deg_sqrt_h},
            {"bias_instability_deg_h", s.bias_instability_deg_h},
            {"rate_random_walk_deg_h_sqrt_h", s.rate_random_walk_deg_h_sqrt_h},
            {"ramp_deg_h_h", s.ramp_deg_h_h}};
}

json discrete_json(const noise::NoiseTerms& terms, double rate_hz) {
    const noise::DiscreteNoise d = noise::discrete_noise(terms, rate_hz);
    return {{"rate_hz", rate_hz},
            {"white_rate_arcsec_s", d.white_rate_arcsec_s},
            {"white_increment_arcsec", d.white_increment_arcsec},
            {"walk_step_arcsec_s", d.walk_step_arcsec_s},
            {"angle_error_arcsec", d.angle_error_arcsec},
            {"ramp_step_arcsec_s", d.ramp_step_arcsec_s},
            {"markov_factor", d.markov_factor},
            {"markov_step_arcsec_s", d.markov_step_arcsec_s}};
}

json fit_json(const AxisResult& axis) {
    if (!axis.fit) return {{"reason", axis.no_fit}};
    json terms = json::array(), points = json::array();
    for (const auto& term : axis.fit->fitted) terms.push_back(term_json(term));
    for (const auto& p : axis.fit->points)
        points.push_back(
            {{"tau_s", p.tau_s}, {"hadamard_variance", p.measured}, {"fitted", p.fitted}, {"edf", p.degrees}});
    return {{"terms", terms},
            {"points", points},
            {"data_sheet", sheet_json(axis.fit->terms)},
            {"discrete", discrete_json(axis.fit->terms, axis.rate_hz)},
            {"chi2", axis.fit->chi2},
            {"dof", axis.fit->dof},
            {"probability", number(axis.fit->probability)},
            {"model_error", axis.fit->model_error},
            {"describes", axis.fit->describes}};
}

json estimate_json(const numeric::Estimate& e) {
    if (!e.determined) return {{"determined", false}, {"reason", e.reason}};
    return {{"determined", true}, {"value", e.value}, {"sigma", e.sigma}};
}

json modes_json(const AxisResult& axis) {
    const noise::ModeSplit& m = *axis.modes;
    json segments = json::array(), switches = json::array(), curves = json::array();
    for (const auto& s : m.segments)
        segments.push_back({{"mode", s.mode},
                            {"time_s", s.time_s},
                            {"known_s", s.known_s},
                            {"rate_arcsec_s", number(s.rate_arcsec_s)}});
    for (const auto& s : m.switches)
        switches.push_back(
            {{"time_s", s.time_s}, {"mode_after", s.mode_after}, {"error_arcsec", number(s.error_arcsec)}});
    for (const auto& c : axis.mode_curves) curves.push_back(curve_json(c));
    const auto& s = m.statistics;
    return {{"segments", segments},
            {"nonmagnetic_arcsec_s", estimate_json(m.nonmagnetic_arcsec_s)},
            {"magnetic_arcsec_s", estimate_json(m.magnetic_arcsec_s)},
            {"magnetic_thermal_arcsec_s", estimate_json(m.magnetic_thermal_arcsec_s)},
            {"thermal_time_s", estimate_json(m.thermal_time_s)},
            {"switches", switches},
            {"switch_statistics",
             {{"n", s.n},
              {"mean_arcsec", s.mean_arcsec},
              {"mean_sigma_arcsec", s.mean_sigma_arcsec},
              {"alternating_arcsec", s.mean_by_mode_arcsec},
              {"rms_arcsec", s.rms_arcsec},
              {"max_arcsec", s.max_arcsec}}},
            {"curves", curves}};
}

json axis_json(const AxisResult& axis) {
    json curves = json::array(), readouts = json::array();
    for (const auto& c : axis.curves) curves.push_back(curve_json(c));
    for (const auto& r : axis.readouts)
        readouts.push_back({{"what", r.what},
                            {"tau_s", r.tau_s},
                            {"kind", deviations::name_of(axis.allan.kind)},
                            {"deviation", r.deviation_arcsec_s},
                            {"unit", "arcsec/s"}});
    json j{{"name", axis.name},
           {"holds", axis.holds},
           {"rate_hz", axis.rate_hz},
           {"samples", axis.n_samples},
           {"known", axis.n_known},
           {"gaps", axis.n_gaps},
           {"is_error", axis.is_error},
           {"mean_rate_arcsec_s", axis.mean_arcsec_s},
           {"mean_rate_sigma_arcsec_s", number(axis.mean_sigma_arcsec_s)},
           {"deviations", curves},
           {"fit", fit_json(axis)},
           {"readouts", readouts}};
    if (axis.modes) j["modes"] = modes_json(axis);
    return j;
}

json table_json(const study::TableResult& test) {
    const calibration::RateTable& r = test.table;
    json stages = json::array();
    for (const auto& s : r.stages)
        stages.push_back({{"input_arcsec_s", s.input_arcsec_s},
                          {"output_units_s", s.output},
                          {"output_sigma", s.output_sigma},
                          {"samples", s.n_samples},
                          {"residual_ppm", s.residual_ppm}});
    return {{"name", test.name},
            {"holds", test.holds},
            {"stages", stages},
            {"scale_factor_units_arcsec", estimate_json(r.scale_factor)},
            {"arcsec_per_unit", estimate_json(r.arcsec_per_unit)},
            {"bias_arcsec_s", estimate_json(r.bias_arcsec_s)},
            {"asymmetry_ppm", estimate_json(r.asymmetry_ppm)},
            {"nonlinearity_ppm", r.nonlinearity_ppm},
            {"largest_residual_ppm", r.largest_residual_ppm},
            {"hysteresis_arcsec_s", r.hysteresis_arcsec_s}};
}

}  // namespace

json analysis_json(const config::Analysis& config, const study::AnalysisResult& result) {
    json j{{"axes", json::array()}, {"earth", json::array()}};
    for (const AxisResult& axis : result.axes) j["axes"].push_back(axis_json(axis));
    for (const auto& e : result.earth)
        j["earth"].push_back({{"group", e.group},
                              {"axes", e.n_axes},
                              {"norm_arcsec_s", e.norm_arcsec_s},
                              {"sigma_arcsec_s", number(e.sigma_arcsec_s)},
                              {"earth_arcsec_s", study::earth_rate_arcsec_s}});
    if (result.presumed)
        j["presumed"] = {{"name", result.presumed->name},
                         {"angle_random_walk_arcsec_sqrt_s", result.presumed->terms.angle_random_walk_arcsec_sqrt_s},
                         {"rate_random_walk_arcsec_s_sqrt_s", result.presumed->terms.rate_random_walk_arcsec_s_sqrt_s},
                         {"data_sheet", sheet_json(result.presumed->terms)}};
    for (const auto& test : result.tables) j["rate_tables"].push_back(table_json(test));
    if (config.latitude_deg)
        j["latitude"] = {{"deg", *config.latitude_deg},
                         {"vertical_arcsec_s", study::earth_vertical_arcsec_s(*config.latitude_deg)},
                         {"horizontal_arcsec_s", study::earth_horizontal_arcsec_s(*config.latitude_deg)}};
    return j;
}

}  // namespace zlg::cli
