// Tables 1 and 2: false drift after re-lock as printed, on the twin, and on loops fitted to the measured drift.

#include <algorithm>
#include <numeric>

#include <zlg/design/relock_tables.hpp>
#include <zlg/report/number_text.hpp>

#include "paper_parts.hpp"

namespace zlg::paper {
namespace {

using design::Decay;
using design::TickDrifts;
using report::Series;

constexpr Decay decays[] = {Decay::exponential, Decay::slew, Decay::slew_tail, Decay::critical};
using Correction = TickDrifts (*)(const design::RelockModel&);

double angle_arcsec(const TickDrifts& drift) {
    return design::table_tick_s * std::accumulate(drift.begin(), drift.end(), 0.0);
}

TickDrifts minus(const TickDrifts& a, const TickDrifts& b) {
    TickDrifts d{};
    std::transform(a.begin(), a.end(), b.begin(), d.begin(), std::minus<>{});
    return d;
}

std::vector<std::string> cells(std::string name, const TickDrifts& drift) {
    std::vector<std::string> row{std::move(name)};
    for (const double x : drift) row.push_back(report::fixed_number(x, 0));
    return row;
}

// As many ticks of the twin as the tables have, if the run holds that many.
std::vector<double> twin_drift(const study::RunResult& run) {
    const auto n = std::min<std::size_t>(design::table_ticks, run.relock_false_drift_deg_h.size());
    return {run.relock_false_drift_deg_h.begin(),
            run.relock_false_drift_deg_h.begin() + static_cast<std::ptrdiff_t>(n)};
}

// --- the table as printed, with the twin beside it -------------------------------------------------------------------

struct PrintedTable {
    int number = 0;
    TickDrifts computed_deg_h{};
    const char* mean_measured = "";  // the sums as printed
    const char* mean_left = "";
    const char* angle_measured = "";
    const char* angle_left = "";
    const char* rest_measured = "";  // without tick 1
    const char* rest_left = "";
};

constexpr PrintedTable printed_1{1, design::table1_computed_arcsec_s, "2131", "1362", "43", "27", "22", "7"};
constexpr PrintedTable printed_2{2, design::table2_computed_arcsec_s, "2131", "166", "43", "3.3", "", ""};

std::string beside(const std::string& ours, const char* printed) {
    return *printed == '\0' ? ours : fmt::format("{} (printed {})", ours, printed);
}

report::Table printed_table(const PrintedTable& printed, const study::RunResult& run) {
    const auto raw = design::summarise(design::measured_arcsec_s, {});
    const auto left = design::summarise(design::measured_arcsec_s, printed.computed_deg_h);
    const std::vector<double> twin = twin_drift(run);
    const bool whole = twin.size() == design::table_ticks;
    const double twin_sum = std::accumulate(twin.begin(), twin.end(), 0.0);
    report::Table table{
        .caption = fmt::format("Table {} of the paper: false drift after re-lock, deg/h. The sums are "
                               "recomputed from the four rows. Twin: its true false drift, averaged over "
                               "the switches of a run.",
                               printed.number),
        .header = {"tick", "measured", "computed", "left", "twin"},
        .rows = {}};
    for (std::size_t i = 0; i < design::table_ticks; ++i) {
        const bool corrected = i > 0 || printed.number == 2;
        table.rows.push_back({fmt::format("{}", i + 1), report::fixed_number(design::measured_arcsec_s[i], 0),
                              corrected ? report::fixed_number(printed.computed_deg_h[i], 0) : "not corrected",
                              report::fixed_number(left.residual_arcsec_s[i], 0),
                              i < twin.size() ? report::fixed_number(twin[i], 0) : "-"});
    }
    const auto sums = [&](const char* name, const std::string& measured, const std::string& residual, double of_twin,
                          int decimals) {
        table.rows.push_back({name, measured, "", residual, whole ? report::fixed_number(of_twin, decimals) : "-"});
    };
    sums("mean", beside(report::fixed_number(raw.mean_arcsec_s, 2), printed.mean_measured),
         beside(report::fixed_number(left.mean_arcsec_s, 2), printed.mean_left), twin_sum / design::table_ticks, 2);
    sums("angle of four ticks, arcsec", beside(report::fixed_number(raw.angle_arcsec, 2), printed.angle_measured),
         beside(report::fixed_number(left.angle_arcsec, 2), printed.angle_left), design::table_tick_s * twin_sum, 2);
    sums("angle without tick 1, arcsec",
         beside(report::fixed_number(raw.angle_without_first_arcsec, 2), printed.rest_measured),
         beside(report::fixed_number(left.angle_without_first_arcsec, 2), printed.rest_left),
         whole ? design::table_tick_s * (twin_sum - twin[0]) : 0.0, 2);
    return table;
}

// --- loops fitted to the measured drift ------------------------------------------------------------------------------

report::Table model_table(const char* equation, Correction correction) {
    report::Table table{
        .caption = fmt::format("Loops fitted to the measured drift, and what {} computes from their own "
                               "signals, deg/h; by (11) tick 1 is corrected with the q of tick 2.",
                               equation),
        .header = {"loop", "tick 1", "tick 2", "tick 3", "tick 4", "angle, arcsec"},
        .rows = {}};
    for (const Decay decay : decays) {
        const design::RelockFit fit = design::fit_relock(decay, design::measured_arcsec_s);
        const TickDrifts corrected = correction(fit.model);
        const TickDrifts left = minus(fit.drift_arcsec_s, corrected);
        const auto add = [&](const std::string& name, const TickDrifts& drift, int decimals) {
            table.rows.push_back(cells(name, drift));
            table.rows.back().push_back(report::fixed_number(angle_arcsec(drift), decimals));
        };
        add(fmt::format("{}: false drift", fit.name), fit.drift_arcsec_s, 1);
        add(fmt::format("by {}", equation), corrected, 1);
        add("left", left, 2);
    }
    return table;
}

std::string list_of_fits() {
    std::string text;
    for (const Decay decay : decays) {
        const design::RelockFit fit = design::fit_relock(decay, design::measured_arcsec_s);
        text += fmt::format("{}{} {:.0f}", text.empty() ? "" : ", ", fit.name, fit.rms_arcsec_s);
    }
    return text;
}

Series ticks_series(std::string name, const double* begin, std::size_t n, report::Mark mark) {
    Series s{.name = std::move(name), .x = {}, .y = {}, .y_error = {}, .mark = mark};
    for (std::size_t i = 0; i < n; ++i) {
        s.x.push_back(static_cast<double>(i + 1));
        s.y.push_back(begin[i]);
    }
    return s;
}

Series ticks_series(std::string name, const TickDrifts& drift, report::Mark mark) {
    return ticks_series(std::move(name), drift.data(), drift.size(), mark);
}

report::Figure decay_figure(const study::RunResult& run) {
    report::Figure figure{.id = "table-1-decay",
                          .title = "False drift after re-lock",
                          .caption =
                              "Points: measured in the paper, and the twin. Lines: loops of four kinds, each with "
                              "its constants by least squares; they join the means over ticks.",
                          .x_label = "tick after the loop is closed",
                          .y_label = "false drift, deg/h",
                          .series = {ticks_series("measured", design::measured_arcsec_s, report::Mark::points)},
                          .bands = {}};
    for (const Decay decay : decays) {
        const design::RelockFit fit = design::fit_relock(decay, design::measured_arcsec_s);
        figure.series.push_back(ticks_series(std::string{fit.name}, fit.drift_arcsec_s, report::Mark::line));
    }
    const std::vector<double> twin = twin_drift(run);
    figure.series.push_back(ticks_series("twin", twin.data(), twin.size(), report::Mark::points));
    return figure;
}

report::Figure residual_figure() {
    const design::RelockFit fit = design::fit_relock(Decay::slew_tail, design::measured_arcsec_s);
    TickDrifts by_frequency = design::corrected_by_frequency_arcsec_s(fit.model);
    by_frequency[0] = 0.0;  // as the paper has it
    const auto left = [&](const TickDrifts& corrected) { return minus(fit.drift_arcsec_s, corrected); };
    const auto printed = [](const TickDrifts& computed) {
        return design::summarise(design::measured_arcsec_s, computed).residual_arcsec_s;
    };
    using enum report::Mark;
    return {.id = "table-2-left",
            .title = "What the corrections leave",
            .caption =
                "Points: the last columns of both tables in print. Lines: the same formulas on the fitted loop that "
                "slews with an exponential tail. Tick 1 of the correction by frequency is left as it is.",
            .x_label = "tick after the loop is closed",
            .y_label = "drift left, deg/h",
            .series = {ticks_series("table 1, by frequency", printed(design::table1_computed_arcsec_s), points),
                       ticks_series("table 2, by detuning", printed(design::table2_computed_arcsec_s), points),
                       ticks_series("(11) on the fitted loop", left(by_frequency), line),
                       ticks_series("(13) on the fitted loop", left(design::corrected_by_detuning_arcsec_s(fit.model)),
                                    line)},
            .bands = {}};
}

std::string per_switch(const study::RunResult& run, const std::string& name) {
    for (const study::VariantResult& v : run.variants)
        if (v.name == name && v.switch_error)
            return fmt::format(
                " In the run of the twin this correction leaves {} arcsec per switch in the mean, the gap's "
                "own error included.",
                report::fixed_number(v.switch_error->mean_arcsec, 1));
    return "";
}

std::string sum_of_twin(const study::RunResult& run) {
    const std::vector<double> twin = twin_drift(run);
    if (twin.size() < design::table_ticks) return "";
    return fmt::format(" The four ticks of the twin make {:.1f} arcsec, those of the table {:.1f}.",
                       design::table_tick_s * std::accumulate(twin.begin(), twin.end(), 0.0),
                       angle_arcsec(design::measured_arcsec_s));
}

std::vector<std::string> text_of_table_1(const study::RunResult& run) {
    const auto tau = design::local_time_constants_s(design::measured_arcsec_s);
    const auto fit = design::fit_relock(Decay::slew_tail, design::measured_arcsec_s);
    const TickDrifts left = minus(fit.drift_arcsec_s, design::corrected_by_frequency_arcsec_s(fit.model));
    const auto printed = design::summarise(design::measured_arcsec_s, design::table1_computed_arcsec_s);
    return {
        fmt::format(
            "Agrees: the arithmetic of the table, but for a mean of {} that is printed as 1362. A loop that slews "
            "and ends in an exponential tail not only has the measured drift, it also fails under (11) as the "
            "table does: by {:.0f}, {:.0f} and {:.0f} deg/h on ticks 2 to 4, where the table leaves {:.0f}, {:.0f} "
            "and {:.0f}.",
            report::fixed_number(printed.mean_arcsec_s, 2), left[1], left[2], left[3], printed.residual_arcsec_s[1],
            printed.residual_arcsec_s[2], printed.residual_arcsec_s[3]) +
            sum_of_twin(run),
        fmt::format(
            "Does not: the exponential of (10). From tick to tick its time constant would have to be {:.1f}, {:.1f} "
            "and {:.1f} ms. Rms difference of the fits from the measured drift, deg/h: {}.",
            1e3 * tau[0], 1e3 * tau[1], 1e3 * tau[2], list_of_fits()),
        fmt::format(
            "Nor need tick 1 be given up: as soon as tick 2 is measured, its q corrects tick 1 as well. On that "
            "loop what is left falls from {:.1f} to {:.1f} arcsec.",
            angle_arcsec({fit.drift_arcsec_s[0], left[1], left[2], left[3]}), angle_arcsec(left)) +
            per_switch(run, "relock_frequency")};
}

std::vector<std::string> text_of_table_2(const study::RunResult& run) {
    const auto fit = design::fit_relock(Decay::slew_tail, design::measured_arcsec_s);
    const TickDrifts left = minus(fit.drift_arcsec_s, design::corrected_by_detuning_arcsec_s(fit.model));
    const auto printed = design::summarise(design::measured_arcsec_s, design::table2_computed_arcsec_s);
    return {
        fmt::format("Agrees: the arithmetic, and that the detuning corrects better than the frequency. The reason is "
                    "less that it can begin with tick 1 than that each tick brings its own ratio of halves: (13) "
                    "hardly notices that the loop is no exponential, and leaves {:.2f} arcsec on the fitted one.",
                    angle_arcsec(left)) +
            per_switch(run, "relock_detuning"),
        fmt::format("Does not: the {:.1f} arcsec in print flatter the method, for residuals of both signs cancel in "
                    "the sum. Their rms is {:.0f} deg/h, far above what the shape of the loop explains; the cause is "
                    "not told.",
                    printed.angle_arcsec, printed.rms_arcsec_s)};
}

}  // namespace

PaperItem paper_table_1(const PaperTask&, const study::RunResult& run) {
    return {.number = "table 1",
            .section = {
                .heading = "Table 1: false drift after re-lock, corrected by the bias frequency",
                .paragraphs = text_of_table_1(run),
                .tables = {printed_table(printed_1, run), model_table("(11)", design::corrected_by_frequency_arcsec_s)},
                .figures = {decay_figure(run)}}};
}

PaperItem paper_table_2(const PaperTask&, const study::RunResult& run) {
    return {.number = "table 2",
            .section = {
                .heading = "Table 2: false drift after re-lock, corrected by the detuning",
                .paragraphs = text_of_table_2(run),
                .tables = {printed_table(printed_2, run), model_table("(13)", design::corrected_by_detuning_arcsec_s)},
                .figures = {residual_figure()}}};
}

}  // namespace zlg::paper
