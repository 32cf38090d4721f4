// Figure 3: the angle error of the twin, and what its sawtooth measures.

#include <algorithm>
#include <cmath>

#include <zlg/design/drift_budget.hpp>
#include <zlg/design/magnetic_angle.hpp>
#include <zlg/report/number_text.hpp>
#include <zlg/study/design_study.hpp>
#include <zlg/study/run_page.hpp>

#include "paper_curves.hpp"
#include "paper_parts.hpp"
#include "paper_words.hpp"

namespace zlg::paper {
namespace {

using report::Series;

// Between two switches. `clean_s` is where the re-lock is over and only drift is left.
struct Segment {
    double from_s = 0.0;
    double clean_s = 0.0;
    double to_s = 0.0;
    int mode = 1;
};

std::vector<Segment> segments_of(const PaperTask& task, const study::RunResult& run) {
    Segment next{.mode = run.switches.empty() ? 1 : -run.switches.front().mode};
    std::vector<Segment> all;
    for (const study::SwitchLine& line : run.switches) {
        next.to_s = static_cast<double>(line.tick) * run.tick_s;
        all.push_back(next);
        const auto ticks = line.gap_ticks + task.config.compensation.relock_ticks + 1;
        next = {.from_s = next.to_s, .clean_s = next.to_s + static_cast<double>(ticks) * run.tick_s, .mode = line.mode};
    }
    next.to_s = static_cast<double>(run.ticks) * run.tick_s;
    all.push_back(next);
    return all;
}

// The rate of a segment, all of it and of the magnetic drift alone, with the sign of the mode undone.
struct Rates {
    double measured_arcsec_s = 0.0;
    double computed_arcsec_s = 0.0;
    int mode = 1;
};

// An even number of them, so that modes are equally many.
std::vector<Rates> rates_of(const std::vector<Segment>& segments, const study::Curve& curve,
                            const design::GyroDrift& gyro) {
    std::vector<Rates> all;
    std::size_t k = 0;
    for (const Segment& s : segments) {
        study::Drift fit;
        int n = 0;
        for (; k < curve.t_s.size() && curve.t_s[k] < s.to_s; ++k)
            if (curve.t_s[k] > s.clean_s) fit.add(curve.t_s[k], curve.error_arcsec[k]), ++n;
        if (n < 3) continue;
        const double magnetic = design::magnetic_integral_arcsec(gyro, s.clean_s, s.to_s) / (s.to_s - s.clean_s);
        all.push_back({fit.slope_arcsec_s(), gyro.nonmagnetic_arcsec_s + s.mode * magnetic, s.mode});
    }
    if (all.size() % 2 == 1) all.pop_back();
    return all;
}

// What a sawtooth shows: its slope, and the rate of its flanks against that slope.
struct Sawtooth {
    double slope_arcsec_s = 0.0;
    double first_arcsec_s = 0.0;
    double last_arcsec_s = 0.0;
    double mean_arcsec_s = 0.0;
};

Sawtooth sawtooth(const std::vector<Rates>& rates, double Rates::*of) {
    const auto n = static_cast<double>(rates.size());
    Sawtooth s;
    for (const Rates& r : rates) {
        s.slope_arcsec_s += r.*of / n;
        s.mean_arcsec_s += r.mode * (r.*of) / n;
    }
    s.first_arcsec_s = rates.front().mode * (rates.front().*of - s.slope_arcsec_s);
    s.last_arcsec_s = rates.back().mode * (rates.back().*of - s.slope_arcsec_s);
    return s;
}

double interval_s(const PaperTask& task, const study::RunResult& run) {
    if (run.switches.size() < 2) return task.config.switching.interval_s;
    return static_cast<double>(run.switches[1].tick - run.switches[0].tick) * run.tick_s;
}

Series computed_curve(const study::Curve& angle, const std::vector<Segment>& segments, const design::GyroDrift& gyro) {
    double before = 0.0;
    std::size_t k = 0;
    return curve({"computed", -1, true}, angle.t_s, [&](double t) {
        for (; k + 1 < segments.size() && segments[k].to_s <= t; ++k)
            before += segments[k].mode * design::magnetic_integral_arcsec(gyro, segments[k].from_s, segments[k].to_s);
        return gyro.nonmagnetic_arcsec_s * t + before +
               segments[k].mode * design::magnetic_integral_arcsec(gyro, segments[k].from_s, t);
    });
}

report::Table sawtooth_table(const Sawtooth& measured, const Sawtooth& computed, double interval) {
    const auto row = [](const char* name, double a, double b, int decimals) {
        return std::vector{std::string{name}, report::fixed_number(a, decimals), report::fixed_number(b, decimals)};
    };
    return table_of("figure 3.table",
                    {row("amplitude, first segment, arcsec", interval * measured.first_arcsec_s,
                         interval * computed.first_arcsec_s, 1),
                     row("amplitude, last segment, arcsec", interval * measured.last_arcsec_s,
                         interval * computed.last_arcsec_s, 1),
                     row("amplitude, mean of the run, arcsec", interval * measured.mean_arcsec_s,
                         interval * computed.mean_arcsec_s, 1),
                     row("slope between switches, deg/h", measured.slope_arcsec_s, computed.slope_arcsec_s, 4)},
                    {interval});
}

std::vector<std::string> sawtooth_text(const PaperTask& task, const study::RunResult& run,
                                       const study::VariantResult& switched, const Sawtooth& measured,
                                       const Sawtooth& computed, double interval) {
    constexpr double tolerance = 0.05;
    const double miss = std::abs(measured.mean_arcsec_s - computed.mean_arcsec_s);
    const bool agree = miss <= tolerance * std::abs(computed.mean_arcsec_s);
    const double run_s = static_cast<double>(run.ticks) * run.tick_s;
    const double bound = design::drift_bound_arcsec_s(study::drift_case(task.config, run_s), std::min(interval, run_s));
    return words("figure 3.sawtooth",
                 {agree ? "Agrees" : "Does not agree", interval * measured.mean_arcsec_s,
                  interval * computed.mean_arcsec_s, measured.slope_arcsec_s, computed.slope_arcsec_s,
                  interval * computed.first_arcsec_s, interval * computed.last_arcsec_s, switched.angle_error_arcsec,
                  std::abs(switched.angle_error_arcsec) / run_s, task.config.design.switch_error_arcsec, bound});
}

report::Figure sawtooth_figure(const PaperTask& task, const study::RunResult& run) {
    report::Figure figure = worded({.id = "figure-3"});
    const auto* switched = run.variant("configured");
    if (switched == nullptr) return figure;
    const design::GyroDrift gyro = study::drift_case(task.config, 1.0).gyro;
    figure.series = {study::curve_of(*switched, "twin"), computed_curve(switched->curve, segments_of(task, run), gyro),
                     curve({"non-magnetic drift", -1, true}, switched->curve.t_s,
                           [&](double t_s) { return gyro.nonmagnetic_arcsec_s * t_s; })};
    return figure;
}

// What the sawtooth of the run has to say, where there is one.
void add_sawtooth(const PaperTask& task, const study::RunResult& run, report::Section& section) {
    const auto* switched = run.variant("configured");
    if (switched == nullptr) return;
    const std::vector<Rates> rates =
        rates_of(segments_of(task, run), switched->curve, study::drift_case(task.config, 1.0).gyro);
    std::vector<std::string> text = words("figure 3.short");
    if (!rates.empty()) {
        const double interval = interval_s(task, run);
        const Sawtooth measured = sawtooth(rates, &Rates::measured_arcsec_s);
        const Sawtooth computed = sawtooth(rates, &Rates::computed_arcsec_s);
        text = sawtooth_text(task, run, *switched, measured, computed, interval);
        section.tables.push_back(sawtooth_table(measured, computed, interval));
    }
    section.paragraphs.insert(section.paragraphs.end(), text.begin(), text.end());
}

}  // namespace

PaperItem paper_figure_3(const PaperTask& task, const study::RunResult& run) {
    PaperItem item = item_of("figure 3", {}, {}, {sawtooth_figure(task, run)});
    add_sawtooth(task, run, item.section);
    return item;
}

}  // namespace zlg::paper
