#include <zlg/acceptance/report.hpp>
#include <zlg/config/config.hpp>
#include <zlg/report/page.hpp>
#include <zlg/rig/refusal.hpp>
#include <zlg/study/analyze.hpp>
#include <zlg/study/run.hpp>
#include <zlg/study/run_page.hpp>
#include <zlg/study/what_happened.hpp>

#include "analysis_dicts.hpp"
#include "bind.hpp"
#include "fields_dict.hpp"
#include "log_columns.hpp"

namespace zlg::python {
namespace {

py::dict of(study::VariantResult&& v) {
    py::dict d = fields_dict(v);
    study::for_each_field<study::SwitchStatistics>([&](const std::string& name, auto get) {
        d[py::str("switch_" + name)] = v.switch_error ? py::cast(get(*v.switch_error)) : py::none();
    });
    d["switch_tick"] = column(v.switches, [](const study::SwitchError& s) { return s.window.first_tick; });
    d["switch_error_arcsec"] = column(v.switches, &study::SwitchError::error_arcsec);
    d["t_s"] = as_array(std::move(v.curve.t_s));
    d["error_arcsec"] = as_array(std::move(v.curve.error_arcsec));
    return d;
}

py::dict run(const config::Config& config, const std::vector<std::string>& warnings, bool raw, bool angles, bool page,
             int threads, const py::object& progress) {
    if (raw || angles)
        rig::require_every_half(config, "a log", "allowed is raw=False, angles=False, or gyro.fidelity = \"averaged\"");
    const Progress notify{progress};
    RawCollector records;
    AngleCollector rows;
    study::RunTask task{.config = config, .warnings = warnings, .threads = threads, .on_progress = std::cref(notify)};
    if (raw) task.on_record = [&](const core::HalfRecord& r, const core::LightSamples&) { records.add(r); };
    if (angles) task.on_row = [&](const core::AngleRow& row, double truth) { rows.add(row, truth); };
    study::RunResult result;
    std::string html;
    {
        const py::gil_scoped_release released;
        result = study::run(task);
        if (page) html = report::html(study::run_page(config, result));
    }
    py::list variants;
    for (study::VariantResult& v : result.variants) variants.append(of(std::move(v)));
    py::dict switches;
    add_columns(switches, result.switches);
    py::dict d;
    d["tick_s"] = result.tick_s;
    d["ticks"] = result.ticks;
    d["fingerprint"] = result.fingerprint;
    d["switches_failed"] = result.tally.failed;
    d["switches_withheld"] = result.tally.withheld;
    d["none_succeeded"] = result.tally.none_succeeded();
    d["warnings"] = result.warnings;
    d["variants"] = variants;
    d["magnetic_estimate"] = of(std::move(result.magnetic_estimate));
    d["what_happened"] = study::what_happened(config, result);
    d["ticks_invalid"] = result.invalid_ticks;
    d["switches"] = switches;
    d["relock_false_drift_deg_h"] = as_array(std::move(result.relock_false_drift_deg_h));
    d["raw"] = raw ? py::object{records.take_out()} : py::none();
    d["angles"] = angles ? py::object{rows.take_out()} : py::none();
    d["page"] = page ? py::object{py::str{html}} : py::none();
    return d;
}

// Name, group, rate, rates, mode, bridged rates, phase and warnings.
using Axis = std::tuple<std::string, std::string, double, In<double>, std::optional<In<std::int8_t>>,
                        std::optional<In<double>>, std::optional<In<double>>, std::vector<std::string>>;

study::AxisRecord record_of(const Axis& axis) {
    const auto& [name, group, rate_hz, rates, mode, bridged, phase, warnings] = axis;
    const auto copied = [](const auto& span) { return std::vector(span.begin(), span.end()); };
    return {.name = name,
            .group = group,
            .holds = "rates in arcsec/s",
            .rate_hz = rate_hz,
            .rates_arcsec_s = copied(span_of(rates, "rates_arcsec_s")),
            .mode = copied(span_of(mode, "mode")),
            .bridged_arcsec_s = copied(span_of(bridged, "bridged_arcsec_s")),
            .phase_arcsec = copied(span_of(phase, "phase_arcsec")),
            .warnings = warnings};
}

py::list list_of(const std::vector<deviations::DeviationCurve>& curves) {
    py::list all;
    for (const auto& curve : curves) all.append(dict_of(curve));
    return all;
}

py::dict of(const study::AxisResult& axis) {
    py::dict d = fields_dict(axis);
    d["deviations"] = list_of(axis.curves);
    d["readouts"] = fields_list(axis.readouts);
    d["modes"] = axis.modes ? py::object{dict_of(*axis.modes)} : py::none();
    d["mode_curves"] = list_of(axis.mode_curves);
    d["fit"] = axis.fit ? py::object{dict_of(*axis.fit)} : py::none();
    d["no_fit"] = axis.no_fit;
    d["warnings"] = axis.warnings;
    return d;
}

py::dict analyze(const config::Config& config, const std::vector<Axis>& axes, std::int64_t settling_samples,
                 int threads, const py::object& progress) {
    const Progress notify{progress};
    std::vector<study::AxisRecord> records;
    for (const Axis& axis : axes) records.push_back(record_of(axis));
    study::AnalysisResult result;
    std::string html;
    {
        const py::gil_scoped_release released;
        const study::AnalysisTask task{config.analysis, settling_samples, threads};
        for (study::AxisRecord& record : records) {
            notify(static_cast<double>(result.axes.size()) / static_cast<double>(records.size()));
            result.axes.push_back(study::analyze_axis(task, std::move(record)));
        }
        result.earth = study::earth_lines(result.axes);
        html = report::html(study::analysis_page(config.analysis, result));
    }
    py::list all;
    for (const study::AxisResult& axis : result.axes) all.append(of(axis));
    return py::dict("axes"_a = all, "earth"_a = fields_list(result.earth), "page"_a = html);
}

// The record as JSON, and the page.
py::tuple accept(const std::string& plan, const config::Config& said, int threads, const py::object& progress) {
    if (!(threads >= 1)) throw std::invalid_argument{"threads: allowed is 1 and more"};
    const Progress notify{progress};
    std::string record, html;
    {
        const py::gil_scoped_release released;
        const acceptance::Acceptance test =
            acceptance::accept({.plan = plan, .said = said, .threads = threads, .on_progress = std::cref(notify)});
        const report::Page page = acceptance::acceptance_page(test, "zlg.accept in Python");
        record = page.data;
        html = acceptance::report_html(page);
    }
    return py::make_tuple(record, html);
}

}  // namespace

void bind_study(py::module_& m) {
    m.def("run", &run);
    m.def("analyze", &analyze);
    m.def("accept", &accept);
}

}  // namespace zlg::python
