// A thousand million normal deviates against their law: moments, the whole distribution function, the tails; as a table
// in Markdown.
//
// Exit 1 where chance alone would bring a figure so far off less than once in ten thousand times.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <span>
#include <string>
#include <vector>

#include <boost/math/special_functions/gamma.hpp>
#include <zlg/chance/address.hpp>
#include <zlg/numeric/parallel.hpp>

#include "command.hpp"

namespace {

using namespace zlg;

constexpr std::size_t of_half = 32;  // deviates of an address, as the twin draws them
constexpr std::size_t halves_of_piece = 1 << 18;
constexpr std::size_t n_cells = 1 << 20;  // of the distribution function, evenly in probability
constexpr std::array sigmas{3.0, 4.0, 5.0, 6.0};
constexpr double least_probability = 1e-4;

double probability_below(double x) { return 0.5 * std::erfc(-x / std::numbers::sqrt2); }

struct Tally {
    std::array<double, 4> powers{};  // sums of x, x^2, x^3, x^4
    std::array<std::uint64_t, sigmas.size()> beyond{};
    double largest = 0.0;
    std::vector<std::uint32_t> cells = std::vector<std::uint32_t>(n_cells);

    void take(double x) {
        powers[0] += x;
        powers[1] += x * x;
        powers[2] += x * x * x;
        powers[3] += x * x * x * x;
        for (std::size_t k = 0; k < sigmas.size(); ++k) beyond[k] += std::abs(x) > sigmas[k] ? 1u : 0u;
        largest = std::max(largest, std::abs(x));
        ++cells[std::min(static_cast<std::size_t>(probability_below(x) * n_cells), n_cells - 1)];
    }

    void add(const Tally& other) {
        for (std::size_t k = 0; k < powers.size(); ++k) powers[k] += other.powers[k];
        for (std::size_t k = 0; k < beyond.size(); ++k) beyond[k] += other.beyond[k];
        largest = std::max(largest, other.largest);
        for (std::size_t k = 0; k < n_cells; ++k) cells[k] += other.cells[k];
    }
};

Tally piece(std::uint64_t seed, std::size_t k) {
    Tally tally;
    chance::Address address{.seed = seed, .cause = chance::Cause::test, .half = k * halves_of_piece};
    std::array<double, of_half> x{};
    for (std::size_t i = 0; i < halves_of_piece; ++i, ++address.half) {
        normals(address, x);
        for (const double one : x) tally.take(one);
    }
    return tally;
}

// Largest distance of the distribution functions at the borders of the cells; what it may be further within one is
// below 1e-6.
double distance(const Tally& tally, double n) {
    double below = 0.0, furthest = 0.0;
    for (std::size_t k = 0; k < n_cells; ++k) {
        below += static_cast<double>(tally.cells[k]);
        furthest = std::max(furthest, std::abs(below / n - static_cast<double>(k + 1) / n_cells));
    }
    return furthest;
}

// That Kolmogorov's statistic sqrt(n) D exceeds x: his series for many numbers.
double kolmogorov_probability(double x) {
    double sum = 0.0;
    for (int k = 1; k <= 100; ++k) sum += (k % 2 == 1 ? 2.0 : -2.0) * std::exp(-2.0 * k * k * x * x);
    return std::min(1.0, sum);
}

// That a Poisson count of this mean is at least as far off, on either side.
double poisson_probability(double count, double mean) {
    const double at_most = boost::math::gamma_q(count + 1.0, mean);
    const double at_least = count > 0.0 ? boost::math::gamma_p(count, mean) : 1.0;
    return std::min(1.0, 2.0 * std::min(at_most, at_least));
}

class Table {
public:
    Table() { fmt::print("| figure | found | expected | probability of so far off |\n|---|---|---|---|\n"); }

    void row(const std::string& name, const std::string& found, const std::string& expected, double probability) {
        fmt::print("| {} | {} | {} | {:.3f} |\n", name, found, expected, probability);
        is_good_ = is_good_ && probability > least_probability;
    }
    [[nodiscard]] bool is_good() const { return is_good_; }

private:
    bool is_good_ = true;
};

bool print(const Tally& tally, double n) {
    Table table;
    const std::array<const char*, 4> names{"mean", "mean of squares", "mean of cubes", "mean of fourth powers"};
    constexpr std::array expected{0.0, 1.0, 0.0, 3.0};
    constexpr std::array variance{1.0, 2.0, 15.0, 96.0};  // of x^p: E x^2p - (E x^p)^2
    for (std::size_t k = 0; k < names.size(); ++k) {
        const double mean = tally.powers[k] / n;
        const double sigma = std::sqrt(variance[k] / n);
        table.row(names[k], fmt::format("{:.6f}", mean), fmt::format("{:.0f} ± {:.6f}", expected[k], sigma),
                  2.0 * probability_below(-std::abs(mean - expected[k]) / sigma));
    }
    const double statistic = std::sqrt(n) * distance(tally, n);
    table.row("Kolmogorov and Smirnov, sqrt(n) D", fmt::format("{:.3f}", statistic), "0.87 ± 0.26",
              kolmogorov_probability(statistic));
    for (std::size_t k = 0; k < sigmas.size(); ++k) {
        const double mean = 2.0 * n * probability_below(-sigmas[k]);
        table.row(fmt::format("beyond {:.0f} sigma", sigmas[k]), fmt::format("{}", tally.beyond[k]),
                  fmt::format("{:.1f}", mean), poisson_probability(static_cast<double>(tally.beyond[k]), mean));
    }
    fmt::print("\n{:.0f} deviates; the largest in size is {:.3f}.\n", n, tally.largest);
    return table.is_good();
}

}  // namespace

int main(int argc, char** argv) {
    double wanted = 1e9;
    std::uint64_t seed = 1;
    int threads = 2;
    CLI::App app{"Normal deviates by address against the normal law", "zlg_normal_law"};
    app.add_option("DEVIATES", wanted)->check(CLI::Range(1e6, 4e9));
    app.add_option("--seed", seed);
    app.add_option("--threads", threads)->check(CLI::PositiveNumber);
    return trials::run_command(app, argc, argv, [&] {
        constexpr std::size_t of_piece = of_half * halves_of_piece;
        const auto of_run = static_cast<std::size_t>(threads);
        const auto pieces = static_cast<std::size_t>(std::ceil(wanted / of_piece));
        Tally all;
        for (std::size_t done = 0; done < pieces; done += of_run) {
            std::vector<Tally> tallies(std::min(of_run, pieces - done));
            numeric::in_parallel(tallies.size(), threads, [&](std::size_t k) { tallies[k] = piece(seed, done + k); });
            for (const Tally& tally : tallies) all.add(tally);
        }
        return print(all, static_cast<double>(pieces * of_piece)) ? 0 : 1;
    });
}
