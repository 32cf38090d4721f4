#include <zlg/core/compensation/coil_asymmetry.hpp>

#include <cstddef>

#include "common/bounds.hpp"

namespace zlg::core {
namespace {

constexpr std::array<double, n_recent_means> recent_ticks{4.0, 16.0, 64.0, 256.0, 1024.0};

// Ticks of a plain mean with the variance of an exponential one. Those made of every fourth value of the shortest have up to a tenth more.
constexpr double equivalent_ticks(std::size_t k) noexcept {
    return (2.0 * recent_ticks[k] - 1.0) / (k > 0 ? 1.1 : 1.0);
}

// Squares of numbers of standard deviations.
constexpr double change_gate_sq = 36.0;
constexpr double near_sq = 4.0;

// Logarithm of the ratio of the likelihoods at which the usual asymmetry is back (cumulative sum, Page 1954).
constexpr double return_evidence = 12.0;

// By these the noise is known to 12 %.
constexpr double learning_ticks = 64.0;
constexpr double noise_ticks = 1024.0;
constexpr double max_noise_ratio = 16.0;  // of one square over the mean
constexpr std::int32_t forgetting_ticks = 400;

// A single wrong reading is no change.
constexpr double trusted_ticks = 3.0;

// With noise of 0.7 of the converter's step a fifth of the ticks repeat the one before; with less a mean does not tell parts of the step.
constexpr double max_repeated = 0.2;

// Of either filter that takes the motion within a tenth of a second out of the turn, and the time until both have settled.
constexpr double smoothing_weight = 1.0 / 16.0;
constexpr double lag_ticks = 64.0;
constexpr double settling_ticks = 96.0;

// Means of fewer ticks hold too little of a step.
constexpr double min_turned_ticks = 32.0;
// Over which the variance of a mean turn is learnt: so long that the turn before a change is seen has little part in it.
constexpr double spread_ticks = 4096.0;

constexpr double degrees = 3.0;  // of Student's distribution
constexpr double decided_odds = 1000.0;
constexpr double max_odds = 1e12;

// A sensor whose two signs differ by 10 ppm/K and that warms by 0.1 K/s: 1e-6 a second, with ticks of 5 ms.
constexpr double sensor_drift = 5e-9;  // a tick

constexpr double squared(double x) noexcept { return x * x; }

double limited_odds(double odds, double most) noexcept {
    if (!(odds * most > 1.0)) return 1.0 / most;
    return odds < most ? odds : most;
}

void add(MeanAsymmetry& mean, double ratio, double turned_arcsec) noexcept {
    if (mean.n_ticks < coil_mean_ticks) mean.n_ticks += 1.0;
    const double weight = 1.0 / mean.n_ticks;
    mean.ratio += weight * (ratio - mean.ratio);
    mean.turned_arcsec += weight * (turned_arcsec - mean.turned_arcsec);
}

void fill(CoilAsymmetryState& s, std::size_t from, const MeanAsymmetry& level) noexcept {
    for (std::size_t k = from; k < s.recent.size(); ++k) {
        s.recent[k].ratio = level.ratio;
        s.recent[k].turned_arcsec = level.turned_arcsec;
    }
}

void learn_noise(CoilAsymmetryState& s, double ratio) noexcept {
    const double found = 0.5 * squared(ratio - s.last_ratio);
    const double repeated = ratio == s.last_ratio ? 1.0 : 0.0;
    s.last_ratio = ratio;
    // A step is no noise.
    const double most = s.n_differences < learning_ticks ? found : max_noise_ratio * s.variance;
    if (s.n_differences < noise_ticks) s.n_differences += 1.0;
    const double weight = 1.0 / s.n_differences;
    s.variance += weight * ((found < most ? found : most) - s.variance);
    s.repeated += weight * (repeated - s.repeated);
}

// Turn of a tick without a part of the motion that is fast against a mean.
void smooth(CoilAsymmetryState& s, double value_arcsec) noexcept {
    s.turned_arcsec[0] += smoothing_weight * (value_arcsec - s.turned_arcsec[0]);
    s.turned_arcsec[1] += smoothing_weight * (s.turned_arcsec[0] - s.turned_arcsec[1]);
}

// A change is soonest seen by a mean that holds it in part; the next shorter one, or the last tick, holds it nearly whole.
void begin_anew(CoilAsymmetryState& s, std::size_t seen_by, double ratio) noexcept {
    if (s.change.n_ticks == 0.0) s.changed_ticks = 0.0;
    s.change = {.ratio = ratio, .turned_arcsec = s.turned_arcsec[1], .n_ticks = 1.0};
    if (seen_by > 0) {
        const RecentAsymmetry& shorter = s.recent[seen_by - 1];
        s.change = {shorter.ratio, shorter.turned_arcsec, equivalent_ticks(seen_by - 1)};
    }
    s.n_turned = s.change.n_ticks;
    s.odds_before = 1.0;
    s.odds = 1.0;
    fill(s, seen_by, s.change);
    s.return_sq = 0.0;
}

// Moves one of the means, and asks whether it is off the level.
bool is_off(CoilAsymmetryState& s, const MeanAsymmetry& level, std::size_t k, double ratio, double turned_arcsec,
            double weight) noexcept {
    RecentAsymmetry& mean = s.recent[k];
    mean.ratio += weight * (ratio - mean.ratio);
    mean.turned_arcsec += weight * (turned_arcsec - mean.turned_arcsec);
    if (s.change.n_ticks == 0.0) {
        const double found = squared(mean.turned_arcsec - s.usual.turned_arcsec);
        const double memory_ticks = s.usual.n_ticks < spread_ticks ? s.usual.n_ticks : spread_ticks;
        const double moved_ticks = k > 0 ? recent_ticks[0] : 1.0;
        mean.turned_variance_arcsec2 += moved_ticks / memory_ticks * (found - mean.turned_variance_arcsec2);
    }
    return squared(mean.ratio - level.ratio) >
           change_gate_sq * s.variance * (1.0 / equivalent_ticks(k) + 1.0 / level.n_ticks);
}

// Returns whether a new level has begun, this tick in it.
bool has_changed(CoilAsymmetryState& s, double ratio) noexcept {
    const MeanAsymmetry level = s.change.n_ticks > 0.0 ? s.change : s.usual;
    // A mean that is younger than its memory is that of the level.
    const double age_ticks = level.n_ticks + 1.0;
    std::size_t k = 0;
    const double newest = 1.0 / (age_ticks < recent_ticks[k] ? age_ticks : recent_ticks[k]);
    if (!is_off(s, level, k, ratio, s.turned_arcsec[1], newest)) {
        // The longer ones take turns, each once in four ticks, and are made of the shortest.
        s.turn = s.turn < n_recent_means - 1 ? s.turn + 1 : 1;
        k = s.turn;
        const double memory_ticks = age_ticks < recent_ticks[k] ? age_ticks : recent_ticks[k];
        const double weight = memory_ticks > recent_ticks[0] ? recent_ticks[0] / memory_ticks : 1.0;
        if (!is_off(s, level, k, s.recent[0].ratio, s.recent[0].turned_arcsec, weight)) return false;
    }
    begin_anew(s, k, ratio);
    return true;
}

double variance_of_change(const CoilAsymmetryState& s) noexcept {
    return s.variance * (1.0 / s.change.n_ticks + 1.0 / s.usual.n_ticks);
}

// Tick by tick the usual value against that since the change.
bool has_returned(CoilAsymmetryState& s, double ratio) noexcept {
    s.return_sq += squared(ratio - s.change.ratio) - squared(ratio - s.usual.ratio);
    if (s.return_sq < 0.0) s.return_sq = 0.0;
    return s.return_sq > 2.0 * return_evidence * s.variance;
}

void end_change(CoilAsymmetryState& s) noexcept {
    s.change = {};
    s.odds = 1.0;
    fill(s, 0, s.usual);
}

void add_turn(CoilAsymmetryState& s) noexcept {
    s.n_turned += 1.0;
    if (s.n_turned < 1.0) return;
    const double n = s.n_turned < coil_mean_ticks ? s.n_turned : coil_mean_ticks;
    s.change.turned_arcsec += (s.turned_arcsec[1] - s.change.turned_arcsec) / n;
}

// Of the mean turn since the change: from how such means spread before, and the readings at both ends.
double turned_variance(const CoilAsymmetryState& s, double reading_arcsec2) noexcept {
    double variance = s.recent[0].turned_variance_arcsec2;
    for (std::size_t k = 1; k < s.recent.size(); ++k)
        if (equivalent_ticks(k) <= s.n_turned && 4.0 * recent_ticks[k] <= s.usual.n_ticks)
            variance = s.recent[k].turned_variance_arcsec2;
    return variance + reading_arcsec2 / squared(s.n_turned);
}

// The smoothed turn follows a step late, so that of its mean over n ticks about 64/(n + 64) is missing.
void weigh(CoilAsymmetryState& s, const CoilTick& tick) noexcept {
    const double turned = s.change.turned_arcsec - s.usual.turned_arcsec;
    const double whole = tick.per_ratio_arcsec * (s.change.ratio - s.usual.ratio);
    const double expected = whole * s.n_turned / (s.n_turned + lag_ticks);
    // Of either: a gyro at rest, whose readings repeat, may begin to move as well as its current may change.
    const double variance =
        turned_variance(s, tick.variance_arcsec2) + squared(tick.per_ratio_arcsec) * variance_of_change(s);
    if (!(variance > 0.0)) return;
    const double ratio = (degrees * variance + squared(turned)) / (degrees * variance + squared(turned - expected));
    s.odds = limited_odds(s.odds_before * squared(ratio), max_odds);  // to the power (degrees + 1)/2
}

// Current or sensor. After a switch the turn begins anew, and its evidence is added.
void judge(CoilAsymmetryState& s, const CoilTick& tick) noexcept {
    s.changed_ticks += 1.0;
    if (!tick.measured) return;
    if (tick.mode != s.mode) {
        s.odds = s.odds_before = limited_odds(s.odds, decided_odds);
        s.n_turned = -settling_ticks;
        s.change.turned_arcsec = 0.0;
    }
    add_turn(s);
    if (s.n_turned >= min_turned_ticks) weigh(s, tick);
}

// Over, or the usual asymmetry was that of a fault, or the sensor has changed.
void look_for_end(CoilAsymmetryState& s, double ratio) noexcept {
    const double variance = variance_of_change(s);
    const bool is_over = has_returned(s, ratio) || squared(s.change.ratio - s.usual.ratio) <= near_sq * variance;
    const double less = size(s.usual.ratio) - size(s.change.ratio);
    const bool is_better = less > 0.0 && squared(less) > change_gate_sq * variance;
    const bool is_new_usual = is_better || s.odds * decided_odds < 1.0;
    if (is_new_usual) {
        s.usual.ratio = s.change.ratio;
        s.usual.n_ticks = s.change.n_ticks;
    }
    if (is_over || is_new_usual) end_change(s);
}

// No coil has less, and no reading is more.
constexpr std::int32_t max_ua = 2'000'000'000;

bool is_read(const HalfRecord& half) noexcept {
    return half.coil_ua != 0 && half.coil_ua <= max_ua && half.coil_ua >= -max_ua;
}

// A sensor whose readings have the sign of the current and cease to is stuck.
bool are_read(CoilAsymmetryState& s, const HalfRecord& first, const HalfRecord& second) noexcept {
    if (!(is_read(first) && is_read(second)) || first.bias_sign == second.bias_sign) return false;
    const bool alternates = (first.coil_ua > 0) != (second.coil_ua > 0);
    if (s.n_differences == 0.0) s.is_signed = alternates;
    return alternates == s.is_signed;
}

void follow(CoilAsymmetryState& s, double ratio, const CoilTick& tick) noexcept {
    if (s.n_differences < 1.0) {
        s.last_ratio = ratio;
        s.turned_arcsec.fill(tick.measured ? tick.value_arcsec : 0.0);
    }
    learn_noise(s, ratio);
    if (tick.measured) smooth(s, tick.value_arcsec);
    if (s.usual.n_ticks < learning_ticks) {
        add(s.usual, ratio, s.turned_arcsec[1]);
        fill(s, 0, s.usual);
    } else {
        if (!has_changed(s, ratio)) {
            if (s.change.n_ticks > 0.0) {
                if (s.change.n_ticks < coil_mean_ticks) s.change.n_ticks += 1.0;
                s.change.ratio += (ratio - s.change.ratio) / s.change.n_ticks;
            } else {
                add(s.usual, ratio, s.turned_arcsec[1]);
            }
        }
        if (s.change.n_ticks > 0.0) {
            judge(s, tick);
            look_for_end(s, ratio);
        }
    }
    if (tick.measured) s.mode = tick.mode;
}

}  // namespace

CoilAsymmetry step(CoilAsymmetryState& state, const HalfRecord& first, const HalfRecord& second,
                   const CoilTick& tick) noexcept {
    if (are_read(state, first, second)) {
        state.n_unknown = 0;
        const double first_ua = size(first.coil_ua);
        const double second_ua = size(second.coil_ua);
        follow(state, first.bias_sign * (first_ua - second_ua) / (first_ua + second_ua), tick);
    } else {
        count_up(state.n_unknown);
        if (state.n_unknown >= forgetting_ticks) state = {};
    }
    if (!(state.change.n_ticks >= trusted_ticks) || state.repeated > max_repeated) return {};
    const double ratio = state.change.ratio - state.usual.ratio;
    const double probability = state.odds / (1.0 + state.odds);
    const double drift = sensor_drift * state.changed_ticks;
    return {probability * ratio,
            variance_of_change(state) + squared(drift) + probability * (1.0 - probability) * squared(ratio)};
}

}  // namespace zlg::core
