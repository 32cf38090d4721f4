// Figures 4 and 5: drift against the interval between switches, and the best interval.

#include <algorithm>
#include <cmath>
#include <limits>

#include <zlg/design/interval_formula.hpp>
#include <zlg/design/switching_interval.hpp>

#include "paper_curves.hpp"
#include "paper_parts.hpp"
#include "paper_readings.hpp"
#include "paper_text.hpp"

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
            all.push_back(curve({sentence("{} s, {}", run_s, name), -1, method == IntervalMethod::as_printed},
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
    report::Table table{
        .caption =
            "Least drift, and the interval between switches at which it is reached. A is the "
            "change of the magnetic drift by a full warm-up.",
        .header = {"A, deg/h", "run, s", "interval by (7), s", "drift, deg/h", "interval by (7c), s", "drift, deg/h"}};
    for (const auto& reading : {study::drift_case, drift_case_per_degree})
        for (const double run_s : runs_s) {
            const DriftCase task = reading(config, run_s);
            const auto printed = design::optimum(IntervalMethod::as_printed, task);
            const auto corrected = design::optimum(IntervalMethod::corrected, task);
            table.rows.push_back({sentence("{}", task.gyro.magnetic_thermal_arcsec_s), sentence("{}", run_s),
                                  sentence("{:.1f}", printed.interval_s), sentence("{:.3f}", printed.drift_arcsec_s),
                                  sentence("{:.1f}", corrected.interval_s),
                                  sentence("{:.3f}", corrected.drift_arcsec_s)});
        }
    return table;
}

std::string figure_4_agreement(const config::Config& config, double shortest_s, double longest_s) {
    const auto first = design::optimum(IntervalMethod::corrected, study::drift_case(config, shortest_s));
    const auto last = design::optimum(IntervalMethod::corrected, study::drift_case(config, longest_s));
    return sentence(
        "Agrees: each curve has one minimum between too many switches and too long a sawtooth, and with the length of "
        "the run it falls and moves to longer intervals, from {:.3f} deg/h at {:.1f} s to {:.3f} deg/h at {:.1f} s. "
        "Runs much shorter than the thermal time hardly show which formula is right.",
        first.drift_arcsec_s, first.interval_s, last.drift_arcsec_s, last.interval_s);
}

std::string figure_4_disagreement(const config::Config& config, double longest_s) {
    const DriftCase task = study::drift_case(config, longest_s);
    const auto right = design::optimum(IntervalMethod::corrected, task);
    const auto printed = design::optimum(IntervalMethod::as_printed, task);
    return sentence(
        "Does not: (7) charges the whole run with the thermal change of its first two segments. In {} s its minimum "
        "is {:.3f} deg/h at {:.1f} s, the right one {:.3f} deg/h at {:.1f} s; and however long the run, (7) stays "
        "about "
        "{:.3f} deg/h above the non-magnetic drift to which the text and (7c) let it fall.",
        longest_s, printed.drift_arcsec_s, printed.interval_s, right.drift_arcsec_s, right.interval_s,
        printed_floor_arcsec_s(task));
}

std::string readings(const config::Config& config, double shortest_s, double longest_s) {
    const auto interval_s = [&](double run_s) {
        return design::optimum(IntervalMethod::as_printed, drift_case_per_degree(config, run_s)).interval_s;
    };
    return sentence(
        "Reading: the print lists the thermal part of the magnetic drift as {} deg/h and the warming as {} C, and "
        "multiplies the two in (5). Here {} deg/h is taken for their product. Taken per degree, A is {} deg/h, and "
        "even "
        "(7) has its minima at {:.1f} s in {} s and {:.1f} s in {} s, which is not the figure 5 that rises with the "
        "run.",
        config.drift.magnetic_thermal_arcsec_s, config.gyro.temperature_rise_c, config.drift.magnetic_thermal_arcsec_s,
        drift_case_per_degree(config, longest_s).gyro.magnetic_thermal_arcsec_s, interval_s(shortest_s), shortest_s,
        interval_s(longest_s), longest_s);
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
    report::Table table{.caption = "Best interval between switches, s.", .header = {"run, s"}};
    for (const IntervalLaw& law : interval_laws) table.header.emplace_back(law.name);
    for (const double run_s : runs_s) {
        std::vector<std::string> row{sentence("{}", run_s)};
        for (const IntervalLaw& law : interval_laws)
            row.push_back(sentence("{:.1f}", law.interval_s(study::drift_case(config, run_s))));
        table.rows.push_back(std::move(row));
    }
    return table;
}

std::string end_of_roots(const DriftCase& task) {
    const double longest_s = design::longest_run_as_printed_s(task.gyro, task.switch_error_arcsec);
    if (!std::isfinite(longest_s)) return "";
    return sentence(", and for runs above {} s it has no positive root at all", longest_s);
}

std::vector<std::string> figure_5_text(const config::Config& config, double shortest_s, double longest_s) {
    const auto at = [&](std::size_t law, double run_s) {
        return interval_laws[law].interval_s(study::drift_case(config, run_s));
    };
    return {
        sentence("Agrees: the best interval grows with the run, and in the shortest one all laws give nearly the same, "
                 "{:.1f} s by (7c) and {:.1f} s by the square root in {} s.",
                 at(0, shortest_s), at(4, shortest_s), shortest_s),
        sentence("Does not: (9) lacks a factor t on its right side, without which its units do not agree, and has the "
                 "thermal term with the wrong sign: a warm-up makes its interval longer{}. With the right sign, (9c), "
                 "it follows (7), mistake included: {:.1f} s in {} s, where the least drift is at {:.1f} s.",
                 end_of_roots(study::drift_case(config, longest_s)), at(2, longest_s), longest_s, at(0, longest_s))};
}

}  // namespace

