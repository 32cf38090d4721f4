// Figures 4 and 5: drift against the interval between switches, and the best interval.

#include <algorithm>
#include <cmath>
#include <limits>

#include <zlg/design/interval_formula.hpp>
#include <zlg/design/switching_interval.hpp>
#include <zlg/report/number_text.hpp>

#include "paper_curves.hpp"
#include "paper_parts.hpp"
#include "paper_trial.hpp"
#include "paper_words.hpp"

namespace zlg::paper {
namespace {

using namespace design;
using report::Series;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

// The colours of a figure come round after so many series; curves of the same run get the same one.
constexpr std::size_t n_colours = 7;

std::vector<double> sorted_runs_s(const config::Config& config) {
    std::vector<double> runs = config.design.run_lengths_s;
    std::sort(runs.begin(), runs.end());
    return runs;
}

// --- figure 4 --------------------------------------------------------------------------------------------------------

struct Range {
    double from_s = 0.0;
    double to_s = 0.0;
};

// A decade to either side of the optima.
Range interval_range(const config::Config& config, const std::vector<double>& runs_s) {
    double least = std::numeric_limits<double>::infinity();
    double greatest = 0.0;
    for (const double run_s : runs_s) {
        const double best_s = design::optimum(IntervalMethod::corrected, study::drift_case(config, run_s)).interval_s;
        least = std::min(least, best_s);
        greatest = std::max(greatest, best_s);
    }
    return {0.1 * least, 10.0 * greatest};
}

std::vector<Series> drift_curves(const config::Config& config, const std::vector<double>& runs_s) {
    const Range range = interval_range(config, runs_s);
    std::vector<Series> all;
    const auto add = [&](IntervalMethod method, const char* name) {
        for (const double run_s : runs_s)
            all.push_back(curve({filled("{} s, {}", {run_s, name}), -1, method == IntervalMethod::as_printed},
                                log_spaced(range.from_s, std::min(run_s, range.to_s), 160), [&](double interval_s) {
                                    return design::drift_arcsec_s(method, study::drift_case(config, run_s), interval_s);
                                }));
    };
    add(IntervalMethod::corrected, "corrected (7c)");
    // A series without a name and without points uses up a colour and shows nowhere.
    while (all.size() % n_colours != 0) all.emplace_back();
    add(IntervalMethod::as_printed, "as printed (7)");
    Series best{.name = "least drift", .mark = report::Mark::points};
    for (const IntervalMethod method : {IntervalMethod::corrected, IntervalMethod::as_printed})
        for (const double run_s : runs_s) {
            const design::Optimum optimum = design::optimum(method, study::drift_case(config, run_s));
            if (optimum.interval_s > range.to_s) continue;
            report::add_point(best, optimum.interval_s, optimum.drift_arcsec_s);
        }
    all.push_back(std::move(best));
    return all;
}

report::Table optimum_table(const config::Config& config, const std::vector<double>& runs_s) {
    std::vector<std::vector<std::string>> rows;
    for (const auto& reading : {study::drift_case, drift_case_per_degree})
        for (const double run_s : runs_s) {
            const DriftCase task = reading(config, run_s);
            rows.push_back({report::short_number(task.gyro.magnetic_thermal_arcsec_s), report::short_number(run_s)});
            for (const IntervalMethod method : {IntervalMethod::as_printed, IntervalMethod::corrected}) {
                const Optimum best = design::optimum(method, task);
                rows.back().push_back(report::fixed_number(best.interval_s, 1));
                rows.back().push_back(report::fixed_number(best.drift_arcsec_s, 3));
            }
        }
    return table_of("figure 4.table", std::move(rows));
}

Values figure_4_numbers(const config::Config& config, double shortest_s, double longest_s) {
    const DriftCase task = study::drift_case(config, longest_s);
    const auto first = design::optimum(IntervalMethod::corrected, study::drift_case(config, shortest_s));
    const auto last = design::optimum(IntervalMethod::corrected, task);
    const auto printed = design::optimum(IntervalMethod::as_printed, task);
    const auto interval_s = [&](double run_s) {
        return design::optimum(IntervalMethod::as_printed, drift_case_per_degree(config, run_s)).interval_s;
    };
    return {first.drift_arcsec_s, first.interval_s, last.drift_arcsec_s, last.interval_s,
            // does not:
            longest_s, printed.drift_arcsec_s, printed.interval_s, last.drift_arcsec_s, last.interval_s,
            printed_floor_arcsec_s(task),
            // reading:
            config.drift.magnetic_thermal_arcsec_s, config.gyro.temperature_rise_c,
            config.drift.magnetic_thermal_arcsec_s,
            drift_case_per_degree(config, longest_s).gyro.magnetic_thermal_arcsec_s, interval_s(shortest_s), shortest_s,
            interval_s(longest_s), longest_s};
}

// --- figure 5 --------------------------------------------------------------------------------------------------------

struct IntervalLaw {
    const char* name;
    double (*interval_s)(const DriftCase&);  // NaN where the law gives none
    bool dashed = false;
};

double inside(IntervalMethod method, const DriftCase& task) {
    const design::Optimum best = design::optimum(method, task);
    return best.status == design::OptimumStatus::inside ? best.interval_s : nan;
}

double smaller(const design::Roots& roots) { return roots.status == design::RootStatus::found ? roots.smaller_s : nan; }

double closed_form(const DriftCase& task) {
    const double interval_s = design::closed_form_interval_s(task);
    return interval_s <= task.run_s ? interval_s : nan;
}

constexpr IntervalLaw interval_laws[] = {
    {"least of (7c)", [](const DriftCase& task) { return inside(IntervalMethod::corrected, task); }},
    {"least of (7) as printed", [](const DriftCase& task) { return inside(IntervalMethod::as_printed, task); }, true},
    {"root of (9c)", [](const DriftCase& task) { return smaller(design::corrected_roots(task)); }},
    {"root of (9) as printed, with its t",
     [](const DriftCase& task) { return smaller(design::roots_as_printed(task)); }, true},
    {"sqrt(dP t/Om)", closed_form},
};

// The run lengths of the configuration are among the points.
std::vector<double> times_s(const std::vector<double>& runs_s) {
    std::vector<double> times = log_spaced(0.1 * runs_s.front(), 3.0 * runs_s.back(), 150);
    times.insert(times.end(), runs_s.begin(), runs_s.end());
    std::sort(times.begin(), times.end());
    return times;
}

std::vector<Series> interval_curves(const config::Config& config, const std::vector<double>& runs_s) {
    std::vector<Series> all;
    for (const IntervalLaw& law : interval_laws)
        all.push_back(curve({law.name, -1, law.dashed}, times_s(runs_s),
                            [&](double run_s) { return law.interval_s(study::drift_case(config, run_s)); }));
    return all;
}

report::Table interval_table(const config::Config& config, const std::vector<double>& runs_s) {
    report::Table table = table_of("figure 5.table", {});
    for (const IntervalLaw& law : interval_laws) table.header.emplace_back(law.name);
    for (const double run_s : runs_s) {
        table.rows.push_back({report::short_number(run_s)});
        for (const IntervalLaw& law : interval_laws)
            table.rows.back().push_back(report::fixed_number(law.interval_s(study::drift_case(config, run_s)), 1));
    }
    return table;
}

std::string end_of_roots(const DriftCase& task) {
    const double longest_s = design::longest_run_as_printed_s(task.gyro, task.switch_error_arcsec);
    if (!std::isfinite(longest_s)) return "";
    return filled(", and for runs above {} s it has no positive root at all", {longest_s});
}

Values figure_5_numbers(const config::Config& config, double shortest_s, double longest_s) {
    const auto at = [&](std::size_t law, double run_s) {
        return interval_laws[law].interval_s(study::drift_case(config, run_s));
    };
    return {at(0, shortest_s), at(4, shortest_s), shortest_s,      end_of_roots(study::drift_case(config, longest_s)),
            at(2, longest_s),  longest_s,         at(0, longest_s)};
}

}  // namespace

PaperItem paper_figure_4(const PaperTask& task) {
    const config::Config& config = task.config;
    const std::vector<double> runs_s = sorted_runs_s(config);
    return item_of("figure 4", figure_4_numbers(config, runs_s.front(), runs_s.back()), {optimum_table(config, runs_s)},
                   {worded({.id = "figure-4", .series = drift_curves(config, runs_s), .log_x = true})});
}

PaperItem paper_figure_5(const PaperTask& task) {
    const config::Config& config = task.config;
    const std::vector<double> runs_s = sorted_runs_s(config);
    return item_of(
        "figure 5", figure_5_numbers(config, runs_s.front(), runs_s.back()), {interval_table(config, runs_s)},
        {worded({.id = "figure-5", .series = interval_curves(config, runs_s), .log_x = true, .log_y = true})});
}

}  // namespace zlg::paper
