#include "relock_onset.hpp"

#include <zlg/core/common/maths.hpp>

#include "relock_chain.hpp"

namespace zlg::core {
namespace {

// Prior weight of the onset 0 over each of the 32 others: a loop without dead time is the usual case. By trial on the
// loops of docs/compensation.md.
constexpr double weight_at_once = 2.0;

// Likelihood relative to the best one below which an onset is left out: it would not change the average.
constexpr double min_weight = 1e-9;

struct Sample {
    double u = 0.0;  // halves since the loop was closed
    double lambda = 0.0;
    double weight = 1.0;
};

// Of the first tick, in order of time.
Sample sample(const RelockProfileState& s, std::int32_t index) noexcept {
    const std::size_t half = index < s.n_samples ? 0 : 1;
    const auto within = static_cast<std::size_t>(half == 0 ? index : index - s.n_samples);
    return {(static_cast<double>(index) + 0.5) / s.n_samples, s.first_tick_lambda[half][within], s.halves[half].weight};
}

// Move the samples after w into the tail; `origin` is that of w, in halves since the loop was closed. Onsets come
// from late to early, so that the tail only grows.
void extend(const RelockProfileState& s, double w, double origin, RelockTail& tail) noexcept {
    while (tail.n_before > 0) {
        const Sample x = sample(s, tail.n_before - 1);
        const double at = x.u - origin;
        if (!(at > w)) return;
        double power = x.weight;
        for (std::size_t p = 0; p < 7; ++p) {
            tail.powers[p] += power;
            if (p < 4) tail.moments[p] += power * x.lambda;
            power *= at;
        }
        tail.before_weight -= x.weight;
        tail.before_sum -= x.weight * x.lambda;
        --tail.n_before;
    }
    // All samples are in the tail: what remains is rounding.
    tail.before_weight = 0.0;
    tail.before_sum = 0.0;
}

// A symmetric form in the coefficients of a cubic whose entry (i, j) depends on i + j alone.
using Form = Vector<7>;

// F: length (value at w)^2 + integral of the square from w to `end`.
Form square_integral(double length, const Form& power, double w, double end) noexcept {
    constexpr Vector<7> part{1.0, 1.0 / 2.0, 1.0 / 3.0, 1.0 / 4.0, 1.0 / 5.0, 1.0 / 6.0, 1.0 / 7.0};
    Form form{};
    double upper = end;
    for (std::size_t p = 0; p < 7; ++p) {
        form[p] = length * power[p] + (upper - power[p] * w) * part[p];
        upper *= end;
    }
    return form;
}

// Integral of the square from -1 to 0.
constexpr Form last_half{1.0, -1.0 / 2.0, 1.0 / 3.0, -1.0 / 4.0, 1.0 / 5.0, -1.0 / 6.0, 1.0 / 7.0};

Vector<4> times(const Form& f, const Vector<4>& x) noexcept {
    Vector<4> y{};
    for (std::size_t i = 0; i < 4; ++i) y[i] = f[i] * x[0] + f[i + 1] * x[1] + f[i + 2] * x[2] + f[i + 3] * x[3];
    return y;
}

// tr(F C).
double sum_of_products(const Form& f, const Matrix<4>& c) noexcept {
    return f[0] * c[0][0] + 2.0 * f[1] * c[0][1] + f[2] * (2.0 * c[0][2] + c[1][1]) + 2.0 * f[3] * (c[0][3] + c[1][2]) +
           f[4] * (2.0 * c[1][3] + c[2][2]) + 2.0 * f[5] * c[2][3] + f[6] * c[3][3];
}

// Estimate for one onset of m_0, m_1 and of z after the first tick.
struct Outcome {
    Vector<5> value{};
    Matrix<5> covariance{};  // lower triangle
};

void scale(RelockMixture& m, double factor) noexcept {
    m.weight *= factor;
    for (std::size_t i = 0; i < 5; ++i) {
        m.sum[i] *= factor;
        for (std::size_t j = 0; j <= i; ++j) {
            m.sum_sq[i][j] *= factor;
            m.within[i][j] *= factor;
        }
    }
}

// Weight of this onset relative to the best one so far. A better one becomes the best, and the sums are scaled to it.
double weigh(RelockMixture& m, double log_likelihood, double prior) noexcept {
    const bool is_first = !(m.weight > 0.0);
    if (!is_first && log_likelihood <= m.log_best) return prior * maths::exp(log_likelihood - m.log_best);
    if (!is_first) scale(m, maths::exp(m.log_best - log_likelihood));
    m.log_best = log_likelihood;
    return prior;
}

void add(RelockMixture& m, double weight, const Outcome& o) noexcept {
    m.weight += weight;
    for (std::size_t i = 0; i < 5; ++i) {
        const double part = weight * o.value[i];
        m.sum[i] += part;
        for (std::size_t j = 0; j <= i; ++j) {
            m.sum_sq[i][j] += part * o.value[j];
            m.within[i][j] += weight * o.covariance[i][j];
        }
    }
}

struct Solution {
    Matrix<4> inverted{};
    Vector<4> x{};
    double fitted_sq = 0.0;
};

// (1): the samples after w are a cubic, those before it its value there; `later` continues from w = 0.
Solution solve(const RelockTail& tail, const RelockInformation& later, double ridge, const Form& power) noexcept {
    Matrix<4> information{};
    Vector<4> vector{};
    for (std::size_t i = 0; i < 4; ++i) {
        for (std::size_t j = 0; j < 4; ++j) information[i][j] = tail.powers[i + j] + tail.before_weight * power[i + j];
        vector[i] = tail.moments[i] + tail.before_sum * power[i];
    }
    information[3][3] += ridge;
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j) information[i][j] += later.matrix[i][j];
        vector[i] += later.vector[i];
    }
    Solution s{.inverted = inverse(information)};
    s.x = zlg::core::times(s.inverted, vector);
    s.fitted_sq = dot(vector, s.x);
    return s;
}

