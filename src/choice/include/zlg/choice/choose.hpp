#pragma once
// The simplest choice that meets a requirement, and its proof.
//
// Closed forms rank and discard first; the candidates that are left are tried in the order of simplicity on common
// gyros, 8, 16, 64 and 128 of them, and dropped as soon as they lie two standard deviations below the confidence
// (successive halving: K. Jamieson, A. Talwalkar, AISTATS 2016, with a fixed threshold). Where one falls short just as
// the closed forms say, those that they hold to be better by less than a proof can tell are left out. Each whose share
// is the confidence or more is proved, on gyros of its own that no other step has seen, until one has a share that is
// the confidence or more: that one meets it. The share has the standard deviation of a binomial share with a flat
// prior, as if it were the only one proved. If none meets it, the simplest candidate whose error a proof cannot tell
// from the least is the answer to what can be met.

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <zlg/choice/candidate.hpp>
#include <zlg/choice/trial.hpp>

namespace zlg::choice {

// A candidate and the gyros that it was tried on.
struct Evaluation {
    Candidate candidate;
    std::vector<Trial> trials;

    [[nodiscard]] std::int64_t met(double limit_arcsec) const;
    [[nodiscard]] double share(double limit_arcsec) const;  // 0 where none was tried
    [[nodiscard]] double rms_arcsec() const;                // of the errors of the good ones; 0 where there is none
};

// Standard deviation of a share of n, k of which hold: that of the posterior under a flat prior.
[[nodiscard]] double sigma_of_share(std::int64_t k, std::int64_t n);

// One constant changed alone, all else as chosen; the interval is chosen anew.
struct Need {
    std::vector<std::string> keys;
    double from = 0.0;  // of the first key
    double to = 0.0;
    bool is_enough = false;  // false: no change of this constant alone
    double share = 0.0;      // of `tried` gyros that then meet it
    std::int64_t tried = 0;
    std::string sentence;
};

struct Part {
    std::string name;
    double rms_arcsec = 0.0;  // of the error at the end
};

struct Answer {
    bool met = false;
    bool is_interrupted = false;  // what was known until then
    double probability = 0.0;     // of meeting the requirement, over the tolerances
    double probability_sigma = 0.0;
    std::int64_t refused = 0, lost = 0;  // of the gyros of the proof
    std::uint64_t proofs = 0;            // candidates that were proved, each on gyros of its own
    config::Config gyro;                 // the base with what is chosen
    Evaluation proof;                    // of the choice
    double least_arcsec = 0.0;           // error at the end that `confidence` of the gyros keep
    Evaluation simulated;                // the first gyros of the proof, simulated half by half
    std::vector<std::string> reasons;
    std::vector<Part> parts;                             // of the error at the end
    std::vector<std::pair<std::string, double>> budget;  // (3) to (7) and what else there is, by name with unit
    std::string binding;
    std::optional<Evaluation> runner_up;
    std::vector<Evaluation> tried;  // in their order
    std::vector<Need> would_need;   // where it is not met
};

struct Task {
    Requirement requirement;
    int threads = 1;
    std::function<void(double)> on_progress;  // optional; 0..1
    IsStopped is_stopped;                     // optional
};

// The same answer for any number of threads.
//
// errors  config::ConfigError where nothing is left to choose from; those of a motion file.
[[nodiscard]] Answer choose(const Task& task);

// As one JSON object.
[[nodiscard]] std::string json_text(const Requirement& requirement, const Answer& answer);

// The configuration that `zlg run` takes, with the requirement and the proof as comments.
[[nodiscard]] std::string toml_text(const Requirement& requirement, const Answer& answer);

}  // namespace zlg::choice
