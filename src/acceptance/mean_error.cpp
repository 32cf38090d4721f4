#include "mean_error.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include <Eigen/Dense>

namespace zlg::acceptance {
namespace {

using std::numbers::pi;

constexpr std::size_t most_means = 64, fewest_means = 8;
// Of the laws: slow noise gives the variance of the mean 2^k times the part of the white noise, one k an octave.
constexpr int first_octave = 4, last_octave = 20;
constexpr double white_weight = 20.0, flicker_weight = 0.2;  // that of a walk is 1

struct Mode {
    double k = 0.0, square = 0.0;
};

std::vector<double> joined(std::span<const double> means) {
    const std::size_t together = std::max<std::size_t>(1, means.size() / most_means);
    std::vector<double> all;
    for (std::size_t from = 0; from + together <= means.size(); from += together) {
        double mean = 0.0, known = 0.0;
        for (const double x : means.subspan(from, together))
            if (std::isfinite(x)) known += 1.0, mean += (x - mean) / known;
        if (known > 0.0) all.push_back(mean);
    }
    return all;
}

// By least squares, with the mean.
void take_out(double half_periods, std::vector<double>& x) {
    const auto n = static_cast<Eigen::Index>(x.size());
    Eigen::MatrixXd laws(n, 3);
    for (Eigen::Index k = 0; k < n; ++k) {
        const double angle = pi * half_periods * (static_cast<double>(k) + 0.5) / static_cast<double>(n);
        laws.row(k) << 1.0, std::cos(angle), std::sin(angle);
    }
    Eigen::Map<Eigen::VectorXd> all{x.data(), n};
    const Eigen::VectorXd fit = laws.colPivHouseholderQr().solve(all);
    all -= laws * fit;
}

std::vector<Mode> spectrum_of(const std::vector<double>& x, std::span<const double> half_periods) {
    constexpr double beside = 1.0;  // a sinusoid that was taken out takes noise along
    const auto n = static_cast<double>(x.size());
    std::vector<Mode> modes;
    for (double k = 1.0; k < n; k += 1.0) {
        if (std::ranges::any_of(half_periods, [k](double line) { return std::abs(k - line) <= beside; })) continue;
        double sum = 0.0, at = 0.5;
        for (const double one : x) sum += (one - x.front()) * std::cos(pi * k * at / n), at += 1.0;
        modes.push_back({k, 2.0 / n * sum * sum});
    }
    return modes;
}

// Of one law: logarithm of its likelihood, mean and mean square of the variance of the mean.
struct Posterior {
    double log_weight = 0.0, variance = 0.0, square = 0.0;
};

// slow   part of the variance of the mean over that of the white noise.
// shape  of the slow noise in mode k, where the white noise has 1 and the part is 1.
template <class Shape>
Posterior posterior(const std::vector<Mode>& modes, double n, double weight, double slow, Shape shape) {
    const auto m = static_cast<double>(modes.size());
    double q = 0.0, logs = 0.0;
    for (const Mode& mode : modes) {
        const double s = 1.0 + slow * shape(mode.k);
        q += mode.square / s;
        logs += std::log(s);
    }
    const double v = (1.0 + slow) * q / n;
    return {std::log(weight) - 0.5 * (logs + m * std::log(q)), v / (m - 2.0), v * v / ((m - 2.0) * (m - 4.0))};
}

std::vector<Posterior> posteriors(const std::vector<Mode>& modes, double n) {
    // Of means of a walk with steps q: q (1/(4 sin^2(pi k/(2n))) - 1/6); of the mean of all q n/3, where one of white
    // noise has 1/n.
    const auto walk = [n](double k) {
        return 3.0 / (n * n) * (0.25 / std::pow(std::sin(0.5 * pi * k / n), 2) - 1.0 / 6.0);
    };
    // B^2/(2 pi f) at f = k/(2T), over means of T/n; of the mean of all 2 ln2/pi B^2.
    const auto flicker = [](double k) { return 1.0 / (2.0 * std::numbers::ln2 * k); };
    std::vector<Posterior> all{posterior(modes, n, white_weight, 0.0, walk)};
    for (int octave = first_octave; octave <= last_octave; ++octave) {
        all.push_back(posterior(modes, n, 1.0, std::ldexp(1.0, octave), walk));
        all.push_back(posterior(modes, n, flicker_weight, std::ldexp(1.0, octave), flicker));
    }
    return all;
}

}  // namespace

MeanError mean_error(std::span<const double> means, std::span<const double> half_periods) {
    std::vector<double> x = joined(means);
    for (const double line : half_periods)
        if (line < static_cast<double>(x.size())) take_out(line, x);
    const std::vector<Mode> modes = spectrum_of(x, half_periods);
    const bool is_noise = std::ranges::any_of(modes, [](const Mode& mode) { return mode.square > 0.0; });
    if (modes.size() + 1 < fewest_means || !is_noise) return {std::numeric_limits<double>::infinity(), 1.0};
    const std::vector<Posterior> all = posteriors(modes, static_cast<double>(x.size()));
    const double most = std::ranges::max_element(all, {}, &Posterior::log_weight)->log_weight;
    double every = 0.0, variance = 0.0, square = 0.0;
    for (const Posterior& p : all) {
        const double weight = std::exp(p.log_weight - most);
        every += weight;
        variance += weight * p.variance;
        square += weight * p.square;
    }
    variance /= every;
    // A Student law has E v^2/(E v)^2 = (degrees - 2)/(degrees - 4).
    const double spread = square / every / (variance * variance);
    return {std::sqrt(variance), (4.0 * spread - 2.0) / (spread - 1.0)};
}

}  // namespace zlg::acceptance