Form powers_of(double w) noexcept {
    Form power{};
    power[0] = 1.0;
    for (std::size_t p = 1; p < 7; ++p) power[p] = power[p - 1] * w;
    return power;
}

Outcome outcome_of(const Solution& s, const Form& first_half, const Form& second_half, double noise_sq) noexcept {
    const Vector<4> first = times(first_half, s.x);
    const Vector<4> second = times(second_half, s.x);
    const Vector<4> by_first = zlg::core::times(s.inverted, first);
    const Vector<4> by_second = zlg::core::times(s.inverted, second);
    Outcome o;
    o.value = {dot(s.x, first) - noise_sq * sum_of_products(first_half, s.inverted),
               dot(s.x, second) - noise_sq * sum_of_products(second_half, s.inverted), s.x[0], s.x[1], s.x[2]};
    o.covariance[0][0] = 4.0 * noise_sq * dot(first, by_first);
    o.covariance[1][0] = 4.0 * noise_sq * dot(first, by_second);
    o.covariance[1][1] = 4.0 * noise_sq * dot(second, by_second);
    for (std::size_t i = 0; i < 3; ++i) {
        o.covariance[i + 2][0] = 2.0 * noise_sq * by_first[i];
        o.covariance[i + 2][1] = 2.0 * noise_sq * by_second[i];
        for (std::size_t j = 0; j <= i; ++j) o.covariance[i + 2][j + 2] = noise_sq * s.inverted[i][j];
    }
    return o;
}

// One cubic from the moment to the end of the tick; w counts halves to there.
void try_one_cubic(RelockProfileState& s, double w) noexcept {
    extend(s, w, 2.0, s.tail);
    const Form power = powers_of(w);
    const Solution solved = solve(s.tail, s.information, cubic_ridge(s), power);
    const double weight = weigh(s.mixture, 0.5 * solved.fitted_sq / s.noise_sq_lambda2, 1.0);
    if (weight < min_weight) return;
    const bool in_first = w < -1.0;
    const Form first = square_integral(in_first ? w + 2.0 : 1.0, power, w, in_first ? -1.0 : w);
    const Form second = in_first ? last_half : square_integral(w + 1.0, power, w, 0.0);
    add(s.mixture, weight, outcome_of(solved, first, second, s.noise_sq_lambda2));
}

// Smoothing over the second half: from z at the middle of the tick, with its covariance with m_0, to the end of the
// tick.
Outcome outcome_of(double mean_sq_first, double variance_first, Vector<3> with_first, RelockLink link,
                   const RelockGain& second, double noise_sq) noexcept {
    const PassedHalf passed = pass(second, noise_sq, link);
    Outcome o{.value = {mean_sq_first, passed.mean_sq_lambda2, link.state[0], link.state[1], link.state[2]}};
    o.covariance[0][0] = variance_first;
    o.covariance[1][0] = dot(passed.slope, with_first);
    o.covariance[1][1] = passed.variance_lambda4;
    with_first = onward(second, with_first);
    for (std::size_t i = 0; i < 3; ++i) {
        o.covariance[i + 2][0] = with_first[i];
        o.covariance[i + 2][1] = passed.with_next[i];
        for (std::size_t j = 0; j <= i; ++j) o.covariance[i + 2][j + 2] = link.within[i][j];
    }
    return o;
}

