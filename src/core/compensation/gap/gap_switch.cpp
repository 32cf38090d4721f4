#include "gap_switch.hpp"

#include <algorithm>

#include <zlg/core/common/handover.hpp>
#include <zlg/core/common/maths.hpp>
#include <zlg/core/compensation/border.hpp>

#include "common/bounds.hpp"
#include "compensation/estimate/window_covariance.hpp"
#include "gap_interpolation.hpp"

namespace zlg::core {
namespace {

// What a reading far from the centre is off by, all halves of a switch in common: the law of the bias by 1.5 %, its
// quartic term at the miss, and the detuning itself by .002 wavelength.
constexpr double law_error_ratio = 0.015;
constexpr double reading_error_lambda = 0.002;

// Beyond so many standard deviations squared, and beyond the part of the bias, a second difference is not that of a
// motion.
constexpr double limit_sq = 25.0;
constexpr double tolerated_bias_ratio = 0.02;

// Halves from the first one with light on that are points of their own.
constexpr int halves_by_halves = 16;

// Lit halves that are points; the wholes that these make too many are left to the light.
constexpr int most_lit_rows = 8;

constexpr int min_points = 3;

// Settled ticks from which on their scatter is known.
constexpr double few_ticks = 25.0;

// How far the roundings of whole counts repeat over the ticks of a mean, 0..1: at rest and at even rates they do not
// average out of it. Their correlation (window_covariance.hpp) at a few distances, the longest half of the memory of
// the bias.
double repetition(const CompensationConstants& gyro, const MotionSpread& spread) noexcept {
    const double count = gyro.scale.value();
    const double turn = 2.0 * spread.mean_half_arcsec / count;
    double least = 1.0;
    for (const double ticks : {16.0, 32.0, 64.0, 128.0}) {
        const double scatter = (spread.tick_arcsec2 + ticks * walk_arcsec2(gyro)) / (count * count);
        const double correlation = 12.0 * rounding_law(ticks * turn, scatter);
        if (correlation < least) least = correlation;
    }
    return least > 0.0 ? least : 0.0;
}

// Composes what is asked of a switch: the window of its gap, and how it is read.
class Planner {
public:
    Planner(const CompensationConstants& gyro, const GapBridgeConfig& config, const GapBridgeState& state,
            const Gap& gap, std::int64_t end, SwitchJob& job) noexcept
        : job_{job},
          window_{job.window},
          gyro_{gyro},
          config_{config},
          state_{state},
          gap_{gap},
          end_of_gap_{gap.first_tick + gap.n},
          end_{end},
          first_tick_{gap.first_tick - ticks_before_estimate},
          by_halves_{window_step_halves(config) == 1} {
        window_ = SwitchWindow{};
        window_.gap = {2 * ticks_before_estimate, 2 * static_cast<int>(ticks_before_estimate + gap.n)};
        window_.with_phase = state.with_phase;
        read_light();
        job.unread_arcsec2 = 0.0;
        job.magnetic_arcsec = state.magnetic_arcsec;
        const bool steps = end_of_gap_ < end && at(state, end_of_gap_).row.mode != gap.mode_before;
        window_.magnetic_variance_arcsec2 = steps ? state.magnetic_variance_arcsec2 : 0.0;
        if (!state.with_phase) window_.bias_variance_arcsec2 = rounding_arcsec2(gyro) * repetition(gyro, state.spread);
        for (std::int64_t t = first_tick_; t < gap.first_tick; ++t) add_tick(t);
        add_gap();
        const int after = std::min(ticks_to_last_point(config), most_ticks_after_estimate);
        const int most_rows = window_.n_rows - n_lit_ + most_points_after;
        for (int k = 0; k < after && window_.n_rows < most_rows; ++k) add_tick(end_of_gap_ + k);
        job.n_late = late_ticks();
    }

