#include <zlg/deviations/averaging.hpp>

#include <zlg/deviations/series.hpp>

#include "test.hpp"

using Factors = std::vector<std::int64_t>;

namespace zlg::deviations::averaging_test {

TEST(Averaging, has_octaves_decades_all_and_many_per_decade) {
    EXPECT_EQ(octave_factors(20), (Factors{1, 2, 4, 8, 16}));
    EXPECT_EQ(octave_factors(16), (Factors{1, 2, 4, 8, 16}));
    EXPECT_EQ(octave_factors(0), Factors{});
    EXPECT_EQ(decade_factors(199), (Factors{1, 2, 4, 10, 20, 40, 100}));
    EXPECT_EQ(all_factors(4), (Factors{1, 2, 3, 4}));
    // 10^(k/4): 1, 1.78, 3.16, 5.62, 10
    EXPECT_EQ(log_factors(4, 20), (Factors{1, 2, 3, 6, 10, 18}));
    EXPECT_EQ(log_factors(10, 10), (Factors{1, 2, 3, 4, 5, 6, 8, 10}));
}

TEST(Averaging, ends_at_the_largest_number_there_is) {
    constexpr std::int64_t most = std::numeric_limits<std::int64_t>::max();
    EXPECT_EQ(octave_factors(most).size(), 63U);
    EXPECT_EQ(decade_factors(most).back(), 8000000000000000000 / 2);
}

TEST(Averaging, takes_the_nearest_whole_number_of_intervals) {
    const std::vector<double> taus_s{0.1, 0.005, 0.0074, 0.0051};
    EXPECT_EQ(nearest_factors(taus_s, 200.0, 100), (Factors{1, 20}));
    for (const double bad : {0.0, 0.001, -1.0, 0.6, std::numeric_limits<double>::quiet_NaN()}) {
        const std::vector<double> one{bad};
        EXPECT_THROW((void)nearest_factors(one, 200.0, 100), SeriesError) << bad;
    }
    EXPECT_THROW((void)log_factors(0, 10), SeriesError);
}

// One term of the longest averaging, none of the next.
TEST(Averaging, is_longest_where_one_term_is_left) {
    EXPECT_EQ(largest_factor(DeviationKind::oadev, 20), 10);
    EXPECT_EQ(largest_factor(DeviationKind::ohdev, 20), 6);
    EXPECT_EQ(largest_factor(DeviationKind::mdev, 20), 7);  // 21 angles
    EXPECT_EQ(largest_factor(DeviationKind::mdev, 19), 6);
    EXPECT_EQ(largest_factor(DeviationKind::totdev, 21), 10);
}

}  // namespace zlg::deviations::averaging_test
