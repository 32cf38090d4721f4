// Records with the place within the fringe: what they are worth, and what becomes of an angle whose phase comes and
// goes.

#include <zlg/core/gyro_compensation.hpp>

#include "gyro_compensation_support.hpp"

namespace zlg::core::gyro_compensation_fringe_test {

using namespace gyro_compensation_support;

constexpr double scale = 3.263;

// A gyro whose counter and phase are read without error: its absolute place at each border, in 65536ths of a count.
struct Places {
    std::vector<std::int64_t> at{0};  // before the first half

    Halves halves() const {
        Halves all;
        for (std::size_t h = 1; h < at.size(); ++h) {
            HalfRecord r;
            r.half = static_cast<std::int64_t>(h) - 1;
            r.bias_sign = h % 2 != 0 ? std::int8_t{1} : std::int8_t{-1};
            r.counts = (at[h] >> 16) - (at[h - 1] >> 16);
            r.fringe = static_cast<float>(at[h] & 0xffff);
            all.push_back(r);
        }
        return all;
    }
    double arcsec(std::size_t from, std::size_t to) const {
        return scale * static_cast<double>(at[to] - at[from]) / 65536.0;
    }
};

// Bias and rotation by places that no short step repeats.
Places turning(std::size_t ticks) {
    Places p;
    p.at[0] = 32768;  // where nothing is known, the middle of a count
    for (std::size_t h = 0; h < 2 * ticks; ++h) {
        const auto bias = static_cast<std::int64_t>(150.37 * 65536.0) * (h % 2 == 0 ? 1 : -1);
        p.at.push_back(p.at.back() + bias + static_cast<std::int64_t>(1e6 * std::sin(0.05 * static_cast<double>(h))));
    }
    return p;
}

constexpr float unknown = std::numeric_limits<float>::quiet_NaN();

TEST(GyroCompensationFringe, ATickIsTheDifferenceOfItsTwoPlaces) {
    const Places places = turning(400);
    const Delivered all = run({}, places.halves());
    ASSERT_EQ(all.rows.size(), 400u);
    for (std::size_t t = 0; t < 400; ++t)
        EXPECT_DOUBLE_EQ(all.rows[t].dtheta_final_arcsec, places.arcsec(2 * t, 2 * t + 2)) << t;
}

TEST(GyroCompensationFringe, TheAngleIsExactWhateverItsLength) {
    const Places places = turning(20'000);
    const Delivered all = run({}, places.halves());
    for (std::size_t t = 0; t < 20'000; t += 997)
        EXPECT_EQ(all.samples[t].angle_arcsec, places.arcsec(0, 2 * t + 2)) << t;
}

TEST(GyroCompensationFringe, ASigmaIsThatOfTheReadingsAtBothEnds) {
    GyroCompensationConfig config;
    config.gyro.fringe_noise_counts = 0.002;
    Halves halves = turning(100).halves();
    halves[41].fringe = unknown;  // the end of tick 20
    const Delivered all = run(config, halves);
    const double walk = 0.14 * 0.14 * 0.005;
    const double phase = scale * scale * (0.002 * 0.002 + 1.0 / 12.0 / 65536.0 / 65536.0);
    const double count = scale * scale / 12.0;
    EXPECT_NEAR(all.rows[0].sigma_arcsec, std::sqrt(walk + phase + count), 1e-12);
    EXPECT_NEAR(all.rows[19].sigma_arcsec, std::sqrt(walk + 2.0 * phase), 1e-12);
    EXPECT_NEAR(all.rows[20].sigma_arcsec, std::sqrt(walk + phase + count), 1e-12);
    EXPECT_NEAR(all.rows[21].sigma_arcsec, std::sqrt(walk + phase + count), 1e-12);
    EXPECT_NEAR(all.rows[22].sigma_arcsec, std::sqrt(walk + 2.0 * phase), 1e-12);
}

TEST(GyroCompensationFringe, APhaseThatComesAndGoesLosesNothing) {
    const Places places = turning(4000);
    Halves halves = places.halves();
    Random random{5};
    for (HalfRecord& half : halves)
        if (random.chance(0.5)) half.fringe = unknown;
    const Delivered all = run({}, halves);
    for (std::size_t t = 0; t < 4000; ++t) {
        const double off = all.samples[t].angle_arcsec - places.arcsec(0, 2 * t + 2);
        if (has_fringe(halves[2 * t + 1]))
            EXPECT_NEAR(off, 0.0, 1e-9) << t;
        else
            EXPECT_LE(std::abs(off), 0.5 * scale + 1e-9) << t;
    }
}

TEST(GyroCompensationFringe, WithoutAPlaceAHalfHasItsWholeCounts) {
    Halves halves = turning(300).halves();
    for (HalfRecord& half : halves) half.fringe = unknown;
    const Delivered all = run({}, halves);
    for (std::size_t t = 0; t < 300; ++t)
        EXPECT_EQ(all.rows[t].dtheta_final_arcsec,
                  scale * static_cast<double>(halves[2 * t].counts + halves[2 * t + 1].counts));
}

// Halves that were missed: the sum over them is that of the two places beside them.
TEST(GyroCompensationFringe, TheSumOverMissedHalvesIsThatOfThePlacesBesideThem) {
    const Places places = turning(600);
    Halves halves = places.halves();
    miss(halves, 800, 5);
    for (std::size_t h = 800; h < 805; ++h) halves[h].fringe = unknown;
    const Delivered all = run({}, halves);
    double sum = 0.0;
    for (std::size_t t = 400; t < 403; ++t) sum += all.rows[t].dtheta_final_arcsec;
    EXPECT_NEAR(sum, places.arcsec(800, 806), 1e-9);
    EXPECT_NEAR(all.samples.back().angle_arcsec, places.arcsec(0, 1200), 1e-8);
}

// At rest whole counts show the bias wrong by a part of a count. A mean of 256 ticks would keep .25 of these .37.
TEST(GyroCompensationFringe, TheBiasByWholeCountsIsSoonForgottenWhenThePhaseComes) {
    Places places;
    places.at[0] = 32768;
    for (std::size_t h = 0; h < 1200; ++h)
        places.at.push_back(32768 + (h % 2 == 0 ? static_cast<std::int64_t>(150.37 * 65536.0) : 0));
    Halves halves = places.halves();
    for (std::size_t h = 0; h < 1000; ++h) halves[h].fringe = unknown;
    GyroCompensationState state;
    Delivered delivered;
    for (std::size_t h = 0; h < 1000; ++h) step_into({}, state, halves[h], delivered);
    EXPECT_NEAR(state.bias_arcsec, 150.0 * scale, 1e-9);
    for (std::size_t h = 1000; h < 1200; ++h) step_into({}, state, halves[h], delivered);
    EXPECT_NEAR(state.bias_arcsec, 150.37 * scale, 0.12 * scale);
}

// A steady rate, so that the gap's angle is known: with whole counts the rounding of both edges stays in it.
TEST(GyroCompensationFringe, AGapOfASteadyRateIsKnownToThePhase) {
    for (const BridgeMethod method : {BridgeMethod::constant, BridgeMethod::quadratic, BridgeMethod::automatic}) {
        GyroCompensationConfig config;
        config.bridge.method = method;
        config.gyro.random_walk = ArcsecPerRootSecond{0.001};
        double with = 0.0;
        Places places;
        places.at[0] = 32768;
        const double per_half = 1.7320508 * 65536.0;
        for (std::size_t h = 1; h <= 16'000; ++h) {
            const double bias = h % 2 != 0 ? 150.37 * 65536.0 : 0.0;
            places.at.push_back(32768 + static_cast<std::int64_t>(per_half * static_cast<double>(h) + bias));
        }
        Halves halves = places.halves();
        for (std::size_t gap = 2000; gap < 15'900; gap += 400)
            for (std::size_t h = gap; h < gap + 6; ++h) {
                halves[h].loop_closed = false;
                halves[h].counts = 12345;  // what a dark counter reads
                if (h < gap + 5) halves[h].fringe = unknown;
            }
        const Delivered all = run(config, halves);
        for (std::size_t gap = 2000; gap < 15'900; gap += 400) {
            double off = -places.arcsec(gap, gap + 6);
            for (std::size_t t = gap / 2; t < gap / 2 + 3; ++t) off += all.rows[t].dtheta_final_arcsec;
            with += off * off;
        }
        EXPECT_LT(std::sqrt(with / static_cast<double>(all.gaps.size())), 0.001);
        EXPECT_LT(all.gaps.back().sigma_sum_arcsec, 0.05);
        EXPECT_GT(all.gaps.back().sigma_sum_arcsec, 0.001);
    }
}

}  // namespace zlg::core::gyro_compensation_fringe_test
