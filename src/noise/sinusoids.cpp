#include "sinusoids.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <numbers>
#include <optional>

#include <Eigen/Dense>
#include <boost/math/distributions/fisher_f.hpp>

#include <zlg/noise/spectrum.hpp>

#include <zlg/numeric/minimum.hpp>

namespace zlg::noise {
namespace {

using std::numbers::pi;

// Longer records are averaged piece by piece, which bounds memory and time; a line is then placed over the whole
// record.
constexpr std::size_t longest_piece = std::size_t{1} << 19;
constexpr std::size_t first_bin = 8;    // periods in a piece
constexpr std::size_t line_width = 4;   // bins of a Hann window's line, to either side
constexpr std::size_t max_around = 48;  // bins of comparison to either side
constexpr double chance = 0.002;        // of a line in noise, anywhere in the record
constexpr double min_of_first = 1e-9;   // beside a line of 1: what is left of it by rounding
constexpr double min_known = 0.05;      // of a piece

struct Peak {
    std::size_t bin = 0;
    double level = 0.0;  // of the spectrum around it
    double probability = 1.0;
};

// The spectrum around a bin without the line itself, by the median: another line nearby does not count.
struct Surroundings {
    double level;
    std::size_t n;
};

Surroundings around(const std::vector<double>& density, std::size_t bin, std::size_t pieces) {
    const std::size_t reach = std::min(max_around + line_width, std::max<std::size_t>(bin / 2, line_width + 3));
    const std::size_t from = bin > reach ? bin - reach : 0, to = std::min(density.size(), bin + reach + 1);
    std::vector<double> others;
    for (std::size_t k = from; k < to; ++k)
        if (k + line_width < bin || k > bin + line_width) others.push_back(density[k]);
    const auto middle = others.begin() + std::ssize(others) / 2;
    std::nth_element(others.begin(), middle, others.end());
    // Median over mean of a chi-square variable of 2 degrees for each piece.
    const double median = std::pow(1.0 - 1.0 / (9.0 * static_cast<double>(pieces)), 3);
    return {*middle / median, others.size()};
}

// A coarse level of each stretch of bins, for a first look.
std::vector<double> coarse_levels(const std::vector<double>& density, std::size_t stretch) {
    std::vector<double> levels;
    for (std::size_t k = 0; k < density.size(); k += stretch) {
        const auto first = density.begin() + static_cast<std::ptrdiff_t>(k);
        std::vector<double> part(first, first + static_cast<std::ptrdiff_t>(std::min(stretch, density.size() - k)));
        const auto middle = part.begin() + std::ssize(part) / 2;
        std::nth_element(part.begin(), middle, part.end());
        levels.push_back(*middle);
    }
    return levels;
}

Peak highest_peak(const Spectrum& spectrum) {
    constexpr std::size_t stretch = 32;
    const auto coarse = coarse_levels(spectrum.density, stretch);
    Peak best;
    double most = 0.0;
    for (std::size_t k = first_bin; k + 1 < spectrum.density.size(); ++k) {
        const double level = k < 4 * stretch ? around(spectrum.density, k, spectrum.pieces).level : coarse[k / stretch];
        if (!(spectrum.density[k] > most * level)) continue;
        most = spectrum.density[k] / level;
        best.bin = k;
    }
    if (most == 0.0) return best;
    const Surroundings here = around(spectrum.density, best.bin, spectrum.pieces);
    best.level = here.level;
    if (!(here.level > 0.0)) return best;
    const auto n = static_cast<double>(spectrum.pieces);
    // The median of n numbers is as good as the mean of half of them.
    const boost::math::fisher_f law(2.0 * n, n * static_cast<double>(here.n));
    best.probability = boost::math::cdf(boost::math::complement(law, spectrum.density[best.bin] / here.level)) *
                       static_cast<double>(spectrum.density.size());
    return best;
}

double hann(std::size_t k, std::size_t n) {
    return 1.0 - std::cos(2.0 * pi * (static_cast<double>(k) + 0.5) / static_cast<double>(n));
}

// exp(2 pi i f k/rate), k = 0, 1, ...: a product each, set right now and then.
class Rotation {
public:
    explicit Rotation(double cycles_per_sample) : cycles_(cycles_per_sample), step_(at(1)) {}
    std::complex<double> next() {
        if (k_ % 1024 == 0) now_ = at(k_);
        const auto value = now_;
        now_ *= step_;
        ++k_;
        return value;
    }

private:
    [[nodiscard]] std::complex<double> at(std::size_t k) const {
        const double turns = cycles_ * static_cast<double>(k);
        return std::polar(1.0, 2.0 * pi * (turns - std::floor(turns)));
    }
    double cycles_;
    std::complex<double> step_;
    std::complex<double> now_{1.0, 0.0};
    std::size_t k_ = 0;
};

// Sums of the weighted rates, turned back by the frequency near the line, over blocks: what is left turns slowly.
struct Demodulated {
    std::vector<std::complex<double>> sum;
    double block_s;