    // Points on both sides, and enough of them.
    [[nodiscard]] bool is_solvable() const noexcept {
        std::array<int, 2> n{};
        for (int r = 0; r < window_.n_rows; ++r) n[row_of(window_, r).after_gap] += row_of(window_, r).read;
        return n[0] > 0 && n[1] > 0 && n[0] + n[1] >= min_points;
    }

private:
    void read_light() noexcept {
        const SwitchLight& light = state_.light;
        const bool is_joint = config_.relock == RelockMethod::joint;
        const bool is_own = light.first_half >= 2 * gap_.first_tick && light.first_half < 2 * (end_of_gap_ + 1);
        job_.light = HalfLight::ticks;
        if (!gap_.moves) return;
        if (config_.relock_ticks == 0 || config_.relock == RelockMethod::none) {
            job_.light = HalfLight::none;
        } else if (is_joint && is_own && is_complete(light)) {
            job_.light = HalfLight::spline;
            window_.light = light.sums;
            window_.light_start = static_cast<int>(light.first_half - 2 * first_tick_);
        } else if (is_joint || config_.relock == RelockMethod::mean_square) {
            job_.light = HalfLight::records;
        }
    }

    [[nodiscard]] bool is_point(std::int64_t tick) const noexcept {
        if (tick < 0 || tick >= end_) return false;
        const HistoryTick& entry = at(state_, tick);
        if (entry.row.tick != tick || !entry.read.measured || !is_finite(entry.read.variance_arcsec2)) return false;
        return !state_.with_phase || entry.read.with_phase;
    }

    WindowRow& add(int halves) noexcept {
        WindowRow& row = window_.row[static_cast<unsigned>(window_.n_rows++)];
        row.halves = {window_.n_halves, window_.n_halves + halves};
        row.after_gap = window_.n_halves >= window_.gap.first;
        for (; window_.n_halves < row.halves.last; ++window_.n_halves) {
            const std::int64_t half = 2 * first_tick_ + window_.n_halves;
            window_.bias_sign[static_cast<unsigned>(window_.n_halves)] =
                half < 0 || half >= 2 * end_ ? std::int8_t{1} : half_reading(half).sign;
        }
        return row;
    }

    // Ticks behind the window that have light.
    [[nodiscard]] int late_ticks() const noexcept {
        if (job_.light != HalfLight::spline) return 0;
        const int seen = (window_.n_halves - window_.gap.last) / 2;
        const int lit = (window_.light.basis.halves - (window_.n_halves - window_.light_start)) / 2;
        const int behind = static_cast<int>(std::min(config_.relock_ticks, end_ - end_of_gap_)) - seen;
        return std::clamp(std::min(behind, lit), 0, most_late_ticks);
    }

    // Magnetic drift that is still in a tick.
    [[nodiscard]] double magnetic(const HistoryTick& entry) const noexcept {
        return entry.row.mode * state_.magnetic_arcsec;
    }

    [[nodiscard]] const HalfReading& half_reading(std::int64_t half) const noexcept {
        return at(state_, half / 2).read.half[static_cast<unsigned>(half % 2)];
    }

    // Adds a half as it was read, with what is taken off by its record, to the row that it is in.
    void read_half(std::int64_t index, bool wanted, WindowRow& row) noexcept {
        const HalfReading& half = half_reading(index);
        row.read = true;
        row.wanted = wanted;
        row.y_arcsec += half.angle_arcsec - 0.5 * magnetic(at(state_, index / 2));
        if (!wanted) return;
        const double d = half.false_arcsec;
        if (job_.light == HalfLight::records || half.lit) {
            row.recorded_arcsec -= d;
            row.error_arcsec2 += half.false_arcsec2;
        }
        if (!half.lit) return;
        // Of the recorded mean square D = unit m: the law, and 2 dl times the error of the detuning.
        const double unit = arcsec_per_lambda2(gyro_, gyro_.bias);
        const double common = square(law_error_ratio * d) + 4.0 * square(reading_error_lambda) * size(unit) * size(d);
        row.common_arcsec = d < 0.0 ? -square_root(common) : square_root(common);
    }

