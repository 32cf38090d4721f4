#include "tridiagonal.hpp"

#include <zlg/core/common/maths.hpp>

namespace zlg::core {
namespace {

// W <- (I - f v v^T) W (I - f v v^T) for v = column j from row `from` on, by the lower half of what is left.
void reflect_rest(Reflections& w, unsigned n, unsigned from, const MixtureColumn& v, double factor) noexcept {
    MixtureColumn p{};
    for (unsigned k = from; k < n; ++k) {
        const MixtureColumn& column = w.of[k];
        double sum = column[k] * v[k];
        const double vk = v[k];
#pragma GCC unroll 4
        for (unsigned i = k + 1; i < n; ++i) {
            p[i] += column[i] * vk;
            sum += column[i] * v[i];
        }
        p[k] += sum;
    }
    double along = 0.0;
    for (unsigned i = from; i < n; ++i) {
        p[i] *= factor;
        along += p[i] * v[i];
    }
    const double half = 0.5 * factor * along;
    for (unsigned i = from; i < n; ++i) p[i] -= half * v[i];
    for (unsigned k = from; k < n; ++k) {
        MixtureColumn& column = w.of[k];
        const double vk = v[k];
        const double pk = p[k];
#pragma GCC unroll 4
        for (unsigned i = k; i < n; ++i) column[i] -= v[i] * pk + p[i] * vk;
    }
}

void apply(const Reflections& w, unsigned n, unsigned j, MixtureColumn& x) noexcept {
    const double factor = w.factor[j];
    if (factor == 0.0) return;
    const MixtureColumn& v = w.of[j];
    double along = 0.0;
#pragma GCC unroll 4
    for (unsigned i = j + 1; i < n; ++i) along += v[i] * x[i];
    along *= factor;
#pragma GCC unroll 4
    for (unsigned i = j + 1; i < n; ++i) x[i] -= along * v[i];
}

}  // namespace

void reduce(Reflections& w, unsigned n, Tridiagonal& t) noexcept {
    for (unsigned j = 0; j < n; ++j) {
        t.diagonal[j] = w.of[j][j];
        w.factor[j] = 0.0;
        if (j + 1 == n) break;
        MixtureColumn& v = w.of[j];
        double below = 0.0;
        for (unsigned i = j + 2; i < n; ++i) below += v[i] * v[i];
        t.beside[j] = v[j + 1];
        if (below == 0.0) continue;
        const double norm = square_root(v[j + 1] * v[j + 1] + below);
        t.beside[j] = v[j + 1] > 0.0 ? -norm : norm;
        v[j + 1] -= t.beside[j];
        w.factor[j] = 2.0 / (v[j + 1] * v[j + 1] + below);
        reflect_rest(w, n, j + 1, v, w.factor[j]);
    }
}

void reflect(const Reflections& w, unsigned n, MixtureColumn& x) noexcept {
    for (unsigned j = 0; j + 1 < n; ++j) apply(w, n, j, x);
}

void reflect_back(const Reflections& w, unsigned n, MixtureColumn& x) noexcept {
    for (unsigned j = n; j-- > 0;) apply(w, n, j, x);
}

}  // namespace zlg::core
