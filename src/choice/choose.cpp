#include <zlg/choice/choose.hpp>

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <zlg/chance/draw.hpp>
#include <zlg/config/schema.hpp>
#include <zlg/numeric/parallel.hpp>
#include <zlg/rig/closed_loop.hpp>

#include "search.hpp"
#include "verdict.hpp"

namespace zlg::choice {
namespace {

constexpr std::int64_t common_gyros = 128;
constexpr double refuted_sigmas = 3.0;
constexpr std::size_t n_best = 4;  // of those that meet nothing, tried for the least error
constexpr std::int64_t best_gyros = 32;

// The error that this share of the gyros keeps; infinite where too many are lost.
double kept_error_arcsec(const Evaluation& e, double share) {
    std::vector<double> errors;
    for (const Trial& t : e.trials)
        errors.push_back(t.state == TrialState::good ? std::abs(t.error_arcsec)
                                                     : std::numeric_limits<double>::infinity());
    if (errors.empty()) return std::numeric_limits<double>::infinity();
    std::ranges::sort(errors);
    const double place = std::ceil(share * static_cast<double>(errors.size()) - 1e-9);
    return errors[static_cast<std::size_t>(std::max(place, 1.0)) - 1];
}

class Choosing {
public:
    Choosing(const Task& task, Answer& answer)
        : task_{task},
          r_{task.requirement},
          common_{r_, r_.base.run.seed, common_gyros},
          forecast_{common_, task.threads, task.is_stopped},
          search_{task_, forecast_, common_},
          answer_{answer} {
        std::vector<std::string> why = search_.all().excluded;
        if (why.empty()) why.emplace_back("no method delivers final values within delay_s");
        if (search_.all().all.empty())
            throw config::ConfigError{fmt::format("[require] leaves nothing to choose from: {}", fmt::join(why, " "))};
    }

    void run() {
        const bool is_possible = !most_are_impossible();
        const bool is_met = is_possible && (prove_one() || prove_the_best());
        settle();
        answer_.met = is_met;
        if (is_possible && !is_met && answer_.probability >= r_.confidence)
            answer_.least_arcsec += false_angle_arcsec(answer_.proof.candidate);
        if (is_possible) confirm();
        if (is_met)
            answer_.runner_up = search_.runner_up(answer_.proof.candidate.method);
        else if (is_possible)
            answer_.would_need = needs(task_, answer_.proof.candidate);
        explain(r_, forecast_, search_.all().excluded, answer_);
        report(1.0);
    }

    // What is known when a signal comes.
    void settle() {
        answer_.tried = search_.tried();
        const Evaluation& proof = answer_.proof;
        const auto n = static_cast<std::int64_t>(proof.trials.size());
        answer_.gyro = with(r_.base, proof.candidate);
        answer_.probability = proof.share(limit_);
        answer_.probability_sigma = sigma_of_share(proof.met(limit_), n);
        answer_.least_arcsec = kept_error_arcsec(proof, r_.confidence);
        const auto count = [&](TrialState state) { return std::ranges::count(proof.trials, state, &Trial::state); };
        answer_.refused = count(TrialState::refused);
        answer_.lost = count(TrialState::lost);
    }

private:
    void report(double fraction) const {
        if (task_.on_progress) task_.on_progress(fraction);
    }

    // Of a search nobody knows how long it is.
    void on_search() {
        searched_ += 1.0;
        report(0.4 * searched_ / (searched_ + 20.0));
    }

    bool prove(const Candidate& candidate, double sigmas) {
        const Population fresh{r_, proof_seed(r_.base.run.seed, ++answer_.proofs), r_.gyros};
        answer_.proof = {candidate, {}};
        const Tester tester{task_, fresh};
        return tester.extend(answer_.proof, r_.gyros, sigmas, [&] {
            report(0.4 + 0.5 * static_cast<double>(answer_.proof.trials.size()) / static_cast<double>(r_.gyros));
        });
    }

