#include <zlg/study/run_page.hpp>

#include <algorithm>

#include <fmt/format.h>

#include <zlg/report/number_text.hpp>
#include <zlg/study/how_made.hpp>
#include <zlg/study/what_happened.hpp>

#include "run_view.hpp"

namespace zlg::study {
namespace {

using report::fixed_number;
using report::short_number;

report::Table meaning_table(const RunResult& result) {
    report::Table table{
        .caption = "What each row is. All compensate the records of one run; one_mode is a run of its own.",
        .header = {"compensation", "what it is"}};
    for (const VariantResult& v : result.variants) table.rows.push_back({v.name, v.meaning});
    return table;
}

std::vector<std::string> result_text(const config::Config& config, const RunResult& result) {
    std::vector<std::string> text = result.warnings;
    for (std::string& sentence : what_happened(config, result)) text.push_back(sentence + ".");
    return text;
}

// What was done to the gyro, and what its core noticed.
report::Section fault_section(const config::Config& config, const RunResult& result) {
    report::Section section{.heading = "Faults"};
    report::Table faults{.caption = "What was made to fail.", .header = {"fault", "from, s", "for, s", "size"}};
    const config::Faults& f = config.faults;
    for (std::size_t i = 0; i < f.kind.size(); ++i) {
        const twin::FaultFacts& facts = twin::facts(f.kind[i]);
        faults.rows.push_back(report::row(facts.name, f.at_s.at(i), f.duration_s.at(i),
                                          fmt::format("{} {}", short_number(f.size.at(i)), facts.unit)));
    }
    if (!faults.rows.empty()) section.tables.push_back(std::move(faults));
    if (f.random_per_hour > 0.0)
        section.paragraphs.push_back(fmt::format("Faults came at random, {} an hour, of seed {}.",
                                                 short_number(f.random_per_hour), f.random_seed));
    report::Table noticed{
        .caption =
            "What the core reported in the whole run: bits of its health, also those of an ordinary switch or "
            "start. health.csv has each change.",
        .header = {"bit of health", "first at, s", "in all, s"}};
    for (const HealthTime& h : result.health) noticed.rows.push_back(report::row(h.name, h.first_s, h.total_s));
    if (noticed.rows.empty())
        section.paragraphs.emplace_back("The core noticed nothing: no bit of its health was set.");
    else
        section.tables.push_back(std::move(noticed));
    return section;
}

report::Table relock_table(const RunResult& result) {
    report::Table table{
        .caption =
            "True false drift on the ticks after the loop is closed, averaged over the switches, with the "
            "sign that makes it positive.",
        .header = {"tick after the gap"},
        .rows = {{"false drift, deg/h"}}};
    for (std::size_t i = 0; i < result.relock_false_drift_deg_h.size(); ++i) {
        table.header.push_back(fmt::format("{}", i + 1));
        table.rows[0].push_back(fmt::format("{:.0f}", result.relock_false_drift_deg_h[i]));
    }
    return table;
}

report::Section switch_section(const RunResult& result) {
    report::Section section{
        .heading = "A switch, magnified",
        .paragraphs = {"Switching takes the perimeter from one longitudinal mode to the next, of opposite "
                       "circular polarisation. On the way there is no light in both directions and the gyro "
                       "is blind; just after it, the bias is not yet what it should be and the gyro lies."},
        .figures = {magnified_figure(result), detuning_figure(result)}};
    if (!result.relock_false_drift_deg_h.empty()) section.tables.push_back(relock_table(result));
    return section;
}

std::string lead(const config::Config& config, const RunResult& result) {
    std::string text = fmt::format("{} s of simulated operation in ticks of {} ms", short_number(duration_s(result)),
                                   short_number(1e3 * result.tick_s));
    if (!result.switches.empty() && config.switching.schedule == config::Schedule::fixed)
        text += fmt::format(", a switch every {} s", short_number(config.switching.interval_s));
    text += "; the true motion is known, so every error is. ";
    if (!faults_of(config).empty()) return text + "What a fault left in the angle is part of every drift below.";
    return text + fmt::format(
                      "As configured the angle drifts by {} deg/h and ends {} arcsec from the truth; never switched it "
                      "would have drifted by {} deg/h.",
                      short_number(result.variants.back().drift_arcsec_s),
                      short_number(result.variants.back().angle_error_arcsec),
                      short_number(result.variants.front().drift_arcsec_s));
}

}  // namespace

report::Table variant_table(const config::Config& config, const RunResult& result) {
    report::Table table{
        .caption = fmt::format(
            "The error of a switch is final minus true angle from the first blind tick to the end of the re-lock; its "
            "mean is taken with the sign of the false drift, which alternates from switch to switch. Drift is the "
            "least-squares slope of the angle error. The constant is the non-magnetic drift, {:g} deg/h, which no "
            "switching takes out and a bias calibration does. Compensations of equal figures share a row.",
            config.drift.nonmagnetic_arcsec_s),
        .header = {"compensation", "error of a switch, rms, arcsec", "mean, arcsec", "largest, arcsec",
                   "drift without the constant, deg/h", "error at the end without it, arcsec", "drift with it, deg/h",
                   "error at the end with it, arcsec"}};
    const RandomWalkShare walk = random_walk_share(config, result);
    if (walk.drift_arcsec_s > 0.0)
        table.caption += fmt::format(" The random walk alone makes +-{:.2g} deg/h and +-{:.2g} arcsec at the end.",
                                     walk.drift_arcsec_s, walk.angle_arcsec);
    const auto add = [&table](const VariantResult& v) {
        const auto error = [&v](double SwitchStatistics::*member) {
            return v.switch_error ? fixed_number((*v.switch_error).*member, 2) : "-";
        };
        std::vector<std::string> row{v.name,
                                     error(&SwitchStatistics::rms_arcsec),
                                     error(&SwitchStatistics::mean_arcsec),
                                     error(&SwitchStatistics::max_arcsec),
                                     fixed_number(v.drift_without_nonmagnetic_arcsec_s, 4),
                                     fixed_number(v.angle_error_without_nonmagnetic_arcsec, 1),
                                     fixed_number(v.drift_arcsec_s, 4),
                                     fixed_number(v.angle_error_arcsec, 1)};
        const auto same = std::ranges::find_if(table.rows, [&row](const auto& other) {
            return std::equal(other.begin() + 1, other.end(), row.begin() + 1);
        });
        if (same == table.rows.end())
            table.rows.push_back(std::move(row));
        else
            same->front() += ", " + v.name;
    };
    for (const VariantResult& v : result.variants) add(v);
    if (!result.magnetic_estimate.name.empty()) add(result.magnetic_estimate);
    return table;
}

report::Page run_page(const config::Config& config, const RunResult& result) {
    report::Page page{.title = "Run of a Zeeman laser gyro in the quasi-four-frequency regime",
                      .verdict = run_verdict(config, result),
                      .lead = lead(config, result)};
    page.sections.push_back({.heading = "Result",
                             .paragraphs = result_text(config, result),
                             .tables = {variant_table(config, result), meaning_table(result)},
                             .figures = {sawtooth_figure(config, result)}});
    auto& figures = page.sections.back().figures;
    if (!result.switches.empty()) figures.push_back(sum_figure(result));
    if (!faults_of(config).empty()) page.sections.push_back(fault_section(config, result));
    if (!result.magnified.empty()) page.sections.push_back(switch_section(result));
    if (!result.switches.empty())
        page.sections.push_back(
            {.heading = "All switches",
             .paragraphs =
                 {"What is left after compensation, switch by switch. The file of switches lists each of them with "
                  "its claimed and its true error."},
             .figures = {switch_error_figure(result)}});
    page.sections.push_back(how_made("run", config));
    page.sections.back().paragraphs.push_back(
        fmt::format("Fingerprint of the run: {}. Made again by this version, on any machine, it has the same.",
                    result.fingerprint));
    return page;
}

}  // namespace zlg::study
