#include <zlg/core/control/piezo_range.hpp>

#include "support.hpp"

namespace zlg::core::piezo_range_test {

constexpr PiezoRange range{.min = Volts{-150.0}, .max = Volts{150.0}, .margin = Volts{10.0}};

static_assert(is_allowed(PiezoRange{}));
static_assert(!is_allowed(PiezoRange{.min = Volts{5.0}, .max = Volts{5.0}}));
static_assert(!is_allowed(PiezoRange{.min = Volts{not_a_number}}));
static_assert(!is_allowed(PiezoRange{.max = Volts{1e9}}));
static_assert(!is_allowed(PiezoRange{.margin = Volts{-1.0}}));
static_assert(!is_allowed(PiezoRange{.margin = Volts{150.0}}));
static_assert(!is_allowed(PiezoRange{.margin = Volts{not_a_number}}));

TEST(PiezoRange, ClampKeepsWhatIsInsideAndMovesTheRestToTheNearestEnd) {
    EXPECT_EQ(clamp(range, Volts{12.5}), Volts{12.5});
    EXPECT_EQ(clamp(range, Volts{-151.0}), Volts{-150.0});
    EXPECT_EQ(clamp(range, Volts{1e300}), Volts{150.0});
    EXPECT_EQ(clamp(range, Volts{not_a_number}), Volts{-150.0});
}

TEST(PiezoRange, TheMarginBelongsToBothEnds) {
    for (const double end : {-140.5, 140.5}) EXPECT_TRUE(near_end(range, Volts{end})) << end;
    for (const double inside : {-139.5, 139.5}) EXPECT_FALSE(near_end(range, Volts{inside})) << inside;
}

TEST(PiezoRange, AReadingMayLieOneRangeOutside) {
    for (const double v : {-449.0, 449.0}) EXPECT_TRUE(plausible(range, Volts{v})) << v;
    for (const double v : {-451.0, 451.0, not_a_number, infinity}) EXPECT_FALSE(plausible(range, Volts{v})) << v;
}

}  // namespace zlg::core::piezo_range_test
