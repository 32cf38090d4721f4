#include <zlg/noise/mean_error.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace zlg::noise {
namespace {

using std::numbers::pi;

constexpr std::size_t most_means = 64, fewest_means = 8;
// Slow noise gives the mean 2^k times the variance that white noise gives it, one law an octave: beyond these octaves
// lies less than 1 % of its prior.
constexpr int first_octave = -6, last_octave = 22;

struct Mode {
    double k = 0.0, square = 0.0;
};

// One of which less than half as much is known as of the average is a gap.
std::vector<double> means_of(std::span<const double> rates) {
    const std::size_t together = std::max<std::size_t>(1, rates.size() / most_means);
    const auto is_known = [](double x) { return std::isfinite(x); };
    const double share = static_cast<double>(std::ranges::count_if(rates, is_known)) /
                         static_cast<double>(std::max<std::size_t>(1, rates.size()));
    std::vector<double> means;
    for (std::size_t from = 0; from + together <= rates.size(); from += together) {
        double mean = 0.0, known = 0.0;
        for (const double x : rates.subspan(from, together))
            if (is_known(x)) known += 1.0, mean += (x - mean) / known;
        if (known > 0.0 && known >= 0.5 * share * static_cast<double>(together)) means.push_back(mean);
    }
    return means;
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

// Of a law: what it weighs beforehand, logarithm of its likelihood, mean and mean square of the variance of the mean.
struct Law {
    double prior = 1.0, log_likelihood = 0.0, variance = 0.0, square = 0.0;
};

// slow   part of the variance of the mean over that of the white noise.
// shape  of the slow noise in mode k, where the white noise has 1 and the part is 1.
template <class Shape> Law law_of(const std::vector<Mode>& modes, double n, double slow, Shape shape) {
    const auto m = static_cast<double>(modes.size());
    double q = 0.0, logs = 0.0, g = 0.0, squares = 0.0;
    for (const Mode& mode : modes) {
        const double s = 1.0 + slow * shape(mode.k), part = 1.0 - 1.0 / s;
        q += mode.square / s;
        logs += std::log(s);
        g += part / m;
        squares += part * part / m;
    }
    const double v = (1.0 + slow) * q / n;
    return {.prior = std::sqrt(std::max(0.0, squares - g * g)),
            .log_likelihood = -0.5 * (logs + m * std::log(q)),
            .variance = v / (m - 2.0),
            .square = v * v / ((m - 2.0) * (m - 4.0))};
}

// Those of one kind weigh 1 together.
template <class Shape> void add_kind(const std::vector<Mode>& modes, double n, Shape shape, std::vector<Law>& all) {
    std::vector<Law> kind;
    double every = 0.0;
    for (int octave = first_octave; octave <= last_octave; ++octave) {
        kind.push_back(law_of(modes, n, std::ldexp(1.0, octave), shape));
        every += kind.back().prior;
    }
    for (Law& law : kind) law.prior /= every, all.push_back(law);
}

std::vector<Law> laws_of(const std::vector<Mode>& modes, double n) {
    // Of means of a walk with steps q: q (1/(4 sin^2(pi k/(2n))) - 1/6); of the mean of all q n/3, where one of white
    // noise has 1/n.
    const auto walk = [n](double k) {
        return 3.0 / (n * n) * (0.25 / std::pow(std::sin(0.5 * pi * k / n), 2) - 1.0 / 6.0);
    };
    // B^2/(2 pi f) at f = k/(2T), over means of T/n; of the mean of all 2 ln2/pi B^2.
    const auto flicker = [](double k) { return 1.0 / (2.0 * std::numbers::ln2 * k); };
    std::vector<Law> all{law_of(modes, n, 0.0, walk)};
    all.front().prior = 1.0;  // white, the first
    add_kind(modes, n, walk, all);
    add_kind(modes, n, flicker, all);
    return all;
}

}  // namespace

MeanError mean_error(std::span<const double> rates, std::span<const double> half_periods) {
    const std::vector<double> means = means_of(rates);
    const std::vector<Mode> modes = spectrum_of(means, half_periods);
    const bool is_noise = std::ranges::any_of(modes, [](const Mode& mode) { return mode.square > 0.0; });
    if (modes.size() + 1 < fewest_means || !is_noise) return {};
    const std::vector<Law> laws = laws_of(modes, static_cast<double>(means.size()));
    const double most = std::ranges::max_element(laws, {}, &Law::log_likelihood)->log_likelihood;
    double every = 0.0, variance = 0.0, square = 0.0;
    for (const Law& law : laws) {
        const double weight = law.prior * std::exp(law.log_likelihood - most);
        every += weight;
        variance += weight * law.variance;
        square += weight * law.square;
    }
    variance /= every;
    // A Student law has E v^2/(E v)^2 = (degrees - 2)/(degrees - 4).
    const double spread = square / every / (variance * variance);
    return {std::sqrt(variance), (4.0 * spread - 2.0) / (spread - 1.0),
            std::exp(laws.front().log_likelihood - most) / every, std::sqrt(laws.front().variance)};
}

}  // namespace zlg::noise
