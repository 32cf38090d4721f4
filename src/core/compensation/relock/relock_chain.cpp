#include "relock_chain.hpp"

#include <zlg/core/common/maths.hpp>

namespace zlg::core {
namespace {

// z' = G q: from the four coefficients of a half to the start of the next one.
Vector<3> carried(const Vector<4>& q) noexcept {
    const double bend = q[2] + 3.0 * q[3];
    return {q[0] + q[1] + q[2] + q[3], q[1] + q[2] + bend, bend};
}

// G C G^T of a symmetric matrix.
Matrix<3> carried(const Matrix<4>& c) noexcept {
    const Vector<3> column[4] = {carried(c[0]), carried(c[1]), carried(c[2]), carried(c[3])};
    Matrix<3> out{};
    for (std::size_t j = 0; j < 3; ++j)
        out[j] = carried(Vector<4>{column[0][j], column[1][j], column[2][j], column[3][j]});
    return out;
}

// G^T r: information on the start of the next half as information on the four coefficients.
Vector<4> pulled_back(const Vector<3>& r) noexcept {
    return {r[0], r[0] + r[1], r[0] + 2.0 * r[1] + r[2], r[0] + 3.0 * (r[1] + r[2])};
}

// G^T M G of a symmetric matrix.
Matrix<4> pulled_back(const Matrix<3>& p) noexcept {
    const Vector<4> row[3] = {pulled_back(p[0]), pulled_back(p[1]), pulled_back(p[2])};
    Matrix<4> out{};
    for (std::size_t j = 0; j < 4; ++j) out[j] = pulled_back(Vector<3>{row[0][j], row[1][j], row[2][j]});
    return out;
}

// N q, N_ij the mean of u^(i+j) over a half.
Vector<4> mean_products_times(const Vector<4>& q) noexcept {
    constexpr Vector<7> mean_of_power{1.0, 1.0 / 2.0, 1.0 / 3.0, 1.0 / 4.0, 1.0 / 5.0, 1.0 / 6.0, 1.0 / 7.0};
    Vector<4> out{};
    for (std::size_t i = 0; i < 4; ++i)
        for (std::size_t j = 0; j < 4; ++j) out[i] += mean_of_power[i + j] * q[j];
    return out;
}

// tr(N C): mean square over a half of a cubic whose coefficients have the covariance C.
double mean_variance(const Matrix<4>& c) noexcept {
    return c[0][0] + c[0][1] + (2.0 * c[0][2] + c[1][1]) / 3.0 + (c[0][3] + c[1][2]) / 2.0 +
           (2.0 * c[1][3] + c[2][2]) / 5.0 + c[2][3] / 3.0 + c[3][3] / 7.0;
}

// cov(q) from cov(z) by the gain (3).
//
// own_variance  of the cubic term for a given z.
Matrix<4> with_cubic(const Matrix<3>& c, const RelockGain& gain, double own_variance) noexcept {
    const Vector<3> last = times(c, gain.by_state);
    Matrix<4> out{};
    for (std::size_t i = 0; i < 3; ++i) {
        out[i] = {c[i][0], c[i][1], c[i][2], last[i]};
        out[3][i] = last[i];
    }
    out[3][3] = dot(last, gain.by_state) + own_variance;
    return out;
}

Matrix<4> sum(const Matrix<4>& a, const Matrix<4>& b) noexcept {
    Matrix<4> out{};
    for (std::size_t i = 0; i < 4; ++i)
        for (std::size_t j = 0; j < 4; ++j) out[i][j] = a[i][j] + b[i][j];
    return out;
}

}  // namespace

double cubic_ridge(const RelockProfileState& s) noexcept {
    return s.noise_sq_lambda2 / (100.0 * s.scale_lambda * s.scale_lambda);
}

RelockGain absorb(const RelockHalf& half, const Vector<7>& powers, double ridge, RelockInformation& later) noexcept {
    Matrix<4> a = pulled_back(later.matrix);
    Vector<4> b = pulled_back(later.vector);
    for (std::size_t i = 0; i < 4; ++i) {
        for (std::size_t j = 0; j < 4; ++j) a[i][j] += half.weight * powers[i + j];
        b[i] += half.weight * half.moments[i];
    }
    const double variance = 1.0 / (a[3][3] + ridge);
    RelockGain gain{.offset = b[3] * variance, .variance = variance};
    for (std::size_t i = 0; i < 3; ++i) gain.by_state[i] = -a[3][i] * variance;
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j) later.matrix[i][j] = a[i][j] + a[3][i] * gain.by_state[j];
        later.vector[i] = b[i] - a[3][i] * gain.offset;
    }
    later.fitted_sq += b[3] * gain.offset;
    return gain;
}