PaperItem paper_figure_4(const PaperTask& task) {
    const config::Config& config = task.config;
    const std::vector<double> runs_s = sorted_runs_s(config);
    PaperItem item{.number = "figure 4",
                   .section = {.heading = "Figure 4: drift against the interval between switches"}};
    if (runs_s.empty()) return item;
    item.section.paragraphs = {figure_4_agreement(config, runs_s.front(), runs_s.back()),
                               figure_4_disagreement(config, runs_s.back()),
                               readings(config, runs_s.front(), runs_s.back())};
    item.section.tables = {optimum_table(config, runs_s)};
    item.section.figures = {{.id = "figure-4",
                             .title = "Drift against the interval between switches, figure 4 of the paper",
                             .caption =
                                 "Full lines: corrected formula. Dashed: as printed, the same colour for the same "
                                 "length of run. Points: the least drift of each curve.",
                             .x_label = "interval between switches, s",
                             .y_label = "drift, deg/h",
                             .series = drift_curves(config, runs_s),
                             .log_x = true}};
    return item;
}

PaperItem paper_figure_5(const PaperTask& task) {
    const config::Config& config = task.config;
    const std::vector<double> runs_s = sorted_runs_s(config);
    PaperItem item{.number = "figure 5", .section = {.heading = "Figure 5: best interval against length of run"}};
    if (runs_s.empty()) return item;
    item.section.paragraphs = figure_5_text(config, runs_s.front(), runs_s.back());
    item.section.tables = {interval_table(config, runs_s)};
    item.section.figures = {{.id = "figure-5",
                             .title = "Best interval between switches, figure 5 of the paper",
                             .caption =
                                 "Minima of the drift budgets, and the formulas that the paper derives for them. A "
                                 "line ends where its law has no answer.",
                             .x_label = "length of the run, s",
                             .y_label = "interval, s",
                             .series = interval_curves(config, runs_s),
                             .log_x = true,
                             .log_y = true}};
    return item;
}

}  // namespace zlg::paper
