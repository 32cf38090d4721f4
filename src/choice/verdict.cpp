#include "verdict.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <zlg/config/schema.hpp>
#include <zlg/report/number_text.hpp>
#include <zlg/study/gyro_drift.hpp>

namespace zlg::choice {
namespace {

using report::short_number;

// The mean square of the errors of the proof that no closed form explains is of the magnetic drift where none knows it.
std::vector<Part> parts_of(Forecast& forecast, const Answer& answer) {
    const Candidate& c = answer.proof.candidate;
    Parts parts = forecast.parts(c);
    const double rms = answer.proof.rms_arcsec();
    if (rms > 0.0 && forecast.leaves_unknown(c)) {
        parts.magnetic = 0.0;
        parts.magnetic = std::max(0.0, rms * rms - parts.sum());
    }
    return {{"magnetic drift", std::sqrt(parts.magnetic)},
            {"switch errors", std::sqrt(parts.switches)},
            {"false angle that the next switch takes back", std::sqrt(parts.alternating)},
            {"random walk", std::sqrt(parts.walk)},
            {"rounding of the counter", std::sqrt(parts.rounding)},
            {"all, of the gyros of the proof", rms}};
}

Budget budget_of(const Requirement& r, Forecast& forecast, const Answer& answer) {
    const Candidate& c = answer.proof.candidate;
    const double rms = forecast.switch_rms_arcsec(c.method);
    const design::DriftCase task{
        .gyro = study::gyro_drift(answer.gyro), .switch_error_arcsec = std::max(rms, 1e-6), .run_s = r.run_s};
    const design::DriftTerms terms = design::corrected_terms(task, c.interval_s);
    Budget budget = budget_7(task, c.interval_s, terms);
    budget.insert(budget.begin(), {{"switches", static_cast<double>(switches_until(r.run_s, c))},
                                   {"switch_error_rms_arcsec", rms},
                                   {"switch_errors_independent_arcsec_s",
                                    design::independent_switch_drift_arcsec_s(task, c.interval_s)}});
    const double worst_s = design::worst_case_drift_arcsec_s(task, c.interval_s, c.first_segment);
    budget.emplace_back("worst_end_arcsec",
                        r.run_s * (worst_s - terms.nonmagnetic_arcsec_s) + std::sqrt(forecast.parts(c).alternating));
    return budget;
}

std::string binding_of(const Requirement& r, const Answer& answer) {
    const auto n = static_cast<double>(answer.proof.trials.size());
    if (2.0 * static_cast<double>(answer.refused) >= n ||
        static_cast<double>(answer.refused) > (1.0 - r.confidence) * n)
        return "tolerances that make no gyro";
    if (static_cast<double>(answer.lost) > (1.0 - r.confidence) * n) return "switches that fail";
    return largest(answer.parts);
}

std::string share_text(const Requirement& r, const Evaluation& e) {
    return fmt::format("{} of {} gyros", e.met(r.limit_arcsec()), e.trials.size());
}

// Of the tried candidates that lack what is chosen, the one that came nearest.
template <class Lacks> std::string without(const Requirement& r, const Answer& answer, const Lacks& lacks) {
    const Evaluation* best = nullptr;
    for (const Evaluation& e : answer.tried)
        if (lacks(e.candidate) && (best == nullptr || e.share(r.limit_arcsec()) > best->share(r.limit_arcsec())))
            best = &e;
    if (best == nullptr) return "without it the closed forms leave no candidate";
    return fmt::format("without it the nearest, {}, meets it in {}", in_words(best->candidate), share_text(r, *best));
}

std::string interval_reason(const Requirement& r, const Answer& answer) {
    const Candidate& c = answer.proof.candidate;
    const Evaluation* longer = nullptr;
    for (const Evaluation& e : answer.tried)
        if (e.candidate.method == c.method && e.candidate.interval_s > c.interval_s &&
            (longer == nullptr || e.candidate.interval_s < longer->candidate.interval_s))
            longer = &e;
    const std::string start = fmt::format("Interval {} s{}: ", short_number(c.interval_s),
                                          c.first_segment == config::FirstSegment::half
                                              ? " with a half first segment, so that the sawtooth runs about its mean"
                                              : "");
    if (longer == nullptr) return start + "of longer ones the closed forms leave none.";
    return start + fmt::format("of the next longer one, {} s, {} meet it.", short_number(longer->candidate.interval_s),
                               share_text(r, *longer));
}

// What was added to the paper's gyro, and what comes of it without.
std::vector<std::string> addition_reasons(const Requirement& r, const Answer& answer) {
    const Method& m = answer.proof.candidate.method;
    std::vector<std::string> all;
    const auto add = [&](bool is_addition, const char* what, const char* otherwise, const auto& lacks) {
        all.push_back(is_addition ? fmt::format("{}: {}.", what, without(r, answer, lacks)) : std::string{otherwise});
    };
    add(m.relock == core::RelockMethod::joint, "The joint estimate of each switch", "The paper's corrections suffice.",
        [](const Candidate& c) { return c.method.relock != core::RelockMethod::joint; });
    add(m.reading != Reading::x1, m.reading == Reading::x4 ? "Four counts a fringe" : "Reading by phase",
        "One count a fringe suffices.", [&](const Candidate& c) { return c.method.reading < m.reading; });
    add(m.schedule == config::Schedule::measured, "A schedule that measures", "A fixed schedule suffices.",
        [](const Candidate& c) { return c.method.schedule == config::Schedule::fixed; });
    add(m.magnetic == core::MagneticMethod::estimate, "The estimate of the magnetic drift",
        "No estimate of the magnetic drift is needed.",
        [](const Candidate& c) { return c.method.magnetic == core::MagneticMethod::none; });
    add(m.tick_s != r.base.gyro.tick_s, "Another tick", "The gyro's tick suffices.",
        [&](const Candidate& c) { return c.method.tick_s == r.base.gyro.tick_s; });
    return all;
}

std::string runner_up_reason(const Requirement& r, const Answer& answer) {
    const Candidate& second = answer.runner_up->candidate;
    return fmt::format(
        "Runner-up: {}; {} meet it. Its cost: {} additions to the paper's gyro in place of {}, {} "
        "switches in place of {}.",
        in_words(second), share_text(r, *answer.runner_up), second.method.additions,
        answer.proof.candidate.method.additions, switches_until(r.run_s, second),
        switches_until(r.run_s, answer.proof.candidate));
}

std::vector<std::string> reasons_of(const Requirement& r, const std::vector<std::string>& excluded,
                                    const Answer& answer) {
    std::vector<std::string> all;
    if (answer.met) {
        all = addition_reasons(r, answer);
        all.insert(all.begin(), interval_reason(r, answer));
    } else if (std::ranges::any_of(answer.proof.trials,
                                   [](const Trial& t) { return t.state == TrialState::untried; })) {
        all.push_back("Half of the gyros or more are none by the tolerances, whatever is chosen: nothing was tried.");
    } else {
        all.push_back(
            "No method and interval leaves an error that these gyros could tell to be less, by the closed forms and by "
            "trials.");
    }
    all.push_back("The perimeter loop and its constants are the gyro's: it settles within the corrected ticks.");
    all.insert(all.end(), excluded.begin(), excluded.end());
    all.push_back(
        fmt::format("All of this is of the angle after {} s; a run that ends at another time ends with up to {} arcsec "
                    "of the sawtooth, of the false angle that the next switch takes back and of switch errors of one "
                    "sign.",
                    short_number(r.run_s), short_number(answer.budget.back().second)));
    if (const double least = std::ceil(1.0 / (1.0 - r.confidence) - 1e-9); static_cast<double>(r.gyros) < least)
        all.push_back(fmt::format("The proof has {} gyros; fewer than {:.0f} cannot tell a share of {}.", r.gyros,
                                  least, r.confidence));
    if (answer.proofs > 1)
        all.push_back(fmt::format("{} candidates were proved in turn, each on gyros of its own; this is the last.",
                                  answer.proofs));
    if (answer.runner_up) all.push_back(runner_up_reason(r, answer));
    if (answer.refused + answer.lost > 0)
        all.push_back(
            fmt::format("Of {} gyros the tolerances make {} impossible, and {} lost their switches: none of "
                        "them meets it.",
                        answer.proof.trials.size(), answer.refused, answer.lost));
    return all;
}

}  // namespace

Budget budget_7(const design::DriftCase& task, double interval_s, const design::DriftTerms& terms) {
    return {{"bound_3_arcsec_s", design::drift_bound_arcsec_s(task, interval_s)},
            {"magnetic_at_end_5_arcsec_s", design::magnetic_rate_arcsec_s(task.gyro, task.run_s)},
            {"quasi_nonmagnetic_4_6_arcsec_s", terms.quasi_nonmagnetic_arcsec_s},
            {"nonmagnetic_7_arcsec_s", terms.nonmagnetic_arcsec_s},
            {"sawtooth_7_arcsec_s", terms.sawtooth_arcsec_s},
            {"switch_errors_7_arcsec_s", terms.switch_errors_arcsec_s},
            {"total_7_arcsec_s", terms.total_arcsec_s()}};
}

std::string largest(const std::vector<Part>& parts) {
    return std::max_element(parts.begin(), parts.end() - 1,
                            [](const Part& a, const Part& b) { return a.rms_arcsec < b.rms_arcsec; })
        ->name;
}

void explain(const Requirement& requirement, Forecast& forecast, const std::vector<std::string>& excluded,
             Answer& answer) {
    answer.parts = parts_of(forecast, answer);
    answer.budget = budget_of(requirement, forecast, answer);
    answer.binding = binding_of(requirement, answer);
    answer.reasons = reasons_of(requirement, excluded, answer);
}

}  // namespace zlg::choice
