#include <zlg/config/config.hpp>
#include <zlg/paper/paper.hpp>
#include <zlg/report/page.hpp>
#include <zlg/study/analyze.hpp>
#include <zlg/study/run.hpp>
#include <zlg/study/run_page.hpp>

#include "analysis_dicts.hpp"
#include "bind.hpp"
#include "log_columns.hpp"

namespace zlg::python {
namespace {

using study::SwitchLine;

py::dict of(study::VariantResult&& v) {
    py::dict d;
    d["name"] = v.name;
    d["drift_arcsec_s"] = v.drift_arcsec_s;
    d["angle_error_arcsec"] = v.angle_error_arcsec;
    d["switch_mean_arcsec"] = v.switch_error ? py::cast(v.switch_error->mean_arcsec) : py::none();
    d["switch_rms_arcsec"] = v.switch_error ? py::cast(v.switch_error->rms_arcsec) : py::none();
    d["switch_max_arcsec"] = v.switch_error ? py::cast(v.switch_error->max_arcsec) : py::none();
    d["switch_tick"] = column(v.switches, [](const study::SwitchError& s) { return s.window.first_tick; });
    d["switch_error_arcsec"] = column(v.switches, &study::SwitchError::error_arcsec);
    d["t_s"] = as_array(std::move(v.curve.t_s));
    d["error_arcsec"] = as_array(std::move(v.curve.error_arcsec));
    return d;
}

py::dict switches_of(const std::vector<SwitchLine>& s) {
    py::dict d;
    d["tick"] = column(s, &SwitchLine::tick);
    d["mode"] = column(s, &SwitchLine::mode);
    d["miss_lambda"] = column(s, &SwitchLine::miss_lambda);
    d["half_wave_v"] = column(s, &SwitchLine::half_wave_v);
    d["gap_ticks"] = column(s, &SwitchLine::gap_ticks);
    d["dp_arcsec"] = column(s, &SwitchLine::dp_arcsec);
    d["relock_arcsec"] = column(s, &SwitchLine::relock_arcsec);
    d["sigma_arcsec"] = column(s, &SwitchLine::sigma_arcsec);
    d["true_error_arcsec"] = column(s, &SwitchLine::true_error_arcsec);
    return d;
}

py::dict run(const config::Config& config, const std::vector<std::string>& warnings, bool raw, bool angles, bool page,
             int threads, const py::object& progress) {
    const Progress tell{progress};
    RawCollector records;
    AngleCollector rows;
    study::RunTask task{.config = config, .warnings = warnings, .threads = threads, .on_progress = std::cref(tell)};
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
    py::dict d;
    d["tick_s"] = result.tick_s;
    d["ticks"] = result.ticks;
    d["switches_failed"] = result.tally.failed;
    d["none_succeeded"] = result.tally.none_succeeded();
    d["warnings"] = result.warnings;
    d["variants"] = variants;
    d["switches"] = switches_of(result.switches);
    d["relock_false_drift_deg_h"] = as_array(std::move(result.relock_false_drift_deg_h));
    d["raw"] = raw ? py::object{records.take_out()} : py::none();
    d["angles"] = angles ? py::object{rows.take_out()} : py::none();
    d["page"] = page ? py::object{py::str{html}} : py::none();
    return d;
}

py::dict paper(const config::Config& config, int threads, int switches_per_point, const py::object& progress) {
    const Progress tell{progress};
    paper::Paper result;
    std::string html;
    {
        const py::gil_scoped_release released;
        result = paper::recompute_paper({.config = config,
                                         .threads = threads,
                                         .switches_per_point = switches_per_point,
                                         .on_progress = std::cref(tell)});
        html = report::html(paper::paper_page(result));
    }
    py::list claims;
    for (const paper::Claim& c : result.claims) {
        py::dict claim;
        claim["where"] = c.where;
        claim["claim"] = c.claim;
        claim["verdict"] = paper::verdict_name(c.verdict);
        claim["finding"] = c.finding;
        claims.append(claim);
    }
    py::dict d;
    d["claims"] = claims;
    d["chi2_per_dof"] = result.chi2_per_dof;
    d["page"] = html;
    return d;
}

struct Axes {
    std::vector<study::AxisRecord> records;

