// One gyro in closed loop, and what is said of it.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <exception>
#include <map>
#include <utility>

#include <zlg/core/common/maths.hpp>
#include <zlg/core/health.hpp>
#include <zlg/rig/closed_loop.hpp>
#include <zlg/rig/switch_count.hpp>
#include <zlg/rig/wiring.hpp>
#include <zlg/study/compensated_run.hpp>
#include <zlg/study/gyro_drift.hpp>
#include <zlg/trials/gyro_campaign.hpp>

namespace zlg::trials {
namespace {

// Bits that tell what a healthy gyro does: it switches, warms up, comes to an end of its range, turns as fast as its
// bias, shifts its edges; in the dark of a switch it has no light; before the ellipse of the photodiodes is known it
// counts whole fringes.
constexpr std::uint32_t no_alarm = core::health_switching | core::health_warming_up |
                                   core::health_piezo_near_range_end | core::health_recentring |
                                   core::health_rate_near_bias | core::health_edges_shifted | core::health_fringe_lost;

constexpr double start_s = 1.0;     // in which a gyro looks for its mode
constexpr double settled_s = 0.25;  // up to the last switch or the end, in which it must have what it needs
constexpr double max_sigmas = 5.0;

class Trial {
public:
    explicit Trial(const config::Config& config)
        : config_{config},
          drift_{config},
          motion_{rig::motion(config)},
          n_ticks_{rig::run_ticks(config, motion_)},
          loop_{config, motion_},
          count_{config},
          compensation_{config, std::max<std::int64_t>(1, n_ticks_ / 2000)},
          flags_(static_cast<std::size_t>(n_ticks_)),
          is_fine_(static_cast<std::size_t>(n_ticks_)),
          is_whole_count_(static_cast<std::size_t>(n_ticks_)) {
        compensation_.on_row = [this](const core::AngleRow& row, const study::TickTruth& truth) { take(row, truth); };
        compensation_.on_gap = [this](const core::GapReport& gap) {
            sigmas_arcsec_[gap.first_tick] = gap.sigma_sum_arcsec;
        };
    }

    GyroOutcome outcome() && {
        for (tick_ = 0; tick_ < n_ticks_; ++tick_) {
            live_through_half();
            live_through_half();
        }
        const study::ErrorMeter& meter = compensation_.end();
        out_.ticks = n_ticks_;
        out_.drift_arcsec_s = meter.drift_arcsec_s() - config_.drift.nonmagnetic_arcsec_s;
        out_.failed = count_.tally().failed;
        out_.lost = count_.tally().none_succeeded() || !ends_well();
        judge_switches(meter.switches());
        return std::move(out_);
    }

private:
    void live_through_half() {
        const rig::LoopHalf half = loop_.advance();
        count_.take(half);
        compensation_.take(half, loop_.light());
        const auto tick = static_cast<std::size_t>(tick_);
        is_whole_count_[tick] = !core::has_fringe(half.record);
        is_fine_[tick] = half.truth.lit && half.record.loop_closed && std::abs(half.truth.detuning_end_lambda) < 0.05;
        const std::uint32_t health = half.control.health;
        const bool is_between = (health & core::health_switching) == 0;
        if (is_between && static_cast<double>(tick_) * config_.gyro.tick_s > start_s) {
            for (std::size_t bit = 0; bit < out_.alarms.size(); ++bit)
                out_.alarms[bit] += ((health & ~no_alarm) >> bit) & 1U;
        }
    }

    void take(const core::AngleRow& row, const study::TickTruth& truth) {
        const bool is_valid =
            (row.flags & (core::flag_invalid | core::flag_unrepaired)) == 0 && std::isfinite(row.sigma_arcsec);
        const double error_arcsec =
            std::abs(row.dtheta_final_arcsec - truth.rotation_arcsec - drift_arcsec(row) + truth.taken_out_arcsec);
        const auto tick = static_cast<std::size_t>(row.tick);
        flags_[tick] = row.flags;
        is_fine_[tick] = is_fine_[tick] && is_valid && (row.flags & core::flag_loop_unlocked) == 0;
        out_.valid += is_valid;
        out_.unrepaired += (row.flags & core::flag_unrepaired) != 0;
        out_.wrong_ticks += is_valid && !(error_arcsec <= max_sigmas * row.sigma_arcsec);
        out_.not_finite |= !std::isfinite(row.dtheta_final_arcsec) || std::isnan(row.sigma_arcsec);
    }

    // No sigma is about the drift.
    [[nodiscard]] double drift_arcsec(const core::AngleRow& row) const {
        const double tick_s = config_.gyro.tick_s;
        const double from_s = static_cast<double>(row.tick) * tick_s;
        return drift_.nonmagnetic_arcsec_s() * tick_s + row.mode * drift_.magnetic_arcsec(from_s, from_s + tick_s);
    }

