#include <algorithm>

#include <fmt/format.h>

#include <zlg/report/number_text.hpp>

#include "case_groups.hpp"
#include "parts.hpp"

namespace zlg::trials {
namespace {

using report::fixed_number;
using Rows = std::vector<std::vector<std::string>>;

report::Section section(std::string heading, std::string caption, std::vector<std::string> header, Rows rows = {}) {
    report::Section s;
    s.heading = std::move(heading);
    s.tables.push_back({.caption = std::move(caption), .header = std::move(header), .rows = std::move(rows)});
    return s;
}

std::string ratio_text(double value, double over) { return over > 0.0 ? fixed_number(value / over, 2) : "-"; }

std::string bound_text(const CaseFigures& c, double bound_arcsec) {
    return c.bound.halves_arcsec > 0.0 ? fixed_number(bound_arcsec, 2) : "-";
}

std::string bias_text(const ErrorFigures& f, int decimals) {
    return fmt::format("{} +- {}", fixed_number(f.bias_arcsec, decimals), fixed_number(f.standard_error, decimals));
}

std::string nev_text(const ErrorFigures& f) { return f.claimed > 0 ? report::short_number(f.nev) : "-"; }

std::string within_text(const ErrorFigures& f) {
    return f.claimed > 0 ? fixed_number(100.0 * f.within_3_sigma_ratio, 1) : "-";
}

// What stands in the first of several rows only.
std::string once(bool first, std::string text) { return first ? std::move(text) : ""; }

// One line for each case: what is possible, the paper's methods, ours, and what the default claims.
report::Section summary_table(const Accuracy& accuracy, const Group& group) {
    report::Section s =
        section(group.heading, group.caption,
                {"case", "bound, ticks, \"", "bound, halves, \"", "constant, \"", "quadratic, \"", "ticks, auto, \"",
                 "auto, \"", "auto/bound", "worst, \"", "bias, \"", "NEV", "within 3 sigma, %"});
    for (const CaseFigures& c : accuracy.cases) {
        const MethodFigures* automatic = find_method(c.methods, method_name::automatic);
        if (c.group != group.group || automatic == nullptr) continue;
        std::vector<std::string> row{c.name, bound_text(c, c.bound.ticks_arcsec), bound_text(c, c.bound.halves_arcsec)};
        for (const char* name :
             {method_name::constant, method_name::quadratic, method_name::automatic_ticks, method_name::automatic}) {
            const MethodFigures* m = find_method(c.methods, name);
            row.push_back(m == nullptr ? "-" : fixed_number(m->whole.rms_arcsec, 2));
        }
        const ErrorFigures& f = automatic->whole;
        row.insert(row.end(), {ratio_text(f.rms_arcsec, c.bound.halves_arcsec), fixed_number(f.worst_arcsec, 1),
                               bias_text(f, 2), fixed_number(f.nev, 2), within_text(f)});
        s.tables[0].rows.push_back(std::move(row));
    }
    return s;
}

report::Section case_table(const Accuracy& accuracy, const Group& group) {
    Rows rows;
    for (const CaseFigures& c : accuracy.cases) {
        if (c.group != group.group) continue;
        for (const MethodFigures& m : c.methods) {
            const bool first = &m == &c.methods.front();
            const ErrorFigures& f = m.whole;
            rows.push_back({once(first, c.name), once(first, bound_text(c, c.bound.ticks_arcsec)),
                            once(first, bound_text(c, c.bound.halves_arcsec)), m.method, fixed_number(f.rms_arcsec, 2),
                            fixed_number(f.worst_arcsec, 2), bias_text(f, 2),
                            ratio_text(f.rms_arcsec, c.bound.halves_arcsec), nev_text(f), within_text(f)});
        }
    }
    return section(fmt::format("{}: every method", group.heading), group.caption,
                   {"case", "bound, ticks, \"", "bound, halves, \"", "method", "rms, \"", "worst, \"", "bias, \"",
                    "rms/bound", "NEV", "within 3 sigma, %"},
                   std::move(rows));
}

report::Section recording_table(const RecordingFigures& r) {
    Rows rows;
    for (const AxisFigures& a : r.axes) {
        for (const MethodFigures& m : a.methods) {
            const bool first = &m == &a.methods.front();
            const ErrorFigures& f = m.whole;
            rows.push_back({once(first, fmt::format("{}", a.column)), once(first, fixed_number(a.fit_rms_arcsec, 4)),
                            m.method, fixed_number(f.rms_arcsec, 4), fixed_number(f.worst_arcsec, 3),
                            ratio_text(f.rms_arcsec, a.fit_rms_arcsec), nev_text(f), within_text(f)});
        }
    }
    return section(fmt::format("(e) Real motion: {}", r.name),
                   "Gaps made in a recording; no re-lock. The fit has the 8 + 8 weights that are best on "
                   "average over the whole recording, known only afterwards.",
                   {"column", "fit, \"", "method", "rms, \"", "worst, \"", "rms/fit", "NEV", "within 3 sigma, %"},
                   std::move(rows));
}

report::Section light_table(const Accuracy& accuracy) {
    Rows rows;
    for (const RelockFigures& f : accuracy.relock)
        rows.push_back({f.name, fixed_number(f.bound_arcsec, 2), bias_text(f.error, 3),
                        fixed_number(f.error.sd_arcsec, 3), ratio_text(f.error.sd_arcsec, f.bound_arcsec),
                        report::short_number(f.error.nev)});
    return section("False angle by the light alone",
                   "The free-form decay of the detuning that `joint` makes from the light samples, x1 counts, 16 "
                   "samples a half: its false angle of the first eight ticks less the true one.",
                   {"loop", "bound, \"", "bias, \"", "sd, \"", "sd/bound", "NEV"}, std::move(rows));
}

bool corrects_relock(const MethodFigures& m) {
    return m.method != method_name::uncorrected && m.method != method_name::linear && m.method != method_name::constant;
}

report::Section relock_table(const Accuracy& accuracy) {
    Rows rows;
    for (const CaseFigures& c : accuracy.cases) {
        if (c.group != CaseGroup::paper && c.group != CaseGroup::loops) continue;
        bool first = true;
        for (const MethodFigures& m : c.methods) {
            if (!corrects_relock(m)) continue;
            rows.push_back({once(first, c.name), once(first, fixed_number(c.bound.relock_arcsec, 2)), m.method,
                            bias_text(m.relock, 2), fixed_number(m.relock.sd_arcsec, 2),
                            ratio_text(m.relock.sd_arcsec, c.bound.relock_arcsec)});
            first = false;
        }
    }
    return section("False angle after re-lock",
                   "What a method subtracts less what was false. The bound is that of the light alone: a "
                   "cubic spline with knots half a tick apart. A method that weighs the counts too may be below it.",
                   {"case", "bound of the light, \"", "method", "bias, \"", "sd, \"", "sd/bound"}, std::move(rows));
}

report::Section drift_table(const Accuracy& accuracy) {
    report::Section s = section("Drift",
                                "Delivered less true angle over time, rms over runs of the paper's case with x1 "
                                "counts, a magnetic drift of 0.7 \"/s that grows by A, and a first segment of half "
                                "length. There is no non-magnetic drift and no random walk in it.",
                                {"case", "method", "runs"});
    report::Table& t = s.tables[0];
    for (double run_s : accuracy_run_lengths_s) t.header.push_back(fmt::format("{:.0f} s, \"/s", run_s));
    std::string last;
    for (const SwitchingDrift& d : accuracy.drift) {
        std::vector<std::string> row{once(d.name != last, d.name), d.method, fmt::format("{}", d.runs)};
        last = d.name;
        for (std::size_t k = 0; k < accuracy_run_lengths_s.size(); ++k)
            row.push_back(k < d.rms_arcsec_s.size() ? fixed_number(d.rms_arcsec_s[k], 5) : "-");
        t.rows.push_back(std::move(row));
    }
    return s;
}

report::Section long_run_table(const Accuracy& accuracy) {
    report::Section s = section("Long runs in closed loop",
                                "The twin under the core's control, sine of 12 000 \"/s at 20.06 Hz, x1 counts, miss "
                                "of 0.22 "
                                "wavelength, magnetic drift of 0.7 \"/s that grows by 0.7 \"/s. Drift in excess of the "
                                "non-magnetic one, rms over runs; a random walk of 0.14 \"/sqrt(s) is in it.",
                                {"switching", "compensation", "switches"});
    report::Table& t = s.tables[0];
    for (const DriftAtTime& at : accuracy.long_runs.front().at)
        t.header.push_back(fmt::format("{:.0f} s, \"/s", at.time_s));
    for (const DriftFigures& d : accuracy.long_runs) {
        std::vector<std::string> row{d.gyro, d.method, fixed_number(d.switches, 0)};
        for (const DriftAtTime& at : d.at) row.push_back(fixed_number(at.rms_arcsec_s, 5));
        t.rows.push_back(std::move(row));
    }
    return s;
}

report::Section manoeuvre_table(const std::vector<ManoeuvreFigures>& figures, std::string heading,
                                std::string caption) {
    Rows rows;
    std::string last;
    for (const ManoeuvreFigures& f : figures) {
        const ErrorFigures& ours = find_method(f.methods, method_name::automatic)->whole;
        std::vector<std::string> row{once(f.base != last, f.base), f.manoeuvre.empty() ? "none" : f.manoeuvre};
        last = f.base;
        for (const char* name : {method_name::constant, method_name::linear, method_name::quadratic})
            row.push_back(fixed_number(find_method(f.methods, name)->whole.rms_arcsec, 2));
        row.insert(row.end(), {fixed_number(ours.rms_arcsec, 2), fixed_number(over_best_polynomial(f), 2),
                               nev_text(ours), within_text(ours)});
        rows.push_back(std::move(row));
    }
    return section(std::move(heading), std::move(caption),
                   {"motion before", "manoeuvre", "constant, \"", "linear, \"", "quadratic, \"", "auto, \"",
                    "auto/best polynomial", "NEV", "within 3 sigma, %"},
                   std::move(rows));
}

report::Section gap_length_table(const Accuracy& accuracy) {
    Rows rows;
    for (const GapLengthFigures& f : accuracy.gap_lengths)
        rows.push_back({f.recording, fmt::format("{}", f.column), fmt::format("{}", f.gap_ticks),
                        fmt::format("{}", f.n), fixed_number(f.best_arcsec, 3), fixed_number(f.rms_arcsec, 3),
                        ratio_text(f.rms_arcsec, f.best_arcsec), ratio_text(f.usual_rms_arcsec, f.usual_best_arcsec),
                        fixed_number(f.nev, 2)});
    return section(
        "(o) Real motion: gaps of 1 to 10 ticks",
        "As (e). The best polynomial is that with the least error in all gaps of a row of the table; without "
        "the worst 1 % are the gaps but for those in which `auto` errs most.",
        {"recording", "column", "ticks", "gaps", "best polynomial, \"", "auto, \"", "auto/best",
         "auto/best without the worst 1 %", "NEV"},
        std::move(rows));
}

const char* name_of(Verdict verdict) {
    return verdict == Verdict::met ? "yes" : verdict == Verdict::missed ? "NO" : "within chance";
}

report::Section criteria_table(const Accuracy& accuracy) {
    const auto n_of = [&](Verdict verdict) {
        return std::ranges::count(accuracy.criteria, verdict, &Criterion::verdict);
    };
    Rows rows;
    for (const Criterion& c : accuracy.criteria) rows.push_back({c.table, c.wanted, c.got, name_of(c.verdict)});
    return section(
        "Wanted and got",
        fmt::format("Of {} limits {} are met, {} are missed, and {} are exceeded by less than two standard "
                    "errors (\"within chance\").",
                    accuracy.criteria.size(), n_of(Verdict::met), n_of(Verdict::missed), n_of(Verdict::within_chance)),
        {"table", "wanted", "got", "met"}, std::move(rows));
}

void add_filled(std::vector<report::Section>& sections, report::Section section) {
    if (!section.tables[0].rows.empty()) sections.push_back(std::move(section));
}

}  // namespace

std::vector<report::Section> tables_of(const Accuracy& accuracy) {
    std::vector<report::Section> tables{criteria_table(accuracy)};
    for (const Group& group : groups) {
        add_filled(tables, summary_table(accuracy, group));
        if (group.group != CaseGroup::non_stationary) continue;
        for (const RecordingFigures& r : accuracy.recordings) tables.push_back(recording_table(r));
    }
    tables.push_back(case_table(accuracy, groups.front()));
    tables.push_back(light_table(accuracy));
    add_filled(tables, manoeuvre_table(accuracy.manoeuvres, "(i) First manoeuvres", manoeuvre_caption));
    for (const Group& group : gap_groups) {
        add_filled(tables, summary_table(accuracy, group));
        if (group.group == CaseGroup::first_gap)
            add_filled(tables, manoeuvre_table(accuracy.changes, "(l) Another motion from the gap on", change_caption));
    }
    add_filled(tables, gap_length_table(accuracy));
    tables.push_back(drift_table(accuracy));
    if (!accuracy.long_runs.empty()) tables.push_back(long_run_table(accuracy));
    return tables;
}

std::vector<report::Section> detailed_tables_of(const Accuracy& accuracy) {
    std::vector<report::Section> tables;
    for (std::size_t k = 1; k < groups.size(); ++k) add_filled(tables, case_table(accuracy, groups[k]));
    tables.push_back(relock_table(accuracy));
    return tables;
}

}  // namespace zlg::trials
