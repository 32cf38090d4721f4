#include "difference_covariance.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>

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
        case 2: return -u;
        case 1: return u2 * std::log(u);
        case 0: return u2 * u;
        case -1: return -u2 * u2 * std::log(u);
        case -2: return -u2 * u2 * u;
        case -3: return u2 * u2 * u2 * std::log(u);
        default: return u2 * u2 * u2 * u;
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

}  // namespace zlg::deviations
