// How often the intervals of a deviation contain the truth, for each kind of deviation and of noise, from the longest
// averaging time down, with the type of the noise given and identified.
//
// Printed are the smallest and the largest share over the averaging times, with `all` every one, and the worst. Exit 1
// where one, the noise given, is more than 3 % beside its confidence, by more than three standard errors of so many
// records.

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <complex>
#include <cstdint>
#include <map>
#include <numbers>
#include <numeric>
#include <string>
#include <vector>

#include <unsupported/Eigen/FFT>

#include <zlg/chance/draw.hpp>
#include <zlg/deviations/averaging.hpp>
#include <zlg/deviations/deviation.hpp>
#include <zlg/deviations/deviation_confidence.hpp>

#include "command.hpp"

namespace {

using namespace zlg::deviations;

constexpr std::array confidences{0.68, 0.90, 0.95, 0.99};
constexpr std::array lengths_over_tau{2.1, 2.22, 2.25, 2.28, 2.34, 2.5,  2.9,  3.0,  3.05, 3.1,  3.25, 3.5,  3.7,
                                      4.0, 4.2,  5.0,  6.3,  7.7,  10.0, 13.0, 16.0, 17.5, 20.0, 32.0, 64.0, 128.0};
constexpr double allowed_percent = 3.0;

// Records of rate noise f^noise: white noise through (1 - B)^(noise/2), for noise < 0 through (1 - B)^(noise/2 + 1) and
// a running sum (Kasdin, Proc. IEEE 83, 1995, 802). Weights reach seven records back; what is cut off belongs to the
// law that is simulated.
class PowerLawNoise {
public:
    PowerLawNoise(int noise, std::size_t samples, std::uint64_t seed)
        : samples_(samples),
          size_(std::bit_ceil(8 * samples)),
          is_summed_(noise < 0),
          draw_(seed, zlg::chance::Cause::deviation_record) {
        const double order = -0.5 * noise - (is_summed_ ? 1.0 : 0.0);
        std::vector<double> weight(size_, 0.0);
        weight[0] = 1.0;
        for (std::size_t k = 1; k < size_ - samples_; ++k)
            weight[k] = weight[k - 1] * (static_cast<double>(k) - 1.0 + order) / static_cast<double>(k);
        transform_.fwd(response_, weight);
    }

    std::vector<double> next() {
        std::vector<double> values(size_);
        for (auto& value : values) value = draw_.normal();
        std::vector<std::complex<double>> spectrum;
        transform_.fwd(spectrum, values);
        for (std::size_t k = 0; k < spectrum.size(); ++k) spectrum[k] *= response_[k];
        transform_.inv(values, spectrum);
        values.erase(values.begin(), values.end() - static_cast<std::ptrdiff_t>(samples_));
        if (is_summed_) std::partial_sum(values.begin(), values.end(), values.begin());
        return values;
    }

    // The spectrum through the estimator's response: both are sums of cosines that this many frequencies integrate
    // exactly.
    [[nodiscard]] double true_deviation(DeviationKind kind, std::int64_t m) const {
        double sum = 0.0;
        for (std::size_t k = 0; k < response_.size(); ++k) {
            const double f = std::max(1e-9, static_cast<double>(k) / static_cast<double>(size_));
            const double s = std::sin(std::numbers::pi * f),
                         sm = std::sin(std::numbers::pi * f * static_cast<double>(m));
            const double mean = sm / (static_cast<double>(m) * s), difference = 4.0 * sm * sm;
            double response = mean * mean * difference / 2.0;
            if (is_modified(kind)) response *= mean * mean;
            if (difference_order(kind) == 3) response *= difference / 3.0;
            if (is_summed_) response /= 4.0 * s * s;
            sum += std::norm(response_[k]) * response;
        }
        const double scale = kind == DeviationKind::tdev ? static_cast<double>(m) / std::numbers::sqrt3 : 1.0;
        return scale * std::sqrt(sum / static_cast<double>(response_.size()));
    }

private:
    std::size_t samples_, size_;
    bool is_summed_;
    zlg::chance::Draw draw_;
    Eigen::FFT<double> transform_;
    std::vector<std::complex<double>> response_;
};

using Counts = std::array<std::int64_t, confidences.size()>;

struct Cell {
    DeviationKind kind = DeviationKind::oadev;
    std::int64_t m = 1, samples = 1;
    double truth = 0.0;
    std::map<int, std::array<Interval, confidences.size()>> of_noise{};  // of a deviation of 1
    std::int64_t all = 0;
    Counts given{}, identified{};

