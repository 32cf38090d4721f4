#include <zlg/trials/fault_campaign.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <exception>

#include <fmt/format.h>

#include "recording.hpp"

namespace zlg::trials {
namespace {

constexpr double settled_s = 0.25;  // at the end of a run, in which a gyro must have recovered

double square(double x) { return x * x; }

bool is_valid(const core::AngleRow& row) {
    return (row.flags & (core::flag_invalid | core::flag_unrepaired)) == 0 && std::isfinite(row.sigma_arcsec);
}

// Of the first fault; without one, of what is called after.
double begin_s(const FaultTrial& trial) {
    if (!trial.fault) return trial.watched_s;
    return trial.other ? std::min(trial.fault->at_s, trial.other->at_s) : trial.fault->at_s;
}

// A range of ticks, the last one excluded.
struct Span {
    std::size_t from = 0;
    std::size_t to = 0;
};

double error_arcsec(const GyroHistory& c, Span ticks) {
    double sum = 0.0;
    for (std::size_t j = ticks.from; j < ticks.to; ++j) sum += c.rows[j].dtheta_final_arcsec - c.true_arcsec[j];
    return sum;
}

// Of the angle over these ticks. Rounding of the counter is shared by neighbours, so that only the ends of the span and
// of what was substituted in it count; what is claimed of a substitution stands in its report.
double claimed_variance(const config::Config& config, const GyroHistory& c, Span ticks) {
    const double count = config.gyro.scale_arcsec;
    const double walk = config.drift.random_walk_arcsec_sqrt_s;
    const double of_count = count * count / 6.0;
    const double of_walk = walk * walk * config.gyro.tick_s;
    const auto begins = [&](const core::GapReport& g) { return static_cast<std::size_t>(g.first_tick); };
    double sum = of_count;
    std::vector<bool> substituted(c.rows.size());
    for (const core::GapReport& gap : c.gaps) {
        const std::size_t end = begins(gap) + static_cast<std::size_t>(gap.n_ticks);
        if (end <= ticks.from || begins(gap) >= ticks.to) continue;
        sum += gap.sigma_sum_arcsec * gap.sigma_sum_arcsec + of_count;
        for (std::size_t j = begins(gap); j < end && j < c.rows.size(); ++j) substituted[j] = true;
    }
    for (std::size_t j = ticks.from; j < ticks.to; ++j) {
        if (substituted[j]) continue;
        const double sigma = c.rows[j].sigma_arcsec;
        sum += of_walk + std::max(0.0, sigma * sigma - of_count - of_walk);
    }
    return sum;
}

std::size_t tick_at(const config::Config& config, double time_s) {
    return static_cast<std::size_t>(std::max(0.0, std::floor(time_s / config.gyro.tick_s)));
}

void judge_detection(const FaultTrial& trial, const GyroHistory& faulty, const GyroHistory& healthy,
                     FaultOutcome& out) {
    const double half_s = 0.5 * trial.config.gyro.tick_s;
    const auto first = static_cast<std::size_t>(begin_s(trial) / half_s);
    const auto last = static_cast<std::size_t>(trial.watched_s / half_s);
    for (std::size_t h = first; h < std::min(last, faulty.health.size()); ++h) {
        const bool flagged = (faulty.health[h] & ~healthy.health[h]) != 0;
        if (!flagged && (faulty.half_valid[h] || !healthy.half_valid[h])) continue;
        out.detected = true;
        out.latency_s = static_cast<double>(h + 1) * half_s - begin_s(trial);
        return;
    }
}

void judge_ticks(const GyroHistory& faulty, Span watched, FaultOutcome& out) {
    for (std::size_t j = 0; j < faulty.rows.size(); ++j) {
        const bool valid = is_valid(faulty.rows[j]);
        const bool after = j >= watched.to;
        const double error = std::abs(faulty.rows[j].dtheta_final_arcsec - faulty.true_arcsec[j]);
        if (j < watched.from || after) {
            ++out.ticks_outside;
            out.valid_outside += valid;
            out.ticks_after += after;
            out.valid_after += after && valid;
            if (valid) out.error_sq_sum += square(error / faulty.rows[j].sigma_arcsec);
        }
        const bool wrong = !(error <= 5.0 * faulty.rows[j].sigma_arcsec);
        out.wrong += valid && wrong;
        out.wrong_bridged += !valid && wrong;
        if (valid) out.worst_sigmas = std::max(out.worst_sigmas, error / faulty.rows[j].sigma_arcsec);
    }
}

bool has_recovered(const config::Config& config, const GyroHistory& faulty) {
    const std::size_t n = faulty.rows.size();
    const std::size_t settled = std::min(n, tick_at(config, settled_s));
    for (std::size_t j = n - settled; j < n; ++j) {
        const bool locked = (faulty.rows[j].flags & core::flag_loop_unlocked) == 0;
        if (!is_valid(faulty.rows[j]) || !locked || !faulty.lit[j] || !(std::abs(faulty.detuning_lambda[j]) < 0.05))
            return false;
    }
    return true;
}

FaultOutcome judged(const FaultTrial& trial, const GyroHistory& faulty, const GyroHistory& healthy) {
    FaultOutcome out;
    if (faulty.rows.size() != faulty.true_arcsec.size()) {
        out.crash = fmt::format("{} final rows of {} ticks", faulty.rows.size(), faulty.true_arcsec.size());
        return out;
    }
    out.not_finite = faulty.not_finite;
    const std::size_t n = faulty.rows.size();
    const Span watched{std::min(n, tick_at(trial.config, begin_s(trial))),
                       std::min(n, tick_at(trial.config, trial.watched_s) + 1)};
    judge_ticks(faulty, watched, out);
    out.recovered = has_recovered(trial.config, faulty);
    if (!trial.fault) return out;
    judge_detection(trial, faulty, healthy, out);
    out.angle_error_arcsec = error_arcsec(faulty, watched) - error_arcsec(healthy, watched);
    out.angle_sigma_arcsec =
        std::sqrt(claimed_variance(trial.config, faulty, watched) + claimed_variance(trial.config, healthy, watched));
    return out;
}

}  // namespace

FaultOutcome run(const FaultTrial& trial) {
    config::Config faulty = trial.config;
    for (const auto& fault : {trial.fault, trial.other}) {
        if (!fault) continue;
        faulty.faults.kind.push_back(fault->kind);
        faulty.faults.at_s.push_back(fault->at_s);
        faulty.faults.duration_s.push_back(fault->duration_s);
        faulty.faults.size.push_back(fault->size);
    }
    try {
        const GyroHistory history = simulate(faulty, trial.end_s);
        return judged(trial, history, trial.fault ? simulate(trial.config, trial.end_s) : history);
    } catch (const std::exception& error) {
        FaultOutcome out;
        out.crash = error.what();
        return out;
    }
}

}  // namespace zlg::trials