    // A half that is recorded as lit but was not alternates with the bias in another way than the two behind it do:
    // their second difference is then not one of the learnt motion. Without one nothing is believed.
    [[nodiscard]] bool fits(std::int64_t half) noexcept {
        const MotionSpread& m = state_.spread;
        if (!(m.n_ticks >= few_ticks) || half + 2 >= 2 * end_ || half + 2 > 2 * end_of_gap_ + 1) return false;
        double off = 0.0, bend = 0.0, variance = m.second_difference_arcsec2;
        constexpr double part[] = {1.0, -2.0, 1.0};
        for (int k = 0; k < 3; ++k) {
            const HalfReading& reading = half_reading(half + k);
            off += part[k] * reading.angle_arcsec;
            bend += part[k] * reading.false_arcsec;
            if (reading.false_arcsec2 > 0.0F) variance += square(part[k]) * reading.false_arcsec2;
        }
        off -= (1.0 + state_.scale.value) * bend;
        variance += (square(law_error_ratio) + state_.scale.variance) * square(bend);
        const double bias = gyro_.bias.value() * gyro_.scale.value() * gyro_.tick.value() / 2.0;
        if (square(off) <= limit_sq * variance + square(tolerated_bias_ratio * bias)) return true;
        job_.unread_arcsec2 = square(off);
        return false;
    }

    // The lit halves that reach up to the end of the gap.
    [[nodiscard]] std::int64_t first_lit_half() noexcept {
        std::int64_t h = 2 * end_of_gap_;
        const bool is_read = job_.light == HalfLight::spline || job_.light == HalfLight::records;
        if (!by_halves_ || !is_read || !is_point(end_of_gap_)) return h;
        const std::int64_t least = std::max(h - most_lit_rows, 2 * gap_.first_tick);
        const auto is_lit = [](const HalfReading& half) { return half.lit && half.false_arcsec2 >= 0.0F; };
        while (h > least && is_lit(half_reading(h - 1)) && fits(h - 1)) --h;
        return h;
    }

    void add_gap() noexcept {
        const std::int64_t lit = first_lit_half();
        const std::int64_t dark_ticks = lit / 2 - gap_.first_tick;
        const auto each = (dark_ticks + most_rows_without - 1) / most_rows_without;
        for (std::int64_t t = gap_.first_tick; t < lit / 2; t += each)
            add(2 * static_cast<int>(std::min(lit / 2 - t, each))).wanted = true;
        if (lit % 2 != 0) add(1).wanted = true;
        n_lit_ = static_cast<int>(2 * end_of_gap_ - lit);
        for (std::int64_t h = lit; h < 2 * end_of_gap_; ++h) read_half(h, true, add(1));
    }

    // One beside the gap.
    void add_tick(std::int64_t tick) noexcept {
        if (!is_point(tick)) {
            (void)add(2);
            return;
        }
        const HistoryTick& entry = at(state_, tick);
        const std::int64_t k = tick - end_of_gap_;
        const bool wanted = k >= 0 && gap_.moves && job_.light != HalfLight::none && k < config_.relock_ticks;
        const bool corrects = wanted && job_.light != HalfLight::ticks;
        const bool by_records = corrects && job_.light == HalfLight::records;
        const bool known =
            !by_records || (entry.read.half[0].false_arcsec2 >= 0.0F && entry.read.half[1].false_arcsec2 >= 0.0F);
        // By the paper's equation; or by nobody, and then the false angle alternates from half to half, and a tick has
        // little of it. Also one in which a fault may have begun unseen.
        const bool is_corrected = !corrects && (!entry.read.settled || entry.read.relock_variance_arcsec2 > 0.0);
        const bool has_halves = entry.read.half[0].read && entry.read.half[1].read;
        if (!has_halves || !known || is_corrected || (k < 0 && !by_halves_)) {
            WindowRow& row = add(2);
            row.read = true;
            row.wanted = wanted;
            row.y_arcsec = entry.row.dtheta_final_arcsec - magnetic(entry);
            row.error_arcsec2 = entry.read.relock_variance_arcsec2;
            if (wanted && state_.with_phase && config_.relock == RelockMethod::frequency)
                row.common_arcsec = other_loop_part * entry.row.relock_arcsec;
            return;
        }
        const bool apart = by_halves_ && n_lit_ + 2 * (k + 1) <= halves_by_halves;
        WindowRow& first = add(apart ? 1 : 2);
        read_half(2 * tick, wanted, first);
        read_half(2 * tick + 1, wanted, apart ? add(1) : first);
    }

