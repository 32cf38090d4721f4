#include <zlg/noise/spectrum.hpp>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include <fmt/format.h>

#include <unsupported/Eigen/FFT>
#include <zlg/deviations/series.hpp>

namespace zlg::noise {
namespace {

constexpr std::size_t least_samples = 8;

// The least length from n on that has no prime factor over 5.
std::size_t quick_length(std::size_t n) {
    for (;; ++n) {
        std::size_t rest = n;
        for (const std::size_t prime : {2u, 3u, 5u})
            while (rest % prime == 0 && rest > 1) rest /= prime;
        if (rest <= 1) return n;
    }
}

// The known samples less their weighted mean under the window, the others 0; empty where too little is known.
//
// squares  of the weights of those that are known.
std::vector<double> windowed(std::span<const double> values, const std::vector<double>& window, double least_known,
                             double& squares) {
    double weight = 0.0, weighted = 0.0, n = 0.0;
    squares = 0.0;
    for (std::size_t k = 0; k < values.size(); ++k) {
        if (!std::isfinite(values[k])) continue;
        n += 1.0;
        weight += window[k];
        weighted += window[k] * values[k];
        squares += window[k] * window[k];
    }
    if (n < static_cast<double>(least_samples) || n < least_known) return {};
    std::vector<double> out(quick_length(values.size()), 0.0);
    for (std::size_t k = 0; k < values.size(); ++k)
        if (std::isfinite(values[k])) out[k] = window[k] * (values[k] - weighted / weight);
    return out;
}

}  // namespace

Spectrum welch_spectrum(std::span<const double> rates, double rate_hz, std::size_t piece, double least_known_ratio) {
    if (!(rate_hz > 0.0) || !std::isfinite(rate_hz))
        throw deviations::SeriesError(fmt::format("spectrum: rate {} Hz, allowed is a positive number", rate_hz));
    if (piece < least_samples || rates.size() < least_samples)
        throw deviations::SeriesError(
            fmt::format("spectrum: pieces of {} of {} samples, allowed is from 8", piece, rates.size()));
    const std::size_t length = std::min(piece, rates.size()), padded = quick_length(length);
    std::vector<double> window;
    for (std::size_t k = 0; k < length; ++k)
        window.push_back(
            1.0 - std::cos(2.0 * std::numbers::pi * (static_cast<double>(k) + 0.5) / static_cast<double>(length)));
    Spectrum mean{.frequency_hz = {}, .density = std::vector<double>(padded / 2, 0.0)};
    for (std::size_t k = 1; k <= padded / 2; ++k)
        mean.frequency_hz.push_back(static_cast<double>(k) * rate_hz / static_cast<double>(padded));
    Eigen::FFT<double> transform;
    transform.SetFlag(Eigen::FFT<double>::HalfSpectrum);
    std::vector<std::complex<double>> transformed;
    for (std::size_t from = 0; from + length <= rates.size(); from += std::max<std::size_t>(1, length / 2)) {
        double squares = 0.0;
        const std::vector<double> values =
            windowed(rates.subspan(from, length), window, least_known_ratio * static_cast<double>(length), squares);
        if (values.empty()) continue;
        ++mean.pieces;
        transform.fwd(transformed, values);
        // Both signs of the frequency are one line, except at half the rate.
        for (std::size_t k = 1; k <= padded / 2; ++k)
            mean.density[k - 1] += (2 * k == padded ? 1.0 : 2.0) * std::norm(transformed[k]) / (squares * rate_hz);
    }
    if (mean.pieces == 0)
        throw deviations::SeriesError(
            fmt::format("spectrum: no piece of {} samples of which {} is known", piece, least_known_ratio));
    for (double& d : mean.density) d /= static_cast<double>(mean.pieces);
    return mean;
}

}  // namespace zlg::noise
