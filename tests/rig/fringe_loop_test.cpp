// The loop closed around a gyro whose fringes are read by phase: what is recorded, and what faults of its photodiodes
// cost.

#include <zlg/config/schema.hpp>
#include <zlg/core/health.hpp>
#include <zlg/rig/closed_loop.hpp>
#include <zlg/rig/wiring.hpp>

#include "fringe_wiring.hpp"
#include "test.hpp"

namespace zlg::fringe_loop_test {

config::Config by_phase(std::initializer_list<std::string_view> settings = {}) {
    config::Config c;
    config::apply_set(c, "gyro.readout=phase");
    config::apply_set(c, "switching.interval_s=2");
    for (const auto setting : settings) config::apply_set(c, setting);
    return c;
}

std::vector<rig::LoopHalf> advance(const config::Config& c, int halves) {
    rig::ClosedLoop loop{c, rig::motion(c)};
    std::vector<rig::LoopHalf> all;
    for (int h = 0; h < halves; ++h) all.push_back(loop.advance());
    return all;
}

// Counts and place of half h against the twin's own phase, counts.
double off_phase(const rig::LoopHalf& half) {
    return std::remainder(half.record.fringe / 65536.0 + half.truth.rounding_arcsec / 3.263, 1.0);
}

TEST(FringeLoop, NothingIsReadWhereTheCounterIsAll) {
    EXPECT_FALSE(rig::fringe_readout_of(config::Config{}).reads);
    for (const rig::LoopHalf& half : advance(config::Config{}, 100)) {
        EXPECT_FALSE(core::has_fringe(half.record));
        EXPECT_EQ(half.control.health & (core::health_fringe_lost | core::health_fringe_skewed), 0u);
    }
}

// Noise of 1 % of the amplitude is 1/(200 pi) of a turn; 12 bits over +-2 add 1/1024/sqrt(12) of it.
TEST(FringeLoop, WhatIsPresumedIsTheNoiseOfThePhotodiodes) {
    const double expected = std::sqrt(1e-4 + 1.0 / 1024.0 / 1024.0 / 12.0) / (2.0 * M_PI);
    EXPECT_DOUBLE_EQ(rig::fringe_noise_counts(by_phase()), expected);
    EXPECT_DOUBLE_EQ(rig::fringe_readout_of(by_phase()).noise_turns, expected);
    const config::Config x4 = by_phase({"gyro.fidelity=laser", "laser.quadrature=x4"});
    EXPECT_DOUBLE_EQ(rig::fringe_noise_counts(x4), 4.0 * expected);
    EXPECT_EQ(rig::fringe_readout_of(x4).counts_per_turn, 4);
}

// In a time t beside the middle of a reversal the phase goes on by f t^2/t_e; the mean of t^4 is 3 jitter^4.
TEST(FringeLoop, WhatIsPresumedHoldsTheJitter) {
    config::Config jittered = by_phase();
    jittered.photodiodes.jitter_s = 5e-6;
    const double plateau_hz = 60e3 / (1.0 - 50e-6 / 5e-3);
    const double expected = std::sqrt(3.0) * plateau_hz * 5e-6 * 5e-6 / 50e-6;
    EXPECT_NEAR(rig::fringe_noise_counts(jittered), std::hypot(expected, rig::fringe_noise_counts(by_phase())), 1e-12);
}

TEST(FringeLoop, APlaceIsKnownWhereverThereIsLightAndIsThatOfTheTwin) {
    const auto halves = advance(by_phase(), 8000);
    double sum = 0.0;
    int n = 0;
    for (std::size_t h = 800; h < halves.size(); ++h) {
        const rig::LoopHalf& half = halves[h];
        if (half.record.loop_closed) {
            ASSERT_TRUE(core::has_fringe(half.record)) << h;
            EXPECT_EQ(half.control.health & core::health_fringe_lost, 0u) << h;
        }
        if (!core::has_fringe(half.record)) continue;
        EXPECT_LT(std::abs(off_phase(half)), 0.012) << h;
        sum += off_phase(half) * off_phase(half);
        ++n;
    }
    const double noise = rig::fringe_noise_counts(by_phase());
    EXPECT_NEAR(std::sqrt(sum / n), noise, 0.15 * noise);
}

// Never a fringe lost: the sum of counts and places over a tick is the rotation, but for the noise.
TEST(FringeLoop, OverATickCountsAndPlacesTurnWithTheGyro) {
    for (const char* fidelity : {"gyro.fidelity=averaged", "gyro.fidelity=laser"}) {
        config::Config c = by_phase({fidelity, "drift.random_walk_arcsec_sqrt_s=0", "laser.lock_in_left_hz=0",
                                     "laser.lock_in_right_hz=0", "laser.beam_power_w=0", "switching.interval_s=100"});
        const auto halves = advance(c, 4000);
        for (std::size_t h = 801; h + 2 < halves.size(); h += 2) {
            double counted = (halves[h + 2].record.fringe - halves[h].record.fringe) / 65536.0;
            double turned = 0.0;
            for (std::size_t k = h + 1; k <= h + 2; ++k) {
                counted += static_cast<double>(halves[k].record.counts);
                turned += halves[k].truth.dtheta_arcsec + halves[k].truth.false_relock_arcsec;
            }
            // Drift adds up to 1.5 arcsec/s.
            EXPECT_NEAR(3.263 * counted, turned, 0.05) << h;
        }
    }
}

TEST(FringeLoop, ASkewBeyondAMicrosecondIsReported) {
    for (const char* fidelity : {"gyro.fidelity=averaged", "gyro.fidelity=laser"}) {
        for (const bool far : {false, true}) {
            config::Config c = by_phase({fidelity});
            c.photodiodes.skew_s = far ? 2.5e-6 : 1e-6;
            const auto halves = advance(c, 16'000);
            EXPECT_EQ((halves.back().control.health & core::health_fringe_skewed) != 0, far) << fidelity;
        }
    }
}

// Photodiodes that make no ellipse: whole counts from the first half to the last.
TEST(FringeLoop, ABadPhotodiodeLeavesTheWholeCounts) {
    for (const char* bad :
         {"photodiodes.amplitude_error=-1", "photodiodes.offset_cosine=0.9", "photodiodes.adc_bits=1"}) {
        const config::Config c = by_phase({bad});
        config::Config counted = c;
        config::apply_set(counted, "gyro.readout=count");
        const auto a = advance(c, 3000);
        const auto b = advance(counted, 3000);
        int n_known = 0;
        for (std::size_t h = 0; h < a.size(); ++h) {
            n_known += core::has_fringe(a[h].record);
            EXPECT_EQ(a[h].record.valid, b[h].record.valid);
            if (!core::has_fringe(a[h].record)) {
                if (h > 0 && !core::has_fringe(a[h - 1].record)) EXPECT_EQ(a[h].record.counts, b[h].record.counts);
                if (a[h].record.valid) EXPECT_NE(a[h].control.health & core::health_fringe_lost, 0u);
            }
        }
        EXPECT_EQ(n_known, 0) << bad;
    }
}

// Final angles of a record, tick by tick.
std::vector<double> final_angles(const core::GyroCompensationConfig& c, const std::vector<core::HalfRecord>& records,
                                 const std::vector<std::vector<float>>& light) {
    core::GyroCompensationState state;
    std::vector<double> angles;
    for (std::size_t h = 0; h < records.size(); ++h) {
        const auto out = step(c, state, records[h], {.a = light[h], .b = {}});
        if (out.has_sample && out.sample.has_final) angles.push_back(out.sample.final_row.dtheta_final_arcsec);
    }
    return angles;
}

// One place that is not known, in whichever half beside a gap: the angle of the switch changes by no more than whole
// counts err, 1.6 arcsec rms of this motion.
TEST(FringeLoop, AMissingPlaceBesideAGapCostsNoMoreThanWholeCounts) {
    const config::Config c = by_phase({"motion.frequency_hz=20.06", "motion.amplitude_arcsec_s=12000"});
    rig::ClosedLoop loop{c, rig::motion(c)};
    std::vector<core::HalfRecord> records;
    std::vector<std::vector<float>> light;
    for (int h = 0; h < 16'000; ++h) {
        records.push_back(loop.advance().record);
        const auto samples = loop.light().a;
        light.emplace_back(samples.begin(), samples.end());
    }
    for (const core::RelockMethod relock : {core::RelockMethod::joint, core::RelockMethod::mean_square}) {
        const auto compensation = rig::compensation_config(c, relock, core::BridgeMethod::automatic);
        const auto whole = final_angles(compensation, records, light);
        // Counted from the first closed half after a gap; negative: from the first open one.
        for (const int k : {-3, -2, -1, 0, 1, 5, 9, 11, 13, 14, 15, 16, 17, 19, 21, 25}) {
            auto lacking = records;
            std::vector<std::size_t> closings;
            for (std::size_t h = 6000; h + 100 < records.size(); ++h) {
                if (!records[h - 1].loop_closed && records[h].loop_closed) closings.push_back(h);
                const bool begins = k >= 0 ? !records[h - 1].loop_closed && records[h].loop_closed
                                           : records[h - 1].loop_closed && !records[h].loop_closed;
                if (begins) lacking[h + static_cast<std::size_t>(k)].fringe = std::nanf("");
            }
            ASSERT_GT(closings.size(), 10u);
            const auto angles = final_angles(compensation, lacking, light);
            double sum_sq = 0.0;
            for (const std::size_t h : closings) {
                double change = 0.0;
                for (std::size_t tick = h / 2 - 8; tick < h / 2 + 24; ++tick) change += angles[tick] - whole[tick];
                sum_sq += change * change;
                EXPECT_LT(std::abs(change), 8.0) << k << " " << h;
            }
            EXPECT_LT(std::sqrt(sum_sq / static_cast<double>(closings.size())), 2.5) << k;
        }
    }
}

}  // namespace zlg::fringe_loop_test
