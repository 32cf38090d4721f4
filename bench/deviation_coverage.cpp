// How often the intervals of a deviation contain the truth, for each kind of noise, with its type given and identified.
//
// usage: zlg_deviation_coverage [RECORDS [SAMPLES]]       default 10000 records of 1024 samples
//
// Printed are the smallest and the largest share over the averaging times 1, 2, 4, ... <= T/8. Exit 1 where one is out of what
// is allowed.

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <complex>
#include <cstdlib>
#include <numbers>
#include <numeric>
#include <random>
#include <vector>

#include <unsupported/Eigen/FFT>

#include <fmt/format.h>
#include <zlg/analysis/averaging.hpp>
#include <zlg/analysis/deviation.hpp>
#include <zlg/analysis/deviation_confidence.hpp>

namespace {

using namespace zlg::analysis;

constexpr std::array kinds{DeviationKind::oadev, DeviationKind::mdev, DeviationKind::hdev, DeviationKind::ohdev};
constexpr std::array confidences{0.6827, 0.95};

// Records of rate noise f^noise: white noise through (1 - B)^(noise/2), for noise < 0 through (1 - B)^(noise/2 + 1) and a
// running sum. Weights reach seven records back; what is cut off belongs to the law that is simulated.
class PowerLawNoise {
public:
    PowerLawNoise(int noise, std::size_t samples, unsigned seed)
        : samples_(samples), size_(std::bit_ceil(8 * samples)), is_summed_(noise < 0), engine_(seed) {
        const double order = -0.5 * noise - (is_summed_ ? 1.0 : 0.0);
        std::vector<double> weight(size_, 0.0);
        weight[0] = 1.0;
        for (std::size_t k = 1; k < size_ - samples_; ++k)
            weight[k] = weight[k - 1] * (static_cast<double>(k) - 1.0 + order) / static_cast<double>(k);
        transform_.fwd(response_, weight);
    }

    std::vector<double> next() {
        std::vector<double> values(size_);
        for (auto& value : values) value = normal_(engine_);
        std::vector<std::complex<double>> spectrum;
        transform_.fwd(spectrum, values);
        for (std::size_t k = 0; k < spectrum.size(); ++k) spectrum[k] *= response_[k];
        transform_.inv(values, spectrum);
        values.erase(values.begin(), values.end() - static_cast<std::ptrdiff_t>(samples_));
        if (is_summed_) std::partial_sum(values.begin(), values.end(), values.begin());
        return values;
    }

