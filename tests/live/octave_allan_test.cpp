// Claims about the Allan deviation of a growing record, against its definition.

#include "octave_allan.hpp"

#include "test.hpp"

namespace zlg::live::octave_allan_test {

// Overlapping, of angles at the borders of ticks; of every `stride`-th start.
double by_definition(const std::vector<double>& angle, std::size_t m, std::size_t stride, double tick_s) {
    double squares = 0.0, n = 0.0;
    for (std::size_t k = 0; k + 2 * m < angle.size(); k += stride, n += 1.0)
        squares += std::pow(angle[k + 2 * m] - 2.0 * angle[k + m] + angle[k], 2);
    return std::sqrt(0.5 * squares / n) / (static_cast<double>(m) * tick_s);
}

TEST(OctaveAllan, is_the_overlapping_deviation_and_of_long_averagings_that_of_fewer_starts) {
    std::mt19937_64 random{7};
    std::normal_distribution<double> normal;
    OctaveAllan allan;
    std::vector<double> angle{0.0};
    for (int k = 0; k < 9001; ++k) {
        angle.push_back(angle.back() + 0.1 + normal(random));
        allan.add(angle.back());
    }
    const auto [tau_s, deviation] = allan.points(0.005);
    ASSERT_EQ(tau_s.size(), 13u);  // 4096 ticks are the longest of which two lie side by side
    for (std::size_t k = 0; k < tau_s.size(); ++k) {
        const std::size_t m = std::size_t{1} << k;
        EXPECT_EQ(tau_s[k], 0.005 * static_cast<double>(m));
        EXPECT_NEAR(deviation[k] / by_definition(angle, m, std::max<std::size_t>(1, m / 1024), 0.005), 1.0, 1e-12) << m;
    }
}

TEST(OctaveAllan, says_nothing_before_there_is_a_difference) {
    OctaveAllan allan;
    EXPECT_TRUE(allan.points(1.0).first.empty());
    allan.add(1.0);
    EXPECT_TRUE(allan.points(1.0).first.empty());
    allan.add(4.0);
    EXPECT_EQ(allan.points(1.0).second, std::vector<double>{std::sqrt(0.5 * 4.0)});
}

}  // namespace zlg::live::octave_allan_test
