#include <cmath>

#include <zlg/choice/choice_page.hpp>
#include <zlg/config/config.hpp>
#include <zlg/design/drift_budget.hpp>
#include <zlg/design/error.hpp>
#include <zlg/design/perimeter_response.hpp>
#include <zlg/design/relock_loop.hpp>
#include <zlg/design/substitution.hpp>
#include <zlg/design/substitution_noise.hpp>
#include <zlg/design/switching_interval.hpp>
#include <zlg/report/page.hpp>
#include <zlg/study/design_study.hpp>

#include "arrays.hpp"
#include "bind.hpp"
#include "fields_dict.hpp"
#include "interruption.hpp"

namespace zlg::python {
namespace {

using namespace design;

IntervalMethod method_of(const std::string& name) {
    std::string allowed;
    for (const IntervalMethod method : interval_methods) {
        if (name == design::name(method)) return method;
        allowed += (allowed.empty() ? "" : ", ") + std::string{design::name(method)};
    }
    throw DesignError{"method = \"" + name + "\": allowed are " + allowed};
}

DriftCase case_of(const config::Config& config, double run_s) { return study::drift_case(config, run_s); }

py::array drift(const config::Config& config, double run_s, const In<double>& interval_s, const std::string& method) {
    const DriftCase task = case_of(config, run_s);
    const IntervalMethod which = method_of(method);
    return of_each([&](double interval) { return drift_arcsec_s(which, task, interval); }, interval_s);
}

py::tuple best(const config::Config& config, double run_s, const std::string& method) {
    const Optimum found = optimum(method_of(method), case_of(config, run_s));
    return py::make_tuple(found.interval_s, found.drift_arcsec_s, std::string{sentence(found.status)});
}

Substitution substitution_of(int order, int n, const std::tuple<int, int, int>& points, bool extrapolate,
                             double tick_s) {
    const auto [extrapolation, before, after] = points;
    return {.fit = extrapolate ? Fit::extrapolation : Fit::interpolation,
            .order = order,
            .n = n,
            .points = {extrapolation, before, after},
            .tick_s = tick_s};
}

py::array response(int order, int n, const std::tuple<int, int, int>& points, bool extrapolate, double tick_s,
                   const In<double>& frequency_hz) {
    const auto answer = ErrorResponse(substitution_of(order, n, points, extrapolate, tick_s));
    return of_each([&](double f) { return std::abs(answer(f)); }, frequency_hz);
}

py::dict relock(const config::Config& config, double miss_lambda, int ticks) {
    const RelockLoop loop{.tick_s = config.gyro.tick_s,
                          .tau_s = config.perimeter.tau_s,
                          .limit_lambda = config.perimeter.limit_lambda,
                          .rc_s = config.piezo.rc_s,
                          .slew_lambda_s = 0.5 * config.piezo.slew_v_s / config.piezo.half_wave_v};
    RelockTrace trace = simulate_relock(loop, miss_lambda, ticks);
    const BiasLaw law{config.gyro.scale_arcsec, config.gyro.bias_hz, config.gyro.bias_chi};
    py::dict d;
    d["false_drift_arcsec_s"] = as_array(false_drift_arcsec_s(law, trace, 1));
    d["step_s"] = trace.step_s;
    d["detuning_lambda"] = as_array(std::move(trace.detuning_lambda));
    return d;
}

py::dict of(const study::IntervalLine& line) {
    py::dict d = fields_dict(line.optimum);
    d["run_s"] = line.run_s;
    d["method"] = name(line.method);
    d["status"] = sentence(line.optimum.status);
    return d;
}

py::dict design_of(const config::Config& config) {
    study::DesignResult result;
    std::string html;
    {
        const py::gil_scoped_release released;
        result = study::design_gyro(config);
        html = report::html(study::design_page(config, result));
    }
    py::list intervals;
    for (const auto& line : result.intervals) intervals.append(of(line));
    py::dict best;
    for (const study::RunLine& line : result.runs) best[py::cast(line.run_s)] = line.best.interval_s;
    py::dict d = fields_dict(result.loop);
    d["phase_margin_deg"] = result.loop.margins.phase_margin_deg;
    d["gain_margin"] = result.loop.margins.gain_margin;
    d["stable"] = result.loop.margins.stable;
    d["switch_error_arcsec"] = result.switch_error_arcsec;
    d["best_interval_s"] = best;
    d["intervals"] = intervals;
    d["substitution"] = fields_list(result.substitution);
    d["page"] = html;
    return d;
}

// The answer as JSON, the configuration that it chooses, the page.
py::tuple choose_of(const std::string& text, const std::string& source_name, const std::vector<std::string>& sets,
                    int threads, const py::object& progress) {
    if (!(threads >= 1)) throw std::invalid_argument{"threads: allowed is 1 and more"};
    const choice::Requirement requirement = choice::parse_requirement(text, source_name, sets);
    Interruption interruption;
    choice::Task task{.requirement = requirement, .threads = threads, .on_progress = {}, .is_stopped = {}};
    task.is_stopped = std::ref(interruption);
    task.on_progress = [&](double fraction) {
        const py::gil_scoped_acquire interpreter;
        if (!progress.is_none()) progress(fraction);
    };
    const choice::Answer answer = without_interpreter([&] { return choice::choose(task); });
    interruption.raise();
    return py::make_tuple(choice::json_text(requirement, answer), choice::toml_text(requirement, answer),
                          report::html(choice::choice_page(requirement, answer)));
}

}  // namespace

void bind_design(py::module_& m) {
    m.def("drift_arcsec_s", &drift, "config"_a, "run_s"_a, "interval_s"_a, "method"_a);
    m.def("optimum", &best, "config"_a, "run_s"_a, "method"_a);
    m.def("substitution_response", &response, "order"_a, "gap_ticks"_a, "points"_a, "extrapolate"_a, "tick_s"_a,
          "frequency_hz"_a);
    m.def("relock", &relock, "config"_a, "miss_lambda"_a, "ticks"_a);
    m.def("choose", &choose_of, "text"_a, "source_name"_a, "sets"_a, "threads"_a, "progress"_a);
    m.def("design_gyro", &design_of, "config"_a);
}

}  // namespace zlg::python