double explained(const RelockInformation& information) noexcept {
    return dot(information.vector, times(inverse(information.matrix), information.vector));
}

RelockLink start_of(const RelockInformation& information, double noise_sq_lambda2) noexcept {
    RelockLink link;
    link.within = inverse(information.matrix);
    link.state = times(link.within, information.vector);
    for (auto& row : link.within)
        for (double& x : row) x *= noise_sq_lambda2;
    return link;
}

PassedHalf pass(const RelockGain& gain, double noise_sq_lambda2, RelockLink& link) noexcept {
    // N q without the factor 2 of (5), which enters at each result below.
    const Vector<4> q{link.state[0], link.state[1], link.state[2], dot(gain.by_state, link.state) + gain.offset};
    const Matrix<4> within = with_cubic(link.within, gain, gain.variance * noise_sq_lambda2);
    const Matrix<4> between = with_cubic(link.between, gain, 0.0);
    const double variance_within = mean_variance(within);
    const double variance_between = mean_variance(between);
    const Vector<4> moment_q = mean_products_times(q);
    const Vector<4> cov_with_moment = times(sum(within, between), moment_q);
    const Vector<3> next_cov_with_moment = carried(cov_with_moment);

    PassedHalf out;
    out.mean_sq_lambda2 = dot(q, moment_q) + variance_between - variance_within;
    const double total_variance = variance_within + variance_between;
    out.variance_lambda4 = 4.0 * dot(moment_q, cov_with_moment) + 2.0 * total_variance * total_variance;
    for (std::size_t i = 0; i < 3; ++i) {
        out.slope[i] = 2.0 * (moment_q[i] + moment_q[3] * gain.by_state[i]);
        out.with_next[i] = 2.0 * next_cov_with_moment[i];
    }
    link.state = carried(q);
    link.within = carried(within);
    link.between = carried(between);
    return out;
}

Vector<3> onward(const RelockGain& gain, const Vector<3>& with) noexcept {
    return carried(Vector<4>{with[0], with[1], with[2], dot(gain.by_state, with)});
}

// A = L L^T by Cholesky, then L^-1, then A^-1 = L^-T L^-1.
template <std::size_t n>
Matrix<n> inverse(const Matrix<n>& a) noexcept {
    Matrix<n> l{};
    Matrix<n> inverted{};  // of l
    for (std::size_t i = 0; i < n; ++i) {
        double pivot = a[i][i];
        for (std::size_t j = 0; j < i; ++j) {
            double sum = a[i][j];
            for (std::size_t k = 0; k < j; ++k) sum -= l[i][k] * l[j][k];
            l[i][j] = sum * inverted[j][j];
            pivot -= l[i][j] * l[i][j];
        }
        // Below this share of its diagonal a pivot is rounding error.
        inverted[i][i] = pivot > 1e-13 * a[i][i] ? 1.0 / square_root(pivot) : 0.0;
        for (std::size_t j = 0; j < i; ++j) {
            double sum = 0.0;
            for (std::size_t k = j; k < i; ++k) sum -= l[i][k] * inverted[k][j];
            inverted[i][j] = sum * inverted[i][i];
        }
    }
    Matrix<n> out{};
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j <= i; ++j) {
            for (std::size_t k = i; k < n; ++k) out[i][j] += inverted[k][i] * inverted[k][j];
            out[j][i] = out[i][j];
        }
    return out;
}

template Matrix<3> inverse(const Matrix<3>&) noexcept;
template Matrix<4> inverse(const Matrix<4>&) noexcept;

}  // namespace zlg::core
