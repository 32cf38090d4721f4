#include "search.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

#include <zlg/config/schema.hpp>
#include <zlg/numeric/parallel.hpp>

namespace zlg::choice {
namespace {

constexpr std::size_t pool_size = 4;
constexpr std::array<std::int64_t, 2> first_rounds{8, 16};
constexpr std::array<std::int64_t, 2> last_rounds{64, 128};
constexpr double hopeless_sigmas = 2.0;
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

// The next candidates that the closed forms leave, in the order of simplicity.
std::vector<Evaluation> Search::pool() {
    std::vector<Evaluation> next;
    while (next.size() < pool_size) {
        if (waiting_.empty()) {
            if (method_ == methods_.all.size()) break;
            waiting_ = candidates(task_.requirement, methods_.all[method_++]);
            std::erase_if(waiting_, [&](const Candidate& c) {
                return forecast_.chance(c, hopeful_ratio) < task_.requirement.confidence;
            });
            std::ranges::reverse(waiting_);
            continue;
        }
        next.push_back({waiting_.back(), {}});
        waiting_.pop_back();
    }
    return next;
}

// A pool through the first rounds; those that pass wait for the last.
void Search::refill(const std::function<void()>& on_gyro) {
    std::vector<Evaluation> left = pool();
    for (const std::int64_t n : first_rounds) {
        std::vector<Evaluation> passed;
        for (Evaluation& e : left)
            (tester_.extend(e, std::min(n, task_.requirement.gyros), hopeless_sigmas, on_gyro) ? passed : tried_)
                .push_back(std::move(e));
        left = std::move(passed);
    }
    promising_.assign(left.rbegin(), left.rend());
}

std::optional<Evaluation> Search::next(const std::function<void()>& on_gyro) {
    while (true) {
        while (promising_.empty() && (method_ < methods_.all.size() || !waiting_.empty())) refill(on_gyro);
        if (promising_.empty()) return std::nullopt;
        Evaluation e = std::move(promising_.back());
        promising_.pop_back();
        bool is_left = true;
        for (const std::int64_t n : last_rounds)
            is_left = is_left && tester_.extend(e, std::min(n, task_.requirement.gyros), hopeless_sigmas, on_gyro);
        tried_.push_back(e);
        if (is_left && e.share(task_.requirement.limit_arcsec()) >= task_.requirement.confidence) return e;
    }
}

std::optional<Evaluation> Search::runner_up(const Method& chosen) {
    const auto passed = std::find_if(promising_.rbegin(), promising_.rend(),
                                     [&](const Evaluation& e) { return !(e.candidate.method == chosen); });
    if (passed != promising_.rend()) return *passed;
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
    std::vector<std::pair<double, Candidate>> ranked;
    for (const Method& method : methods_.all)
        for (const Candidate& c : candidates(task_.requirement, method))
            ranked.emplace_back(forecast_.parts(c).sum(), c);
    std::ranges::stable_sort(ranked, {}, &std::pair<double, Candidate>::first);
    std::vector<Candidate> found;
    for (std::size_t k = 0; k < ranked.size() && found.size() < n; ++k) {
        // One interval of each method: neighbours would fill the list.
        const Method& m = ranked[k].second.method;
        if (std::ranges::none_of(found, [&](const Candidate& c) { return c.method == m; }))
            found.push_back(ranked[k].second);
    }
    return found;
}

}  // namespace zlg::choice
