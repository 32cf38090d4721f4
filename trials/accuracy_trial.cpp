#include "accuracy_trial.hpp"

#include <array>
#include <cmath>
#include <limits>

#include <zlg/rig/replay.hpp>

#include "accuracy_gyro.hpp"

namespace zlg::trials {
namespace {

// A switch disturbs nothing before it and nothing longer after it.
constexpr std::int64_t lead_ticks = 8;
constexpr std::int64_t trail_ticks = 56;
constexpr std::int64_t drain_ticks = 80;  // until every final value is known

std::vector<std::int64_t> openings_of(const TrialCourse& course) {
    numeric::Draw draw{course.seed ^ 0x5f3759df};
    std::vector<std::int64_t> openings;
    std::int64_t tick = course.learn_ticks;
    for (int k = 0; k < course.switches; ++k) {
        openings.push_back(tick);
        tick += course.interval_ticks +
                static_cast<std::int64_t>(static_cast<double>(course.interval_ticks) / 8.0 * draw.uniform());
    }
    return openings;
}

// Which switch a tick belongs to; for ticks that come in their order.
class Windows {
public:
    Windows(const std::vector<std::int64_t>& openings, int gap_ticks) : openings_{openings}, gap_ticks_{gap_ticks} {}

    [[nodiscard]] std::int64_t first(std::size_t k) const { return openings_[k] - lead_ticks; }
    [[nodiscard]] std::int64_t last(std::size_t k) const { return openings_[k] + gap_ticks_ + trail_ticks - 1; }

    // The switch, or -1 between switches.
    std::ptrdiff_t of(std::int64_t tick) {
        while (at_ < openings_.size() && tick > last(at_)) ++at_;
        return at_ < openings_.size() && tick >= first(at_) ? static_cast<std::ptrdiff_t>(at_) : -1;
    }

private:
    const std::vector<std::int64_t>& openings_;
    int gap_ticks_;
    std::size_t at_ = 0;
};

// What is true of each switch: rotation, false rotation, and roundings at the ends of its stretch.
struct Truth {
    double rotation_arcsec = 0.0, false_arcsec = 0.0, rounding_arcsec = 0.0;
    int sign = 1;
};

// Of one tick, both halves.
struct TickTruth {
    double rotation_arcsec = 0.0, false_arcsec = 0.0, rounding_arcsec = 0.0;
    int sign = 1;
};

class Judge {
public:
    Judge(const AccuracyMethod& method, const std::vector<std::int64_t>& openings, int gap_ticks)
        : replay_{method.config},
          windows_{openings, gap_ticks},
          openings_{openings},
          gap_ticks_{gap_ticks},
          errors_(openings.size()) {
        for (SwitchError& e : errors_) e.sigma_arcsec = std::numeric_limits<double>::infinity();
    }

    void take(const SyntheticHalf& half) {
        replay_.take(
            half.record, half.light, [this](const core::AngleRow& row) { judge(row); },
            [this](const core::GapReport& gap) { report(gap); });
    }

    // What the tick has truly turned, before it is judged.
    void see(std::int64_t tick, double true_arcsec) {
        true_arcsec_[static_cast<std::size_t>(tick) % remembered] = true_arcsec;
    }

    [[nodiscard]] std::vector<SwitchError> against(const std::vector<Truth>& truth) const {
        std::vector<SwitchError> errors = errors_;
        for (std::size_t k = 0; k < errors.size(); ++k) {
            errors[k].error_arcsec -= truth[k].rotation_arcsec + truth[k].rounding_arcsec;
            errors[k].relock_error_arcsec -= truth[k].false_arcsec;
            errors[k].sign = truth[k].sign;
        }
        return errors;
    }

private:
    static constexpr std::size_t remembered = 128;

    void judge(const core::AngleRow& row) {
        const std::ptrdiff_t k = windows_.of(row.tick);
        if (k < 0) return;
        SwitchError& e = errors_[static_cast<std::size_t>(k)];
        e.error_arcsec += row.dtheta_final_arcsec;
        e.relock_error_arcsec += row.relock_arcsec;
        const std::int64_t opening = openings_[static_cast<std::size_t>(k)];
        if (row.tick >= opening && row.tick < opening + gap_ticks_) judge_tick(row, e);
    }

