#include "accuracy_tables.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include <zlg/report/number_text.hpp>

#include "accuracy_parts.hpp"

namespace zlg::trials {
namespace {

struct Group {
    char letter;
    const char* heading;
    const char* words;
};

constexpr std::array<Group, 7> groups{{
    {'a', "(a) The paper's case",
     "A sine of 12 000 \"/s at 20.06 Hz, gaps of 3 ticks, a miss of 0.22 wavelength that the loop removes with a "
     "constant slew "
     "and an exponential tail, 16 light samples a half with noise of 0.0033 wavelength."},
    {'b', "(b) Frequency, amplitude, gap, light and miss", "The paper's case with one thing changed."},
    {'c', "(c) Random vibration", "Gaussian motion with a flat spectrum between the frequencies named."},
    {'d', "(d) Coning and shock", "Motion that is not stationary: it waxes and wanes, or comes in blows."},
    {'f', "(f) Loops",
     "The paper's case with other ways in which the detuning decays, and with a bias scale that is not as presumed."},
    {'g', "(g) Warm-up", "The paper's case with a magnetic drift of 0.7 \"/s that grows by A."},
    {'h', "(h) Rest",
     "A constant rate of up to 15 \"/s. Roundings repeat here, so the bound for independent ones does not hold."},
}};

std::string ratio_text(double value, double over) { return over > 0.0 ? report::fixed_number(value / over, 2) : "-"; }

std::vector<std::string> case_row(const CaseFigures& c, const MethodFigures& m, bool first) {
    const ErrorFigures& f = m.whole;
    const bool bounded = c.bound.halves > 0.0;
    const auto bound = [&](double x) {
        return first && bounded ? report::fixed_number(x, 2) : std::string{first ? "-" : ""};
    };
    return {first ? c.name : "",
            bound(c.bound.ticks),
            bound(c.bound.halves),
            m.method,
            report::fixed_number(f.rms_arcsec, 2),
            report::fixed_number(f.worst_arcsec, 2),
            fmt::format("{} +- {}", report::fixed_number(f.bias_arcsec, 2), report::fixed_number(f.standard_error, 2)),
            ratio_text(f.rms_arcsec, c.bound.halves),
            f.claimed > 0 ? report::short_number(f.nev) : "-",
            f.claimed > 0 ? report::fixed_number(100.0 * f.within_3_sigma_ratio, 1) : "-"};
}

// One line for each case: what is possible, the paper's methods, ours, and what the default claims.
TableOfAccuracy summary_table(const Accuracy& accuracy, const Group& group) {
    TableOfAccuracy t{.heading = group.heading, .words = group.words, .table = {}};
    t.table.header = {"case",
                      "bound, ticks, \"",
                      "bound, halves, \"",
                      "constant, \"",
                      "quadratic, \"",
                      "ticks, auto, \"",
                      "optimal, \"",
                      "auto, \"",
                      "auto/bound",
                      "worst, \"",
                      "bias, \"",
                      "NEV",
                      "within 3 sigma, %"};
    for (const CaseFigures& c : accuracy.cases) {
        const MethodFigures* automatic = find_method(c.methods, method_name::automatic);
        if (c.group != group.letter || automatic == nullptr) continue;
        const bool bounded = c.bound.halves > 0.0;
        std::vector<std::string> row{c.name, bounded ? report::fixed_number(c.bound.ticks, 2) : "-",
                                     bounded ? report::fixed_number(c.bound.halves, 2) : "-"};
        for (const char* name : {method_name::constant, method_name::quadratic, method_name::automatic_ticks,
                                 method_name::optimal, method_name::automatic}) {
            const MethodFigures* m = find_method(c.methods, name);
            row.push_back(m == nullptr ? "-" : report::fixed_number(m->whole.rms_arcsec, 2));
        }
        const ErrorFigures& f = automatic->whole;
        row.insert(
            row.end(),
            {ratio_text(f.rms_arcsec, c.bound.halves), report::fixed_number(f.worst_arcsec, 1),
             fmt::format("{} +- {}", report::fixed_number(f.bias_arcsec, 2), report::fixed_number(f.standard_error, 2)),
             report::fixed_number(f.nev, 2), report::fixed_number(100.0 * f.within_3_sigma_ratio, 1)});
        t.table.rows.push_back(std::move(row));
    }
    return t;
}

TableOfAccuracy case_table(const Accuracy& accuracy, const Group& group) {
    TableOfAccuracy t{.heading = fmt::format("{}: every method", group.heading), .words = group.words, .table = {}};
    t.table.header = {"case",      "bound, ticks, \"", "bound, halves, \"", "method", "rms, \"",
                      "worst, \"", "bias, \"",         "rms/bound",         "NEV",    "within 3 sigma, %"};
    for (const CaseFigures& c : accuracy.cases) {
        if (c.group != group.letter) continue;
        bool first = true;
        for (const MethodFigures& m : c.methods) {
            t.table.rows.push_back(case_row(c, m, first));
            first = false;
        }
    }
    return t;
}

TableOfAccuracy recording_table(const RecordingFigures& r) {
    TableOfAccuracy t{.heading = fmt::format("(e) Real motion: {}", r.name),
                      .words =
                          "Gaps made in a recording; no re-lock. The fit has the 8 + 8 weights that are best on "
                          "average over the whole recording, known only afterwards.",
                      .table = {}};
    t.table.header = {"column", "fit, \"", "method", "rms, \"", "worst, \"", "rms/fit", "NEV", "within 3 sigma, %"};
    for (const AxisFigures& a : r.axes) {
        bool first = true;
        for (const MethodFigures& m : a.methods) {
            const ErrorFigures& f = m.whole;
            t.table.rows.push_back(
                {first ? fmt::format("{}", a.column) : "", first ? report::fixed_number(a.fit_rms_arcsec, 4) : "",
                 m.method, report::fixed_number(f.rms_arcsec, 4), report::fixed_number(f.worst_arcsec, 3),
                 ratio_text(f.rms_arcsec, a.fit_rms_arcsec), f.claimed > 0 ? report::short_number(f.nev) : "-",
                 f.claimed > 0 ? report::fixed_number(100.0 * f.within_3_sigma_ratio, 1) : "-"});
            first = false;
        }
    }
    return t;
}

TableOfAccuracy light_table(const Accuracy& accuracy) {
    TableOfAccuracy t{
        .heading = "False angle by the light alone",
        .words =
            "The free-form course of the detuning that `joint` makes from the light samples, x1 counts, 16 "
            "samples a half: its false angle of the first eight ticks less the true one.",
        .table = {}};
    t.table.header = {"loop", "bound, \"", "bias, \"", "sd, \"", "sd/bound", "NEV"};
    for (const RelockFigures& f : accuracy.relock)
        t.table.rows.push_back({f.name, report::fixed_number(f.bound_arcsec, 2),
                                fmt::format("{} +- {}", report::fixed_number(f.error.bias_arcsec, 3),
                                            report::fixed_number(f.error.standard_error, 3)),
                                report::fixed_number(f.error.sd_arcsec, 3),
                                ratio_text(f.error.sd_arcsec, f.bound_arcsec), report::short_number(f.error.nev)});
    return t;
}

TableOfAccuracy relock_table(const Accuracy& accuracy) {
    TableOfAccuracy t{
        .heading = "False angle after re-lock",
        .words =
            "What a method subtracts less what was false. The bound is that of the light alone: a "
            "cubic spline with knots half a tick apart. A method that weighs the counts too may be below it.",
        .table = {}};
    t.table.header = {"case", "bound of the light, \"", "method", "bias, \"", "sd, \"", "sd/bound"};
    for (const CaseFigures& c : accuracy.cases) {
        if (c.group != 'a' && c.group != 'f') continue;
        bool first = true;
        for (const MethodFigures& m : c.methods) {
            if (m.method == method_name::uncorrected || m.method == method_name::linear ||
                m.method == method_name::constant)
                continue;
            t.table.rows.push_back({first ? c.name : "", first ? report::fixed_number(c.bound.relock, 2) : "", m.method,
                                    fmt::format("{} +- {}", report::fixed_number(m.relock.bias_arcsec, 2),
                                                report::fixed_number(m.relock.standard_error, 2)),
                                    report::fixed_number(m.relock.sd_arcsec, 2),
                                    ratio_text(m.relock.sd_arcsec, c.bound.relock)});
            first = false;
        }
    }
    return t;
}

TableOfAccuracy drift_table(const Accuracy& accuracy) {
    TableOfAccuracy t{
        .heading = "Drift",
        .words =
            "Delivered less true angle over time, rms over runs of the paper's case with x1 counts, a magnetic "
            "drift of 0.7 \"/s that grows by A, and a first segment of half length. There is no "
            "non-magnetic drift and no random walk in it.",
        .table = {}};
    t.table.header = {"case", "method", "runs"};
    for (double s : accuracy_run_lengths_s) t.table.header.push_back(fmt::format("{:.0f} s, \"/s", s));
    std::string last;
    for (const SwitchingDrift& d : accuracy.drift) {
        std::vector<std::string> row{d.name == last ? "" : d.name, d.method, fmt::format("{}", d.runs)};
        last = d.name;
        for (std::size_t k = 0; k < accuracy_run_lengths_s.size(); ++k)
            row.push_back(k < d.rms_arcsec_s.size() ? report::fixed_number(d.rms_arcsec_s[k], 5) : "-");
        t.table.rows.push_back(std::move(row));
    }
    return t;
}

TableOfAccuracy long_run_table(const Accuracy& accuracy) {
    TableOfAccuracy t{.heading = "Long runs in closed loop",
                      .words =
                          "The twin under the core's control, sine of 12 000 \"/s at 20.06 Hz, x1 counts, miss of 0.22 "
                          "wavelength, magnetic drift of 0.7 \"/s that grows by 0.7 \"/s. Drift in excess of the "
                          "non-magnetic one, rms over runs; a random walk of 0.14 \"/sqrt(s) is in it.",
                      .table = {}};
    t.table.header = {"switching", "compensation", "switches"};
    if (accuracy.long_runs.empty()) return t;
    for (const DriftAtTime& at : accuracy.long_runs.front().at)
        t.table.header.push_back(fmt::format("{:.0f} s, \"/s", at.time_s));
    for (const DriftFigures& d : accuracy.long_runs) {
        std::vector<std::string> row{d.gyro, d.method, report::fixed_number(d.switches, 0)};
        for (const DriftAtTime& at : d.at) row.push_back(report::fixed_number(at.rms_arcsec_s, 5));
        t.table.rows.push_back(std::move(row));
    }
    return t;
}

const char* name_of(Verdict verdict) {
    return verdict == Verdict::met ? "yes" : verdict == Verdict::missed ? "NO" : "within chance";
}

TableOfAccuracy criteria_table(const Accuracy& accuracy) {
    const auto n_of = [&](Verdict verdict) {
        return std::ranges::count(accuracy.criteria, verdict, &Criterion::verdict);
    };
    TableOfAccuracy t{
        .heading = "Wanted and got",
        .words = fmt::format(
            "Of {} limits {} are met, {} are missed, and {} are exceeded by less than two standard errors "
            "(\"within chance\").",
            accuracy.criteria.size(), n_of(Verdict::met), n_of(Verdict::missed), n_of(Verdict::within_chance)),
        .table = {}};
    t.table.header = {"number", "wanted", "got", "met"};
    t.table.prose = true;
    for (const Criterion& c : accuracy.criteria)
        t.table.rows.push_back({c.number, c.wanted, c.got, name_of(c.verdict)});
    return t;
}

}  // namespace

std::vector<TableOfAccuracy> tables_of(const Accuracy& accuracy) {
    std::vector<TableOfAccuracy> tables{criteria_table(accuracy)};
    for (const Group& group : groups) {
        tables.push_back(summary_table(accuracy, group));
        if (tables.back().table.rows.empty()) tables.pop_back();
        if (group.letter != 'd') continue;
        for (const RecordingFigures& r : accuracy.recordings) tables.push_back(recording_table(r));
    }
    tables.push_back(case_table(accuracy, groups.front()));
    tables.push_back(light_table(accuracy));
    tables.push_back(drift_table(accuracy));
    if (!accuracy.long_runs.empty()) tables.push_back(long_run_table(accuracy));
    return tables;
}

std::vector<TableOfAccuracy> detailed_tables_of(const Accuracy& accuracy) {
    std::vector<TableOfAccuracy> tables;
    for (const Group& group : groups) {
        if (group.letter == groups.front().letter) continue;
        tables.push_back(case_table(accuracy, group));
        if (tables.back().table.rows.empty()) tables.pop_back();
    }
    tables.push_back(relock_table(accuracy));
    return tables;
}

}  // namespace zlg::trials