    // The end may fall into a switch: then what was before it counts.
    [[nodiscard]] bool ends_well() const {
        const double tick_s = config_.gyro.tick_s;
        const auto settled = static_cast<std::int64_t>(settled_s / tick_s);
        const auto last_fine = std::find(is_fine_.rbegin(), is_fine_.rend(), true);
        const auto at_end = static_cast<std::int64_t>(last_fine - is_fine_.rbegin());
        const std::int64_t of_a_switch = config_.switching.gap_ticks + config_.compensation.relock_ticks + settled;
        if (at_end > of_a_switch) return false;
        const auto n_fine = std::count(last_fine, std::min(is_fine_.rend(), last_fine + of_a_switch + settled), true);
        return n_fine >= settled;
    }

    void judge_switches(const std::vector<study::SwitchError>& switches) {
        double ratio_sq = 0.0;
        double error_sq = 0.0;
        for (const study::SwitchError& s : switches) {
            const auto sigma = sigmas_arcsec_.find(s.window.first_tick);
            if (s.unrepaired || sigma == sigmas_arcsec_.end() || !std::isfinite(sigma->second)) continue;
            ++out_.judged;
            const double sigmas = s.error_arcsec / core::maths::hypot(sigma->second, unknown_rounding_arcsec(s.window));
            ratio_sq += sigmas * sigmas;
            error_sq += s.error_arcsec * s.error_arcsec;
            const bool flagged = is_flagged(s.window);
            out_.flagged += flagged;
            double& worst = flagged ? out_.worst_flagged_sigmas : out_.worst_sigmas;
            worst = std::max(worst, std::abs(sigmas));
            out_.not_finite |= !std::isfinite(sigmas);
        }
        if (out_.judged == 0) return;
        out_.mean_sq_ratio = ratio_sq / static_cast<double>(out_.judged);
        out_.switch_rms_arcsec = std::sqrt(error_sq / static_cast<double>(out_.judged));
    }

    [[nodiscard]] bool is_flagged(const study::SwitchWindow& window) const {
        const auto first = flags_.begin() + window.first_tick;
        const auto last = flags_.begin() + std::min(window.last_tick + 1, n_ticks_);
        return std::any_of(first, last,
                           [](std::uint32_t flags) { return (flags & core::flag_relock_uncorrected) != 0; });
    }

    // Roundings of whole counts that are in the error and that no sigma is about, each evenly within a count. The twin
    // knows the phase of an averaged gyro; of a laser the meter's error holds those at both ends of the switch. And the
    // sigma of a polynomial is that of the gap alone, without what both its edges keep.
    [[nodiscard]] double unknown_rounding_arcsec(const study::SwitchWindow& window) const {
        const auto counts = [&](std::int64_t tick) {
            return int{tick >= 0 && is_whole_count_[static_cast<std::size_t>(tick)]};
        };
        const std::int64_t last_of_gap = window.first_tick + window.n_ticks - 1;
        int n = 0;
        if (config_.gyro.fidelity == config::Fidelity::laser)
            n += counts(window.first_tick - 1) + counts(window.last_tick);
        if (is_polynomial()) n += counts(window.first_tick - 1) + counts(last_of_gap);
        return config_.gyro.scale_arcsec * std::sqrt(n / 12.0);
    }

    [[nodiscard]] bool is_polynomial() const { return config_.compensation.bridge != core::BridgeMethod::automatic; }

    const config::Config& config_;
    study::RunDrift drift_;
    twin::Motion motion_;
    std::int64_t n_ticks_;
    rig::ClosedLoop loop_;
    rig::SwitchCount count_;
    study::MeteredCompensation compensation_;
    std::vector<std::uint32_t> flags_;              // the vectors by tick
    std::vector<bool> is_fine_;                     // lit, locked and valid
    std::vector<bool> is_whole_count_;              // at its end
    std::map<std::int64_t, double> sigmas_arcsec_;  // by the first tick of the gap
    std::int64_t tick_ = 0;
    GyroOutcome out_;
};

}  // namespace

GyroOutcome run(const GyroTrial& trial) {
    GyroOutcome out;
    try {
        out = Trial{trial.config}.outcome();
    } catch (const std::exception& error) {
        out.crash = error.what();
    }
    out.number = trial.number;
    out.fidelity = trial.config.gyro.fidelity;
    out.refused = static_cast<std::int64_t>(trial.refused.size());
    out.command = command(trial);
    return out;
}

std::string GyroOutcome::alarm_names() const {
    std::string names;
    for (std::size_t bit = 0; bit < alarms.size(); ++bit)
        if (alarms[bit] > 0) names += (names.empty() ? "" : ", ") + std::string{core::health_bit_names[bit]};
    return names;
}

}  // namespace zlg::trials
