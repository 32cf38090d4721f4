#include "rounding_law.hpp"

#include <zlg/core/common/maths.hpp>
#include <zlg/core/compensation/border.hpp>

namespace zlg::core {
namespace {

constexpr double two_pi_squared = 19.739208802178716;

// Newton's method for the scatter: steps at most, and the accuracy at which it stops, counts^2.
constexpr int refinements = 5;
constexpr double converged_counts2 = 1e-6;

// Beyond this variance, counts^2, the coherence is below 6e-5 and counts as 0.
constexpr double max_scatter_counts2 = 0.5;

// Distance to the nearest whole number; beyond 2^51 counts no fraction is known.
double distance_to_whole(double x) noexcept {
    constexpr double most = 2e15;
    constexpr double whole_part = 6755399441055744.0;  // 1.5 2^52: a sum with it is whole
    if (!(x < most && x > -most)) return 0.0;
    const double off = x - ((x + whole_part) - whole_part);
    return off < 0.0 ? -off : off;
}

// (1). It is even in x, so the distance to the nearest whole number is enough.
double at_steady_rate(double rotation_counts) noexcept {
    const double x = distance_to_whole(rotation_counts);
    return 0.5 * (x * x - x + 1.0 / 6.0);
}

// The coherence exp(-2 pi^2 s^2) of (2).
double coherence_of(double variance) noexcept {
    return variance < max_scatter_counts2 ? maths::exp(-two_pi_squared * variance) : 0.0;
}

// Learnt mean square of the angle of the first n = 0, 1.. ticks of a window about n times the level: sums over the
// growing upper left corners of the moments.
std::array<double, window_ticks + 1> learnt_rotation_sq(const MotionMomentsConfig& config,
                                                        const Moments& learnt) noexcept {
    std::array<double, window_ticks + 1> read{};
    if (!(learnt.n_windows > 0.0)) return read;
    const int window = window_of(config);
    Window column{};
    const double* element = learnt.sum.data();
    for (int a = 0; a < window; ++a) {
        column[static_cast<unsigned>(a)] += *element++;
        for (int b = a + 1; b < window; ++b) column[static_cast<unsigned>(b)] += 2.0 * *element++;
    }
    const int stride = samples_per_tick(config);
    double sum = 0.0;
    for (int b = 0; b < window; ++b) {
        sum += column[static_cast<unsigned>(b)];
        read[static_cast<unsigned>(b / stride + 1)] = sum / learnt.n_windows;
    }
    return read;
}

}  // namespace

double rounding_covariance(double rotation_counts, double variance_counts2) noexcept {
    return at_steady_rate(rotation_counts) * coherence_of(variance_counts2);
}

double scatter_of_rotation(double rotation_counts, double read_variance_counts2) noexcept {
    const double covariance = at_steady_rate(rotation_counts);
    const double without = read_variance_counts2 - 1.0 / 6.0;
    if (!(without < max_scatter_counts2)) return without;
    // Solve v + 1/6 - 2 R(x, v) = read variance for v. R > 0: Newton's method from v = 0, monotone because the left
    // side is concave; R <= 0: fixed-point steps to the smallest solution.
    double v = 0.0;
    for (int k = 0; k < refinements; ++k) {
        const double r = covariance * coherence_of(v);
        const double missing = without + 2.0 * r - v;
        const double slope = covariance > 0.0 ? 1.0 + 2.0 * two_pi_squared * r : 1.0;
        v += missing / slope;
        if (!(v > 0.0)) return 0.0;
        if (missing < converged_counts2 && -missing < converged_counts2) return v;
    }
    return v;
}

RoundingLaw rounding_law(double step, double rate_arcsec, const std::array<double, window_ticks + 1>& read_arcsec2,
                         bool halves, double bias_arcsec) noexcept {
    RoundingLaw law;
    if (!(step > 0.0)) return law;
    const int stride = halves ? 2 : 1;
    law.step_arcsec = step;
    law.rate_counts = rate_arcsec / step / stride;
    law.bias_counts = halves ? bias_arcsec / step : 0.0;
    std::array<double, max_window + 1> scatter{};
    for (int lag = 1; lag <= window_ticks; ++lag) {
        const auto k = static_cast<unsigned>(stride * lag);
        scatter[k] = scatter_of_rotation(law.rate_counts * stride * lag,
                                         read_arcsec2[static_cast<unsigned>(lag)] / (step * step));
        // The scatter at the middle of a tick lies between those at its ends; half of the first tick has half of its
        // angle, so a quarter.
        if (halves) scatter[k - 1] = lag > 1 ? 0.5 * (scatter[k - 2] + scatter[k]) : 0.25 * scatter[k];
    }
    for (int lag = 0; lag <= stride * window_ticks; ++lag) {
        const auto k = static_cast<unsigned>(lag);
        const double offset = lag % 2 == 0 ? 0.0 : law.bias_counts;
        law.coherent_arcsec2[k] = step * step * coherence_of(scatter[k]);
        law.arcsec2[0][k] = law.coherent_arcsec2[k] * at_steady_rate(law.rate_counts * lag + offset);
        law.arcsec2[1][k] = law.coherent_arcsec2[k] * at_steady_rate(law.rate_counts * lag - offset);
    }
    return law;
}

RoundingLaw rounding_law(const CompensationConstants& gyro, const OptimalBridgeConfig& config,
                         const MotionMomentsState& moments, bool halves, double bias_arcsec) noexcept {
    const auto read = learnt_rotation_sq(MotionMomentsConfig{config.halves}, moments.moments[fast_memory]);
    return rounding_law(gyro.scale.value(), moments.level, read, halves, bias_arcsec);
}

RoundingLaw independent_readings(double step) noexcept {
    RoundingLaw law{.step_arcsec = step};
    law.coherent_arcsec2[0] = step * step;
    law.arcsec2[0][0] = law.arcsec2[1][0] = step * step / 12.0;
    return law;
}

RoundingLaw of_whole_ticks(const RoundingLaw& halves) noexcept {
    RoundingLaw law{.step_arcsec = halves.step_arcsec, .rate_counts = 2.0 * halves.rate_counts};
    for (unsigned lag = 0; lag <= window_ticks; ++lag) {
        law.coherent_arcsec2[lag] = halves.coherent_arcsec2[2 * lag];
        law.arcsec2[0][lag] = law.arcsec2[1][lag] = halves.arcsec2[0][2 * lag];
    }
    return law;
}

void BorderWeights::add(int place, double of_point, double false_angle_arcsec, double false_variance_arcsec2) noexcept {
    const auto k = static_cast<unsigned>(place);
    const bool broken = next != place;
    const int last = next < 0 ? 0 : stretch[static_cast<unsigned>(next)];
    if (broken) stretch[k] = static_cast<std::int8_t>(last + 1);
    stretch[k + 1] = stretch[k];
    false_arcsec[k + 1] = false_arcsec[k] + false_angle_arcsec;
    false_arcsec2[k + 1] = false_arcsec2[k] + false_variance_arcsec2;
    weight[k] -= of_point;
    weight[k + 1] += of_point;
    next = place + 1;
}

void BorderWeights::add_edges() noexcept {
    weight[static_cast<unsigned>(gap_begin)] += 1.0;
    weight[static_cast<unsigned>(gap_end)] -= 1.0;
}

namespace {

using Lags = std::array<double, max_window + 1>;

// Covariances of border a with itself and with later ones, by distance, without false angles. `sign`: of the bias in
// the first half of a tick.
const Lags& from_border(const RoundingLaw& law, unsigned a, int sign) noexcept {
    return law.arcsec2[(a % 2 != 0) != (sign < 0) ? 1 : 0];
}

// Coherence between each border and the one before it, where the false angle between them is uncertain: (2) with its
// variance.
Lags coherence_across_false_angles(const RoundingLaw& law, const BorderWeights& w) noexcept {
    Lags coherence{1.0};
    for (unsigned b = 1; b < coherence.size(); ++b) {
        const double variance = w.false_arcsec2[b] - w.false_arcsec2[b - 1];
        coherence[b] = variance <= 0.0 ? 1.0 : coherence_of(variance / (law.step_arcsec * law.step_arcsec));
    }
    return coherence;
}

// Row a of c^T R c / (2 c_a): border a, counted half, and the later ones of its stretch. False angles turn the phase
// and, being uncertain, reduce the coherence.
double in_stretch(const RoundingLaw& law, const BorderWeights& w, const Lags& coherence, unsigned a,
                  int sign) noexcept {
    const Lags& row = from_border(law, a, sign);
    const double bias = a % 2 != 0 ? -sign * law.bias_counts : sign * law.bias_counts;
    double sum = 0.5 * w.weight[a] * row[0];
    double coherence_from = 1.0;
    for (unsigned b = a + 1; b < w.weight.size() && w.stretch[b] == w.stretch[a]; ++b) {
        const unsigned lag = b - a;
        const double false_rotation = w.false_arcsec[b] - w.false_arcsec[a];
        coherence_from *= coherence[b];
        double covariance = row[lag];
        if (false_rotation != 0.0 || coherence_from != 1.0)
            covariance =
                coherence_from * law.coherent_arcsec2[lag] *
                at_steady_rate(law.rate_counts * lag + (lag % 2 == 0 ? 0.0 : bias) + false_rotation / law.step_arcsec);
        sum += w.weight[b] * covariance;
    }
    return sum;
}

// The same over all later borders before `end`, without false angles: as in a window that was counted throughout.
double in_window(const RoundingLaw& law, const BorderWeights& w, unsigned a, unsigned end, int sign) noexcept {
    const Lags& row = from_border(law, a, sign);
    double sum = 0.5 * w.weight[a] * row[0];
    for (unsigned b = a + 1; b < end; ++b) sum += w.weight[b] * row[b - a];
    return sum;
}

}  // namespace

RoundingSums rounding_of(const RoundingLaw& law, const BorderWeights& w, int sign_before, int sign_after) noexcept {
    RoundingSums sums;
    if (!(law.step_arcsec > 0.0)) return sums;
    const Lags coherence = coherence_across_false_angles(law, w);
    const auto end = static_cast<unsigned>((w.next > w.gap_end ? w.next : w.gap_end) + 1);
    for (unsigned a = 0; a < end; ++a) {
        if (w.weight[a] == 0.0) continue;
        const int sign = a <= static_cast<unsigned>(w.gap_begin) ? sign_before : sign_after;
        sums.white_arcsec2 += w.weight[a] * w.weight[a] * law.step_arcsec * law.step_arcsec / 12.0;
        sums.continuing_arcsec2 += 2.0 * w.weight[a] * in_window(law, w, a, end, sign_before);
        sums.broken_arcsec2 += 2.0 * w.weight[a] * in_stretch(law, w, coherence, a, sign);
    }
    return sums;
}

}  // namespace zlg::core
