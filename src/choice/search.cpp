#include "search.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

#include <zlg/config/schema.hpp>
#include <zlg/numeric/parallel.hpp>

namespace zlg::choice {
namespace {

constexpr std::array<std::int64_t, 4> rounds{8, 16, 64, 128};
constexpr double hopeless_sigmas = 2.0;
constexpr double believed_sigmas = 2.0;  // of the share by which trials may be off the closed forms
// A switch may leave this much less than its short trial says, before the closed form discards.
constexpr double hopeful_ratio = 0.75;

}  // namespace

std::int64_t Evaluation::met(double limit_arcsec) const {
    return std::ranges::count_if(trials, [&](const Trial& t) { return t.meets(limit_arcsec); });
}

double Evaluation::share(double limit_arcsec) const {
    return trials.empty() ? 0.0 : static_cast<double>(met(limit_arcsec)) / static_cast<double>(trials.size());
}

double Evaluation::rms_arcsec() const {
    double sum = 0.0, n = 0.0;
    for (const Trial& t : trials) {
        if (t.state != TrialState::good) continue;
        sum += t.error_arcsec * t.error_arcsec;
        n += 1.0;
    }
    return n > 0.0 ? std::sqrt(sum / n) : 0.0;
}

double sigma_of_share(std::int64_t k, std::int64_t n) {
    const double a = static_cast<double>(k) + 1.0, b = static_cast<double>(n - k) + 1.0;
    return std::sqrt(a * b / (a + b + 1.0)) / (a + b);
}

double mean_square_error(std::int64_t n) { return std::sqrt(2.0 / static_cast<double>(n)); }

config::Fidelity fidelity_of(const Requirement& requirement) {
    const config::Config& base = requirement.base;
    return config::is_given(base, "gyro.fidelity") ? base.gyro.fidelity : config::Fidelity::events;
}

bool Tester::is_hopeless(const Evaluation& e, double sigmas) const {
    const auto n = static_cast<std::int64_t>(e.trials.size());
    const std::int64_t k = e.met(task_.requirement.limit_arcsec());
    const double share = (static_cast<double>(k) + 1.0) / (static_cast<double>(n) + 2.0);
    return n > 0 && share + sigmas * sigma_of_share(k, n) < task_.requirement.confidence;
}

bool Tester::extend(Evaluation& e, std::int64_t gyros, double sigmas, const std::function<void()>& on_gyro) const {
    const config::Fidelity fidelity = fidelity_of(task_.requirement);
    while (static_cast<std::int64_t>(e.trials.size()) < gyros) {
        if (is_hopeless(e, sigmas)) return false;
        const std::size_t begin = e.trials.size();
        const std::size_t n = std::min<std::size_t>(begin < 64 ? 8 : 64, static_cast<std::size_t>(gyros) - begin);
        std::vector<Trial> made(n);
        numeric::in_parallel(n, task_.threads, [&](std::size_t k) {
            made[k] = population_.run(static_cast<std::int64_t>(begin + k), e.candidate, fidelity, task_.is_stopped);
        });
        std::ranges::move(made, std::back_inserter(e.trials));
        if (on_gyro) on_gyro();
    }
    return !is_hopeless(e, sigmas);
}

Search::Search(const Task& task, Forecast& forecast, const Population& population)
    : task_{task}, forecast_{forecast}, tester_{task, population}, methods_{methods(task.requirement)} {}

// The next candidate that the closed forms leave, in the order of simplicity.
std::optional<Candidate> Search::pop() {
    while (true) {
        while (waiting_.empty()) {
            if (method_ == methods_.all.size()) return std::nullopt;
            waiting_ = candidates(task_.requirement, methods_.all[method_++]);
            std::ranges::reverse(waiting_);
        }
        const Candidate c = waiting_.back();
        waiting_.pop_back();
        if (forecast_.chance(c, hopeful_ratio) >= least_chance_) return c;
    }
}

std::optional<Evaluation> Search::next(const std::function<void()>& on_gyro) {
    while (const std::optional<Candidate> c = pop()) {
        Evaluation e{*c, {}};
        const bool is_left = std::ranges::all_of(rounds, [&](std::int64_t n) {
            return tester_.extend(e, std::min(n, task_.requirement.gyros), hopeless_sigmas, on_gyro);
        });
        tried_.push_back(e);
        if (is_left && e.share(task_.requirement.limit_arcsec()) >= task_.requirement.confidence) return e;
        fall_short(e);
    }
    return std::nullopt;
}

void Search::fall_short(const Evaluation& e) {
    const Requirement& r = task_.requirement;
    const auto n = static_cast<double>(e.trials.size());
    const double predicted = forecast_.chance(e.candidate), off = std::abs(e.share(r.limit_arcsec()) - predicted);
    if (off > believed_sigmas * std::sqrt(predicted * (1.0 - predicted) / n)) return;
    // At most half of what is left to certainty, which few gyros could never tell.
    const double sigma_of_proof = std::sqrt(r.confidence * (1.0 - r.confidence) / static_cast<double>(r.gyros));
    least_chance_ = std::max(least_chance_, predicted + std::min(sigma_of_proof, 0.5 * (1.0 - predicted)));
}

std::optional<Evaluation> Search::runner_up(const Method& chosen) {
    for (int trials = 0; method_ < methods_.all.size() && trials < 4; ++method_) {
        for (const Candidate& c : candidates(task_.requirement, methods_.all[method_])) {
            if (c.method == chosen || forecast_.chance(c) < task_.requirement.confidence) continue;
            Evaluation e{c, {}};
            ++trials;
            if (tester_.extend(e, 32, hopeless_sigmas, {})) return e;
            break;
        }
    }
    return std::nullopt;
}

std::vector<Candidate> Search::best(std::size_t n) {
    std::vector<std::pair<double, Candidate>> all;
    for (const Method& method : methods_.all)
        for (const Candidate& c : candidates(task_.requirement, method)) all.emplace_back(forecast_.parts(c).sum(), c);
    const double least = std::ranges::min(all, {}, &std::pair<double, Candidate>::first).first;
    std::vector<Candidate> found;
    for (const auto& [sum, c] : all)
        if (found.size() < n && sum <= least * (1.0 + mean_square_error(task_.requirement.gyros)) &&
            (found.empty() || !(found.back().method == c.method)))
            found.push_back(c);
    return found;
}

}  // namespace zlg::choice