    // The spectrum through the estimator's response: both are sums of cosines that this many frequencies integrate exactly.
    [[nodiscard]] double true_deviation(DeviationKind kind, std::int64_t m) const {
        double sum = 0.0;
        for (std::size_t k = 0; k < response_.size(); ++k) {
            const double f = std::max(1e-9, static_cast<double>(k) / static_cast<double>(size_));
            const double s = std::sin(std::numbers::pi * f),
                         sm = std::sin(std::numbers::pi * f * static_cast<double>(m));
            const double mean = sm / (static_cast<double>(m) * s), difference = 4.0 * sm * sm;
            double response = mean * mean * difference / 2.0;
            if (kind == DeviationKind::mdev) response *= mean * mean;
            if (difference_order(kind) == 3) response *= difference / 3.0;
            if (is_summed_) response /= 4.0 * s * s;
            sum += std::norm(response_[k]) * response;
        }
        return std::sqrt(sum / static_cast<double>(response_.size()));
    }

private:
    std::size_t samples_, size_;
    bool is_summed_;
    std::mt19937_64 engine_;
    std::normal_distribution<double> normal_;
    Eigen::FFT<double> transform_;
    std::vector<std::complex<double>> response_;
};

struct Share {
    std::int64_t inside = 0, all = 0;
    void count(bool is_inside) {
        inside += is_inside ? 1 : 0;
        ++all;
    }
    [[nodiscard]] double percent() const { return 100.0 * static_cast<double>(inside) / static_cast<double>(all); }
};

struct Cell {
    double truth = 0.0;
    VarianceLaw law{};
    std::array<Share, 2> given{}, identified{};
};

void count(Cell& cell, const DeviationPoint& point) {
    for (std::size_t c = 0; c < confidences.size(); ++c) {
        const auto given = confidence_interval(point.deviation, cell.law, confidences[c]);
        cell.given[c].count(given.low <= cell.truth && cell.truth <= given.high);
        const auto identified = confidence_interval(point.deviation, point.law, confidences[c]);
        cell.identified[c].count(identified.low <= cell.truth && cell.truth <= identified.high);
    }
}

struct Range {
    double low = 100.0, high = 0.0;
    void add(double percent) {
        low = std::min(low, percent);
        high = std::max(high, percent);
    }
};

bool print(const char* what, const Range& range, double low, double high) {
    const bool good = range.low >= low && range.high <= high;
    fmt::print("  {} {:5.1f} ..{:5.1f} %{}", what, range.low, range.high, good ? " " : "!");
    return good;
}

bool run(int noise, std::int64_t records, std::size_t samples, bool verbose) {
    const auto factors = octave_factors(static_cast<std::int64_t>(samples) / 8);
    PowerLawNoise source(noise, samples, 1);
    std::vector<std::vector<Cell>> cells(kinds.size(), std::vector<Cell>(factors.size()));
    for (std::size_t k = 0; k < kinds.size(); ++k)
        for (std::size_t t = 0; t < factors.size(); ++t) {
            cells[k][t].truth = source.true_deviation(kinds[k], factors[t]);
            cells[k][t].law = variance_law(kinds[k], noise, factors[t], static_cast<std::int64_t>(samples));
        }
    for (std::int64_t r = 0; r < records; ++r) {
        const auto values = source.next();
        const AngleRecord record(Series{.what = {DataKind::rate, Unit::one, 1.0}, .values = values});
        for (std::size_t k = 0; k < kinds.size(); ++k) {
            const auto curve = deviation(record, kinds[k], factors);
            for (std::size_t t = 0; t < factors.size(); ++t) count(cells[k][t], curve.points[t]);
        }
    }
    bool good = true;
    for (std::size_t k = 0; k < kinds.size(); ++k) {
        std::array<Range, 2> given, identified;
        for (std::size_t t = 0; t < factors.size(); ++t)
            for (std::size_t c = 0; c < 2; ++c) {
                given[c].add(cells[k][t].given[c].percent());
                identified[c].add(cells[k][t].identified[c].percent());
            }
        fmt::print("{:>5} f^{:<2}", name_of(kinds[k]), noise);
        good &= print("given 68:", given[0], 66.0, 70.0);
        good &= print("95:", given[1], 94.0, 96.0);
        good &= print("identified 68:", identified[0], 60.0, 75.0);
        good &= print("95:", identified[1], 90.0, 98.0);
        fmt::print("\n");
        if (verbose)
            for (std::size_t t = 0; t < factors.size(); ++t)
                fmt::print("      m {:4} given {:5.1f} {:5.1f} identified {:5.1f} {:5.1f} edf {:.1f} p {:.1f}\n",
                           factors[t], cells[k][t].given[0].percent(), cells[k][t].given[1].percent(),
                           cells[k][t].identified[0].percent(), cells[k][t].identified[1].percent(),
                           cells[k][t].law.edf, cells[k][t].law.skewness_p);
    }
    return good;
}

}  // namespace

int main(int argc, char** argv) {
    const std::int64_t records = argc > 1 ? std::atoll(argv[1]) : 10000;
    const std::size_t samples = argc > 2 ? static_cast<std::size_t>(std::atoll(argv[2])) : 1024;
    if (records < 1 || samples < 64) {
        fmt::print(stderr, "zlg_deviation_coverage: allowed is 1 or more records of 64 or more samples\n");
        return 2;
    }
    bool good = true;
    for (const int noise : {2, 1, 0, -1, -2}) good &= run(noise, records, samples, argc > 3);
    return good ? 0 : 1;
}