    void judge_tick(const core::AngleRow& row, SwitchError& e) const {
        if (!(row.sigma_arcsec > 0.0 && std::isfinite(row.sigma_arcsec))) return;
        const double error = row.dtheta_final_arcsec - true_arcsec_[static_cast<std::size_t>(row.tick) % remembered];
        e.tick_squares += (error / row.sigma_arcsec) * (error / row.sigma_arcsec);
        ++e.ticks_claimed;
    }

    void report(const core::GapReport& gap) {
        while (at_gap_ < openings_.size() && openings_[at_gap_] < gap.first_tick) ++at_gap_;
        if (at_gap_ < openings_.size() && openings_[at_gap_] == gap.first_tick)
            errors_[at_gap_].sigma_arcsec = gap.sigma_sum_arcsec;
    }

    rig::Replay replay_;
    Windows windows_;
    const std::vector<std::int64_t>& openings_;
    int gap_ticks_;
    std::size_t at_gap_ = 0;
    std::vector<SwitchError> errors_;
    std::array<double, remembered> true_arcsec_{};
};

// Lets a tick of the gyro pass before every judge.
TickTruth advance_tick(std::int64_t tick, SyntheticGyro& gyro, std::vector<Judge>& judges) {
    TickTruth now;
    for (int h = 0; h < 2; ++h) {
        const SyntheticHalf half = gyro.advance();
        // The magnetic drift of either mode is no error of the switch between them.
        now.rotation_arcsec += half.true_arcsec + half.magnetic_arcsec;
        now.false_arcsec += half.false_arcsec;
        now.rounding_arcsec = half.rounding_arcsec;
        if (h == 0) now.sign = half.record.bias_sign * half.record.mode;
        for (Judge& judge : judges) {
            if (h == 1) judge.see(tick, now.rotation_arcsec);
            judge.take(half);
        }
    }
    return now;
}

// Gathers what is true of each switch, tick by tick.
class Witness {
public:
    Witness(const std::vector<std::int64_t>& openings, int gap_ticks)
        : openings_{openings}, gap_ticks_{gap_ticks}, windows_{openings, gap_ticks}, truth_(openings.size()) {}

    void take(std::int64_t tick, const TickTruth& now) {
        const std::ptrdiff_t in = windows_.of(tick);
        if (in >= 0) {
            const auto k = static_cast<std::size_t>(in);
            Truth& truth = truth_[k];
            truth.rotation_arcsec += now.rotation_arcsec;
            truth.false_arcsec += now.false_arcsec;
            if (tick == windows_.first(k)) truth.rounding_arcsec -= rounding_before_arcsec_;
            if (tick == windows_.last(k)) truth.rounding_arcsec += now.rounding_arcsec;
            if (tick == openings_[k] + gap_ticks_) truth.sign = now.sign;
        }
        rounding_before_arcsec_ = now.rounding_arcsec;
    }

    [[nodiscard]] const std::vector<Truth>& truth() const { return truth_; }
    [[nodiscard]] std::int64_t last_tick() const { return windows_.last(openings_.size() - 1) + drain_ticks; }

private:
    const std::vector<std::int64_t>& openings_;
    int gap_ticks_;
    Windows windows_;
    std::vector<Truth> truth_;
    double rounding_before_arcsec_ = 0.0;  // at the end of the tick before
};

}  // namespace

std::vector<std::vector<SwitchError>> run_course(const TrialCourse& course,
                                                 const std::vector<AccuracyMethod>& methods) {
    const std::vector<std::int64_t> openings = openings_of(course);
    SyntheticGyro gyro{course.gyro, course.motion, course.seed};
    std::vector<Judge> judges;
    for (const AccuracyMethod& m : methods) judges.emplace_back(m, openings, course.gyro.gap_ticks);
    Witness witness{openings, course.gyro.gap_ticks};
    std::size_t next = 0;
    for (std::int64_t tick = 0; tick <= witness.last_tick(); ++tick) {
        if (next < openings.size() && tick == openings[next]) {
            gyro.open();
            ++next;
        }
        witness.take(tick, advance_tick(tick, gyro, judges));
    }
    std::vector<std::vector<SwitchError>> errors;
    for (const Judge& judge : judges) errors.push_back(judge.against(witness.truth()));
    return errors;
}

}  // namespace zlg::trials
