#include "rounding_law.hpp"

#include <zlg/core/common/maths.hpp>

namespace zlg::core {
namespace {

constexpr double two_pi_squared = 19.739208802178716;
constexpr int refinements = 5;
constexpr double close_enough = 1e-6;

// Beyond this much of scatter, in counts^2, nothing is left of a covariance.
constexpr double max_scatter = 0.5;

// Distance to the nearest whole number; beyond 2^51 counts no fraction is known.
double beside_whole(double x) noexcept {
    constexpr double most = 2e15;
    constexpr double whole_part = 6755399441055744.0;  // 1.5 2^52: a sum with it is whole
    if (!(x < most && x > -most)) return 0.0;
    const double off = x - ((x + whole_part) - whole_part);
    return off < 0.0 ? -off : off;
}

double at_steady_rate(double turned_counts) noexcept {
    const double x = beside_whole(turned_counts);
    return 0.5 * (x * x - x + 1.0 / 6.0);
}

// What a scatter leaves of a covariance.
double left_by(double variance) noexcept {
    return variance < max_scatter ? exponential(-two_pi_squared * variance) : 0.0;
}

// Mean square of the first 0, 1.. ticks of a window about that of the level: sums over growing corners of the moments.
std::array<double, window_ticks + 1> read_by(const MotionMomentsConfig& config, const Moments& learnt) noexcept {
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

double rounding_covariance(double turned_counts, double variance_counts2) noexcept {
    return at_steady_rate(turned_counts) * left_by(variance_counts2);
}

double scatter_of_rotation(double turned_counts, double read_variance_counts2) noexcept {
    const double covariance = at_steady_rate(turned_counts);
    const double without = read_variance_counts2 - 1.0 / 6.0;
    if (!(without < max_scatter)) return without;
    // Of v + 1/6 - 2 R(v) = read variance: by Newton from the left where R falls, else step by step to the first solution.
    double v = 0.0;
    for (int k = 0; k < refinements; ++k) {
        const double r = covariance * left_by(v);
        const double missing = without + 2.0 * r - v;
        const double slope = covariance > 0.0 ? 1.0 + 2.0 * two_pi_squared * r : 1.0;
        v += missing / slope;
        if (!(v > 0.0)) return 0.0;
        if (missing < close_enough && -missing < close_enough) return v;
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
        // In the midst of a tick it is between those of its ends; in the first it begins at none.
        if (halves) scatter[k - 1] = lag > 1 ? 0.5 * (scatter[k - 2] + scatter[k]) : 0.25 * scatter[k];
    }
    for (int lag = 0; lag <= stride * window_ticks; ++lag) {
        const auto k = static_cast<unsigned>(lag);
        const double offset = lag % 2 == 0 ? 0.0 : law.bias_counts;
        law.left_arcsec2[k] = step * step * left_by(scatter[k]);
        law.arcsec2[0][k] = law.left_arcsec2[k] * at_steady_rate(law.rate_counts * lag + offset);
        law.arcsec2[1][k] = law.left_arcsec2[k] * at_steady_rate(law.rate_counts * lag - offset);
    }
    return law;
}

RoundingLaw rounding_law(const OptimalBridgeConfig& config, const MotionMomentsState& moments, bool halves,
                         double bias_arcsec) noexcept {
    const auto read = read_by(MotionMomentsConfig{config.halves}, moments.moments[fast_memory]);
    return rounding_law(config.counter_step.value(), moments.level, read, halves, bias_arcsec);
}

RoundingLaw of_whole_ticks(const RoundingLaw& halves) noexcept {
    RoundingLaw law{.step_arcsec = halves.step_arcsec, .rate_counts = 2.0 * halves.rate_counts};
    for (unsigned lag = 0; lag <= window_ticks; ++lag) {
        law.left_arcsec2[lag] = halves.left_arcsec2[2 * lag];
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

// Covariances of border a with itself and with later ones, where no false angle turns the phase.
const Lags& from_border(const RoundingLaw& law, unsigned a, int sign) noexcept {
    return law.arcsec2[(a % 2 != 0) != (sign < 0) ? 1 : 0];
}

// What is not known of the false angle between each border and the one before it leaves of a covariance.
Lags left_by_false(const RoundingLaw& law, const BorderWeights& w) noexcept {
    Lags left{1.0};
    for (unsigned b = 1; b < left.size(); ++b) {
        const double variance = w.false_arcsec2[b] - w.false_arcsec2[b - 1];
        left[b] = variance <= 0.0 ? 1.0 : left_by(variance / (law.step_arcsec * law.step_arcsec));
    }
    return left;
}

// Weighted sum over border a, counted half, and the later ones of its stretch, where false angles turn the phase.
double in_stretch(const RoundingLaw& law, const BorderWeights& w, const Lags& left, unsigned a, int sign) noexcept {
    const Lags& row = from_border(law, a, sign);
    const double bias = a % 2 != 0 ? -sign * law.bias_counts : sign * law.bias_counts;
    double sum = 0.5 * w.weight[a] * row[0];
    double left_from = 1.0;
    for (unsigned b = a + 1; b < w.weight.size() && w.stretch[b] == w.stretch[a]; ++b) {
        const unsigned lag = b - a;
        const double turned = w.false_arcsec[b] - w.false_arcsec[a];
        left_from *= left[b];
        double covariance = row[lag];
        if (turned != 0.0 || left_from != 1.0)
            covariance = left_from * law.left_arcsec2[lag] *
                         at_steady_rate(law.rate_counts * lag + (lag % 2 == 0 ? 0.0 : bias) + turned / law.step_arcsec);
        sum += w.weight[b] * covariance;
    }
    return sum;
}

// The same over all later borders before `end`, without false angles.
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
    const Lags left = left_by_false(law, w);
    const auto end = static_cast<unsigned>((w.next > w.gap_end ? w.next : w.gap_end) + 1);
    for (unsigned a = 0; a < end; ++a) {
        if (w.weight[a] == 0.0) continue;
        const int sign = a <= static_cast<unsigned>(w.gap_begin) ? sign_before : sign_after;
        sums.white_arcsec2 += w.weight[a] * w.weight[a] * law.step_arcsec * law.step_arcsec / 12.0;
        sums.continuing_arcsec2 += 2.0 * w.weight[a] * in_window(law, w, a, end, sign_before);
        sums.broken_arcsec2 += 2.0 * w.weight[a] * in_stretch(law, w, left, a, sign);
    }
    return sums;
}

}  // namespace zlg::core
