// The tables of a campaign as Markdown.

#include <algorithm>
#include <array>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <zlg/report/number_text.hpp>

#include "parts.hpp"

namespace zlg::trials {
namespace {

struct Group {
    CaseGroup group;
    const char* heading;
    const char* caption;
};

constexpr std::array<Group, 7> groups{{
    {CaseGroup::paper, "(a) The paper's case",
     "A sine of 12 000 \"/s at 20.06 Hz, gaps of 3 ticks, a miss of 0.22 wavelength that the loop removes with a "
     "constant slew and an exponential tail, 16 light samples a half with noise of 0.0033 wavelength."},
    {CaseGroup::grid, "(b) Frequency, amplitude, gap, light and miss", "The paper's case with one thing changed."},
    {CaseGroup::broadband, "(c) Random vibration",
     "Gaussian motion with a flat spectrum between the frequencies named."},
    {CaseGroup::non_stationary, "(d) Coning and shock",
     "Motion that is not stationary: its amplitude rises and falls, or it consists of shocks."},
    {CaseGroup::loops, "(f) Loops",
     "The paper's case with other ways in which the detuning decays, and with a bias scale that is not as presumed."},
    {CaseGroup::warm_up, "(g) Warm-up", "The paper's case with a magnetic drift of 0.7 \"/s that grows by A."},
    {CaseGroup::rest, "(h) Rest",
     "A constant rate of up to 15 \"/s. Roundings repeat here, so the bound for independent ones does not hold."},
}};

constexpr std::array<Group, 4> gap_groups{{
    {CaseGroup::gap_lengths, "(j) Gaps of 1 to 10 ticks",
     "Switches come 3 to 3.4 s apart; the tones have 12 000 \"/s each."},
    {CaseGroup::first_gap, "(k) The first gap",
     "The first gap of a log, at a random tick of those named. Tones of 12 000 \"/s. By phase the ellipse of the "
     "photodiodes is not known at the start."},
    {CaseGroup::phase, "(m) The phase of the fringe",
     "Photodiodes with offsets of 10 %, amplitudes that differ by 10 %, 5 degrees of angle, 1 % of noise and 12 bits; "
     "the core learns and corrects their ellipse. Without a random walk, but for the case that names one. Switches "
     "come 5 to 5.6 s apart. The bound takes only the noise of the photodiodes in place of the rounding."},
    {CaseGroup::lit, "(n) Lit halves of a gap",
     "The last three of the six halves of a gap have counts and light, at the full miss. Switches come 5 to 5.6 s "
     "apart."},
}};

constexpr const char* manoeuvre_caption =
    "A gyro whose motion was even until then meets a gap and, at the same time, a manoeuvre that it has never "
    "seen: its rate changes within the duration named, from a beginning within eight ticks before the gap, in it, "
    "or within eight ticks after it, or it has changed within the eight ticks before. Gaps of 3 ticks, a miss of 0.22 "
    "wavelength.";

constexpr const char* change_caption =
    "Until the opening of the gap the motion is even, from there on it is another one, with a phase of its own. 10 Hz "
    "and 20 Hz are sines of 12 000 \"/s. Gaps of 3 ticks, a miss of 0.22 wavelength.";

using report::fixed_number;

using Row = std::vector<std::string>;

std::string row_text(const Row& cells) { return fmt::format("| {} |\n", fmt::join(cells, " | ")); }

// Nothing where there are no rows.
std::string section(const std::string& heading, const std::string& caption, const Row& header,
                    const std::vector<Row>& rows) {
    if (rows.empty()) return "";
    std::string text = fmt::format("## {}\n\n{}\n\n{}|", heading, caption, row_text(header));
    for (std::size_t k = 0; k < header.size(); ++k) text += "---|";
    text += "\n";
    for (const Row& row : rows) text += row_text(row);
    return text + "\n";
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
std::string summary_table(const Accuracy& accuracy, const Group& group) {
    std::vector<Row> rows;
    for (const CaseFigures& c : accuracy.cases) {
        const MethodFigures* automatic = find_method(c.methods, method_name::automatic);
        if (c.group != group.group || automatic == nullptr) continue;
        Row row{c.name, bound_text(c, c.bound.ticks_arcsec), bound_text(c, c.bound.halves_arcsec)};
        for (const char* name :
             {method_name::constant, method_name::quadratic, method_name::automatic_ticks, method_name::automatic}) {
            const MethodFigures* m = find_method(c.methods, name);
            row.push_back(m == nullptr ? "-" : fixed_number(m->whole.rms_arcsec, 2));
        }
        const ErrorFigures& f = automatic->whole;
        row.insert(row.end(), {ratio_text(f.rms_arcsec, c.bound.halves_arcsec), fixed_number(f.worst_arcsec, 1),
                               bias_text(f, 2), fixed_number(f.nev, 2), within_text(f)});
        rows.push_back(std::move(row));
    }
    return section(group.heading, group.caption,
                   {"case", "bound, ticks, \"", "bound, halves, \"", "constant, \"", "quadratic, \"", "ticks, auto, \"",
                    "auto, \"", "auto/bound", "worst, \"", "bias, \"", "NEV", "within 3 sigma, %"},
                   rows);
}

std::string case_table(const Accuracy& accuracy, const Group& group) {
    std::vector<Row> rows;
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
                   rows);
}

std::string recording_table(const RecordingFigures& r) {
    std::vector<Row> rows;
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
                   rows);
}

std::string light_table(const Accuracy& accuracy) {
    std::vector<Row> rows;
    for (const RelockFigures& f : accuracy.relock)
        rows.push_back({f.name, fixed_number(f.bound_arcsec, 2), bias_text(f.error, 3),
                        fixed_number(f.error.sd_arcsec, 3), ratio_text(f.error.sd_arcsec, f.bound_arcsec),
                        report::short_number(f.error.nev)});
    return section("False angle by the light alone",
                   "The free-form decay of the detuning that `joint` makes from the light samples, x1 counts, 16 "
                   "samples a half: its false angle of the first eight ticks less the true one.",
                   {"loop", "bound, \"", "bias, \"", "sd, \"", "sd/bound", "NEV"}, rows);
}

std::string manoeuvre_table(const std::vector<ManoeuvreFigures>& figures, const char* heading, const char* caption) {
    std::vector<Row> rows;
    std::string last;
    for (const ManoeuvreFigures& f : figures) {
        const ErrorFigures& ours = find_method(f.methods, method_name::automatic)->whole;
        Row row{once(f.base != last, f.base), f.manoeuvre.empty() ? "none" : f.manoeuvre};
        last = f.base;
        for (const char* name : {method_name::constant, method_name::linear, method_name::quadratic})
            row.push_back(fixed_number(find_method(f.methods, name)->whole.rms_arcsec, 2));
        row.insert(row.end(), {fixed_number(ours.rms_arcsec, 2), fixed_number(over_best_polynomial(f), 2),
                               nev_text(ours), within_text(ours)});
        rows.push_back(std::move(row));
    }
    return section(heading, caption,
                   {"motion before", "manoeuvre", "constant, \"", "linear, \"", "quadratic, \"", "auto, \"",
                    "auto/best polynomial", "NEV", "within 3 sigma, %"},
                   rows);
}

std::string gap_length_table(const Accuracy& accuracy) {
    std::vector<Row> rows;
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
        rows);
}

