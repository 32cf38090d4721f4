#include "difference_covariance.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>

#include <boost/math/special_functions/digamma.hpp>

namespace zlg::deviations {
namespace {

constexpr std::int64_t max_sampled = 64;
constexpr std::int64_t max_flicker_steps = 512;  // of flicker of the angle, which depends on the sampling as ln m

std::int64_t steps_of(int noise, bool is_averaged, std::int64_t m) {
    return std::min(m, noise == 1 && !is_averaged ? max_flicker_steps : max_sampled);
}

}  // namespace

double flicker_covariance(std::int64_t lag) {
    const auto u = static_cast<double>(std::abs(lag));
    if (u >= 12.0) {
        constexpr double euler = 0.57721566490153286;
        return -0.5 * (std::log(u) + 1.0 / (24.0 * u * u) + euler + 2.0 * std::numbers::ln2);
    }
    double sum = 0.0;
    for (double k = 1.0; k <= u; ++k) sum -= 1.0 / (2.0 * k - 1.0);
    return sum;
}

std::vector<double> sampled_covariance(int noise, std::int64_t n) {
    std::vector<double> g(static_cast<std::size_t>(n + 1), 0.0);
    int law = noise % 2 == 0 ? 2 : 1;
    if (law == 2) g[0] = 1.0;
    for (std::size_t k = 0; law == 1 && k < g.size(); ++k) g[k] = flicker_covariance(static_cast<std::int64_t>(k));
    for (; law > noise; law -= 2) {
        std::vector<double> sum(g.size(), 0.0);
        if (sum.size() > 1) sum[1] = -0.5 * g[0];
        for (std::size_t k = 2; k < sum.size(); ++k) sum[k] = 2.0 * sum[k - 1] - sum[k - 2] - g[k - 1];
        g = std::move(sum);
    }
    return g;
}

double continuous_covariance(double t, int noise) {
    const double u = std::abs(t), u2 = u * u;
    if (u == 0.0) return 0.0;
    switch (noise) {
        case 2:
            return -u;
        case 1:
            return u2 * std::log(u);
        case 0:
            return u2 * u;
        case -1:
            return -u2 * u2 * std::log(u);
        case -2:
            return -u2 * u2 * u;
        case -3:
            return u2 * u2 * u2 * std::log(u);
        default:
            return u2 * u2 * u2 * u;
    }
}

DifferenceCovariance::DifferenceCovariance(int noise, int d, bool is_averaged, std::int64_t m, std::int64_t reach)
    : noise_(noise),
      d_(d),
      is_averaged_(is_averaged),
      is_sampled_(m <= max_sampled),
      steps_(steps_of(noise, is_averaged, m)) {
    // The differences reach d or, of the averaged angle, d + 1 averaging times farther.
    if (is_sampled_) sampled_ = sampled_covariance(noise - (is_averaged ? 2 : 0), (reach + d + 2) * m);
}

double DifferenceCovariance::angle(std::int64_t lag) const {
    if (is_sampled_) {
        const auto g = [&](std::int64_t k) { return sampled_[static_cast<std::size_t>(std::abs(k))]; };
        return is_averaged_ ? 2.0 * g(lag) - g(lag - steps_) - g(lag + steps_) : g(lag);
    }
    const double t = static_cast<double>(lag) / static_cast<double>(steps_);
    if (is_averaged_)
        return 2.0 * continuous_covariance(t, noise_) - continuous_covariance(t - 1.0, noise_) -
               continuous_covariance(t + 1.0, noise_);
    return noise_ == 1 ? flicker_covariance(lag) : continuous_covariance(t, noise_ + 2);
}

double DifferenceCovariance::operator()(std::int64_t lag) const {
    const auto at = [&](std::int64_t k) { return angle(lag - k * steps_) + angle(lag + k * steps_); };
    if (d_ == 2) return 3.0 * at(0) - 4.0 * at(1) + at(2);
    return 10.0 * at(0) - 15.0 * at(1) + 6.0 * at(2) - at(3);
}

namespace {

// Variogram of flicker at any lag.
double flicker_between(double lag) {
    constexpr double euler = 0.57721566490153286;
    return -0.5 * (boost::math::digamma(std::abs(lag) + 0.5) + euler + 2.0 * std::numbers::ln2);
}

}  // namespace

std::vector<double> flicker_means_covariance(const Thinned& thin, std::int64_t n, double width_a, double width_b) {
    const auto n_a = std::max<std::int64_t>(1, std::lround(width_a)),
               n_b = std::max<std::int64_t>(1, std::lround(width_b));
    const double spacing = static_cast<double>(std::min(thin.m, max_flicker_m)) / static_cast<double>(thin.steps);
    std::vector<double> g;
    for (std::int64_t k = 0; k <= n; ++k) {
        double sum = 0.0;
        for (std::int64_t a = 0; a < n_a; ++a)
            for (std::int64_t b = 0; b < n_b; ++b) {
                const double centred = static_cast<double>(2 * a - n_a) - static_cast<double>(2 * b - n_b);
                const double lag = spacing * static_cast<double>(k) + 0.5 * centred;
                sum += flicker_between(lag);
            }
        g.push_back(sum / static_cast<double>(n_a * n_b));
    }
    return g;
}

namespace {

std::vector<double> angle_covariance(const Thinned& thin, std::int64_t n) {
    if (thin.steps == thin.m || thin.noise == 2) return sampled_covariance(thin.noise, n);
    if (thin.noise == 1 && thin.kind != DeviationKind::mtotdev) return flicker_means_covariance(thin, n, 1.0, 1.0);
    std::vector<double> g;
    for (std::int64_t k = 0; k <= n; ++k)
        g.push_back(thin.noise == 1 ? flicker_covariance(k)
                                    : continuous_covariance(static_cast<double>(k), thin.noise + 2));
    return g;
}

}  // namespace

Eigen::VectorXd second_difference_covariance(const Thinned& thin, Eigen::Index n, const std::vector<double>& g) {
    const auto at = [&](std::int64_t lag, std::int64_t k) {
        return g[static_cast<std::size_t>(std::abs(lag - k))] + g[static_cast<std::size_t>(lag + k)];
    };
    Eigen::VectorXd covariance(n + 1);
    for (Eigen::Index k = 0; k <= n; ++k)
        covariance[k] = thin.of_rates() ? 10.0 * at(k, 0) - 15.0 * at(k, 1) + 6.0 * at(k, 2) - at(k, 3)
                                        : 3.0 * at(k, 0) - 4.0 * at(k, 1) + at(k, 2);
    return covariance;
}

Eigen::VectorXd second_difference_covariance(const Thinned& thin, Eigen::Index n) {
    return second_difference_covariance(thin, n, angle_covariance(thin, n + 4));
}

Eigen::MatrixXd of_second_differences(const Eigen::MatrixXd& of_values) {
    Eigen::MatrixXd rows(of_values.rows(), of_values.cols() - 2);
    for (Eigen::Index i = 0; i < rows.rows(); ++i) {
        double once = 0.0, twice = 0.0;
        for (Eigen::Index k = 0; k < rows.cols(); ++k) {
            once += of_values(i, k);
            twice += once;
            rows(i, k) = twice;
        }
    }
    return rows;
}

Eigen::MatrixXd mirrored_terms(std::int64_t s, std::int64_t n, std::int64_t first, std::int64_t last) {
    Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(last - first + 1, n + 1);
    for (std::int64_t centre = first; centre <= last; ++centre) {
        auto row = rows.row(centre - first);
        const auto add = [&](std::int64_t k, double weight) {
            const std::int64_t end = k < 0 ? 0 : n;
            if (k < 0 || k > n) {
                row[end] += 2.0 * weight;
                row[2 * end - k] -= weight;
            } else {
                row[k] += weight;
            }
        };
        add(centre - s, 1.0);
        add(centre, -2.0);
        add(centre + s, 1.0);
    }
    return rows;
}

Eigen::RowVectorXd plain_difference(std::int64_t s) {
    Eigen::RowVectorXd row = Eigen::RowVectorXd::Constant(3 * s, 1.0 / static_cast<double>(s));
    row.segment(s, s) *= -2.0;
    return row;
}

Eigen::MatrixXd piece_terms(std::int64_t s) {
    const std::int64_t length = 3 * s, half = length / 2, second = length - half;
    const Eigen::RowVectorXd plain = plain_difference(s);
    Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(2 * half + 1, length);
    for (std::int64_t start = -half; start <= half; ++start)
        for (std::int64_t k = 0; k < length; ++k) {
            const std::int64_t at = ((start + k) % (2 * length) + 2 * length) % (2 * length);
            rows(start + half, at < length ? at : 2 * length - 1 - at) += plain[k];
        }
    Eigen::RowVectorXd mean = Eigen::RowVectorXd::Constant(length, 0.5 / static_cast<double>(half)), slope = mean;
    slope.setConstant(1.0 / (static_cast<double>(half) * static_cast<double>(second)));
    slope.head(half) *= -1.0;
    if (second > half) mean[half] = slope[half] = 0.0;
    const Eigen::VectorXd place = Eigen::VectorXd::LinSpaced(length, -0.5 * static_cast<double>(length - 1),
                                                             0.5 * static_cast<double>(length - 1));
    const Eigen::VectorXd on_mean = rows.rowwise().sum(), on_slope = rows * place;
    rows -= on_mean * mean + on_slope * slope;
    // Of an even length both ends of the half period belong half to the other.
    if (length % 2 == 0) {
        rows.row(0) *= std::sqrt(0.5);
        rows.row(length) *= std::sqrt(0.5);
    }
    return of_second_differences(rows / std::sqrt(static_cast<double>(length)));
}

}  // namespace zlg::deviations
