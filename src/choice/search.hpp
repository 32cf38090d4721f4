#pragma once
// The way to a choice: candidates in the order of simplicity, tried on more and more gyros.

#include <zlg/choice/choose.hpp>

#include "forecast.hpp"

namespace zlg::choice {

// Of the gyros of a proof, numbered from 1, that no other step has seen.
[[nodiscard]] std::uint64_t proof_seed(std::uint64_t seed, std::uint64_t proof);

// Relative standard deviation of the mean square of n normal deviates: what so many gyros cannot tell apart.
[[nodiscard]] double mean_square_error(std::int64_t n);

// By which a gyro is tried: events, where the requirement does not ask for another.
[[nodiscard]] config::Fidelity fidelity_of(const Requirement& requirement);

// Ends an evaluation when the share of those that meet is hopelessly below the confidence.
class Tester {
public:
    Tester(const Task& task, const Population& population) : task_{task}, population_{population} {}

    // Up to so many gyros in all. sigmas  below the confidence at which it stops.
    //
    // return  false where it stopped for that.
    bool extend(Evaluation& evaluation, std::int64_t gyros, double sigmas, const std::function<void()>& on_gyro) const;

    [[nodiscard]] bool is_hopeless(const Evaluation& evaluation, double sigmas) const;

private:
    const Task& task_;
    const Population& population_;
};

// Walks through the candidates, each through rounds of more and more gyros.
class Search {
public:
    // forecast, population  outlive it.
    Search(const Task& task, Forecast& forecast, const Population& population);

    // The next candidate that passed all rounds; nothing where there is none.
    [[nodiscard]] std::optional<Evaluation> next(const std::function<void()>& on_gyro);

    [[nodiscard]] const std::vector<Evaluation>& tried() const { return tried_; }
    [[nodiscard]] const Methods& all() const { return methods_; }

    // Where a candidate falls short just as the closed forms say, those fall short too that they hold to be better by
    // less than the standard deviation of a proof: left out from then on.
    void fall_short(const Evaluation& evaluation);

    // After a choice: the next in order that the closed forms believe in and 32 gyros do not refute; not of the same
    // method.
    [[nodiscard]] std::optional<Evaluation> runner_up(const Method& chosen);

    // The candidates with the least error by the closed forms as far as the gyros of a proof tell errors apart, the
    // simplest first, one of each method.
    [[nodiscard]] std::vector<Candidate> best(std::size_t n);

private:
    [[nodiscard]] std::optional<Candidate> pop();

    const Task& task_;
    Forecast& forecast_;
    Tester tester_;
    Methods methods_;
    std::size_t method_ = 0;          // the next to begin
    std::vector<Candidate> waiting_;  // of the method begun, last first
    std::vector<Evaluation> tried_;
    double least_chance_ = task_.requirement.confidence;  // by the closed forms, of what is tried
};

}  // namespace zlg::choice
