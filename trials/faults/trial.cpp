#include <zlg/trials/fault_campaign.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <zlg/rig/asked_compensation.hpp>
#include <zlg/rig/closed_loop.hpp>
#include <zlg/rig/replay.hpp>
#include <zlg/rig/wiring.hpp>

namespace zlg::trials {
namespace {

// One gyro in closed loop, half by half and tick by tick.
struct GyroHistory {
    std::vector<std::uint32_t> health;  // of each half
    std::vector<bool> half_valid;
    std::vector<double> true_arcsec;  // of each tick
    std::vector<core::AngleRow> rows;
    std::vector<core::GapReport> gaps;
    std::vector<double> detuning_lambda;  // of each tick, at its end
    std::vector<bool> lit;
    bool not_finite = false;
};

bool is_finite(const core::HalfRecord& r) {
    return std::isfinite(r.detuning_lambda) && std::isfinite(r.detuning_sq_lambda2) && std::isfinite(r.piezo_v) &&
           std::isfinite(r.temperature_c);
}

bool is_finite(const core::ActuatorFrame& a) {
    return std::ranges::all_of(a.set_point_v, [](double v) { return std::isfinite(v); });
}

bool is_finite(const core::AngleRow& r) {
    return std::isfinite(r.dtheta_arcsec) && std::isfinite(r.dtheta_final_arcsec) && !std::isnan(r.sigma_arcsec);
}

class Recorder {
public:
    Recorder(const config::Config& config, double end_s)
        : replay_{rig::asked_compensation(config)},
          loop_{config, rig::motion(config)},
          n_ticks_{std::llround(end_s / config.gyro.tick_s)} {}

    GyroHistory record() {
        for (std::int64_t tick = 0; tick < n_ticks_; ++tick) add_tick();
        replay_.end([this](const core::AngleRow& row) { add(row); },
                    [this](const core::GapReport& gap) { history_.gaps.push_back(gap); });
        return std::move(history_);
    }

private:
    void add_tick() {
        double turned_arcsec = 0.0;
        bool lit = true;
        double detuning_lambda = 0.0;
        for (int k = 0; k < 2; ++k) {
            const rig::LoopHalf half = loop_.advance();
            history_.health.push_back(half.control.health);
            history_.half_valid.push_back(half.record.valid);
            history_.not_finite |= !is_finite(half.record) || !is_finite(half.control.actuator);
            turned_arcsec += half.truth.dtheta_arcsec;
            lit = lit && half.truth.lit;
            detuning_lambda = half.truth.detuning_end_lambda;
            const core::CompensationOutput out = replay_.take(
                half.record, {}, [this](const core::AngleRow& row) { add(row); },
                [this](const core::GapReport& gap) { history_.gaps.push_back(gap); });
            history_.not_finite |= !std::isfinite(out.angle_arcsec) || !std::isfinite(out.sample.dtheta_arcsec);
        }
        history_.true_arcsec.push_back(turned_arcsec);
        history_.lit.push_back(lit);
        history_.detuning_lambda.push_back(detuning_lambda);
    }

    void add(const core::AngleRow& row) {
        history_.not_finite |= !is_finite(row);
        history_.rows.push_back(row);
    }

    rig::Replay replay_;
    rig::ClosedLoop loop_;
    std::int64_t n_ticks_;
    GyroHistory history_;
};

// errors  config::ConfigError.
GyroHistory simulate(const config::Config& config, double end_s) { return Recorder{config, end_s}.record(); }

constexpr double settled_s = 0.25;  // at the end of a run, in which a gyro must have recovered

double square(double x) { return x * x; }

bool is_valid(const core::AngleRow& row) {
    return (row.flags & (core::flag_invalid | core::flag_unrepaired)) == 0 && std::isfinite(row.sigma_arcsec);
}

// Of the first fault; without one, of what is called after.
double begin_s(const FaultTrial& trial) {
    if (!trial.fault) return trial.watched_s;
    double first_s = trial.fault->at_s;
    for (const twin::Fault& other : trial.others) first_s = std::min(first_s, other.at_s);
    return first_s;
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
    out.ticks = static_cast<std::int64_t>(n);
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
    std::vector<twin::Fault> all = trial.others;
    if (trial.fault) all.insert(all.begin(), *trial.fault);
    for (const twin::Fault& fault : all) {
        faulty.faults.kind.push_back(fault.kind);
        faulty.faults.at_s.push_back(fault.at_s);
        faulty.faults.duration_s.push_back(fault.duration_s);
        faulty.faults.size.push_back(fault.size);
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
