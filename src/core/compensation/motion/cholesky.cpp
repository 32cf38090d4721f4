#include <zlg/core/compensation/cholesky.hpp>

#include <zlg/core/common/maths.hpp>

namespace zlg::core {
namespace {

// What rounding leaves of a pivot that is 0 in exact arithmetic is a few times 1e-16 of the diagonal.
constexpr double smallest_pivot = 1e-12;

unsigned row_start(int i) noexcept { return static_cast<unsigned>(i * (i + 1) / 2); }

}  // namespace

template <std::size_t capacity>
bool add_row(CholeskyFactorOf<capacity>& factor, const ColumnOf<capacity>& covariance) noexcept {
    const auto n = static_cast<unsigned>(factor.n);
    double* const row = factor.lower.data() + row_start(factor.n);
    const double* other = factor.lower.data();
    double pivot = covariance[n];
    for (unsigned k = 0; k < n; other += ++k) {
        double x = covariance[k];
#pragma GCC unroll 4
        for (unsigned i = 0; i < k; ++i) x -= row[i] * other[i];
        row[k] = x * other[k];
        pivot -= row[k] * row[k];
    }
    if (!(pivot > smallest_pivot * covariance[n] && is_finite(pivot))) {
        for (unsigned k = 0; k < n; ++k) row[k] = 0.0;
        return false;
    }
    row[n] = 1.0 / square_root(pivot);
    ++factor.n;
    return true;
}

template <std::size_t capacity>
ColumnOf<capacity> forward(const CholeskyFactorOf<capacity>& factor, const ColumnOf<capacity>& x) noexcept {
    ColumnOf<capacity> y{};
    const double* row = factor.lower.data();
    for (unsigned k = 0; k < static_cast<unsigned>(factor.n); row += ++k) {
        double sum = x[k];
#pragma GCC unroll 4
        for (unsigned i = 0; i < k; ++i) sum -= row[i] * y[i];
        y[k] = sum * row[k];
    }
    return y;
}

template <std::size_t capacity>
ColumnOf<capacity> backward(const CholeskyFactorOf<capacity>& factor, const ColumnOf<capacity>& x) noexcept {
    ColumnOf<capacity> y = x;
    const double* row = factor.lower.data() + row_start(factor.n);
    for (auto k = static_cast<unsigned>(factor.n); k-- > 0;) {
        row -= k + 1;
        y[k] *= row[k];
#pragma GCC unroll 4
        for (unsigned i = 0; i < k; ++i) y[i] -= row[i] * y[k];
    }
    return y;
}

template <std::size_t capacity>
double product(const ColumnOf<capacity>& a, const ColumnOf<capacity>& b, int n) noexcept {
    double sum = 0.0;
#pragma GCC unroll 4
    for (unsigned k = 0; k < static_cast<unsigned>(n); ++k) sum += a[k] * b[k];
    return sum;
}

template bool add_row(CholeskyFactor&, const Column&) noexcept;
template Column forward(const CholeskyFactor&, const Column&) noexcept;
template Column backward(const CholeskyFactor&, const Column&) noexcept;
template double product(const Column&, const Column&, int) noexcept;

using SideRows = CholeskyFactorOf<16>;
using SideNumbers = ColumnOf<16>;
template bool add_row(SideRows&, const SideNumbers&) noexcept;
template SideNumbers forward(const SideRows&, const SideNumbers&) noexcept;
template SideNumbers backward(const SideRows&, const SideNumbers&) noexcept;

using FewRows = CholeskyFactorOf<few_unknowns>;
using FewNumbers = ColumnOf<few_unknowns>;
template bool add_row(FewRows&, const FewNumbers&) noexcept;
template FewNumbers forward(const FewRows&, const FewNumbers&) noexcept;
template FewNumbers backward(const FewRows&, const FewNumbers&) noexcept;
template double product(const FewNumbers&, const FewNumbers&, int) noexcept;

}  // namespace zlg::core
