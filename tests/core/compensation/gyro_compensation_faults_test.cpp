// What a fault leaves in the ticks beside those that the control refuses, and what an opened loop leaves where nothing
// is subtracted.

#include <zlg/core/gyro_compensation.hpp>

#include "gyro_compensation_support.hpp"

namespace zlg::core::gyro_compensation_faults_test {

using namespace gyro_compensation_support;

constexpr double scale = 3.263;
constexpr double of_count_arcsec2 = scale * scale / 6.0;

GyroCompensationConfig without_walk() {
    GyroCompensationConfig config;
    config.gyro.random_walk = ArcsecPerRootSecond{0.0};
    config.relock.method = RelockMethod::mean_square;
    config.bridge.method = BridgeMethod::automatic;
    return config;
}

// At rest, with the light's noise as the mean square.
Halves at_rest(int ticks, bool by_phase, double mean_sq_lambda2 = 1.1e-5) {
    Halves all = biased_halves(2 * ticks);
    for (HalfRecord& r : all) {
        r.detuning_lambda = 0.0;
        r.detuning_sq_lambda2 = mean_sq_lambda2;
        if (by_phase) r.fringe = 32768.0f;
    }
    return all;
}

double sigma_of(const Delivered& all, std::size_t tick) { return all.rows.at(tick).sigma_arcsec; }

// A hundredth of the bias of a half, 1.5 counts.
constexpr double unseen_arcsec2 = 1.5 * 1.5 * scale * scale;

TEST(FaultEdges, AFaultMayBeginOrEndUnseenInTheTickBesideARefusedOne) {
    Halves halves = at_rest(300, false);
    for (const std::size_t h : {400u, 401u, 402u, 403u}) halves[h].valid = false;
    const Delivered all = run(without_walk(), halves);
    EXPECT_NEAR(sigma_of(all, 199), std::sqrt(of_count_arcsec2 + unseen_arcsec2), 1e-9);
    EXPECT_NEAR(sigma_of(all, 198), std::sqrt(of_count_arcsec2), 1e-9);
    // Its re-lock correction adds a little.
    EXPECT_NEAR(sigma_of(all, 202), std::sqrt(of_count_arcsec2 + unseen_arcsec2), 1e-3);
    EXPECT_NEAR(sigma_of(all, 203), std::sqrt(of_count_arcsec2), 1e-3);
}

TEST(FaultEdges, AHalfThatIsRefusedWithinItsTickLeavesTheOthersAlone) {
    Halves halves = at_rest(300, false);
    halves[401].valid = false;  // second of tick 200
    halves[404].valid = false;  // first of tick 202
    const Delivered all = run(without_walk(), halves);
    EXPECT_NEAR(sigma_of(all, 199), std::sqrt(of_count_arcsec2), 1e-3);
    EXPECT_NEAR(sigma_of(all, 203), std::sqrt(of_count_arcsec2), 1e-3);
    EXPECT_GT(sigma_of(all, 201), std::sqrt(of_count_arcsec2 + unseen_arcsec2));
}

TEST(FaultEdges, AMissedHalfIsNoFaultOfTheGyro) {
    Halves halves = at_rest(300, false);
    miss(halves, 400, 1);
    const Delivered all = run(without_walk(), halves);
    for (std::size_t t = 190; t < 210; ++t) EXPECT_NEAR(sigma_of(all, t), std::sqrt(of_count_arcsec2), 1e-3) << t;
}

// Without its bias a gyro at rest counts nothing. What tells it from a missed half is that the next one has only its
// own counts.
TEST(FaultEdges, AFaultInWhichNothingIsCountedMayEndUnseenToo) {
    Halves halves = at_rest(300, true);
    for (const std::size_t h : {400u, 401u, 402u, 403u}) {
        halves[h].valid = false;
        halves[h].counts = 0;
    }
    EXPECT_GT(sigma_of(run(without_walk(), halves), 202), std::sqrt(unseen_arcsec2));
}

// The error of an unknown threshold is the same in all ticks: those of the gap have it from the points beside it, and
// with those of the re-lock it adds up in the switch.
TEST(FaultEdges, ASwitchHoldsTheUnknownLockInOfItsTicks) {
    GyroCompensationConfig config = without_walk();
    config.lock_in.sigma = Hertz{300.0};
    for (const std::int64_t rate : {0, 120}) {
        Halves halves = at_rest(400, true);
        for (HalfRecord& half : halves) half.counts += rate;
        for (std::size_t h = 600; h < 606; ++h) halves[h].loop_closed = halves[h].valid = false;
        const Delivered all = run(config, halves);
        const auto in_tick = static_cast<double>(2 * rate);
        const LostCounts lost = lost_to_lock_in(config.gyro, config.lock_in, 0.5 * in_tick, 0.5 * in_tick);
        const double common = scale * std::sqrt(lost.variance);
        const double ratio = static_cast<double>(rate) / 150.0;
        // Adler's, of 0.75 counts in a half, to the second order: (1/2) (L/f0)^2 r T/(1 - (r/f0)^2).
        const double adler = 0.5 * 0.005 * 0.005 * in_tick / (1.0 - ratio * ratio);
        EXPECT_NEAR(common, scale * adler, 0.01 * scale * adler);
        ASSERT_EQ(all.gaps.size(), 1u);
        EXPECT_GE(all.gaps[0].sigma_sum_arcsec, 23.0 * common);
        EXPECT_LE(all.gaps[0].sigma_sum_arcsec, 23.0 * common + 0.5);
        for (std::size_t t = 300; t < 303; ++t) EXPECT_GE(sigma_of(all, t), common);
    }
}

// Detuning that comes and goes within a tick, far from any gap, which no correction subtracts: its false angle is
// chi f0/2 (<dl^2>_second - <dl^2>_first) K T.
TEST(FaultEdges, APushOfThePerimeterIsInSigmaByPhase) {
    for (const double lambda : {0.005, 0.01, 0.02, 0.03, 0.042}) {
        for (const std::size_t half : {600u, 601u}) {
            Halves halves = at_rest(500, true);
            const double sq = lambda * lambda;
            halves[half].detuning_sq_lambda2 += sq;
            const Delivered all = run(without_walk(), halves);
            const double false_arcsec = 0.5 * 3.6 * 60e3 * sq * scale * 0.005;
            EXPECT_GE(sigma_of(all, 300), false_arcsec) << lambda;
            EXPECT_LE(sigma_of(all, 300), 2.0 * false_arcsec) << lambda;
            EXPECT_LT(sigma_of(all, 298), 0.05) << lambda;
        }
    }
}

// A detuning of 0.25/sqrt(2) wavelength, of which tick n has no more than a part 1/(2n - 1) left.
TEST(Uncorrected, WhatAClosingLeavesIsInSigmaAndFlagged) {
    GyroCompensationConfig config = without_walk();
    config.relock = {.method = RelockMethod::none, .presumes = true};
    Halves halves = at_rest(300, false, 0.0);
    for (std::size_t h = 400; h < 406; ++h) halves[h].loop_closed = false;
    for (std::size_t h = 403; h < halves.size(); ++h) {
        halves[h].mode = -1;
        halves[h].counts = -halves[h].counts;
    }
    const Delivered all = run(config, halves);
    const double most = 0.5 * 3.6 * 60e3 * 0.5 * 0.25 * 0.25 * scale * 0.005;
    double sum = 0.0;
    for (std::size_t n = 1; n <= 20; ++n) {
        const AngleRow& row = all.rows[202 + n];
        const double left = most / (2.0 * static_cast<double>(n) - 1.0);
        EXPECT_NEAR(row.sigma_arcsec, std::sqrt(of_count_arcsec2 + left * left), 1e-9) << n;
        EXPECT_TRUE((row.flags & flag_relock_uncorrected) != 0) << n;
        EXPECT_EQ(row.dtheta_final_arcsec, 0.0) << n;
        if (n <= 10) sum += left * left;
    }
    EXPECT_EQ(all.rows[223].flags & flag_relock_uncorrected, 0u);
    ASSERT_EQ(all.gaps.size(), 1u);
    EXPECT_GE(all.gaps[0].sigma_sum_arcsec, std::sqrt(sum));
}

TEST(Uncorrected, ALaterGapDoesNotHaveWhatAClosingLeft) {
    GyroCompensationConfig config = without_walk();
    config.relock = {.method = RelockMethod::none, .presumes = true};
    double sigma[2] = {};
    for (const bool opened : {false, true}) {
        Halves halves = at_rest(600, false, 0.0);
        for (std::size_t h = 400; h < 406; ++h) halves[h].loop_closed = !opened;
        // Half of the tick is missing for good.
        halves[900].valid = false;
        halves[900].counts = 0;
        const Delivered all = run(config, halves);
        ASSERT_EQ(all.gaps.size(), opened ? 2u : 1u);
        sigma[opened] = all.gaps.back().sigma_sum_arcsec;
    }
    EXPECT_NEAR(sigma[1], sigma[0], 0.05);
}

TEST(Uncorrected, AMissedHalfMovesNoPerimeter) {
    GyroCompensationConfig config = without_walk();
    config.relock = {.method = RelockMethod::none, .presumes = true};
    Halves halves = at_rest(300, false, 0.0);
    miss(halves, 400, 1);
    for (const AngleRow& row : run(config, halves).rows) EXPECT_EQ(row.flags & flag_relock_uncorrected, 0u) << row.tick;
}

}  // namespace zlg::core::gyro_compensation_faults_test