    void add(const std::string& name, const std::string& group, double rate_hz, const In<double>& rates,
             const std::optional<In<std::int8_t>>& mode, const std::optional<In<double>>& bridged) {
        const auto copied = [](const auto& span) { return std::vector(span.begin(), span.end()); };
        records.push_back({.name = name,
                           .group = group,
                           .holds = "rates in arcsec/s",
                           .rate_hz = rate_hz,
                           .rates_arcsec_s = copied(span_of(rates, "rates_arcsec_s")),
                           .mode = copied(span_of(mode, "mode")),
                           .bridged_arcsec_s = copied(span_of(bridged, "bridged_arcsec_s"))});
    }
};

py::list list_of(const std::vector<deviations::DeviationCurve>& curves) {
    py::list all;
    for (const auto& curve : curves) all.append(dict_of(curve));
    return all;
}

py::list list_of(const std::vector<study::Readout>& readouts) {
    py::list all;
    for (const study::Readout& readout : readouts) {
        py::dict d;
        d["what"] = readout.what;
        d["tau_s"] = readout.tau_s;
        d["deviation_arcsec_s"] = readout.deviation_arcsec_s;
        all.append(d);
    }
    return all;
}

py::list list_of(const std::vector<study::EarthLine>& lines) {
    py::list all;
    for (const study::EarthLine& line : lines) {
        py::dict d;
        d["group"] = line.group;
        d["n_axes"] = line.n_axes;
        d["norm_arcsec_s"] = line.norm_arcsec_s;
        d["sigma_arcsec_s"] = line.sigma_arcsec_s;
        all.append(d);
    }
    return all;
}

py::dict of(const study::AxisResult& axis) {
    py::dict d;
    d["name"] = axis.name;
    d["n_samples"] = axis.n_samples;
    d["n_known"] = axis.n_known;
    d["n_gaps"] = axis.n_gaps;
    d["mean_arcsec_s"] = axis.mean_arcsec_s;
    d["mean_sigma_arcsec_s"] = axis.mean_sigma_arcsec_s;
    d["deviations"] = list_of(axis.curves);
    d["readouts"] = list_of(axis.readouts);
    d["modes"] = axis.modes ? py::object{dict_of(*axis.modes)} : py::none();
    d["mode_curves"] = list_of(axis.mode_curves);
    d["fit"] = axis.fit ? py::object{dict_of(*axis.fit)} : py::none();
    d["no_fit"] = axis.no_fit;
    return d;
}

// The records are taken out of `axes`.
py::dict analyze(const config::Config& config, Axes& axes, std::int64_t settling_samples, int threads,
                 const py::object& progress) {
    const Progress tell{progress};
    std::vector<study::AxisRecord> records = std::move(axes.records);
    study::AnalysisResult result;
    std::string html;
    {
        const py::gil_scoped_release released;
        const study::AnalysisTask task{config.analysis, settling_samples, threads};
        for (study::AxisRecord& record : records) {
            tell(static_cast<double>(result.axes.size()) / static_cast<double>(records.size()));
            result.axes.push_back(study::analyze_axis(task, std::move(record)));
        }
        result.earth = study::earth_lines(result.axes);
        html = report::html(study::analysis_page(config.analysis, result));
    }
    py::list all;
    for (const study::AxisResult& axis : result.axes) all.append(of(axis));
    py::dict d;
    d["axes"] = all;
    d["earth"] = list_of(result.earth);
    d["page"] = html;
    return d;
}

}  // namespace

void bind_study(py::module_& m) {
    m.def("run", &run, py::arg("config"), py::arg("warnings"), py::arg("raw"), py::arg("angles"), py::arg("page"),
          py::arg("threads"), py::arg("progress"));
    py::class_<Axes>(m, "Axes")
        .def(py::init<>())
        .def("add", &Axes::add, py::arg("name"), py::arg("group"), py::arg("rate_hz"), py::arg("rates_arcsec_s"),
             py::arg("mode"), py::arg("bridged_arcsec_s"));
    m.def("analyze", &analyze, py::arg("config"), py::arg("axes"), py::arg("settling_samples"), py::arg("threads"),
          py::arg("progress"));
    m.def("paper", &paper, py::arg("config"), py::arg("threads"), py::arg("switches_per_point"), py::arg("progress"));
}

}  // namespace zlg::python
