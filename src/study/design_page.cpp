#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include <zlg/design/substitution.hpp>
#include <zlg/report/number_text.hpp>
#include <zlg/study/design_study.hpp>
#include <zlg/study/how_made.hpp>

namespace zlg::study {
namespace {

using namespace report;

Figure budget_figure(const config::Config& config) {
    Figure f = report::blank_figure(
        "budget", "Drift against the interval between switches",
        "Long intervals let the magnetic drift pile up, short ones pay for many switches. Points: the optimum.",
        "interval, s", "drift, deg/h");
    f.log_x = true;
    Series best = blank_series("optimum", Mark::points);
    for (double run_s : config.design.run_lengths_s) {
        const design::DriftCase task = drift_case(config, run_s);
        const design::Optimum optimum = design::optimum(design::IntervalMethod::corrected, task);
        Series s = blank_series(fmt::format("run of {} s", short_number(run_s)));
        for (int k = -30; k <= 30; ++k) {
            const double interval_s = optimum.interval_s * std::pow(10.0, k / 30.0);
            if (interval_s > run_s) break;
            add_point(s, interval_s, design::drift_arcsec_s(design::IntervalMethod::corrected, task, interval_s));
        }
        f.series.push_back(std::move(s));
        add_point(best, optimum.interval_s, optimum.drift_arcsec_s);
    }
    f.series.push_back(std::move(best));
    return f;
}

report::Table interval_table(const DesignResult& result) {
    report::Table t{.caption = "Each method minimises its own budget, so compare intervals, not drifts.",
                    .header = {"run, s", "method", "interval, s", "drift, deg/h"}};
    for (const IntervalLine& l : result.intervals)
        t.rows.push_back(report::row(l.run_s, design::name(l.method), l.optimum.interval_s, l.optimum.drift_arcsec_s));
    return t;
}

std::string root_text(const design::Roots& roots) {
    return roots.status == design::RootStatus::found ? short_number(roots.smaller_s)
                                                     : std::string{design::sentence(roots.status)};
}

report::Table run_table(const DesignResult& result) {
    report::Table t{
        .caption =
            "The terms of the corrected budget at its best interval, and another policy: a first segment of half the "
            "length.",
        .header = {"run, s", "non-magnetic, deg/h", "quasi-non-magnetic", "sawtooth", "switches", "root of (9c), s",
                   "root of printed (9), s", "half first segment: interval, s", "drift, deg/h"}};
    for (const RunLine& r : result.runs)
        t.rows.push_back(report::row(r.run_s, r.terms.nonmagnetic_arcsec_s, r.terms.quasi_nonmagnetic_arcsec_s,
                                     r.terms.sawtooth_arcsec_s, r.terms.switch_errors_arcsec_s,
                                     root_text(r.corrected_roots), root_text(r.roots_as_printed),
                                     r.half_first_segment.interval_s, r.half_first_segment.drift_arcsec_s));
    return t;
}

report::Table substitution_table(const DesignResult& result) {
    report::Table t{
        .caption =
            "Final error of the gap's angle by the order of the polynomial: from the motion at the worst phase and "
            "over random phase, from rounding of the counter, from re-lock, and all together by eq (19) with the "
            "residual of re-lock that it omits.",
        .header = {"frequency, Hz", "gap, ticks", "order", "worst, arcsec", "rms, arcsec", "white noise gain",
                   "rounding, arcsec", "re-lock, arcsec", "together, arcsec"}};
    for (const SubstitutionLine& l : result.substitution)
        t.rows.push_back(report::row(std::isfinite(l.frequency_hz) ? short_number(l.frequency_hz) : "all", l.gap_ticks,
                                     l.order, l.worst_arcsec, l.rms_arcsec, l.noise_gain, l.counter_arcsec,
                                     l.relock_arcsec, l.total_arcsec));
    return t;
}

report::Table loop_table(const LoopLine& l) {
    return {.caption = "The perimeter loop.",
            .header = {"quantity", "value"},
            .rows = {
                {"phase margin", fmt::format("{} deg at {} rad/s", short_number(l.margins.phase_margin_deg),
                                             short_number(l.margins.crossover_rad_s))},
                {"gain margin", fmt::format("{} dB at {} rad/s", short_number(20.0 * std::log10(l.margins.gain_margin)),
                                            short_number(l.margins.limit_rad_s))},
                {"T/tau, and its limit of stability for " + l.stability_note,
                 fmt::format("{}, {}", short_number(l.tick_over_tau), short_number(l.stability_limit))},
                {fmt::format("re-lock to 0.01 wavelength from {}", short_number(l.relock_from_lambda)),
                 fmt::format("{} ms{}{}", short_number(1e3 * l.relock_s), l.relock_note.empty() ? "" : ", ",
                             l.relock_note)},
                {"false angle of that re-lock",
                 fmt::format("{} arcsec; by (T/4) G(0+) {} arcsec", short_number(l.false_angle_arcsec),
                             short_number(l.false_angle_law_arcsec))},
                {"capture range of the detector", fmt::format("{} wavelength", short_number(l.capture_lambda))}}};
}

report::Table miss_table(const LoopLine& l) {
    report::Table t{.caption = "What the miss at closing is made of.", .header = {"cause", "wavelengths"}};
    for (const design::MissPart& part : l.miss.part) t.rows.push_back(report::row(part.name, part.lambda));
    t.rows.push_back(report::row("root sum square", l.miss.root_sum_square_lambda));
    t.rows.push_back(report::row("all of one sign", l.miss.worst_lambda));
    return t;
}

Figure false_drift_figure(const LoopLine& l, double tick_s) {
    Figure f = report::blank_figure(
        "relock", "False drift after the loop is closed",
        "The reading of the ticks after a switch, by simulation of the loop from the configured miss, "
        "before correction.",
        "tick after closing", "false drift, deg/h");
    Series s = blank_series("simulated", Mark::points);
    for (std::size_t k = 0; k < l.false_drift_arcsec_s.size(); ++k)
        add_point(s, static_cast<double>(k + 1), l.false_drift_arcsec_s[k]);
    f.series = {std::move(s)};
    f.caption += fmt::format(" A tick is {} ms.", short_number(1e3 * tick_s));
    return f;
}

std::string best_list(const DesignResult& result) {
    std::string text;
    for (const RunLine& r : result.runs)
        text += fmt::format("{} {} s for a run of {} s", text.empty() ? "" : ",", short_number(r.best.interval_s),
                            short_number(r.run_s));
    return text;
}

std::string magnetic_note(const config::Config& config) {
    if (config.compensation.magnetic != core::MagneticMethod::estimate) return "";
    return " The whole magnetic drift is in these budgets: how much of it compensation.magnetic = \"estimate\" takes "
           "out is not foreseen.";
}

// Of the run that the configuration asks for, where it is among them; else of the longest.
std::string verdict(const config::Config& config, const DesignResult& result) {
    if (result.runs.empty()) return "";
    auto run = std::ranges::find(result.runs, config.run.duration_s.value_or(3600.0), &RunLine::run_s);
    if (run == result.runs.end()) run = std::ranges::max_element(result.runs, {}, &RunLine::run_s);
    const std::string presumed = short_number(config.design.switch_error_arcsec);
    std::string text = fmt::format(
        "Switch every {} s in a run of {} s: a switch of this gyro leaves {} arcsec rms, which makes a drift of {} "
        "deg/h",
        short_number(run->best.interval_s), short_number(run->run_s), short_number(result.switch_error_arcsec),
        short_number(run->best.drift_arcsec_s));
    const auto paper = std::ranges::find_if(result.intervals, [&](const IntervalLine& l) {
        return l.run_s == run->run_s && l.method == design::IntervalMethod::corrected;
    });
    if (paper != result.intervals.end())
        text += fmt::format("; the budget of the paper, with {} arcsec, asks for {} s", presumed,
                            short_number(paper->optimum.interval_s));
    return text + (result.loop.margins.stable ? "." : "; the perimeter loop is unstable.");
}

}  // namespace

report::Page design_page(const config::Config& config, const DesignResult& result) {
    report::Page page{
        .title = "Design of a Zeeman laser gyro with mode switching",
        .lead =
            "Interval between switches, substitution of the blind ticks and perimeter loop, from the configuration "
            "of one gyro."};
    page.verdict = verdict(config, result);
    page.sections.push_back(
        {.heading = "Interval",
         .paragraphs =
             {"corrected: run mean of the thermal term and the sawtooth of the cold gyro. worst_case: exact, "
              "at the worst switch. as_printed: the paper's formula with its mistake. closed_form: no thermal change.",
              fmt::format("The tables take design.switch_error_arcsec = {} for the error of a switch. Of this gyro it "
                          "is {} arcsec rms, {}. The least drift with independent errors of that size:{}.{}",
                          short_number(config.design.switch_error_arcsec), short_number(result.switch_error_arcsec),
                          result.switch_error_source, best_list(result), magnetic_note(config))},
         .tables = {interval_table(result), run_table(result)},
         .figures = {budget_figure(config)}});
    page.sections.push_back(
        {.heading = "Substitution",
         .paragraphs = {"Orders 0 and 1, and orders 2 and 3, give the same angle of the gap when the points lie "
                        "symmetrically. Re-lock: uncorrected its whole false angle, else the light noise of a "
                        "mean-square correction, in the angle itself and through the points after the gap."},
         .tables = {substitution_table(result)}});
    page.sections.push_back({.heading = "Perimeter loop",
                             .tables = {loop_table(result.loop), miss_table(result.loop)},
                             .figures = {false_drift_figure(result.loop, config.gyro.tick_s)}});
    page.sections.push_back(how_made("design", config));
    return page;
}

}  // namespace zlg::study
