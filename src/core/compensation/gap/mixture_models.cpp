#include "mixture_models.hpp"

#include <zlg/core/common/maths.hpp>

namespace zlg::core {
namespace {

// W of the points from `first` on: the columns of L^-1 R, then the lower half of (L^-1 R) L^-T.
void whiten(const GapMixture& m, const Added& a, Reflections& w) noexcept {
    const unsigned n = static_cast<unsigned>(m.points.n) - a.first;
    for (unsigned j = 0; j < n; ++j) {
        const int place = place_of(m, a.first + j);
        for (unsigned i = 0; i < n; ++i) {
            const double* const row = row_of(m.factor, a.first + i) + a.first;
            double x = a.of(place_of(m, a.first + i), place);
#pragma GCC unroll 4
            for (unsigned k = 0; k < i; ++k) x -= row[k] * w.of[j][k];
            w.of[j][i] = x * row[i];
        }
    }
    // w.of[j] is column j of L^-1 R; the second system runs over the columns.
    for (unsigned j = 0; j < n; ++j) {
        const double* const row = row_of(m.factor, a.first + j) + a.first;
        for (unsigned k = 0; k < j; ++k) {
            const double factor = row[k];
#pragma GCC unroll 4
            for (unsigned i = j; i < n; ++i) w.of[j][i] -= factor * w.of[k][i];
        }
#pragma GCC unroll 4
        for (unsigned i = j; i < n; ++i) w.of[j][i] *= row[j];
    }
}

void add(double h, double z, double g, double weight, MixtureProducts& p) noexcept {
    const double weighted = weight * g;
    p.hg += weighted * h;
    p.gz += weighted * z;
    p.gg += weighted * g;
    p.hz += weight * h * z;
    p.hh += weight * h * h;
    p.zz += weight * z * z;
}

MixtureModel model_of(const MixtureProducts& p, double determinant, double variance, int n_gap) noexcept {
    const double rate = p.hz / p.hh;
    const double gain = n_gap - p.hg;
    return {.log_evidence = -(p.zz - p.hz * rate) - maths::log(determinant * p.hh),
            .rate = rate,
            .value = p.gz + rate * gain,
            .variance = variance - p.gg + gain * gain / p.hh};
}

// Products of the first n coordinates, where nothing is added.
MixtureProducts products_of(const GapMixture& m, unsigned n) noexcept {
    MixtureProducts p;
    for (unsigned i = 0; i < n; ++i) add(m.ones[i], m.value[i], m.with_sum[i], 1.0, p);
    return p;
}

// Of a shape that reaches into the gap.
void add_gap(const GapMixture& m, const Added& a, ShapeColumns& c) noexcept {
    const MixturePoints& p = m.points;
    MixtureColumn with_gap{};
    for (int j = p.n_side; j < p.n_side + p.n_gap; ++j) {
        for (unsigned i = 0; i < c.n; ++i) with_gap[i] += a.of(p.place[i], j);
        for (int k = p.n_side; k < p.n_side + p.n_gap; ++k) c.more_variance += a.of(j, k);
    }
    c.more_with_sum = forward(m.factor, with_gap);
}

}  // namespace

Added added_by(const Shape& shape, const GapMixture& m) noexcept {
    Added a{.shape = shape};
    if (shape.quiet_ticks < 0) return a;
    a.origin = (m.reversed ? 0 : m.points.n_side) + m.points.n_gap + shape.quiet_ticks;
    while (a.first < static_cast<unsigned>(m.points.n) && place_of(m, a.first) < a.origin) ++a.first;
    return a;
}

MixtureModel nothing_added(const GapMixture& m) noexcept {
    return model_of(products_of(m, static_cast<unsigned>(m.points.n)), 1.0, m.sum_variance, m.points.n_gap);
}

void reduce(const Shape& shape, GapMixture& m) noexcept {
    const Added a = added_by(shape, m);
    m.shape.first = a.first;
    m.shape.n = static_cast<unsigned>(m.points.n) - a.first;
    whiten(m, a, m.shape.reflections);
    reduce(m.shape.reflections, m.shape.n, m.shape.w);
}

void prepare(const Shape& shape, GapMixture& m) noexcept {
    const Added a = added_by(shape, m);
    ShapeColumns& c = m.shape;
    c.more_with_sum = {};
    c.more_variance = 0.0;
    c.before = products_of(m, a.first);
    for (unsigned i = 0; i < c.n; ++i) {
        c.ones[i] = m.ones[a.first + i];
        c.value[i] = m.value[a.first + i];
        c.with_sum[i] = m.with_sum[a.first + i];
    }
    for (MixtureColumn* column : {&c.ones, &c.value, &c.with_sum}) reflect(c.reflections, c.n, *column);
    if (shape.quiet_ticks >= 0) return;
    add_gap(m, a, c);
    reflect(c.reflections, c.n, c.more_with_sum);
}

MixtureModel solve(const GapMixture& m, double s2, Bidiagonal& b) noexcept {
    const ShapeColumns& c = m.shape;
    MixtureProducts p = c.before;
    double determinant = 1.0;
    double h = 0.0;
    double z = 0.0;
    double g = 0.0;
    double inverse = 0.0;
    for (unsigned i = 0; i < c.n; ++i) {
        const double beside = i > 0 ? s2 * c.w.beside[i - 1] : 0.0;
        const double below = beside * inverse;
        const double d = 1.0 + s2 * c.w.diagonal[i] - beside * below;
        // W is positive semidefinite; what rounding makes of it need not be.
        const double pivot = d > 1.0 ? d : 1.0;
        inverse = 1.0 / pivot;
        b.below[i] = below;
        b.inverse[i] = inverse;
        determinant *= pivot;
        h = c.ones[i] - below * h;
        z = c.value[i] - below * z;
        g = c.with_sum[i] + s2 * c.more_with_sum[i] - below * g;
        add(h, z, g, inverse, p);
    }
    return model_of(p, determinant, m.sum_variance + s2 * c.more_variance, m.points.n_gap);
}

void dual_of(const ShapeColumns& c, const Bidiagonal& b, double rate, MixtureColumn& y) noexcept {
    double before = 0.0;
    for (unsigned i = 0; i < c.n; ++i) {
        before = c.value[i] - rate * c.ones[i] - b.below[i] * before;
        y[i] = before * b.inverse[i];
    }
    for (unsigned i = c.n - 1; i-- > 0;) y[i] -= b.below[i + 1] * y[i + 1];
}

}  // namespace zlg::core
