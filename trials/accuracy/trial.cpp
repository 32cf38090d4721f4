#include "trial.hpp"

#include <array>
#include <cmath>
#include <limits>

#include <zlg/rig/replay.hpp>

#include "synthetic/gyro.hpp"

namespace zlg::trials {
namespace {

// A switch disturbs nothing earlier before it and nothing later after it.
constexpr std::int64_t lead_ticks = 8;
constexpr std::int64_t trail_ticks = 56;
constexpr std::int64_t disturbed_ticks = 20;
constexpr std::int64_t drain_ticks = 80;  // until every final value is known

std::vector<std::int64_t> openings_of(const SwitchTrial& trial) {
    chance::Draw draw{trial.seed, chance::Cause::switch_opening};
    std::vector<std::int64_t> openings;
    std::int64_t tick = trial.learn_ticks;
    for (int k = 0; k < trial.switches; ++k) {
        openings.push_back(tick);
        tick += trial.interval_ticks +
                static_cast<std::int64_t>(static_cast<double>(trial.interval_ticks) / 8.0 * draw.uniform());
    }
    return openings;
}

// Which switch a tick belongs to; for ticks that come in their order.
class Windows {
public:
    Windows(const std::vector<std::int64_t>& openings, int gap_ticks) : openings_{openings}, gap_ticks_{gap_ticks} {}

    [[nodiscard]] std::size_t size() const { return openings_.size(); }
    [[nodiscard]] std::int64_t first(std::size_t k) const { return openings_[k] - lead_ticks; }
    [[nodiscard]] std::int64_t last(std::size_t k) const { return closing(k) + trail_ticks - 1; }
    [[nodiscard]] std::int64_t opening(std::size_t k) const { return openings_[k]; }
    [[nodiscard]] std::int64_t closing(std::size_t k) const { return openings_[k] + gap_ticks_; }

    // The switch, or -1 between switches.
    std::ptrdiff_t of(std::int64_t tick) {
        while (at_ < size() && tick > last(at_)) ++at_;
        return at_ < size() && tick >= first(at_) ? static_cast<std::ptrdiff_t>(at_) : -1;
    }

private:
    const std::vector<std::int64_t>& openings_;
    int gap_ticks_;
    std::size_t at_ = 0;
};

// What is true of a tick, or of the window of a switch: rotation, random walk, rounding of the counter (of a window at
// its end less at its beginning), sign of the false angle.
struct Truth {
    double rotation_arcsec = 0.0, walk_arcsec = 0.0, rounding_arcsec = 0.0;
    int sign = 1;
};

// One method and its errors, switch by switch.
class MethodErrors {
public:
    MethodErrors(const AccuracyMethod& method, const Windows& windows)
        : replay_{method.config},
          windows_{windows},
          errors_(windows.size(), {.sigma_arcsec = std::numeric_limits<double>::infinity()}) {}

    void add(const SyntheticHalf& half) {
        replay_.take(
            half.record, half.light, [this](const core::AngleRow& row) { add(row); },
            [this](const core::GapReport& gap) { add(gap); });
    }

    // To be called before the second half of the tick is added.
    void set_truth(std::int64_t tick, double true_arcsec) { true_of(tick) = true_arcsec; }

    [[nodiscard]] std::vector<SwitchError> against(const std::vector<Truth>& truth) const {
        std::vector<SwitchError> errors = errors_;
        for (std::size_t k = 0; k < errors.size(); ++k) {
            errors[k].error_arcsec -= truth[k].rotation_arcsec + truth[k].rounding_arcsec;
            errors[k].sign = truth[k].sign;
        }
        return errors;
    }

private:
    void add(const core::AngleRow& row) {
        const std::ptrdiff_t in = windows_.of(row.tick);
        if (in < 0) return;
        const auto k = static_cast<std::size_t>(in);
        SwitchError& e = errors_[k];
        e.error_arcsec += row.dtheta_final_arcsec;
        if (row.tick < windows_.opening(k) || row.tick >= windows_.closing(k)) return;
        if (!(row.sigma_arcsec > 0.0 && std::isfinite(row.sigma_arcsec))) return;
        const double error = row.dtheta_final_arcsec - true_of(row.tick);
        e.tick_squares += (error / row.sigma_arcsec) * (error / row.sigma_arcsec);
        ++e.ticks_claimed;
    }