    [[nodiscard]] double length_over_tau() const { return static_cast<double>(samples) / static_cast<double>(m); }

    void count(double deviation, int noise, Counts& inside) {
        auto& intervals = of_noise[noise];
        for (std::size_t c = 0; c < confidences.size(); ++c) {
            if (intervals[c].high == 0.0)
                intervals[c] = confidence_interval(1.0, variance_law(kind, noise, m, samples), confidences[c]);
            inside[c] += intervals[c].low * deviation <= truth && truth <= intervals[c].high * deviation ? 1 : 0;
        }
    }
    [[nodiscard]] double percent(std::int64_t inside) const {
        return 100.0 * static_cast<double>(inside) / static_cast<double>(all);
    }
};

std::vector<std::int64_t> factors_of(DeviationKind kind, std::int64_t samples) {
    std::vector<std::int64_t> factors{1};
    for (const double ratio : lengths_over_tau) {
        const auto m = static_cast<std::int64_t>(std::floor(static_cast<double>(samples) / ratio + 1e-9));
        if (m >= 1 && m <= largest_factor(kind, samples)) factors.push_back(m);
    }
    std::ranges::sort(factors);
    factors.erase(std::unique(factors.begin(), factors.end()), factors.end());
    return factors;
}

// Identified as an analysis would: what the record says at each averaging time.
std::map<std::int64_t, int> identified_noise(const AngleRecord& record, DeviationKind kind,
                                             const std::vector<std::int64_t>& factors) {
    const auto simple = difference_order(kind) == 3 ? DeviationKind::ohdev : DeviationKind::oadev;
    std::map<std::int64_t, int> noise;
    for (const auto& point : deviation(record, simple, factors).points) noise[point.m] = point.noise;
    return noise;
}

std::vector<std::vector<Cell>> simulate(int noise, std::int64_t records, std::int64_t samples) {
    PowerLawNoise source(noise, static_cast<std::size_t>(samples), 1);
    std::vector<std::vector<Cell>> cells(deviation_kinds.size());
    std::vector<std::vector<std::int64_t>> factors;
    for (std::size_t k = 0; k < deviation_kinds.size(); ++k) {
        factors.push_back(factors_of(deviation_kinds[k], samples));
        for (const auto m : factors[k])
            cells[k].push_back({.kind = deviation_kinds[k],
                                .m = m,
                                .samples = samples,
                                .truth = source.true_deviation(deviation_kinds[k], m)});
    }
    for (std::int64_t r = 0; r < records; ++r) {
        const auto values = source.next();
        const AngleRecord record(Series{.what = {DataKind::rate, Unit::one, 1.0}, .values = values});
        for (std::size_t k = 0; k < deviation_kinds.size(); ++k) {
            const auto found = identified_noise(record, deviation_kinds[k], factors[k]);
            const auto curve = deviation(record, deviation_kinds[k], factors[k], {.noise = noise});
            for (std::size_t t = 0; t < factors[k].size(); ++t) {
                Cell& cell = cells[k][t];
                ++cell.all;
                const double value = curve.points[t].deviation;
                cell.count(value, noise, cell.given);
                const int other = found.at(cell.m);
                const auto bias = [&](int of) { return total_variance_bias(cell.kind, of, cell.m, samples); };
                cell.count(value * std::sqrt(bias(noise) / bias(other)), other, cell.identified);
            }
        }
    }
    return cells;
}

// The smallest and the largest percentage over the averaging times.
template <class Percent>
std::string range_text(const std::vector<Cell>& cells, const Percent& percent) {
    std::vector<double> all;
    for (const Cell& cell : cells) all.push_back(percent(cell));
    const auto [low, high] = std::ranges::minmax(all);
    return fmt::format(" {:.1f} .. {:.1f} |", low, high);
}

struct Worst {
    double beside = 0.0;  // percent
    std::string where{};
    bool is_good = true;
};

// What chance puts beside a share that is as low as allowed, percent.
double chance_percent(double confidence, std::int64_t records) {
    const double least = confidence - 0.01 * allowed_percent;
    return 300.0 * std::sqrt(least * (1.0 - least) / static_cast<double>(records));
}

void print_row(int noise, const std::vector<Cell>& cells, Worst& worst) {
    fmt::print("| {} | `{}` |", noise, name_of(cells.front().kind));
    for (std::size_t c = 0; c < confidences.size(); ++c) {
        const auto given = [&](const Cell& cell) { return cell.percent(cell.given[c]); };
        for (const Cell& cell : cells) {
            const double beside = std::abs(given(cell) - 100.0 * confidences[c]);
            if (beside > allowed_percent + chance_percent(confidences[c], cell.all)) worst.is_good = false;
            if (beside <= worst.beside) continue;
            worst.beside = beside;
            worst.where = fmt::format("{} f^{} T/tau {:.3f}: {:.0f} % holds {:.2f} %", name_of(cell.kind), noise,
                                      cell.length_over_tau(), 100.0 * confidences[c], given(cell));
        }
        fmt::print("{}", range_text(cells, given));
    }
    for (const std::size_t c : {std::size_t{0}, std::size_t{2}})
        fmt::print("{}", range_text(cells, [&](const Cell& cell) { return cell.percent(cell.identified[c]); }));
    fmt::print("\n");
}

void print_cells(const std::vector<Cell>& cells) {
    for (const Cell& cell : cells) {
        fmt::print("    T/tau {:8.3f} m {:4} edf {:6.1f} given", cell.length_over_tau(), cell.m,
                   variance_law(cell.kind, cell.of_noise.begin()->first, cell.m, cell.samples).edf);
        for (const auto inside : cell.given) fmt::print(" {:5.1f}", cell.percent(inside));
        fmt::print("  identified");
        for (const auto inside : cell.identified) fmt::print(" {:5.1f}", cell.percent(inside));
        fmt::print("\n");
    }
}

}  // namespace

