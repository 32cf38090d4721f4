#include <zlg/core/control/frame_order.hpp>

#include "support.hpp"

namespace zlg::core::frame_order_test {

// Frames of halves 0, 1, 2, ... up to here, in order.
FrameOrderState after(std::uint32_t n, std::uint32_t first = 0) {
    FrameOrderState s;
    for (std::uint32_t k = 0; k < n; ++k) EXPECT_TRUE(step(s, true, first + k).follows);
    return s;
}

TEST(FrameOrder, AnyNumberMayBeTheFirstAndTheyWrap) {
    FrameOrderState s = after(3, 0xffffffffu);
    EXPECT_EQ(s.expected, 2u);
}

TEST(FrameOrder, AfterMissedFramesTheNumberOfItsHalfIsExpected) {
    FrameOrderState s = after(10);
    for (int k = 0; k < 3; ++k) {
        const FrameOrderOutput out = step(s, false, 7);
        EXPECT_FALSE(out.fresh || out.follows || out.error);
    }
    const FrameOrderOutput out = step(s, true, 13);
    EXPECT_TRUE(out.fresh && out.follows && !out.error);
}

TEST(FrameOrder, AFirstFrameAfterMissedOnesFollowsWithTheNumberOfItsHalfOnly) {
    for (std::uint32_t number = 0; number < 4; ++number) {
        FrameOrderState s;
        for (int k = 0; k < 2; ++k) (void)step(s, false, 0);
        const FrameOrderOutput out = step(s, true, number);
        EXPECT_TRUE(out.fresh) << number;
        EXPECT_EQ(out.follows, number == 2) << number;
    }
}

TEST(FrameOrder, ARepeatedFrameIsNeverFresh) {
    FrameOrderState s = after(10);
    for (int k = 0; k < 1000; ++k) {
        const FrameOrderOutput out = step(s, true, 9);
        ASSERT_TRUE(out.error && !out.fresh && !out.follows) << k;
    }
    EXPECT_TRUE(step(s, true, 1010).follows);
}

// Two minutes of 2.5 ms: whatever delays them is still at work.
TEST(FrameOrder, FramesThatComeLateStayLate) {
    for (std::uint32_t late = 1; late <= 8; ++late) {
        FrameOrderState s = after(100);
        for (std::uint32_t k = 0; k < late; ++k) (void)step(s, false, 0);
        for (std::uint32_t k = 0; k < 48000; ++k) ASSERT_FALSE(step(s, true, 100 + k).fresh) << late << " " << k;
        EXPECT_TRUE(step(s, true, 48100 + late).follows) << late;
    }
}

// A count too many, or a start anew just after the start: the stamps say that the frames are not late.
TEST(FrameOrder, NumbersBegunAnewALittleBehindAreKnownByTheirStamps) {
    for (std::uint32_t behind = 1; behind <= 8; ++behind) {
        FrameOrderState s = after(100);
        std::uint32_t n = 0;
        while (!step(s, true, 100 - behind + n, true).fresh) ASSERT_LT(++n, 300u) << behind;
        EXPECT_TRUE(step(s, true, 101 - behind + n, true).follows) << behind;
    }
    FrameOrderState s = after(100);
    (void)step(s, false, 0);
    for (std::uint32_t k = 0; k < 24000; ++k) ASSERT_FALSE(step(s, true, 100 + k, k > 0).fresh) << k;
}

TEST(FrameOrder, NumbersBegunAnewAreBelievedAfterHalfASecond) {
    FrameOrderState s = after(1000);
    int n = 0;
    while (!step(s, true, static_cast<std::uint32_t>(n)).fresh) ASSERT_LT(++n, 1000);
    EXPECT_EQ(n, 199);
    EXPECT_TRUE(step(s, true, 200).follows);
}

TEST(FrameOrder, FramesLostBetweenTwoHalvesCostTwo) {
    FrameOrderState s = after(10);
    const FrameOrderOutput first = step(s, true, 15);
    EXPECT_TRUE(first.error && !first.fresh);
    const FrameOrderOutput second = step(s, true, 16);
    EXPECT_TRUE(second.error && second.fresh && !second.follows);
    EXPECT_TRUE(step(s, true, 17).follows);
}

TEST(FrameOrder, OneDamagedNumberDoesNotLeadAway) {
    FrameOrderState s = after(10);
    EXPECT_FALSE(step(s, true, 0x80000000u).fresh);
    EXPECT_TRUE(step(s, true, 11).follows);
}

}  // namespace zlg::core::frame_order_test
