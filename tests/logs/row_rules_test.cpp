#include <zlg/logs/row_rules.hpp>

#include "test.hpp"

namespace zlg::logs::row_rules_test {

using zlg::core::HalfRecord;

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

TEST(RowRules, rows_are_counted_without_holes) {
    EXPECT_TRUE(RowNumber::allows(7, 7));
    EXPECT_FALSE(RowNumber::allows(8, 7));
    EXPECT_EQ(RowNumber::fault(8, 7), "leaves a hole; expected 7");
    EXPECT_EQ(RowNumber::fault(6, 7), "is a repetition; expected 7");
    zlg::test::expect_contains(RowNumber::fault(796, 0), "expected 0, where the numbers of every log begin");
    EXPECT_EQ(RowNumber::fault(-1, 7), "is out of range; allowed is 0..9223372036854775807");
}

TEST(RowRules, whole_numbers_have_bounds) {
    EXPECT_TRUE(Sign::allows(1, 0) && Sign::allows(-1, 0));
    EXPECT_FALSE(Sign::allows(0, 0) || Sign::allows(2, 0) || Sign::allows(-2, 0));
    EXPECT_TRUE(Flag::allows(0, 0) && Flag::allows(1, 0));
    EXPECT_FALSE(Flag::allows(-1, 0) || Flag::allows(2, 0));
    constexpr Whole die{1, 6};
    EXPECT_TRUE(die.allows(1, 0) && die.allows(6, 0));
    EXPECT_FALSE(die.allows(0, 0) || die.allows(7, 0));
    EXPECT_EQ(Sign::fault(0, 0), "is out of range; allowed is +1 or -1");
    EXPECT_EQ(Flag::fault(2, 0), "is out of range; allowed is 0 or 1");
    EXPECT_EQ(die.fault(7, 0), "is out of range; allowed is 1..6");
    EXPECT_TRUE(any_whole<std::int32_t>.allows(std::numeric_limits<std::int32_t>::min(), 0));
}

TEST(RowRules, real_numbers_are_finite) {
    EXPECT_TRUE(Real{}.allows(std::numeric_limits<double>::max(), 0));
    EXPECT_TRUE(Real{}.allows(std::numeric_limits<double>::lowest(), 0));
    for (const double bad : {infinity, -infinity, nan}) {
        EXPECT_FALSE(Real{}.allows(bad, 0)) << bad;
        EXPECT_EQ(Real{}.fault(bad, 0), "is not finite; allowed is a finite number") << bad;
    }
    constexpr Real unit{0.0, 1.0, "lambda"};
    EXPECT_TRUE(unit.allows(1.0, 0));
    EXPECT_FALSE(unit.allows(1.1, 0) || unit.allows(-0.1, 0) || unit.allows(nan, 0));
    EXPECT_EQ(unit.fault(1.1, 0), "is out of range; allowed is 0..1 lambda");
}

TEST(RowRules, a_light_sample_may_be_missing_but_not_infinite) {
    EXPECT_TRUE(Sample::allows(0.7, 0) && Sample::allows(nan, 0));
    EXPECT_FALSE(Sample::allows(infinity, 0) || Sample::allows(-infinity, 0));
    EXPECT_EQ(Sample::fault(infinity, 0),
              "is out of range; allowed is a finite number, or nan where the converter gave none");
}

TEST(RowRules, a_deviation_may_be_unknown) {
    EXPECT_TRUE(Deviation::allows(0.0, 0) && Deviation::allows(infinity, 0));
    EXPECT_FALSE(Deviation::allows(-1e-300, 0) || Deviation::allows(nan, 0));
    EXPECT_EQ(Deviation::fault(-1.0, 0), "is negative; allowed is 0 or more, or inf");
    EXPECT_EQ(Deviation::fault(nan, 0), "is not a number; allowed is a number or inf");
}

TEST(RawSequence, the_bias_sign_alternates) {
    RawSequence rows;
    EXPECT_TRUE(rows.next({.bias_sign = -1}));
    const HalfRecord same{.bias_sign = -1};
    EXPECT_FALSE(rows.next(same));
    EXPECT_STREQ(rows.fault(same).column, "bias_sign");
    EXPECT_EQ(rows.fault(same).value, -1);
    EXPECT_EQ(rows.fault(same).what, "as in the row before; expected +1: it must alternate");
    EXPECT_TRUE(rows.next({.bias_sign = 1})) << "the refused row is none of those before";
}

TEST(RawSequence, a_span_goes_over_missed_rows_alone) {
    RawSequence rows;
    EXPECT_TRUE(rows.next({.counts = 150, .bias_sign = 1}));
    EXPECT_TRUE(rows.next({.counts = 0, .bias_sign = -1, .valid = false}));
    EXPECT_TRUE(rows.next({.counts = 0, .bias_sign = 1, .valid = false}));
    HalfRecord row{.counts = 450, .bias_sign = -1, .span = 4};
    EXPECT_FALSE(rows.next(row));
    EXPECT_STREQ(rows.fault(row).column, "span");
    EXPECT_EQ(rows.fault(row).value, 4);
    zlg::test::expect_contains(rows.fault(row).what, "allowed is 1..3: this row and the 2 directly before it");
    row.span = 0;
    EXPECT_FALSE(rows.next(row));
    row.span = 3;
    EXPECT_TRUE(rows.next(row));
    row = {.counts = 300, .bias_sign = 1, .span = 2};
    EXPECT_FALSE(rows.next(row)) << "none is missed since";
}

}  // namespace zlg::logs::row_rules_test
