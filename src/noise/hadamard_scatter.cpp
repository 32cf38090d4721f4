#include "hadamard_scatter.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <vector>

namespace zlg::noise {
namespace {

constexpr std::array<double, 4> weight{1.0, -3.0, 3.0, -1.0};  // of a third difference
constexpr std::int64_t farthest = 64;

// Covariances of the angle at whole multiples of a stride.
class Table {
public:
    Table(const NoiseTerms& terms, double stride_s, std::size_t n) : value_(n) {
        for (std::size_t k = 0; k < n; ++k) value_[k] = angle_covariance(terms, static_cast<double>(k) * stride_s);
    }
    [[nodiscard]] double at(std::int64_t k) const { return value_[static_cast<std::size_t>(std::abs(k))]; }

private:
    std::vector<double> value_;
};

struct Pair {
    std::int64_t short_m, long_m;
    std::int64_t n_short, n_long;  // differences
    std::int64_t stride;

    // Pairs at the lag `lag` = start of the long difference less start of the short one.
    [[nodiscard]] double count(std::int64_t lag) const {
        const std::int64_t first = std::max<std::int64_t>(0, -lag);
        const std::int64_t last = std::min(n_short - 1, n_long - 1 - lag);
        return static_cast<double>(std::max<std::int64_t>(0, last - first + 1));
    }

    [[nodiscard]] double smooth(const Table& table, std::int64_t lag) const {
        const std::int64_t a = short_m / stride, b = long_m / stride, l = lag / stride;
        double sum = 0.0;
        for (std::int64_t i = 0; i < 4; ++i)
            for (std::int64_t j = 0; j < 4; ++j)
                sum += weight[static_cast<std::size_t>(i)] * weight[static_cast<std::size_t>(j)] *
                       table.at(l + j * b - i * a);
        return sum;
    }
};

// Errors of single angles correlate two differences only where they share an angle.
double from_shared_angles(const Pair& pair, const Table& table, double angle_variance, bool near) {
    struct Spike {
        std::int64_t lag;
        double value;
    };
    std::array<Spike, 16> spikes{};
    std::size_t n = 0;
    for (std::int64_t i = 0; i < 4; ++i)
        for (std::int64_t j = 0; j < 4; ++j) {
            const std::int64_t lag = i * pair.short_m - j * pair.long_m;
            const double value =
                angle_variance * weight[static_cast<std::size_t>(i)] * weight[static_cast<std::size_t>(j)];
            const auto same = std::find_if(spikes.begin(), spikes.begin() + static_cast<std::ptrdiff_t>(n),
                                           [lag](const Spike& s) { return s.lag == lag; });
            if (same != spikes.begin() + static_cast<std::ptrdiff_t>(n))
                same->value += value;
            else
                spikes[n++] = {lag, value};
        }
    double sum = 0.0;
    for (std::size_t k = 0; k < n; ++k) {
        const double smooth = near ? pair.smooth(table, spikes[k].lag) : 0.0;
        sum += pair.count(spikes[k].lag) * spikes[k].value * (spikes[k].value + 2.0 * smooth);
    }
    return sum;
}

double sum_of_squares(const Pair& pair, const Table& table, double angle_variance) {
    const bool near = pair.long_m <= farthest * pair.short_m;
    double sum = 0.0;
    if (near) {
        const std::int64_t reach = 3 * pair.long_m + 2 * pair.short_m;
        const std::int64_t first = -reach / pair.stride, last = (3 * pair.short_m + 2 * pair.long_m) / pair.stride;
        for (std::int64_t k = first; k <= last; ++k) {
            const std::int64_t lag = k * pair.stride;
            const double c = pair.smooth(table, lag);
            sum += pair.count(lag) * c * c;
        }
        sum *= static_cast<double>(pair.stride);
    }
    if (angle_variance > 0.0) sum += from_shared_angles(pair, table, angle_variance, near);
    return sum;
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
        const Table table(terms, static_cast<double>(stride) * tau_0_s,
                          static_cast<std::size_t>((8 * longest + 8 * m) / stride));
        for (Eigen::Index j = i; j < n; ++j) {
            const std::int64_t k = factors[static_cast<std::size_t>(j)];
            const Pair pair{m, k, n_intervals - 3 * m + 1, n_intervals - 3 * k + 1, stride};
            const double pairs = static_cast<double>(pair.n_short) * static_cast<double>(pair.n_long);
            relative(i, j) = relative(j, i) =
                2.0 * sum_of_squares(pair, table, angle_variance) / (pairs * expected(m) * expected(k));
        }
    }
    return relative;
}

}  // namespace zlg::noise
