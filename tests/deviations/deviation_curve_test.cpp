#include <zlg/deviations/deviation_curve.hpp>

#include <zlg/deviations/series.hpp>

#include "test.hpp"

namespace zlg::deviations::deviation_curve_test {

TEST(DeviationCurve, an_option_out_of_its_range_is_refused) {
    EXPECT_NO_THROW(check(DeviationOptions{}));
    for (const double bad : {0.0, 1.0, -0.1, std::numeric_limits<double>::quiet_NaN()})
        EXPECT_THROW(check(DeviationOptions{.confidence = bad}), SeriesError) << bad;
    for (const double bad : {0.0, 1.01, std::numeric_limits<double>::quiet_NaN()})
        EXPECT_THROW(check(DeviationOptions{.least_known_ratio = bad}), SeriesError) << bad;
    for (const int bad : {3, -5}) EXPECT_THROW(check(DeviationOptions{.noise = bad}), SeriesError) << bad;
}

}  // namespace zlg::deviations::deviation_curve_test
