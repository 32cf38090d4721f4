#include "gap_bridge_support.hpp"

namespace zlg::core::gap_bridge_support::gap_bridge_test {

constexpr BridgeMethod all_bridges[] = {BridgeMethod::constant, BridgeMethod::linear, BridgeMethod::quadratic};

GapBridgeConfig config_of(BridgeMethod method) { return {.method = method}; }

// Ticks of a motion given tick by tick; those in [first, first + n) are a gap.
Log log_of(int n_ticks, int first, int n, const std::function<double(int)>& motion) {
    Log log;
    for (int k = 0; k < n_ticks; ++k)
        log.push_back(k >= first && k < first + n ? gap_tick() : measured_tick(motion(k)));
    return log;
}

double parabola(int k) { return 7.0 - 1.25 * k + 0.125 * k * k; }

double motion_of_order(int order, int k) { return order == 0 ? 7.0 : order == 1 ? 7.0 - 1.25 * k : parabola(k); }

TEST(GapBridge, PolynomialsOfItsOrderPassWithoutError) {
    for (const BridgeMethod method : all_bridges)
        for (int n = 1; n <= max_polynomial_gap; ++n)
            for (int before = 1; before <= 8; ++before)
                for (int after = 1; after <= 8; ++after) {
                    GapBridgeConfig config{.method = method, .points_before = before, .points_after = after};
                    if (!is_allowed(config)) continue;
                    const auto motion = [&](int k) { return motion_of_order(order_of(method), k); };
                    const Delivered got = run(config, log_of(50, 15, n, motion));
                    for (int k = 0; k < 50; ++k) {
                        const AngleRow& row = got.rows[static_cast<unsigned>(k)];
                        ASSERT_NEAR(row.dtheta_final_arcsec, motion(k), 1e-9);
                        ASSERT_NEAR(row.dtheta_arcsec, motion(k), 1e-9);
                    }
                    ASSERT_EQ(got.gaps.size(), 1u);
                    EXPECT_NEAR(got.gaps[0].dp_arcsec, 0.0, 1e-9);
                }
}

TEST(GapBridge, TheStandardGapHasTheWeightsOfThePaper) {
    // One arcsec in the last tick before the gap, nothing elsewhere.
    const auto impulse = [](int k) { return k == 9 ? 1.0 : 0.0; };
    const Delivered got = run(config_of(BridgeMethod::quadratic), log_of(20, 10, 3, impulse));
    const double extrapolated[] = {9.0 / 4.0, 81.0 / 20.0, 127.0 / 20.0};
    const double interpolated[] = {57.0 / 65.0, 0.9, 47.0 / 65.0};
    for (unsigned j = 0; j < 3; ++j) {
        EXPECT_NEAR(got.samples[10 + j].dtheta_arcsec, extrapolated[j], 1e-14);
        EXPECT_NEAR(got.rows[10 + j].dtheta_final_arcsec, interpolated[j], 1e-14);
        EXPECT_EQ(got.rows[10 + j].flags, flag_extrapolated | flag_interpolated);
    }
    // j = n + 1 + points_after carries the difference.
    EXPECT_NEAR(got.rows[15].dtheta_arcsec, 2.5 - 253.0 / 20.0, 1e-13);
    EXPECT_EQ(got.rows[15].flags, flag_correction);
    EXPECT_EQ(got.rows[15].dtheta_final_arcsec, 0.0);
    EXPECT_NEAR(got.gaps[0].dp_arcsec, 253.0 / 20.0 - 2.5, 1e-13);
    for (const unsigned k : {13u, 14u, 16u, 17u}) EXPECT_EQ(got.rows[k].flags, 0u) << k;
}

TEST(GapBridge, MethodNonePassesTheTicksAsRead) {
    Log log = log_of(30, 10, 3, parabola);
    log[20] = gap_tick(-1);
    const Delivered got = run(config_of(BridgeMethod::none), log);
    for (std::size_t k = 0; k < log.size(); ++k) {
        EXPECT_EQ(got.rows[k].dtheta_arcsec, log[k].value_arcsec);
        EXPECT_EQ(got.rows[k].dtheta_final_arcsec, log[k].value_arcsec);
        EXPECT_EQ(std::isinf(got.rows[k].sigma_arcsec), !log[k].measured);
        EXPECT_FALSE(has(got.rows[k].flags, flag_extrapolated) || has(got.rows[k].flags, flag_interpolated));
    }
    EXPECT_TRUE(has(got.rows[20].flags, flag_switching));
    EXPECT_FALSE(has(got.rows[11].flags, flag_switching));
}

// However long a gap, its first 16 ticks were delivered with something else than their final value.
TEST(GapBridge, TheCorrectionOfAGapThatIsTooLongIsOfItsFirstSixteenTicks) {
    for (const int n : {17, 40, 48, 56, 57, 64, 65, 100, 1000}) {
        const Delivered got = run(config_of(BridgeMethod::quadratic), log_of(n + 60, 20, n, parabola));
        const double mean = (parabola(16) + parabola(17) + parabola(18) + parabola(19)) / 4.0;
        double lump = 0.0;
        for (int k = 20; k < 36; ++k) lump += mean - parabola(k);
        const int due = 20 + n + 2;
        EXPECT_NEAR(got.rows[static_cast<unsigned>(due)].dtheta_arcsec, parabola(due) + lump, 1e-8) << "gap of " << n;
        EXPECT_NEAR(got.gaps.at(0).dp_arcsec, -lump, 1e-8) << "gap of " << n;
    }
}

TEST(GapBridge, ALogWithoutAMeasuredTickIsZeroOfUnknownSigma) {
    for (const std::size_t n : {1u, 5u, 16u, 17u, 200u}) {
        const Delivered got = run(config_of(BridgeMethod::quadratic), Log(n, gap_tick()));
        ASSERT_EQ(got.rows.size(), n);
        for (const AngleRow& row : got.rows) {
            EXPECT_EQ(row.dtheta_arcsec, 0.0);
            EXPECT_EQ(row.dtheta_final_arcsec, 0.0);
            EXPECT_TRUE(std::isinf(row.sigma_arcsec));
            EXPECT_TRUE(has(row.flags, flag_unrepaired));
        }
    }
}

}  // namespace zlg::core::gap_bridge_support::gap_bridge_test
