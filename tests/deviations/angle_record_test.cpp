#include <zlg/deviations/angle_record.hpp>

#include "records.hpp"

namespace zlg::deviations::angle_record_test {

constexpr SeriesKind rates{DataKind::rate, Unit::one, 1.0};

TEST(AngleRecord, sums_what_is_known_less_its_mean) {
    const std::vector<double> values{1.0, 4.0, not_a_number, 7.0};
    const AngleRecord record(Series{.what = rates, .values = values});
    const std::vector<double> expected{0.0, -3.0, -3.0, -3.0, 0.0};
    ASSERT_EQ(record.angle().size(), 5U);
    for (std::size_t k = 0; k < 5; ++k) EXPECT_DOUBLE_EQ(record.angle()[k], expected[k]);
    const std::vector<std::uint32_t> known{0, 1, 2, 2, 3};
    for (std::size_t k = 0; k < 5; ++k) EXPECT_EQ(record.known()[k], known[k]);
    EXPECT_EQ(record.n_intervals(), 4);
    EXPECT_EQ(record.n_known(), 3);
    EXPECT_TRUE(record.has_gaps());
}

TEST(AngleRecord, needs_no_counts_without_gaps) {
    const std::vector<double> values{1.0, 4.0};
    EXPECT_TRUE(AngleRecord(Series{.what = rates, .values = values}).known().empty());
}

TEST(AngleRecord, takes_infinity_and_flagged_samples_for_missing) {
    const std::vector<double> values{1.0, std::numeric_limits<double>::infinity(), 4.0, 9.0};
    const std::vector<std::uint8_t> valid{1, 1, 0, 1};
    EXPECT_EQ(AngleRecord(Series{.what = rates, .values = values, .valid = valid}).n_known(), 2);
}

TEST(AngleRecord, keeps_phase_as_it_is) {
    const std::vector<double> values{1.0, not_a_number, 5.0};
    const AngleRecord record(Series{.what = {DataKind::phase, Unit::one, 1.0}, .values = values});
    EXPECT_EQ(record.n_intervals(), 2);
    EXPECT_EQ(record.angle()[2], 5.0);
    EXPECT_TRUE(std::isnan(record.angle()[1]));
}

// The sum of ten million steps of 0.1 less their mean, with one step in the middle, is right to the last bits.
TEST(AngleRecord, does_not_lose_in_a_long_sum) {
    std::vector<double> values(3000000, 0.1);
    values.front() += 1.0;
    values.back() -= 1.0;
    const AngleRecord record(Series{.what = rates, .values = values});
    EXPECT_NEAR(record.angle()[values.size() / 2], 1.0, 1e-9);
    EXPECT_NEAR(record.angle()[values.size()], 0.0, 1e-9);
}

TEST(AngleRecord, sums_in_place_what_it_is_given) {
    std::vector<double> values{1.0, 2.0, 6.0};
    values.reserve(4);
    const double* place = values.data();
    const AngleRecord record(rates, std::move(values));
    EXPECT_EQ(record.angle().data(), place);
    EXPECT_DOUBLE_EQ(record.angle()[1], -2.0);
}

TEST(AngleRecord, refuses_what_has_nothing_to_say) {
    const std::vector<double> none{not_a_number, not_a_number}, constant{2.0, not_a_number, 2.0};
    EXPECT_THROW(AngleRecord(Series{.what = rates, .values = none}), SeriesError);
    EXPECT_THROW(AngleRecord(Series{.what = rates, .values = constant}), SeriesError);
    EXPECT_THROW(AngleRecord(rates, std::vector<double>{}), SeriesError);
}

}  // namespace zlg::deviations::angle_record_test
