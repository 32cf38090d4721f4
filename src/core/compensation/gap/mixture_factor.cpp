#include "mixture_factor.hpp"

#include <zlg/core/common/maths.hpp>

#include "mixture_models.hpp"

namespace zlg::core {
namespace {

// Covariance of the roundings of two ticks, each the difference of two readings of unit variance.
double rounding_of(int a, int b) noexcept {
    if (a == b) return 2.0;
    return a - b == 1 || b - a == 1 ? -1.0 : 0.0;
}

// The same of a tick with the whole gap, which has a reading at either edge.
double rounding_with_gap(const MixturePoints& p, int place) noexcept {
    const int start = p.n_side;
    const int end = p.n_side + p.n_gap;
    int sum = 0;
    if (place == start) ++sum;
    if (place + 1 == start) --sum;
    if (place + 1 == end) ++sum;
    if (place == end) --sum;
    return sum;
}

double log_determinant(const GapMixture& m) noexcept {
    double inverse = 1.0;
    for (unsigned i = 0; i < static_cast<unsigned>(m.points.n); ++i) inverse *= row_of(m.factor, i)[i];
    return -2.0 * natural_log(inverse);
}

}  // namespace

double covariance_with(const MotionCovariance& covariance, const GapMixture& m, int a, int b) noexcept {
    return covariance.of_ticks(a, b) + m.more_rounding * rounding_of(a, b);
}

void factorize(const MotionCovariance& covariance, GapMixture& m) noexcept {
    const MixturePoints& p = m.points;
    const auto n = static_cast<unsigned>(p.n);
    m.factor.n = 0;
    MixtureColumn ones{};
    MixtureColumn value{};
    MixtureColumn with_sum{};
    double largest = 0.0;
    for (unsigned i = 0; i < n; ++i) {
        MixtureColumn row{};
        for (unsigned k = 0; k <= i; ++k) row[k] = covariance_of(m, i, k);
        if (!add_row(m.factor, row)) m.failed = true;
        if (m.failed) return;
        const double inverse = row_of(m.factor, i)[i];
        if (inverse > largest) largest = inverse;
        const unsigned own = point_of(m, i);
        ones[i] = 1.0;
        value[i] = p.value[own];
        with_sum[i] = -p.error_with_all[own];
        for (int j = 0; j < p.n_gap; ++j) with_sum[i] += covariance.of_ticks(p.place[own], p.n_side + j);
        with_sum[i] += m.more_rounding * rounding_with_gap(p, p.place[own]);
    }
    m.ones = forward(m.factor, ones);
    m.value = forward(m.factor, value);
    m.with_sum = forward(m.factor, with_sum);
    m.smallest = 1.0 / (largest * largest);
}

void begin(const MotionCovariance& covariance, GapMixture& m) noexcept {
    const MixturePoints& p = m.points;
    m.sum_variance = p.error_variance;
    for (int a = p.n_side; a < p.n_side + p.n_gap; ++a) {
        m.sum_variance += covariance.of_ticks(a, a);
        for (int b = p.n_side; b < a; ++b) m.sum_variance += 2.0 * covariance.of_ticks(b, a);
    }
    m.reversed = m.learnt;
    factorize(covariance, m);
    if (p.n < 3 || !is_finite(m.smallest)) m.failed = true;
    if (!m.failed) m.nothing = nothing_added(m);
}

void add_rounding(const MotionCovariance& covariance, GapMixture& m) noexcept {
    const MixturePoints& p = m.points;
    const double missing = p.reading_variance - m.smallest;
    if (m.failed || !(missing > 0.0)) return;
    m.more_rounding = missing;
    for (unsigned i = 0; i < static_cast<unsigned>(p.n); ++i)
        for (unsigned k = i > 0 ? i - 1 : 0; k <= i; ++k)
            m.covariance[i * (i + 1) / 2 + k] += missing * rounding_of(p.place[i], p.place[k]);
    // Of the whole gap, by its two edges.
    m.sum_variance += 2.0 * missing;
    m.nothing.log_evidence -= log_determinant(m);
    factorize(covariance, m);
    // (2) holds |C + E|, which all other models share.
    if (!m.failed) m.nothing.log_evidence += log_determinant(m);
}

}  // namespace zlg::core
