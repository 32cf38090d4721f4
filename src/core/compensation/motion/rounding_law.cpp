#include "rounding_law.hpp"

#include <zlg/core/common/maths.hpp>

namespace zlg::core {
namespace {

constexpr double two_pi_squared = 19.739208802178716;
constexpr int refinements = 5;

// Beyond this much of scatter, in counts^2, nothing is left of a covariance.
constexpr double most_scatter = 0.5;

double fraction(double x) noexcept {
    // Beyond 2^53 counts no fraction is known.
    constexpr double most = 9e15;
    if (!(x < most && x > -most)) return 0.0;
    const double whole = static_cast<double>(static_cast<std::int64_t>(x));
    return x >= whole ? x - whole : x - whole + 1.0;
}

double at_steady_rate(double turned_counts) noexcept {
    const double x = fraction(turned_counts);
    return 0.5 * (x * x - x + 1.0 / 6.0);
}

double left_of(double covariance, double variance) noexcept {
    return variance < most_scatter ? covariance * exponential(-two_pi_squared * variance) : 0.0;
}

// Mean square rotation over the first `lag` ticks of a window about that of the level.
void add_lag(const MotionMomentsState& state, const MotionMomentsConfig& config, int lag, double& sum) noexcept {
    const Moments& learnt = state.moments[fast_memory];
    const int stride = samples_per_tick(config);
    for (int b = stride * lag; b < stride * (lag + 1); ++b) {
        for (int a = 0; a < b; ++a) sum += 2.0 * moment(config, learnt, a, b);
        sum += moment(config, learnt, b, b);
    }
}

}  // namespace

double rounding_covariance(double turned_counts, double variance_counts2) noexcept {
    return left_of(at_steady_rate(turned_counts), variance_counts2);
}

double scatter_of_rotation(double turned_counts, double read_variance_counts2) noexcept {
    const double covariance = at_steady_rate(turned_counts);
    const double without = read_variance_counts2 - 1.0 / 6.0;
    if (!(without < most_scatter)) return without;
    // Of v + 1/6 - 2 R(v) = read variance: by Newton from the left where R falls, else step by step to the first solution.
    double v = 0.0;
    for (int k = 0; k < refinements; ++k) {
        const double r = left_of(covariance, v);
        const double missing = without + 2.0 * r - v;
        const double slope = covariance > 0.0 ? 1.0 + 2.0 * two_pi_squared * r : 1.0;
        v += missing / slope;
        if (!(v > 0.0)) return 0.0;
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
    for (int lag = 1; lag <= window_ticks; ++lag) {
        const auto k = static_cast<unsigned>(stride * lag);
        law.scatter_counts2[k] = scatter_of_rotation(law.rate_counts * stride * lag,
                                                     read_arcsec2[static_cast<unsigned>(lag)] / (step * step));
        // In the midst of a tick it is between those of its ends; in the first it begins at none.
        if (halves)
            law.scatter_counts2[k - 1] =
                lag > 1 ? 0.5 * (law.scatter_counts2[k - 2] + law.scatter_counts2[k]) : 0.25 * law.scatter_counts2[k];
    }
    for (int lag = 0; lag <= stride * window_ticks; ++lag) {
        const auto k = static_cast<unsigned>(lag);
        const double offset = lag % 2 == 0 ? 0.0 : law.bias_counts;
        law.arcsec2[0][k] = step * step * rounding_covariance(law.rate_counts * lag + offset, law.scatter_counts2[k]);
        law.arcsec2[1][k] = step * step * rounding_covariance(law.rate_counts * lag - offset, law.scatter_counts2[k]);
    }
    return law;
}

RoundingLaw rounding_law(const OptimalBridgeConfig& config, const MotionMomentsState& moments, bool halves,
                         double bias_arcsec) noexcept {
    std::array<double, window_ticks + 1> read{};
    double sum = 0.0;
    for (int lag = 1; lag <= window_ticks; ++lag) {
        add_lag(moments, MotionMomentsConfig{config.halves}, lag - 1, sum);
        read[static_cast<unsigned>(lag)] = sum;
    }
    return rounding_law(config.counter_step.value(), moments.level, read, halves, bias_arcsec);
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

// Of two borders, of which b is not before a.
double by_distance(const RoundingLaw& law, int a, int b, int sign) noexcept {
    const bool middle = (a % 2 != 0) != (sign < 0);
    return law.arcsec2[middle ? 1 : 0][static_cast<unsigned>(b - a)];
}

// The same on one side of the gap, where a false angle turns the phase as well.
double on_one_side(const RoundingLaw& law, const BorderWeights& w, unsigned a, unsigned b, int sign) noexcept {
    const double turned = w.false_arcsec[b] - w.false_arcsec[a];
    const double variance = w.false_arcsec2[b] - w.false_arcsec2[a];
    const int lag = static_cast<int>(b - a);
    if (turned == 0.0 && variance == 0.0) return by_distance(law, static_cast<int>(a), static_cast<int>(b), sign);
    const double offset = lag % 2 == 0 ? 0.0 : a % 2 != 0 ? -sign * law.bias_counts : sign * law.bias_counts;
    const double step_sq = law.step_arcsec * law.step_arcsec;
    return step_sq * rounding_covariance(law.rate_counts * lag + offset + turned / law.step_arcsec,
                                         law.scatter_counts2[b - a] + variance / step_sq);
}

}  // namespace

RoundingSums rounding_of(const RoundingLaw& law, const BorderWeights& w, int sign_before, int sign_after) noexcept {
    RoundingSums sums;
    if (!(law.step_arcsec > 0.0)) return sums;
    for (unsigned b = 0; b < w.weight.size(); ++b) {
        if (w.weight[b] == 0.0) continue;
        const int sign = b <= static_cast<unsigned>(w.gap_begin) ? sign_before : sign_after;
        sums.white_arcsec2 += w.weight[b] * w.weight[b] * law.step_arcsec * law.step_arcsec / 12.0;
        for (unsigned a = 0; a <= b; ++a) {
            const double product = (a == b ? 1.0 : 2.0) * w.weight[a] * w.weight[b];
            if (product == 0.0) continue;
            sums.continuing_arcsec2 +=
                product * by_distance(law, static_cast<int>(a), static_cast<int>(b), sign_before);
            if (w.stretch[a] == w.stretch[b]) sums.broken_arcsec2 += product * on_one_side(law, w, a, b, sign);
        }
    }
    return sums;
}

}  // namespace zlg::core
