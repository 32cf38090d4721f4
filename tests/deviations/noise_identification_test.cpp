#include <zlg/deviations/noise_identification.hpp>

#include "test.hpp"

namespace zlg::deviations::noise_identification_test {

std::vector<double> white(int n, unsigned seed) {
    std::mt19937_64 engine(seed);
    std::normal_distribution<double> normal;
    std::vector<double> values(static_cast<std::size_t>(n));
    for (auto& value : values) value = normal(engine);
    return values;
}

// Rates of spectrum f^noise, noise even: white noise differenced or summed.
std::vector<double> identified_rates(int noise, int n, unsigned seed) {
    auto values = white(n, seed);
    if (noise == 2) std::adjacent_difference(values.begin(), values.end(), values.begin());
    for (int k = noise; k < 0; k += 2) std::partial_sum(values.begin(), values.end(), values.begin());
    return values;
}

AngleRecord record_of(const std::vector<double>& values) {
    return AngleRecord(Series{.what = {DataKind::rate, Unit::one, 1.0}, .values = values});
}

TEST(NoiseIdentification, tells_the_laws_apart_at_every_averaging) {
    for (const int noise : {2, 0, -2, -4})
        for (unsigned seed = 1; seed <= 5; ++seed) {
            const auto steps = noise_steps(record_of(identified_rates(noise, 8192, seed)), 0.9);
            ASSERT_EQ(steps.size(), 9U);  // 1 ... 256: 30 means or more
            for (const auto& step : steps) {
                if (step.means < 100) continue;
                // Sums of samples are taken for -3 until averaging has made them smooth.
                if (noise == -4 && step.m < 32) continue;
                EXPECT_EQ(std::lround(*noise_exponent(steps, step.m)), noise) << "m " << step.m << " seed " << seed;
            }
        }
}

TEST(NoiseIdentification, sees_one_law_give_way_to_another) {
    auto values = identified_rates(0, 1 << 17, 3);
    const auto walk = identified_rates(-2, 1 << 17, 4);
    for (std::size_t k = 0; k < values.size(); ++k) values[k] += 0.02 * walk[k];
    const auto steps = noise_steps(record_of(values), 0.9);
    EXPECT_EQ(std::lround(*noise_exponent(steps, 1)), 0);
    EXPECT_EQ(std::lround(*noise_exponent(steps, 2048)), -2);
}

TEST(NoiseIdentification, is_not_misled_by_gaps_or_a_constant_rate) {
    auto values = identified_rates(0, 8192, 5);
    for (std::size_t k = 0; k < values.size(); ++k) {
        values[k] += 1e6;
        if (k % 100 < 3) values[k] = std::numeric_limits<double>::quiet_NaN();
    }
    const auto steps = noise_steps(record_of(values), 0.9);
    for (const std::int64_t m : {1, 16, 64}) EXPECT_EQ(std::lround(*noise_exponent(steps, m)), 0) << m;
}

TEST(NoiseIdentification, says_nothing_of_a_short_record) {
    EXPECT_TRUE(noise_steps(record_of(white(29, 6)), 0.9).empty());
    EXPECT_FALSE(noise_exponent({}, 1).has_value());
    EXPECT_EQ(noise_steps(record_of(white(31, 6)), 0.9).size(), 1U);
}

TEST(NoiseIdentification, weighs_steps_by_their_means) {
    const std::array<NoiseStep, 4> steps{{{1, 800, 2.0}, {2, 400, 1.0}, {4, 200, 0.0}, {8, 100, -1.0}}};
    EXPECT_DOUBLE_EQ(*noise_exponent(steps, 1), 2.0);
    EXPECT_DOUBLE_EQ(*noise_exponent(steps, 3), (1600.0 + 400.0) / 1200.0);
    EXPECT_DOUBLE_EQ(*noise_exponent(steps, 1000), (400.0 - 100.0) / 700.0);
}

}  // namespace zlg::deviations::noise_identification_test