    [[nodiscard]] double power(double offset_hz) const {
        std::complex<double> total = 0.0;
        for (std::size_t b = 0; b < sum.size(); ++b)
            total += sum[b] * std::polar(1.0, -2.0 * pi * offset_hz * block_s * static_cast<double>(b));
        return std::norm(total);
    }
};

Demodulated demodulate(std::span<const double> rates, double mean, double rate_hz, double frequency_hz,
                       std::size_t n_blocks) {
    const std::size_t length = (rates.size() + n_blocks - 1) / n_blocks;
    Demodulated d{.sum = std::vector<std::complex<double>>((rates.size() + length - 1) / length),
                  .block_s = static_cast<double>(length) / rate_hz};
    Rotation rotation(-frequency_hz / rate_hz);
    for (std::size_t k = 0; k < rates.size(); ++k) {
        const auto turn = rotation.next();
        if (std::isfinite(rates[k])) d.sum[k / length] += hann(k, rates.size()) * (rates[k] - mean) * turn;
    }
    return d;
}

struct KnownPart {
    double mean = 0.0;
    double n = 0.0;
};

KnownPart known_part(std::span<const double> rates) {
    KnownPart known;
    for (const double r : rates)
        if (std::isfinite(r)) known.n += 1.0, known.mean += (r - known.mean) / known.n;
    return known;
}

double fine_frequency(std::span<const double> rates, double mean, double rate_hz, double frequency_hz, double step_hz) {
    const double record_s = static_cast<double>(rates.size()) / rate_hz;
    const auto n_blocks = std::min(rates.size(), static_cast<std::size_t>(32.0 * step_hz * record_s) + 32);
    const Demodulated d = demodulate(rates, mean, rate_hz, frequency_hz, n_blocks);
    const auto n_steps = static_cast<int>(std::min(4000.0, 16.0 * step_hz * record_s));
    const auto loss = [&d](double offset_hz) { return -d.power(offset_hz); };
    return frequency_hz + numeric::scanned_minimum(loss, -step_hz, step_hz, n_steps).at;
}

// Constant, cosine, sine, and what a change of the frequency does, by least squares, weighted by the Hann window: slow
// drifts do not leak in, and gaps do no harm.
//
// return  cosine, sine, and the change of the frequency, Hz.
Eigen::Vector3d least_squares(std::span<const double> rates, double mean, double rate_hz, const Sinusoid& s) {
    Eigen::Matrix4d normal = Eigen::Matrix4d::Zero();
    Eigen::Vector4d right = Eigen::Vector4d::Zero();
    Rotation rotation(s.frequency_hz / rate_hz);
    const auto n = static_cast<double>(rates.size());
    for (std::size_t k = 0; k < rates.size(); ++k) {
        const auto turn = rotation.next();
        if (!std::isfinite(rates[k])) continue;
        const double t = static_cast<double>(k) / n - 0.5;
        const Eigen::Vector4d row{1.0, turn.real(), turn.imag(), t * (s.sine * turn.real() - s.cosine * turn.imag())};
        const double w = hann(k, rates.size());
        normal.noalias() += w * row * row.transpose();
        right += w * (rates[k] - mean) * row;
    }
    // The middle of the record is where phase and frequency do not depend on each other; the phase is kept at its
    // start.
    const Eigen::Vector4d fit = normal.ldlt().solve(right);
    return {fit[1], fit[2], std::isfinite(fit[3]) ? fit[3] * rate_hz / (2.0 * pi * n) : 0.0};
}

// With a change of the frequency the phase turns about the middle of the record.
void improve(std::span<const double> rates, double mean, double rate_hz, Sinusoid& s) {
    const double half_s = 0.5 * static_cast<double>(rates.size()) / rate_hz;
    for (int round = 0; round < 4; ++round) {
        const Eigen::Vector3d fit = least_squares(rates, mean, rate_hz, s);
        const double change_hz = round == 0 ? 0.0 : fit[2];
        const std::complex<double> turned =
            std::complex<double>(fit[0], -fit[1]) * std::polar(1.0, -2.0 * pi * change_hz * half_s);
        s.cosine = turned.real();
        s.sine = -turned.imag();
        s.frequency_hz += change_hz;
    }
}

void subtract(std::span<double> rates, double rate_hz, const Sinusoid& s, double times) {
    Rotation rotation(s.frequency_hz / rate_hz);
    for (double& r : rates) {
        const auto turn = rotation.next();
        r -= times * (s.cosine * turn.real() + s.sine * turn.imag());
    }
}

// A Hann window leaves 2/3 of the record's information on the amplitude, and less than half of that on the frequency.
// With a two-sided density S and a record of T seconds the variances are 3 S/T and, of the angular frequency, 56.2
// S/(A^2 T^3): the sandwich covariance of least squares with the window as weight. Without it they are 2 S/T and
// 24 S/(A^2 T^3).
void take_sigmas(Sinusoid& s, double level, double known_s, double span_s) {
    const double two_sided = 0.5 * level;
    s.amplitude_sigma = std::sqrt(3.0 * two_sided / known_s);
    const double amplitude = std::max(s.amplitude_arcsec_s, s.amplitude_sigma);
    s.frequency_sigma_hz =
        std::sqrt(56.2 * two_sided / (amplitude * amplitude * known_s * span_s * span_s)) / (2.0 * pi);
}

std::optional<Sinusoid> strongest(std::span<const double> rates, double rate_hz, double& step_hz) {
    const Spectrum spectrum = welch_spectrum(rates, rate_hz, std::min(rates.size(), longest_piece), min_known);
    if (spectrum.density.size() < 4 * first_bin) return std::nullopt;
    const Peak peak = highest_peak(spectrum);
    if (!(peak.probability < chance)) return std::nullopt;
    step_hz = spectrum.frequency_hz[0];
    const auto [mean, n] = known_part(rates);
    Sinusoid s;
    s.frequency_hz = fine_frequency(rates, mean, rate_hz, spectrum.frequency_hz[peak.bin], step_hz);
    improve(rates, mean, rate_hz, s);
    s.amplitude_arcsec_s = std::hypot(s.cosine, s.sine);
    take_sigmas(s, peak.level, n / rate_hz, static_cast<double>(rates.size()) / rate_hz);
    return s;
}

}  // namespace

std::vector<Sinusoid> take_out_sinusoids(std::span<double> rates, double rate_hz, int most) {
    std::vector<Sinusoid> found;
    double first = 0.0;
    while (most > 0) {
        double step_hz = 0.0;
        const auto next = strongest(rates, rate_hz, step_hz);
        if (!next || next->amplitude_arcsec_s < min_of_first * first) break;
        first = std::max(first, next->amplitude_arcsec_s);
        const auto beside = std::find_if(found.begin(), found.end(), [&](const Sinusoid& s) {
            return std::abs(s.frequency_hz - next->frequency_hz) < 2.0 * static_cast<double>(line_width) * step_hz;
        });
        if (beside != found.end()) {
            subtract(rates, rate_hz, *beside, -1.0);
            found.erase(beside);
            break;
        }
        // One more than are wanted is looked for, to see whether the last one was coherent.
        if (std::ssize(found) == most) break;
        subtract(rates, rate_hz, *next, 1.0);
        found.push_back(*next);
    }
    for (Sinusoid& s : found) {
        // What is seen is the mean over a sample.
        const double x = pi * s.frequency_hz / rate_hz;
        const double averaged = std::sin(x) / x;
        s.amplitude_arcsec_s /= averaged;
        s.amplitude_sigma /= averaged;
    }
    return found;
}

}  // namespace zlg::noise