const char* name_of(Verdict verdict) {
    return verdict == Verdict::met ? "yes" : verdict == Verdict::missed ? "NO" : "within chance";
}

std::string criteria_table(const Accuracy& accuracy) {
    const auto n_of = [&](Verdict verdict) {
        return std::ranges::count(accuracy.criteria, verdict, &Criterion::verdict);
    };
    std::vector<Row> rows;
    for (const Criterion& c : accuracy.criteria) rows.push_back({c.table, c.wanted, c.got, name_of(c.verdict)});
    return section(
        "Wanted and got",
        fmt::format("Of {} limits {} are met, {} are missed, and {} are exceeded by less than two standard "
                    "errors (\"within chance\").",
                    accuracy.criteria.size(), n_of(Verdict::met), n_of(Verdict::missed), n_of(Verdict::within_chance)),
        {"table", "wanted", "got", "met"}, rows);
}

}  // namespace

std::string markdown(const Accuracy& accuracy) {
    std::string text = criteria_table(accuracy);
    for (const Group& group : groups) {
        text += summary_table(accuracy, group);
        if (group.group != CaseGroup::non_stationary) continue;
        for (const RecordingFigures& r : accuracy.recordings) text += recording_table(r);
    }
    text += case_table(accuracy, groups.front());
    text += light_table(accuracy);
    text += manoeuvre_table(accuracy.manoeuvres, "(i) First manoeuvres", manoeuvre_caption);
    for (const Group& group : gap_groups) {
        text += summary_table(accuracy, group);
        if (group.group == CaseGroup::first_gap)
            text += manoeuvre_table(accuracy.changes, "(l) Another motion from the gap on", change_caption);
    }
    return text + gap_length_table(accuracy);
}

}  // namespace zlg::trials