    SwitchJob& job_;
    SwitchWindow& window_;
    const CompensationConstants& gyro_;
    const GapBridgeConfig& config_;
    const GapBridgeState& state_;
    const Gap& gap_;
    std::int64_t end_of_gap_;
    std::int64_t end_;
    std::int64_t first_tick_;
    bool by_halves_;
    int n_lit_ = 0;
};

// is_corrected  by the light: else the tick keeps its flags.
void set_after_tick(HistoryTick& entry, double value_arcsec, double error_arcsec2, bool is_corrected,
                    ExactSum& change) noexcept {
    const double read = entry.row.dtheta_final_arcsec + entry.row.relock_arcsec;
    change.add_difference(value_arcsec, entry.row.dtheta_final_arcsec);
    entry.row.dtheta_final_arcsec = value_arcsec;
    entry.row.relock_arcsec = read - value_arcsec;
    entry.read.variance_arcsec2 += error_arcsec2 - entry.read.relock_variance_arcsec2;
    entry.read.relock_variance_arcsec2 = error_arcsec2;
    entry.row.sigma_arcsec = deviation(entry.read.variance_arcsec2);
    if (is_corrected)
        entry.row.flags = (entry.row.flags & ~std::uint32_t{flag_relock_uncorrected}) | flag_relock_corrected;
}

// Ticks behind the window.
void correct_late_ticks(GapBridgeState& state, const Gap& gap, const SwitchJob& job, SwitchAngle& found) noexcept {
    const SwitchWindow& window = job.window;
    found.behind = gap.first_tick + gap.n + (window.n_halves - window.gap.last) / 2;
    for (int k = 0; k < job.n_late; ++k) {
        HistoryTick& entry = at(state, found.behind + k);
        const bool alternates = entry.read.half[0].sign == -entry.read.half[1].sign;
        if (!entry.read.measured || !entry.read.half[0].read || !entry.read.half[1].read || !alternates) continue;
        const double d = entry.read.half[0].sign * job.late_arcsec[static_cast<unsigned>(k)];
        const double variance = job.late_arcsec2[static_cast<unsigned>(k)] + job.scale.variance * d * d;
        const double read = entry.row.dtheta_final_arcsec + entry.row.relock_arcsec;
        set_after_tick(entry, read + (1.0 + job.scale.value) * d, variance, true, found.after_arcsec);
    }
}

// The ticks of the gap and those after it get their final values.
void set_rows(const CompensationConstants& gyro, GapBridgeState& state, const Gap& gap, const SwitchJob& job,
              SwitchAngle& out) noexcept {
    const SwitchWindow& window = job.window;
    // Of a row, counted from the first one of the gap.
    const auto tick_of = [&](int r) { return row_of(window, r).halves.first / 2 - ticks_before_estimate; };
    out.known = true;
    out.variance_arcsec2 = job.found.variance_arcsec2;
    if (job.light == HalfLight::spline || job.light == HalfLight::records) state.scale = job.found.scale;
    for (int r = 0; r < window.n_rows;) {
        const int tick = tick_of(r);
        double angle = 0.0, variance = 0.0, unread = 0.0, share = 0.0;
        int n_lit = 0;
        const WindowRow& head = row_of(window, r);
        for (const int first = r; r < window.n_rows && tick_of(r) == tick; ++r) {
            const RowEstimate& of_row = job.found.row[static_cast<unsigned>(r)];
            angle += of_row.angle_arcsec;
            variance += of_row.variance_arcsec2 + (r > first ? 2.0 * of_row.with_before_arcsec2 : 0.0);
            share += of_row.share;
            const WindowRow& row = row_of(window, r);
            n_lit += row.read;
            if (row.wanted && !row.read) unread += job.unread_arcsec2 * width(row);
        }
        out.variance_arcsec2 += unread;
        variance = (variance > 0.0 ? variance : 0.0) + unread;
        if (!head.wanted) continue;
        if (tick >= gap.n) {
            HistoryTick& entry = at(state, gap.first_tick + tick);
            const bool is_corrected = job.light == HalfLight::spline || head.recorded_arcsec != 0.0;
            set_after_tick(entry, angle + entry.row.mode * job.magnetic_arcsec, variance, is_corrected,
                           out.after_arcsec);
            continue;
        }
        // What was read of a tick has the roundings at its borders, which cancel in the angle of the switch.
        variance += 0.5 * n_lit * rounding_arcsec2(gyro, window.with_phase);
        const int n_ticks = (head.halves.last - head.halves.first + 1) / 2;
        for (int k = 0; k < n_ticks; ++k) {
            HistoryTick& entry = at(state, gap.first_tick + tick + k);
            AngleRow& row = entry.row;
            row.dtheta_final_arcsec = angle / n_ticks;
            row.sigma_arcsec = deviation(variance / n_ticks);
            row.flags = (row.flags & ~(std::uint32_t{flag_unrepaired} | flag_lower_order)) | flag_interpolated;
            if (!job.learnt) row.flags |= flag_lower_order;
            out.gap_arcsec.add_difference(row.dtheta_final_arcsec, row.dtheta_arcsec);
            entry.share = share / n_ticks;
        }
    }
    correct_late_ticks(state, gap, job, out);
}

}  // namespace

double tick_variance(const GapBridgeState& state) noexcept {
    return state.spread.n_ticks >= few_ticks ? state.spread.tick_arcsec2 : infinity;
}

void ask(const CompensationConstants& gyro, const GapBridgeConfig& config, GapBridgeState& state, PendingGap& pending,
         std::int64_t end) noexcept {
    const Gap& gap = pending.gap;
    if (!gap.has_before || !is_estimated(config) || gap.n > max_gap_ticks(config)) return;
    bool is_late = false;
    for (std::size_t k = 0; k < state.background.job.size(); ++k) {
        SwitchJob& job = state.background.job[k];
        const JobState now = taken(job.state);
        is_late = is_late || now == JobState::late;
        if (now != JobState::free) continue;
        if (!Planner{gyro, config, state, gap, end, job}.is_solvable()) return;
        job.asked_at = end;
        job.scale = state.scale;
        pending.job = static_cast<std::int8_t>(k);
        return hand_over(job.state, JobState::asked);
    }
    // For want of a place that a late one still has.
    if (is_late) ++state.background.n_late;
}

SwitchAngle take(const CompensationConstants& gyro, GapBridgeState& state, PendingGap& pending, bool late) noexcept {
    SwitchAngle out;
    if (pending.job < 0) return out;
    SwitchJob& job = state.background.job[static_cast<std::size_t>(pending.job)];
    if (late || taken(job.state) != JobState::done)
        ++state.background.n_late;
    else if (job.found.known)
        set_rows(gyro, state, pending.gap, job, out);
    if (!hand_over_if(job.state, JobState::asked, JobState::late))
        (void)hand_over_if(job.state, JobState::done, JobState::free);
    pending.job = -1;
    return out;
}

}  // namespace zlg::core
