#include <zlg/deviations/series.hpp>

#include "test.hpp"

namespace zlg::deviations::series_test {

const std::vector<double> two{1.0, 2.0};

Series series(DataKind kind, Unit unit, double rate_hz = 1.0) { return {.what = {kind, unit, rate_hz}, .values = two}; }

TEST(Series, takes_units_of_the_kind_of_its_data) {
    EXPECT_NO_THROW(check(series(DataKind::increments, Unit::arcsec)));
    EXPECT_NO_THROW(check(series(DataKind::phase, Unit::rad)));
    EXPECT_NO_THROW(check(series(DataKind::rate, Unit::deg_h)));
    for (const auto kind : {DataKind::increments, DataKind::phase, DataKind::rate})
        EXPECT_NO_THROW(check(series(kind, Unit::one)));
    EXPECT_THROW(check(series(DataKind::increments, Unit::deg_h)), SeriesError);
    EXPECT_THROW(check(series(DataKind::phase, Unit::arcsec_s)), SeriesError);
    EXPECT_THROW(check(series(DataKind::rate, Unit::arcsec)), SeriesError);
}

TEST(Series, needs_a_sampling_rate) {
    for (const double rate_hz :
         {0.0, -1.0, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()})
        EXPECT_THROW(check(series(DataKind::rate, Unit::one, rate_hz)), SeriesError);
}

TEST(Series, needs_a_mark_for_each_sample_or_none) {
    auto marked = series(DataKind::rate, Unit::one);
    const std::vector<std::uint8_t> one{1}, both{1, 0};
    marked.valid = both;
    EXPECT_NO_THROW(check(marked));
    marked.valid = one;
    EXPECT_THROW(check(marked), SeriesError);
}

TEST(Series, knows_units_by_their_names) {
    for (const auto unit :
         {Unit::arcsec, Unit::rad, Unit::deg, Unit::arcsec_s, Unit::rad_s, Unit::deg_s, Unit::deg_h, Unit::one})
        EXPECT_EQ(unit_of(name_of(unit)), unit);
    EXPECT_EQ(unit_of("deg/h"), Unit::deg_h);
    EXPECT_THROW((void)unit_of("deg/hr"), SeriesError);
    EXPECT_EQ(data_kind_of("increments"), DataKind::increments);
    EXPECT_EQ(data_kind_of("rate"), DataKind::rate);
    EXPECT_EQ(data_kind_of("phase"), DataKind::phase);
    EXPECT_THROW((void)data_kind_of("freq"), SeriesError);
}

TEST(Series, counts_units_in_arcsec) {
    EXPECT_DOUBLE_EQ(in_arcsec(Unit::deg), 3600.0);
    EXPECT_DOUBLE_EQ(in_arcsec(Unit::deg_h), 1.0);  // 3600 arcsec in 3600 s
    EXPECT_NEAR(in_arcsec(Unit::rad_s), 206264.80624709636, 1e-9);
    EXPECT_TRUE(is_rate(Unit::deg_h));
    EXPECT_FALSE(is_rate(Unit::deg));
    // Increments are divided by the interval to be rates; the scale is of a variance.
    EXPECT_DOUBLE_EQ(rate_scale({DataKind::increments, Unit::arcsec, 200.0}), 200.0 * 200.0);
    EXPECT_DOUBLE_EQ(rate_scale({DataKind::rate, Unit::arcsec_s, 200.0}), 1.0);
}

}  // namespace zlg::deviations::series_test
