#include <zlg/rig/bias_check.hpp>

#include "test.hpp"

namespace zlg::bias_check_test {

constexpr core::CompensationConstants paper{};  // 60 kHz, 5 ms: 150 counts in a half

struct CheckedGyro {
    double bias_counts = 150.0;
    std::function<double(int)> rotation = [](int) { return 0.1; };  // counts in a half
    // The bias sign alternates; the mode changes at every 1000th half, behind three open ticks.
    std::function<void(int, core::HalfRecord&)> column = [](int, core::HalfRecord&) {};
};

std::string complaint(const CheckedGyro& gyro, int n_halves = 4000, core::CompensationConstants constants = paper) {
    rig::BiasCheck check{constants};
    for (int t = 0; t < n_halves; ++t) {
        core::HalfRecord half{.half = t};
        half.bias_sign = t % 2 == 0 ? 1 : -1;
        half.mode = t / 1000 % 2 == 0 ? 1 : -1;
        half.loop_closed = t < 1000 || t % 1000 >= 6;
        half.counts = std::lround(gyro.bias_counts * half.bias_sign * half.mode + gyro.rotation(t));
        gyro.column(t, half);
        check.take(half);
    }
    return check.complaint("raw.csv");
}

const std::function<double(int)> vibration = [](int t) { return 120.0 * std::sin(0.4 * t); };
// Up to twice the bias and back.
const std::function<double(int)> fast = [](int t) { return 300.0 * std::sin(0.003 * t); };

TEST(BiasCheck, right_columns_agree_whatever_the_rotation_and_the_gyro) {
    for (const auto& rotation : {CheckedGyro{}.rotation, vibration, fast})
        for (const double bias_counts : {3.0, 40.0, 150.0, 1000.0})
            EXPECT_EQ(complaint({.bias_counts = bias_counts, .rotation = rotation}), "");
    for (const auto& rotation : {vibration, fast}) EXPECT_EQ(complaint({.bias_counts = 0.0, .rotation = rotation}), "");
}

TEST(BiasCheck, a_counter_that_stands_still_is_named_and_a_slow_one_is_not) {
    zlg::test::expect_contains(complaint({.bias_counts = 0.0}), "the counter stands still: in 39");
    // One count in ten pairs is no standing counter.
    EXPECT_EQ(complaint({.bias_counts = 0.0, .column = [](int t, core::HalfRecord& h) { h.counts = t % 20 == 0; }}),
              "");
}

TEST(BiasCheck, a_constant_mode_is_found_with_its_place) {
    const CheckedGyro gyro{.rotation = [](int) { return 0.0; }, .column = [](int, core::HalfRecord& h) { h.mode = 1; }};
    const std::string said = complaint(gyro);
    zlg::test::expect_contains(
        said, "raw.csv: the columns mode and bias_sign contradict the counts in 1986 of 3978 half-periods");
    zlg::test::expect_contains(
        said, "first in half-period 1006: bias_sign * mode is +1 and then -1, and the counts are -150 and then 150");
}

TEST(BiasCheck, an_inverted_column_is_found_in_any_motion) {
    for (const auto& rotation : {CheckedGyro{}.rotation, vibration, fast}) {
        EXPECT_NE(complaint({.rotation = rotation, .column = [](int, core::HalfRecord& h) { h.mode *= -1; }}), "");
        EXPECT_NE(complaint({.rotation = rotation, .column = [](int, core::HalfRecord& h) { h.bias_sign *= -1; }}), "");
        const auto both = [](int, core::HalfRecord& h) {
            h.mode *= -1;
            h.bias_sign *= -1;
        };
        EXPECT_EQ(complaint({.rotation = rotation, .column = both}), "");
    }
}

// Every segment is shorter than what lasts, and all are wrong.
TEST(BiasCheck, gaps_and_halves_that_show_nothing_do_not_end_a_contradiction) {
    const auto in_pieces = [](int t, core::HalfRecord& h) {
        h.mode *= -1;
        if (t % 20 < 8) h.loop_closed = false;
    };
    EXPECT_NE(complaint({.column = in_pieces}), "");
}

// The other helicity lases for as long as the control needs to follow it, again and again; one reading is wrong.
TEST(BiasCheck, faults_are_no_contradiction) {
    const auto briefly = [](int t, core::HalfRecord& h) {
        if (t % 500 < 20) h.mode *= -1;
    };
    EXPECT_EQ(complaint({.column = briefly}), "");
    EXPECT_EQ(complaint({.column = [](int t, core::HalfRecord& h) { h.counts += t % 300 == 0 ? 100'000 : 0; }}), "");
    EXPECT_EQ(complaint({.column = [](int t, core::HalfRecord& h) { h.counts = t > 2000 ? 0 : h.counts; }}), "");
}

TEST(BiasCheck, judges_nothing_by_few_halves_or_by_halves_that_were_not_measured) {
    const CheckedGyro inverted{.column = [](int, core::HalfRecord& h) { h.mode *= -1; }};
    EXPECT_EQ(complaint(inverted, 32), "");
    EXPECT_NE(complaint(inverted, 33), "");
    for (const std::function<void(core::HalfRecord&)>& lose :
         {std::function<void(core::HalfRecord&)>{[](auto& h) { h.valid = false; }},
          std::function<void(core::HalfRecord&)>{[](auto& h) { h.loop_closed = false; }},
          std::function<void(core::HalfRecord&)>{[](auto& h) { h.span = 2; }}})
        EXPECT_EQ(complaint({.column =
                                 [&](int, core::HalfRecord& h) {
                                     h.mode *= -1;
                                     lose(h);
                                 }}),
                  "");
}

// Counts at the ends of their range.
TEST(BiasCheck, takes_any_count) {
    EXPECT_EQ(
        complaint(
            {.column = [](int t, core::HalfRecord& h) { h.counts = (t % 4 < 2 ? 1 : -1) * (std::int64_t{1} << 52); }}),
        "");
}

TEST(BiasCheck, counts_without_their_direction_are_found_with_the_first_pair) {
    const CheckedGyro gyro{.rotation = [](int) { return 0.0; },
                           .column = [](int, core::HalfRecord& h) { h.counts = std::abs(h.counts); }};
    const std::string said = complaint(gyro);
    zlg::test::expect_contains(said, "the bias of 150 counts in a half-period does not show: in 3978 of 3978 pairs");
    zlg::test::expect_contains(said, "150 and then 150 in half-periods 0 and 1");
}

// A fast rotation counts one way too, and shows the bias.
TEST(BiasCheck, a_gyro_that_turns_faster_than_its_bias_is_right) {
    EXPECT_EQ(complaint({.rotation = [](int) { return 400.0; }}), "");
}

}  // namespace zlg::bias_check_test