    // Half of the gyros or more are none by the tolerances, whatever is chosen: nothing is tried then.
    bool most_are_impossible() {
        const Population fresh{r_, proof_seed(r_.base.run.seed, 1), r_.gyros};
        const Candidate any = candidates(r_, search_.all().all.front()).front();
        Evaluation drawn{any, {}};
        for (std::int64_t k = 0; k < r_.gyros; ++k) {
            try {
                (void)rig::ClosedLoop{fresh.gyro(k, any), twin::Motion::rest()};
                drawn.trials.push_back({.state = TrialState::untried});
            } catch (const config::ConfigError& error) {
                drawn.trials.push_back({.state = TrialState::refused, .reason = error.what()});
            }
        }
        const auto refused = std::ranges::count(drawn.trials, TrialState::refused, &Trial::state);
        if (2 * refused < r_.gyros) return false;
        answer_.proof = drawn;
        return true;
    }

    bool prove_one() {
        while (const auto found = search_.next([&] { on_search(); })) {
            if (prove(found->candidate, refuted_sigmas) && answer_.proof.share(limit_) >= r_.confidence) return true;
            search_.fall_short(answer_.proof);
        }
        return false;
    }

    double false_angle_arcsec(const Candidate& c) { return std::sqrt(forecast_.parts(c).alternating); }

    // The first of those with the least error by the closed forms that gyros do not contradict; where much of it is the
    // magnetic drift, or they contradict all, the one with the least on common gyros. Closed forms may have discarded
    // what meets it; what only an even number of false angles lets meet it does not. A proof of such a one that went
    // to its end is not repeated.
    bool prove_the_best() {
        const std::vector<Candidate> all = search_.best(n_best);
        const auto predicted = [&](const Candidate& c) { return forecast_.parts(c).sum(); };
        if (static_cast<std::int64_t>(answer_.proof.trials.size()) == r_.gyros &&
            predicted(answer_.proof.candidate) <= predicted(*std::ranges::max_element(all, {}, predicted)))
            return false;
        const Tester tester{task_, common_};
        std::optional<Candidate> best;
        double least = std::numeric_limits<double>::infinity();
        for (const Candidate& c : all) {
            Evaluation e{c, {}};
            tester.extend(e, std::min(best_gyros, r_.gyros), std::numeric_limits<double>::infinity(),
                          [&] { on_search(); });
            const double kept = kept_error_arcsec(e, r_.confidence);
            if (best && kept >= least) continue;
            best = c;
            least = kept;
            const Parts parts = forecast_.parts(c);
            const double off = e.rms_arcsec() * e.rms_arcsec() / parts.sum() - 1.0;
            if (std::isfinite(kept) && off <= refuted_sigmas * mean_square_error(best_gyros) &&
                parts.magnetic <= mean_square_error(r_.gyros) * parts.sum())
                break;
        }
        prove(*best, std::numeric_limits<double>::infinity());
        return answer_.proof.share(limit_) >= r_.confidence && false_angle_arcsec(*best) <= limit_;
    }

    // The first gyros of the proof again, simulated half by half.
    void confirm() {
        if (fidelity_of(r_) == config::Fidelity::averaged) return;
        const double halves = 2.0 * r_.run_s / answer_.gyro.gyro.tick_s;
        const auto n = std::min(r_.gyros, static_cast<std::int64_t>(std::clamp(8e6 / halves, 2.0, 32.0)));
        const Population same{r_, proof_seed(r_.base.run.seed, answer_.proofs), r_.gyros};
        std::vector<Trial> simulated(static_cast<std::size_t>(n));
        numeric::in_parallel(simulated.size(), task_.threads, [&](std::size_t k) {
            simulated[k] = same.run(static_cast<std::int64_t>(k), answer_.proof.candidate, config::Fidelity::averaged,
                                    task_.is_stopped);
        });
        answer_.simulated = {answer_.proof.candidate, std::move(simulated)};
    }

    const Task& task_;
    const Requirement& r_;
    Population common_;
    Forecast forecast_;
    Search search_;
    Answer& answer_;
    double limit_ = r_.limit_arcsec();
    double searched_ = 0.0;
};

}  // namespace

std::uint64_t proof_seed(std::uint64_t seed, std::uint64_t proof) {
    return chance::Draw{seed, chance::Cause::sweep_seed, proof, chance::thing_of("proof")}.bits();
}

Answer choose(const Task& task) {
    Answer answer;
    answer.proof.candidate = {.interval_s = task.requirement.run_s};
    Choosing choosing{task, answer};
    try {
        choosing.run();
    } catch (const Stopped&) {
        choosing.settle();
        answer.met = false;
        answer.is_interrupted = true;
    }
    return answer;
}

}  // namespace zlg::choice
