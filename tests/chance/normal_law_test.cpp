// Ten million deviates against the normal law: moments, the whole distribution function, the tails.

#include <zlg/chance/address.hpp>

#include "test.hpp"

namespace zlg::chance::normal_law_test {

constexpr std::size_t n_deviates = 10'000'000;

// As the twin draws: few at an address, halves one after the other.
const std::vector<double>& deviates() {
    static const std::vector<double> all = [] {
        constexpr std::size_t of_half = 32;
        std::vector<double> x(n_deviates);
        Address address{.seed = 1, .cause = Cause::test};
        for (std::size_t at = 0; at < n_deviates; at += of_half, ++address.half)
            normals(address, std::span{x}.subspan(at, of_half));
        return x;
    }();
    return all;
}

double probability_below(double x) { return 0.5 * std::erfc(-x / std::numbers::sqrt2); }

// E x^p = (p - 1)!! for even p; the mean of n_deviates has the variance (E x^2p - (E x^p)^2)/n_deviates.
TEST(NormalLaw, MomentsAreThoseOfTheLaw) {
    const auto expected = [](int p) {
        double product = p % 2 == 0 ? 1.0 : 0.0;
        for (int k = p - 1; k > 1; k -= 2) product *= k;
        return product;
    };
    for (int p = 1; p <= 6; ++p) {
        double sum = 0.0;
        for (const double x : deviates()) sum += std::pow(x, p);
        const double sigma = std::sqrt((expected(2 * p) - expected(p) * expected(p)) / static_cast<double>(n_deviates));
        EXPECT_NEAR(sum / static_cast<double>(n_deviates), expected(p), 4.0 * sigma) << p;
    }
}

// Kolmogorov's statistic sqrt(n_deviates) D is above 1.95 with a probability of 0.001.
TEST(NormalLaw, TheDistributionFunctionIsThatOfTheLaw) {
    std::vector<double> sorted = deviates();
    std::ranges::sort(sorted);
    double furthest = 0.0;
    for (std::size_t i = 0; i < n_deviates; ++i) {
        const double p = probability_below(sorted[i]);
        furthest =
            std::max({furthest, p - static_cast<double>(i) / n_deviates, static_cast<double>(i + 1) / n_deviates - p});
    }
    EXPECT_LT(std::sqrt(static_cast<double>(n_deviates)) * furthest, 1.95);
}

TEST(NormalLaw, TheTailsHoldAsManyAsTheyShould) {
    for (const double sigmas : {3.0, 3.5, 4.0, 4.5, 5.0}) {
        const double expected = n_deviates * probability_below(-sigmas);
        const auto beyond = std::ranges::count_if(deviates(), [=](double x) { return x > sigmas; });
        const auto below = std::ranges::count_if(deviates(), [=](double x) { return x < -sigmas; });
        EXPECT_NEAR(static_cast<double>(beyond), expected, 4.0 * std::sqrt(expected)) << sigmas;
        EXPECT_NEAR(static_cast<double>(below), expected, 4.0 * std::sqrt(expected)) << -sigmas;
    }
}

}  // namespace zlg::chance::normal_law_test
