#include <zlg/core/common/triangle.hpp>

#include <zlg/core/common/maths.hpp>

namespace zlg::core {
namespace {

// x_j .. x_(j+3), from which the products with the columns before j are taken off at the same time.
void eliminate_four(Triangle factor, const double* reciprocal, int j, double* x) noexcept {
    const double* const r0 = factor.row(j);
    const double* const r1 = factor.row(j + 1);
    const double* const r2 = factor.row(j + 2);
    const double* const r3 = factor.row(j + 3);
    double s0 = x[j];
    double s1 = x[j + 1];
    double s2 = x[j + 2];
    double s3 = x[j + 3];
    for (int k = 0; k < j; ++k) {
        const double xk = x[k];
        s0 -= xk * r0[k];
        s1 -= xk * r1[k];
        s2 -= xk * r2[k];
        s3 -= xk * r3[k];
    }
    s0 *= reciprocal[j];
    s1 = (s1 - s0 * r1[j]) * reciprocal[j + 1];
    s2 = (s2 - s0 * r2[j] - s1 * r2[j + 1]) * reciprocal[j + 2];
    s3 = (s3 - s0 * r3[j] - s1 * r3[j + 1] - s2 * r3[j + 2]) * reciprocal[j + 3];
    x[j] = s0;
    x[j + 1] = s1;
    x[j + 2] = s2;
    x[j + 3] = s3;
}

}  // namespace

double log_of_product(const double* x, int n) noexcept {
    double sum = 0.0;
    double product = 1.0;
    for (int i = 0; i < n; ++i) {
        product *= x[i];
        if (product > 1e-200 && product < 1e200) continue;
        sum += maths::log(product);
        product = 1.0;
    }
    return sum + maths::log(product);
}

double dot(const double* a, const double* b, int n) noexcept {
    double even = 0.0;
    double odd = 0.0;
    int k = 0;
    for (; k + 1 < n; k += 2) {
        even += a[k] * b[k];
        odd += a[k + 1] * b[k + 1];
    }
    if (k < n) even += a[k] * b[k];
    return even + odd;
}

void eliminate(Triangle factor, const double* reciprocal, int n, double* x) noexcept {
    int j = 0;
    for (; j + 4 <= n; j += 4) eliminate_four(factor, reciprocal, j, x);
    for (; j < n; ++j) x[j] = (x[j] - dot(x, factor.row(j), j)) * reciprocal[j];
}

void substitute_back(Triangle factor, const double* reciprocal, int n, double* x) noexcept {
    for (int i = n; i-- > 0;) {
        x[i] *= reciprocal[i];
        const double* const row = factor.row(i);
        for (int k = 0; k < i; ++k) x[k] -= row[k] * x[i];
    }
}

void invert(Triangle factor, const double* reciprocal, int n) noexcept {
    // L^-1, row by row: an element of L is of no use to those right of it.
    for (int i = 0; i < n; ++i) {
        double* const row = factor.row(i);
        for (int j = 0; j < i; ++j) {
            double sum = 0.0;
            for (int k = j; k < i; ++k) sum += row[k] * factor.row(k)[j];
            row[j] = -sum * reciprocal[i];
        }
        row[i] = reciprocal[i];
    }
    // L^-T L^-1: an element from its own row and those below.
    for (int i = 0; i < n; ++i)
        for (int j = 0; j <= i; ++j) {
            double sum = 0.0;
            for (int k = i; k < n; ++k) sum += factor.row(k)[i] * factor.row(k)[j];
            factor.row(i)[j] = sum;
        }
}

bool factorise(Triangle a, double* reciprocal, int n) noexcept {
    for (int i = 0; i < n; ++i) {
        double* const row = a.row(i);
        eliminate(a, reciprocal, i, row);
        const double pivot = row[i] - dot(row, row, i);
        if (!(pivot > 0.0 && is_finite(pivot))) return false;
        row[i] = square_root(pivot);
        reciprocal[i] = 1.0 / row[i];
    }
    return true;
}

}  // namespace zlg::core
