#include "hadamard_scatter.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <map>
#include <vector>

namespace zlg::noise {
namespace {

constexpr std::array<double, 4> weight{1.0, -3.0, 3.0, -1.0};  // of a third difference
constexpr std::int64_t farthest = 64;

// Differences over two averaging times. A lag is the start of the long one less that of the short one.
struct Pair {
    std::int64_t short_m, long_m;
    std::int64_t n_short, n_long;  // differences
    std::int64_t stride;
    const std::vector<double>& covariance;  // of the angle at whole multiples of the stride

    [[nodiscard]] double count(std::int64_t lag) const {
        const std::int64_t first = std::max<std::int64_t>(0, -lag);
        const std::int64_t last = std::min(n_short - 1, n_long - 1 - lag);
        return static_cast<double>(std::max<std::int64_t>(0, last - first + 1));
    }
    [[nodiscard]] bool is_near() const { return long_m <= farthest * short_m; }
    // Of two such differences, errors of single angles aside.
    [[nodiscard]] double smooth(std::int64_t lag) const {
        const std::int64_t a = short_m / stride, b = long_m / stride, l = lag / stride;
        double sum = 0.0;
        for (std::int64_t i = 0; i < 4; ++i)
            for (std::int64_t j = 0; j < 4; ++j)
                sum += weight[static_cast<std::size_t>(i)] * weight[static_cast<std::size_t>(j)] *
                       covariance[static_cast<std::size_t>(std::abs(l + j * b - i * a))];
        return sum;
    }
};

// Errors of single angles correlate two differences only where they share an angle.
double from_shared_angles(const Pair& pair, double angle_variance) {
    std::map<std::int64_t, double> shared;
    for (std::int64_t i = 0; i < 4; ++i)
        for (std::int64_t j = 0; j < 4; ++j)
            shared[i * pair.short_m - j * pair.long_m] +=
                angle_variance * weight[static_cast<std::size_t>(i)] * weight[static_cast<std::size_t>(j)];
    double sum = 0.0;
    for (const auto& [lag, value] : shared)
        sum += pair.count(lag) * value * (value + (pair.is_near() ? 2.0 * pair.smooth(lag) : 0.0));
    return sum;
}

double sum_of_squares(const Pair& pair, double angle_variance) {
    double sum = 0.0;
    const std::int64_t first = -(3 * pair.long_m + 2 * pair.short_m) / pair.stride,
                       last = (3 * pair.short_m + 2 * pair.long_m) / pair.stride;
    for (std::int64_t k = first; k <= last && pair.is_near(); ++k) {
        const double c = pair.smooth(k * pair.stride);
        sum += pair.count(k * pair.stride) * c * c;
    }
    sum *= static_cast<double>(pair.stride);
    return angle_variance > 0.0 ? sum + from_shared_angles(pair, angle_variance) : sum;
}

}  // namespace

Eigen::MatrixXd hadamard_scatter(const NoiseTerms& terms, double tau_0_s, std::span<const std::int64_t> factors,
                                 std::int64_t n_intervals) {
    const auto n = std::ssize(factors);
    Eigen::MatrixXd relative = Eigen::MatrixXd::Zero(n, n);
    const double angle_variance = terms.quantisation_arcsec * terms.quantisation_arcsec;
    const auto expected = [&](std::int64_t m) {
        const double tau_s = static_cast<double>(m) * tau_0_s;
        return 6.0 * tau_s * tau_s * hadamard_variance(terms, tau_s);
    };
    for (Eigen::Index i = 0; i < n; ++i) {
        const std::int64_t m = factors[static_cast<std::size_t>(i)];
        const std::int64_t stride = std::max<std::int64_t>(1, m / 8);
        const std::int64_t longest = std::min(factors.back(), farthest * m);
        std::vector<double> covariance;
        for (std::int64_t lag = 0; lag < 8 * longest + 8 * m; lag += stride)
            covariance.push_back(angle_covariance(terms, static_cast<double>(lag) * tau_0_s));
        for (Eigen::Index j = i; j < n; ++j) {
            const std::int64_t k = factors[static_cast<std::size_t>(j)];
            const Pair pair{m, k, n_intervals - 3 * m + 1, n_intervals - 3 * k + 1, stride, covariance};
            const double pairs = static_cast<double>(pair.n_short) * static_cast<double>(pair.n_long);
            relative(i, j) = relative(j, i) =
                2.0 * sum_of_squares(pair, angle_variance) / (pairs * expected(m) * expected(k));
        }
    }
    return relative;
}

}  // namespace zlg::noise
