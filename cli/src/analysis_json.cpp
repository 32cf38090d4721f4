#include <cmath>

#include <zlg/noise/noise_units.hpp>
#include <zlg/study/term_text.hpp>

#include "analysis_json.hpp"
#include "fields_json.hpp"

namespace zlg::cli {
namespace {

using nlohmann::json;
using study::AxisResult;

json curve_json(const deviations::DeviationCurve& curve) {
    json points = json::array();
    const bool is_total = curve.kind == deviations::DeviationKind::totdev;
    for (const auto& p : curve.points) {
        points.push_back(fields_json(p, {{"terms", "n"}}));
        points.back()["edf"] = p.law.edf;
        if (!is_total) points.back().erase("as_computed");
    }
    return {{"kind", deviations::name_of(curve.kind)},
            {"unit", curve.kind == deviations::DeviationKind::tdev ? "arcsec" : "arcsec/s"},
            {"confidence", curve.confidence},
            {"points", points}};
}

json curves_json(const std::vector<deviations::DeviationCurve>& curves) {
    json all = json::array();
    for (const auto& curve : curves) all.push_back(curve_json(curve));
    return all;
}

json term_json(const noise::FittedTerm& term) {
    const study::ShownTerm in = study::shown_term(term.kind);
    json j = fields_json(term, {{"limit", "limit_95"}});
    j["term"] = noise::name_of(term.kind);
    j["unit"] = noise::unit_of(term.kind);
    j["shown"] = {{"unit", in.unit},
                  {"value", term.value * in.factor},
                  {"sigma", term.sigma * in.factor},
                  {"limit_95", term.limit * in.factor}};
    if (term.kind == noise::NoiseKind::angle_random_walk && std::isfinite(term.second))
        j["bandwidth_hz"] = term.second, j["bandwidth_sigma_hz"] = term.second_sigma;
    if (term.kind == noise::NoiseKind::markov) j["time_s"] = term.second, j["time_sigma_s"] = term.second_sigma;
    if (term.kind == noise::NoiseKind::sine)
        j["frequency_hz"] = term.second, j["frequency_sigma_hz"] = term.second_sigma;
    return j;
}

json fit_json(const AxisResult& axis) {
    if (!axis.fit) return {{"reason", axis.no_fit}};
    json j = fields_json(*axis.fit);
    j["terms"] = json::array();
    for (const auto& term : axis.fit->fitted) j["terms"].push_back(term_json(term));
    j["points"] = fields_json(axis.fit->points, {{"measured", "hadamard_variance"}, {"degrees", "edf"}});
    // Without sinusoids and Markov terms, for which a data sheet has no line.
    j["data_sheet"] = fields_json(noise::data_sheet(axis.fit->terms));
    j["discrete"] = fields_json(noise::discrete_noise(axis.fit->terms, axis.rate_hz));
    j["discrete"]["rate_hz"] = axis.rate_hz;
    return j;
}

json modes_json(const AxisResult& axis) {
    const noise::ModeSplit& m = *axis.modes;
    json j = fields_json(m);
    j["segments"] = fields_json(m.segments);
    j["switches"] = fields_json(m.switches);
    j["switch_statistics"] = fields_json(m.statistics, {{"mean_by_mode_arcsec", "alternating_arcsec"}});
    j["curves"] = curves_json(axis.mode_curves);
    return j;
}

json axis_json(const AxisResult& axis) {
    json j = fields_json(axis, {{"n_samples", "samples"},
                                {"n_known", "known"},
                                {"n_gaps", "gaps"},
                                {"mean_arcsec_s", "mean_rate_arcsec_s"},
                                {"mean_sigma_arcsec_s", "mean_rate_sigma_arcsec_s"}});
    j["warnings"] = axis.warnings;
    j["deviations"] = curves_json(axis.curves);
    j["fit"] = fit_json(axis);
    j["readouts"] = fields_json(axis.readouts, {{"deviation_arcsec_s", "deviation"}});
    for (json& readout : j["readouts"]) {
        readout["kind"] = deviations::name_of(axis.allan.kind);
        readout["unit"] = "arcsec/s";
    }
    if (axis.modes) j["modes"] = modes_json(axis);
    if (axis.temperature) j["temperature"] = fields_json(*axis.temperature);
    return j;
}

json table_json(const study::TableResult& test) {
    json j = fields_json(test.table, {{"scale_factor", "scale_factor_units_arcsec"}});
    j["name"] = test.name;
    j["holds"] = test.holds;
    j["warnings"] = test.warnings;
    if (test.temperature) j["temperature"] = fields_json(*test.temperature);
    j["stages"] = fields_json(test.table.stages, {{"output", "output_units_s"}, {"n_samples", "samples"}});
    return j;
}

}  // namespace

json analysis_json(const study::AnalysisResult& result) {
    json j{{"axes", json::array()}};
    for (const AxisResult& axis : result.axes) j["axes"].push_back(axis_json(axis));
    j["earth"] = fields_json(result.earth, {{"n_axes", "axes"}});
    for (json& line : j["earth"]) line["earth_arcsec_s"] = study::earth_rate_arcsec_s;
    for (const auto& test : result.tables) j["rate_tables"].push_back(table_json(test));
    return j;
}

}  // namespace zlg::cli