// One cubic from the onset to the end of the first half, another in the second one; w counts halves to the middle of
// the tick.
void try_two_cubics(RelockProfileState& s, double w) noexcept {
    extend(s, w, 1.0, s.tail);
    RelockInformation later = s.information;
    const RelockGain gain = absorb(s.halves[1], s.powers, cubic_ridge(s), later);
    const Form power = powers_of(w);
    const Solution solved = solve(s.tail, later, cubic_ridge(s), power);
    const double fitted_sq = solved.fitted_sq + later.fitted_sq - s.information.fitted_sq;
    const double noise_sq = s.noise_sq_lambda2;
    const double weight = weigh(s.mixture, 0.5 * fitted_sq / noise_sq, 1.0);
    if (weight < min_weight) return;

    const Form half = square_integral(w + 1.0, power, w, 0.0);
    const Vector<4> slope = times(half, solved.x);
    const Vector<4> with = zlg::core::times(solved.inverted, slope);
    RelockLink link{.state = {solved.x[0], solved.x[1], solved.x[2]}};
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j) link.within[i][j] = noise_sq * solved.inverted[i][j];
    const double by_noise = 2.0 * noise_sq;
    add(s.mixture, weight,
        outcome_of(dot(solved.x, slope) - noise_sq * sum_of_products(half, solved.inverted),
                   2.0 * by_noise * dot(slope, with), {by_noise * with[0], by_noise * with[1], by_noise * with[2]},
                   link, gain, noise_sq));
}

// Onset 0: both halves are ordinary ones of the chain.
void try_at_once(RelockProfileState& s) noexcept {
    RelockInformation information = s.information;
    const RelockGain second = absorb(s.halves[1], s.powers, cubic_ridge(s), information);
    const RelockGain first = absorb(s.halves[0], s.powers, cubic_ridge(s), information);
    const double fitted_sq = information.fitted_sq - s.information.fitted_sq + explained(information);
    const double noise_sq = s.noise_sq_lambda2;
    const double weight = weigh(s.mixture, 0.5 * fitted_sq / noise_sq, weight_at_once);
    if (weight < min_weight) return;
    RelockLink link = start_of(information, noise_sq);
    const PassedHalf passed = pass(first, noise_sq, link);
    add(s.mixture, weight,
        outcome_of(passed.mean_sq_lambda2, passed.variance_lambda4, passed.with_next, link, second, noise_sq));
}

// In T/32 since the loop was closed.
constexpr std::int32_t tick_parts = n_onsets - 1;
constexpr std::int32_t half_parts = tick_parts / 2;
constexpr std::int32_t last_of_one_cubic = half_parts / 2;  // in the first half

RelockTail samples_of(const RelockProfileState& s, std::size_t halves) noexcept {
    RelockTail tail{.n_before = static_cast<std::int32_t>(halves) * s.n_samples};
    for (std::size_t k = 0; k < halves; ++k) {
        tail.before_weight += s.halves[k].weight * s.n_samples;
        tail.before_sum += s.halves[k].weight * s.halves[k].moments[0];
    }
    return tail;
}

}  // namespace

void try_onset(RelockProfileState& s, std::int32_t index) noexcept {
    // Onset 0, then one cubic from T down to T/2 and from T/4 down to T/32, then two cubics between T/2 and T/4: the
    // tail grows.
    constexpr std::int32_t first_in_second_half = 1;
    constexpr std::int32_t first_in_first_quarter = first_in_second_half + tick_parts - half_parts + 1;
    constexpr std::int32_t first_in_second_quarter = first_in_first_quarter + last_of_one_cubic;
    const auto w = [](std::int32_t parts) { return -static_cast<double>(parts) / half_parts; };
    if (index == first_in_second_half) s.tail = samples_of(s, 2);
    if (index == first_in_second_quarter) s.tail = samples_of(s, 1);
    if (index < first_in_second_half)
        try_at_once(s);
    else if (index < first_in_first_quarter)
        try_one_cubic(s, w(index - first_in_second_half));
    else if (index < first_in_second_quarter)
        try_one_cubic(s, w(tick_parts - last_of_one_cubic + index - first_in_first_quarter));
    else
        try_two_cubics(s, w(index - first_in_second_quarter + 1));
}

void average_onsets(RelockProfileState& s) noexcept {
    const RelockMixture& m = s.mixture;
    const double part = 1.0 / m.weight;
    Vector<5> mean{};
    for (std::size_t i = 0; i < 5; ++i) mean[i] = part * m.sum[i];
    // Lower triangles: j <= i.
    const auto within = [&](std::size_t i, std::size_t j) { return part * m.within[i][j]; };
    const auto between = [&](std::size_t i, std::size_t j) { return part * m.sum_sq[i][j] - mean[i] * mean[j]; };
    auto& covariance = s.profile.covariance_lambda4;
    for (std::size_t i = 0; i < 2; ++i) {
        s.profile.mean_sq_lambda2[i] = mean[i];
        for (std::size_t j = 0; j <= i; ++j) covariance[i][j] = covariance[j][i] = within(i, j) + between(i, j);
        for (std::size_t j = 0; j < 3; ++j) s.with_half[i][j] = within(j + 2, i) + between(j + 2, i);
    }
    for (std::size_t i = 0; i < 3; ++i) {
        s.link.state[i] = mean[i + 2];
        for (std::size_t j = 0; j <= i; ++j) {
            s.link.within[i][j] = s.link.within[j][i] = within(i + 2, j + 2);
            s.link.between[i][j] = s.link.between[j][i] = between(i + 2, j + 2);
        }
    }
}

}  // namespace zlg::core
