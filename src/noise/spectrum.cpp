#include <zlg/noise/spectrum.hpp>

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <numbers>
#include <vector>

#include <fmt/format.h>

#include <unsupported/Eigen/FFT>
#include <zlg/deviations/series.hpp>
#include <zlg/numeric/parallel.hpp>

namespace zlg::noise {
namespace {

constexpr std::size_t max_samples_at_work = std::size_t{1} << 19;

// The least length from n on that has no prime factor over 5.
std::size_t quick_length(std::size_t n) {
    for (;; ++n) {
        std::size_t rest = n;
        for (const std::size_t prime : {2u, 3u, 5u})
            while (rest % prime == 0 && rest > 1) rest /= prime;
        if (rest <= 1) return n;
    }
}

// Sums of x_k exp(-2 pi i j k/n), j = 0..n/2. What it computes once for a length, the next piece finds in it.
class HalfTransform {
public:
    HalfTransform() { transform_.SetFlag(Eigen::FFT<double>::HalfSpectrum); }
    const std::vector<std::complex<double>>& of(const std::vector<double>& values) {
        transform_.fwd(spectrum_, values);
        return spectrum_;
    }

private:
    Eigen::FFT<double> transform_;
    std::vector<std::complex<double>> spectrum_;
};

class Pieces {
public:
    Pieces(std::span<const double> rates, double rate_hz, std::size_t piece, double least_known_ratio)
        : rates_(rates), rate_hz_(rate_hz), min_known_(least_known_ratio) {
        if (!(rate_hz > 0.0) || !std::isfinite(rate_hz))
            throw deviations::SeriesError(fmt::format("spectrum: rate {} Hz, allowed is a positive number", rate_hz));
        if (piece < 8 || rates.size() < 8)
            throw deviations::SeriesError(
                fmt::format("spectrum: pieces of {} of {} samples, allowed is from 8", piece, rates.size()));
        length_ = std::min(piece, rates.size());
        padded_ = quick_length(length_);
        for (std::size_t k = 0; k < length_; ++k)
            window_.push_back(
                1.0 - std::cos(2.0 * std::numbers::pi * (static_cast<double>(k) + 0.5) / static_cast<double>(length_)));
    }

    [[nodiscard]] std::size_t length() const { return length_; }
    [[nodiscard]] std::size_t count() const { return (rates_.size() - length_) / step() + 1; }
    [[nodiscard]] std::size_t step() const { return std::max<std::size_t>(1, length_ / 2); }
    [[nodiscard]] std::vector<double> frequencies() const {
        std::vector<double> f;
        for (std::size_t k = 1; k <= padded_ / 2; ++k)
            f.push_back(static_cast<double>(k) * rate_hz_ / static_cast<double>(padded_));
        return f;
    }

    // Empty where too little is known.
    [[nodiscard]] std::vector<double> density(std::size_t p, HalfTransform& transform) const {
        const auto values = rates_.subspan(p * step(), length_);
        double weight = 0.0, weighted = 0.0, squares = 0.0;
        std::size_t n = 0;
        for (std::size_t k = 0; k < length_; ++k) {
            if (!std::isfinite(values[k])) continue;
            ++n;
            weight += window_[k];
            weighted += window_[k] * values[k];
            squares += window_[k] * window_[k];
        }
        if (n < 8 || static_cast<double>(n) < min_known_ * static_cast<double>(length_)) return {};
        std::vector<double> windowed(padded_, 0.0);
        for (std::size_t k = 0; k < length_; ++k)
            if (std::isfinite(values[k])) windowed[k] = window_[k] * (values[k] - weighted / weight);
        std::vector<double> out;
        const auto& transformed = transform.of(windowed);
        for (std::size_t k = 1; k <= padded_ / 2; ++k) {
            // Both signs of the frequency are one line, except at half the rate.
            const double sides = 2 * k == padded_ ? 1.0 : 2.0;
            out.push_back(sides * std::norm(transformed[k]) / (squares * rate_hz_));
        }
        return out;
    }

private:
    std::span<const double> rates_;
    double rate_hz_;
    double min_known_;
    std::size_t length_ = 0;
    std::size_t padded_ = 0;
    std::vector<double> window_;
};

}  // namespace

Spectrum welch_spectrum(std::span<const double> rates, double rate_hz, std::size_t piece, double least_known_ratio,
                        int threads) {
    const Pieces pieces(rates, rate_hz, piece, least_known_ratio);
    Spectrum mean{.frequency_hz = pieces.frequencies(), .density = {}};
    mean.density.assign(mean.frequency_hz.size(), 0.0);
    // So many pieces at a time, added up in their order: the sum is the same on any number of threads.
    // A piece at work holds some 40 bytes a sample, so that the longest are one at a time.
    const std::size_t at_work = std::max<std::size_t>(1, max_samples_at_work / pieces.length());
    const std::size_t together = std::min(at_work, static_cast<std::size_t>(std::max(threads, 1)));
    std::vector<HalfTransform> transforms(together);
    std::vector<std::vector<double>> each(together);
    for (std::size_t from = 0; from < pieces.count(); from += together) {
        const std::size_t n = std::min(together, pieces.count() - from);
        numeric::in_parallel(n, threads, [&](std::size_t t) { each[t] = pieces.density(from + t, transforms[t]); });
        for (std::size_t t = 0; t < n; ++t) {
            if (each[t].empty()) continue;
            ++mean.pieces;
            for (std::size_t k = 0; k < each[t].size(); ++k) mean.density[k] += each[t][k];
        }
    }
    if (mean.pieces == 0)
        throw deviations::SeriesError(
            fmt::format("spectrum: no piece of {} samples of which {} is known", piece, least_known_ratio));
    for (double& d : mean.density) d /= static_cast<double>(mean.pieces);
    return mean;
}

}  // namespace zlg::noise
