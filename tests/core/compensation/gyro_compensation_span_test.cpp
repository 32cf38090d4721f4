// Halves without a reading: what the counter has counted over them is in the angle, however the bridge distributes it.

#include <zlg/core/gyro_compensation.hpp>

#include "gyro_compensation_support.hpp"

namespace zlg::core::gyro_compensation_span_test {

using namespace gyro_compensation_support;

GyroCompensationConfig with(BridgeMethod method) {
    GyroCompensationConfig config;
    config.bridge.method = method;
    return config;
}

constexpr double swing_arcsec = 60.0;  // of a tick
double turned(std::int64_t tick) { return 5.0 + swing_arcsec * std::sin(0.2209 * static_cast<double>(tick)); }

Halves swing(const GyroCompensationConfig& config, std::int64_t ticks) {
    Recorder recorder{config, 1, 1};
    Halves halves;
    for (std::int64_t t = 0; t < ticks; ++t) recorder.tick_into(halves, turned(t));
    return halves;
}

double count_sum(const Halves& halves) {
    std::int64_t sum = 0;
    for (const HalfRecord& half : halves) sum += half.counts;
    return 3.263 * static_cast<double>(sum);
}

class Span : public testing::TestWithParam<BridgeMethod> {};
INSTANTIATE_TEST_SUITE_P(GyroCompensation, Span,
                         testing::Values(BridgeMethod::constant, BridgeMethod::quadratic, BridgeMethod::automatic));

TEST_P(Span, TheSumOverAGapIsThatOfTheCounterWhateverItsLength) {
    const GyroCompensationConfig config = with(GetParam());
    for (const std::size_t n : {1u, 2u, 3u, 9u, 20u, 30u, 33u, 48u, 70u, 400u, 3001u}) {
        for (std::size_t first = 800; first < 802; ++first) {
            Halves halves = swing(config, 2200);
            miss(halves, first, n);
            const Delivered all = run(config, halves);
            const Sums s = sums_of(all);
            EXPECT_NEAR(s.final, count_sum(halves), 1e-6) << n << " from " << first;
            EXPECT_NEAR(s.delivered, count_sum(halves), 1e-6) << n << " from " << first;
            ASSERT_EQ(all.gaps.size(), 1u);
            EXPECT_NEAR(all.gaps[0].sigma_sum_arcsec, 3.263 / std::sqrt(6.0), 0.1 + 1e-3 * static_cast<double>(n));
        }
    }
}

TEST_P(Span, ATickOfWhichOnlyItsFirstHalfIsMissedIsKnownExactly) {
    const GyroCompensationConfig config = with(GetParam());
    Halves halves = swing(config, 500);
    const double true_arcsec = 3.263 * static_cast<double>(halves[900].counts + halves[901].counts);
    miss(halves, 900, 1);
    const AngleRow row = run(config, halves).rows[450];
    EXPECT_EQ(row.dtheta_final_arcsec, true_arcsec);
    EXPECT_NEAR(row.sigma_arcsec, 3.263 / std::sqrt(6.0), 0.01);
    EXPECT_NE(row.dtheta_arcsec, true_arcsec);
}

TEST_P(Span, NoFrameLostByChanceTakesAngle) {
    const GyroCompensationConfig config = with(GetParam());
    for (const double part : {0.1, 0.5, 0.9}) {
        Random random{7};
        Halves halves = swing(config, 2000);
        for (std::size_t h = 600; h + 600 < halves.size(); ++h)
            if (random.chance(part)) miss(halves, h, 1);
        const Sums s = sums_of(run(config, halves), false);
        EXPECT_NEAR(s.final, count_sum(halves), 1e-6) << part;
        EXPECT_NEAR(s.delivered, count_sum(halves), 1e-6) << part;
    }
}

// By the learnt motion: where it is the motion of before, its ticks are within their sigma.
TEST(GyroCompensationSpan, TicksOfAKnownSumHaveATrueSigma) {
    const GyroCompensationConfig config = with(BridgeMethod::automatic);
    for (const std::size_t n : {4u, 11u, 29u}) {
        double squares = 0.0;
        double most = 0.0;
        int rows = 0;
        for (std::size_t start = 0; start < 25; ++start) {
            Halves halves = swing(config, 1000);
            miss(halves, 1600 + start, n);
            const Delivered all = run(config, halves);
            for (std::int64_t t = 800; t < 840; ++t) {
                const AngleRow& row = all.rows[static_cast<std::size_t>(t)];
                if ((row.flags & flag_extrapolated) == 0) continue;
                const double z = (row.dtheta_final_arcsec - turned(t)) / row.sigma_arcsec;
                squares += z * z;
                most = std::max(most, std::abs(row.dtheta_final_arcsec - turned(t)));
                ++rows;
            }
        }
        EXPECT_LT(squares / rows, 1.5) << n;
        EXPECT_GT(squares / rows, 0.05) << n;
        EXPECT_LT(most, n < 20 ? 8.0 : 30.0) << n;
    }
}

// A turn of 450 arcsec within one tick is no motion that was learnt: it may be in any of the gap's ticks.
TEST(GyroCompensationSpan, AForeignTurnIsWithinTheSigmaOfTheTickItWasIn) {
    for (const BridgeMethod method : {BridgeMethod::automatic, BridgeMethod::quadratic}) {
        const GyroCompensationConfig config = with(method);
        for (const double turn : {100.0, 450.0, 3000.0}) {
            for (std::int64_t at = 400; at < 404; ++at) {
                Recorder recorder{config, 1, 1};
                Halves halves;
                for (std::int64_t t = 0; t < 500; ++t) recorder.tick_into(halves, 5.0 + (t == at ? turn : 0.0));
                miss(halves, 800, 7);
                const Delivered all = run(config, halves);
                for (std::int64_t t = 400; t < 404; ++t) {
                    const AngleRow& row = all.rows[static_cast<std::size_t>(t)];
                    const double error = row.dtheta_final_arcsec - 5.0 - (t == at ? turn : 0.0);
                    EXPECT_LT(std::abs(error), 5.0 * row.sigma_arcsec) << turn << " " << at << " " << t;
                }
            }
        }
    }
}

TEST(GyroCompensationSpan, ALongGapHasASigmaWhereItsRowsHaveNotLeft) {
    const GyroCompensationConfig config = with(BridgeMethod::automatic);
    Halves halves = swing(config, 2200);
    miss(halves, 1000, 400);
    const Delivered all = run(config, halves);
    int known = 0;
    for (std::int64_t t = 500; t < 700; ++t) {
        const AngleRow& row = all.rows[static_cast<std::size_t>(t)];
        EXPECT_EQ(std::isinf(row.sigma_arcsec), (row.flags & flag_unrepaired) != 0);
        if (std::isinf(row.sigma_arcsec)) continue;
        ++known;
        EXPECT_LT(std::abs(row.dtheta_final_arcsec - turned(t)), 5.0 * row.sigma_arcsec) << t;
    }
    EXPECT_GE(known, max_polynomial_gap);
}

TEST(GyroCompensationSpan, ASwitchWithinTheMissedHalvesIsBridgedAsBefore) {
    const GyroCompensationConfig config = with(BridgeMethod::quadratic);
    Halves missed = swing(config, 500);
    for (std::size_t h = 804; h < 808; ++h) missed[h].loop_closed = false;
    miss(missed, 800, 10);
    missed[810].valid = false;
    missed[810].counts = 0;
    missed[810].span = 1;
    Halves with_span = missed;
    with_span[810].valid = true;
    with_span[810].counts = 12345;
    with_span[810].span = 11;
    const Delivered a = run(config, missed);
    const Delivered b = run(config, with_span);
    for (std::size_t t = 0; t < a.rows.size(); ++t) {
        EXPECT_EQ(a.rows[t].dtheta_final_arcsec, b.rows[t].dtheta_final_arcsec) << t;
        EXPECT_EQ(a.rows[t].dtheta_arcsec, b.rows[t].dtheta_arcsec) << t;
    }
}

// A rest with a switch behind which the gyro turns at once, by `turn_arcsec` within one half; the halves from `first`
// after the closing on are waited for, and the light is read in them, or not.
struct Jerk {
    std::size_t first = 2;
    std::size_t n = 6;
    bool lit = true;
    double turn_arcsec = 0.0;
    double left = 0.68;  // of the detuning, by half
};

struct Error {
    double angle_arcsec = 0.0, sigma_arcsec = 0.0, worst_sigmas = 0.0;
};

Error error_after(const GyroCompensationConfig& config, const Jerk& jerk) {
    Recorder recorder{config, 1, 1};
    Halves halves;
    for (int t = 0; t < 600; ++t) recorder.tick_into(halves, 7.3);
    for (int t = 0; t < 3; ++t) recorder.tick_into(halves, 7.3, false);
    recorder.flip();
    const std::size_t closed = halves.size();
    std::vector<double> true_arcsec(240, 7.3);
    const std::size_t turned = jerk.first + 1;
    for (std::size_t h = 0; h < 400; ++h) {
        const double square = 0.22 * 0.22 * std::pow(jerk.left, 2 * h) + 1e-5;
        halves.push_back(recorder.half(0.5 * 7.3 + (h == turned ? jerk.turn_arcsec : 0.0), square));
    }
    true_arcsec[3 + turned / 2] += jerk.turn_arcsec;
    miss(halves, closed + jerk.first, jerk.n);
    for (std::size_t h = closed + jerk.first; h < closed + jerk.first + jerk.n && !jerk.lit; ++h)
        halves[h].detuning_sq_lambda2 = halves[h].detuning_lambda = 0.0;
    const Delivered all = run(config, halves);
    Error out;
    for (std::size_t t = 600; t < 640; ++t) {
        const double off = all.rows[t].dtheta_final_arcsec - true_arcsec[t - 600];
        out.angle_arcsec += off;
        out.worst_sigmas = std::max(out.worst_sigmas, std::abs(off) / all.rows[t].sigma_arcsec);
    }
    double variance = 0.0;
    for (const GapReport& gap : all.gaps) variance += gap.sigma_sum_arcsec * gap.sigma_sum_arcsec;
    out.sigma_arcsec = std::sqrt(variance);
    return out;
}

// The sum of the counter holds what the detuning takes from the bias.
TEST(GyroCompensationSpan, ASumOfAReLockIsNoSumOfTheRotation) {
    GyroCompensationConfig config = with(BridgeMethod::automatic);
    config.relock.method = RelockMethod::mean_square;
    for (const double left : {0.4, 0.68, 0.85}) {
        for (std::size_t n = 1; n <= 6; ++n) {
            const Error error = error_after(config, {.n = n, .lit = false, .left = left});
            EXPECT_LT(std::abs(error.angle_arcsec), 2.5 * error.sigma_arcsec) << left << ", " << n << " missed";
            EXPECT_LT(std::abs(error.angle_arcsec), 4.0) << left << ", " << n << " missed";
        }
    }
}

// The false angle of the settling detuning, up to 40 arcsec, is known to 3 % where the light was read, and is in sigma
// where it was not. The roundings of two sums, up to 2 arcsec each, are in what differs from a gyro that rests.
TEST(GyroCompensationSpan, AJerkInAReLockIsInTheSumOfTheCounter) {
    for (const BridgeMethod method : {BridgeMethod::automatic, BridgeMethod::quadratic}) {
        GyroCompensationConfig config = with(method);
        config.relock.method = RelockMethod::mean_square;
        for (const double turn : {-2500.0, -300.0, 300.0, 2500.0}) {
            for (std::size_t first = 2; first < 8; ++first) {
                for (const bool lit : {true, false}) {
                    const Error quiet = error_after(config, {.first = first, .n = 7, .lit = lit});
                    const Error error = error_after(config, {.first = first, .n = 7, .lit = lit, .turn_arcsec = turn});
                    const double more = lit ? 5.2 : 44.0;
                    EXPECT_NEAR(error.angle_arcsec, quiet.angle_arcsec, more) << turn << " from " << first;
                    EXPECT_LT(std::abs(error.angle_arcsec), 4.0 * error.sigma_arcsec) << turn << " from " << first;
                    EXPECT_LT(error.sigma_arcsec, quiet.sigma_arcsec + more) << turn << " from " << first;
                    EXPECT_LT(error.worst_sigmas, 4.0) << turn << " from " << first;
                }
            }
        }
    }
}

// From the very closing on, the sum is that of a part of the gap, and the jerk may have begun beside that.
TEST(GyroCompensationSpan, AJerkAtAClosingMayHaveBegunBeforeIt) {
    GyroCompensationConfig config = with(BridgeMethod::automatic);
    config.relock.method = RelockMethod::mean_square;
    for (const double turn : {-2500.0, 2500.0}) {
        const Error error = error_after(config, {.first = 0, .turn_arcsec = turn});
        EXPECT_LT(std::abs(error.angle_arcsec), 7.0);
        EXPECT_GT(error.sigma_arcsec, 2500.0);
        EXPECT_LT(error.sigma_arcsec, 3.5 * 2500.0);
    }
    const Error quiet = error_after(config, {.first = 0});
    EXPECT_LT(std::abs(quiet.angle_arcsec), 4.0);
    EXPECT_LT(quiet.sigma_arcsec, 4.0);
}

// `none` bridges nothing: what the counter says is the angle, in the tick in which it says it.
TEST(GyroCompensationSpan, WithoutABridgeTheCountsAreTheAngle) {
    const GyroCompensationConfig config = with(BridgeMethod::none);
    Halves halves = swing(config, 300);
    miss(halves, 200, 51);
    const Sums s = sums_of(run(config, halves));
    EXPECT_NEAR(s.final, count_sum(halves), 1e-6);
}

}  // namespace zlg::core::gyro_compensation_span_test