int main(int argc, char** argv) {
    std::int64_t records = 10'000;
    std::int64_t samples = 256;
    std::string which;
    CLI::App app{"How often intervals of deviations contain the truth", "zlg_deviation_coverage"};
    app.add_option("RECORDS", records)->check(CLI::PositiveNumber);
    app.add_option("SAMPLES", samples, "of a record")->check(CLI::Range(32, 65536));
    app.add_option("WHICH", which, "every averaging time too")->check(CLI::IsMember({"all"}));
    return zlg::trials::run_command(app, argc, argv, [&] {
        fmt::print("| noise | deviation |");
        for (const double confidence : confidences) fmt::print(" {:.0f} %, given |", 100.0 * confidence);
        fmt::print(" 68 %, identified | 95 %, identified |\n|---|---|---|---|---|---|---|---|\n");
        Worst worst;
        for (const int noise : {2, 1, 0, -1, -2})
            for (const auto& cells : simulate(noise, records, samples)) {
                print_row(noise, cells, worst);
                if (which == "all") print_cells(cells);
            }
        fmt::print("\nWorst: {}. {} records of {} samples; chance leaves {:.1f} % at 68 %.\n", worst.where, records,
                   samples, 100.0 * std::sqrt(0.68 * 0.32 / static_cast<double>(records)));
        return worst.is_good ? 0 : 1;
    });
}