    void add(const core::GapReport& gap) {
        while (at_gap_ < windows_.size() && windows_.opening(at_gap_) < gap.first_tick) ++at_gap_;
        if (at_gap_ < windows_.size() && windows_.opening(at_gap_) == gap.first_tick)
            errors_[at_gap_].sigma_arcsec = gap.sigma_sum_arcsec;
    }

    double& true_of(std::int64_t tick) { return true_arcsec_[static_cast<std::size_t>(tick) % true_arcsec_.size()]; }

    rig::Replay replay_;
    Windows windows_;
    std::size_t at_gap_ = 0;
    std::vector<SwitchError> errors_;
    std::array<double, 128> true_arcsec_{};  // of the latest ticks: more than a final row is late
};

// One tick of the gyro through every method.
Truth advance_tick(std::int64_t tick, SyntheticGyro& gyro, std::vector<MethodErrors>& methods) {
    Truth now;
    for (int h = 0; h < 2; ++h) {
        const SyntheticHalf half = gyro.advance();
        // The magnetic drift of either mode is no error of the switch between them.
        now.rotation_arcsec += half.true_arcsec + half.magnetic_arcsec;
        now.walk_arcsec += half.walk_arcsec;
        now.rounding_arcsec = half.rounding_arcsec;
        if (h == 0) now.sign = half.record.bias_sign * half.record.mode;
        for (MethodErrors& m : methods) {
            if (h == 1) m.set_truth(tick, now.rotation_arcsec);
            m.add(half);
        }
    }
    return now;
}

}  // namespace

std::vector<std::vector<SwitchError>> run_trial(const SwitchTrial& trial, const std::vector<AccuracyMethod>& methods) {
    const std::vector<std::int64_t> openings = openings_of(trial);
    SyntheticGyro gyro{trial.gyro, trial.motion, trial.seed};
    Windows windows{openings, trial.gyro.gap_ticks};
    std::vector<MethodErrors> compensated;
    for (const AccuracyMethod& m : methods) compensated.emplace_back(m, windows);
    std::vector<Truth> truth(openings.size());
    double rounding_before_arcsec = 0.0;
    std::size_t next = 0;
    for (std::int64_t tick = 0; tick <= windows.last(openings.size() - 1) + drain_ticks; ++tick) {
        if (next < openings.size() && tick == openings[next]) {
            gyro.open();
            ++next;
        }
        const Truth now = advance_tick(tick, gyro, compensated);
        if (const std::ptrdiff_t in = windows.of(tick); in >= 0) {
            const auto k = static_cast<std::size_t>(in);
            truth[k].rotation_arcsec += now.rotation_arcsec;
            // The random walk of the ticks that the switch disturbs is part of its error.
            if (tick < windows.opening(k) || tick >= windows.closing(k) + disturbed_ticks)
                truth[k].rotation_arcsec += now.walk_arcsec;
            if (tick == windows.first(k)) truth[k].rounding_arcsec -= rounding_before_arcsec;
            if (tick == windows.last(k)) truth[k].rounding_arcsec += now.rounding_arcsec;
            if (tick == windows.closing(k)) truth[k].sign = now.sign;
        }
        rounding_before_arcsec = now.rounding_arcsec;
    }
    std::vector<std::vector<SwitchError>> errors;
    for (const MethodErrors& m : compensated) errors.push_back(m.against(truth));
    return errors;
}

}  // namespace zlg::trials
