#include <zlg/choice/choice_page.hpp>

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <zlg/config/schema.hpp>
#include <zlg/report/number_text.hpp>
#include <zlg/study/gyro_drift.hpp>

#include "forecast.hpp"

namespace zlg::choice {
namespace {

using namespace report;

std::string share_text(const Answer& a) {
    return fmt::format("{:.3f} +- {:.3f} of {} gyros", a.probability, a.probability_sigma, a.proof.trials.size());
}

// Gyros that were tried with the chosen method, and what the magnetic drift alone leaves of the gyro without
// tolerances.
Figure interval_figure(const Requirement& r, const Answer& a) {
    Figure f = blank_figure("error-interval", "Error at the end against the interval",
                            "Each point is a gyro that was tried with the chosen method. Line: what the alternating "
                            "magnetic drift leaves without tolerances and without the estimate of it. Dashed: what is "
                            "required.",
                            "interval, s", "error of the angle at the end, arcsec");
    f.log_x = f.log_y = true;
    Series points = blank_series("gyros", Mark::points);
    Series magnetic = blank_series("magnetic drift");
    Series limit = blank_series("required", Mark::line, true);
    const auto add_gyros = [&](const Evaluation& e) {
        for (const Trial& t : e.trials)
            if (t.state == TrialState::good) add_point(points, e.candidate.interval_s, std::abs(t.error_arcsec));
    };
    for (const Evaluation& e : a.tried)
        if (e.candidate.method == a.proof.candidate.method) add_gyros(e);
    add_gyros(a.proof);
    for (int k = 0; k <= 200; ++k) {
        Candidate c = a.proof.candidate;
        c.interval_s = r.run_s * std::pow(10.0, -0.01 * k);
        add_point(magnetic, c.interval_s, std::abs(magnetic_angle_arcsec(study::gyro_drift(a.gyro), r.run_s, c)));
        add_point(limit, c.interval_s, r.limit_arcsec());
    }
    f.series = {std::move(points), std::move(magnetic), std::move(limit)};
    return f;
}

Figure probability_figure(const Requirement& r, const Answer& a) {
    Figure f = blank_figure("probability", "Share of the gyros against what is required",
                            "The gyros of the proof that keep so small an error. Thin: one standard deviation. "
                            "Shaded: up to what is required.",
                            "error of the angle at the end, arcsec", "share of the gyros");
    std::vector<double> errors;
    for (const Trial& t : a.proof.trials)
        if (t.state == TrialState::good) errors.push_back(std::abs(t.error_arcsec));
    std::ranges::sort(errors);
    Series share = blank_series("share");
    Series low = blank_series("", Mark::line, true, 0);
    Series high = blank_series("one standard deviation", Mark::line, true, 0);
    const auto n = static_cast<std::int64_t>(a.proof.trials.size());
    for (std::size_t k = 0; k < errors.size(); ++k) {
        const auto held = static_cast<std::int64_t>(k + 1);
        const double value = static_cast<double>(held) / static_cast<double>(n);
        const double sigma = sigma_of_share(held, n);
        add_point(share, errors[k], value);
        add_point(low, errors[k], value - sigma);
        add_point(high, errors[k], value + sigma);
    }
    for (const Series* s : {&share, &low, &high}) f.series.push_back(thin(*s, 400));
    f.bands = {{0.0, r.limit_arcsec(), "required"}};
    return f;
}

Figure budget_figure(const Answer& a) {
    Figure f = blank_figure("budget-bars", "What the error at the end is made of",
                            "Root mean square over the gyros of each part, and of all together.", "part", "arcsec rms");
    for (std::size_t k = 0; k < a.parts.size(); ++k) {
        Series bar = blank_series(a.parts[k].name, Mark::bars);
        add_point(bar, static_cast<double>(k + 1), a.parts[k].rms_arcsec);
        f.series.push_back(std::move(bar));
    }
    return f;
}

report::Table choice_table(const Requirement& r, const Answer& a) {
    report::Table t{.caption = "What is chosen.", .header = {"key", "value"}};
    for (const auto& [key, value] : chosen_keys(r.base, a.proof.candidate)) t.rows.push_back(row(key, value));
    return t;
}

report::Table budget_table(const Answer& a) {
    report::Table t{.caption =
                        "The budget by the paper's equations, whose numbers stand in the names, with the error "
                        "that a switch of this gyro leaves.",
                    .header = {"quantity", "value"}};
    for (const auto& [name, value] : a.budget) t.rows.push_back(row(name, value));
    for (const Part& part : a.parts) t.rows.push_back(row(part.name + ", arcsec rms at the end", part.rms_arcsec));
    return t;
}

std::string model_sentence(const Requirement& r) {
    const auto is_given = [&](const std::string& key) {
        return config::is_given(r.base, key) || std::ranges::any_of(r.tolerance, [&](const sweep::Parameter& p) {
                   return std::ranges::find(p.keys, key) != p.keys.end();
               });
    };
    std::string given, presumed;
    for (const char* key : {"perimeter.miss_lambda", "gyro.light_noise_lambda", "drift.magnetic_arcsec_s",
                            "drift.magnetic_thermal_arcsec_s", "drift.thermal_time_s",
                            "drift.random_walk_arcsec_sqrt_s", "gyro.scale_arcsec", "gyro.bias_hz"}) {
        std::string& list = is_given(key) ? given : presumed;
        list += (list.empty() ? "" : ", ") + std::string{key};
    }
    return fmt::format(
        "All of it is of this model. The requirement gives {}; presumed, as the paper's gyro has them: "
        "{}. A constant that is given is worth as much as the calibration behind it.",
        given.empty() ? "no constant that decides" : given, presumed.empty() ? "none" : presumed);
}

}  // namespace

std::string verdict(const Requirement& r, const Answer& a) {
    const std::string demand =
        fmt::format("an error of at most {} arcsec after {} s", short_number(r.limit_arcsec()), short_number(r.run_s));
    if (a.is_interrupted)
        return fmt::format(
            "Interrupted: of {}, asked of {} of the gyros, this is known until now. Last tried: {}; {} keep it.",
            demand, r.confidence, in_words(a.proof.candidate), share_text(a));
    if (a.met)
        return fmt::format("{} meets {} in {}, where {} is asked.", in_words(a.proof.candidate), demand, share_text(a),
                           r.confidence);
    return fmt::format(
        "Nothing meets {}: {} does in {}{}, where {} is asked. That share keeps {} arcsec. What binds: {}.", demand,
        in_words(a.proof.candidate), share_text(a),
        a.probability < r.confidence ? "" : ", as long as false angles cancel in pairs", r.confidence,
        short_number(a.least_arcsec), a.binding);
}

report::Page choice_page(const Requirement& r, const Answer& a) {
    report::Page page{.title = "The simplest gyro that meets a requirement",
                      .verdict = verdict(r, a),
                      .lead =
                          "Interval, correction, reading and schedule, chosen by closed forms and trials, proved on "
                          "gyros that were not used to choose."};
    std::vector<std::string> reasons = a.reasons;
    if (!a.simulated.trials.empty())
        reasons.push_back(fmt::format(
            "Of the first {} gyros of the proof, simulated half by half, {} meet it; their errors are {} arcsec rms, "
            "those of the proof {}.",
            a.simulated.trials.size(), a.simulated.met(r.limit_arcsec()), short_number(a.simulated.rms_arcsec()),
            short_number(a.proof.rms_arcsec())));
    page.sections.push_back({.heading = "Choice", .paragraphs = std::move(reasons), .tables = {choice_table(r, a)}});
    std::vector<std::string> needs;
    for (const Need& need : a.would_need) needs.push_back(need.sentence);
    if (!needs.empty())
        page.sections.push_back({.heading = "What would have to change", .paragraphs = std::move(needs)});
    page.sections.push_back({.heading = "Proof",
                             .paragraphs = {model_sentence(r)},
                             .figures = {interval_figure(r, a), probability_figure(r, a)}});
    page.sections.push_back({.heading = "Budget",
                             .paragraphs = {"What binds: " + a.binding + "."},
                             .tables = {budget_table(a)},
                             .figures = {budget_figure(a)}});
    page.sections.push_back({.heading = "Configuration",
                             .paragraphs = {"Saved as chosen.toml, these lines are what zlg run chosen.toml takes."},
                             .code = toml_text(r, a)});
    return page;
}

}  // namespace zlg::choice
