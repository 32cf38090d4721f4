#pragma once
// The way to a choice: candidates in the order of simplicity, tried on more and more gyros.

#include <zlg/choice/choose.hpp>

#include "forecast.hpp"

namespace zlg::choice {

// Of the gyros of a proof, numbered from 1, that no other step has seen.
[[nodiscard]] std::uint64_t proof_seed(std::uint64_t seed, std::uint64_t proof);

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

// Walks through the candidates: a pool at a time through the first rounds, one by one through the last.
class Search {
public:
    // forecast, population  outlive it.
    Search(const Task& task, Forecast& forecast, const Population& population);

    // The next candidate that passed all rounds; nothing where there is none.
    [[nodiscard]] std::optional<Evaluation> next(const std::function<void()>& on_gyro);

    [[nodiscard]] const std::vector<Evaluation>& tried() const { return tried_; }
    [[nodiscard]] const Methods& all() const { return methods_; }

    // After a choice: the next in order that passed the first rounds, or that the closed forms believe in and 32 gyros
    // do not refute; not of the same method.
    [[nodiscard]] std::optional<Evaluation> runner_up(const Method& chosen);

    // The candidates with the least error by the closed forms, the best first.
    [[nodiscard]] std::vector<Candidate> best(std::size_t n);

private:
    [[nodiscard]] std::vector<Evaluation> pool();
    void refill(const std::function<void()>& on_gyro);

    const Task& task_;
    Forecast& forecast_;
    Tester tester_;
    Methods methods_;
    std::size_t method_ = 0;             // the next that no pool has had
    std::vector<Candidate> waiting_;     // of the methods begun, last first
    std::vector<Evaluation> promising_;  // last first
    std::vector<Evaluation> tried_;
};

}  // namespace zlg::choice
