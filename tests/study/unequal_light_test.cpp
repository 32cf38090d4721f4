// Gyros whose photodiodes are unequal, from the light to the angle.

#include <zlg/config/schema.hpp>
#include <zlg/core/health.hpp>
#include <zlg/rig/closed_loop.hpp>
#include <zlg/rig/wiring.hpp>
#include <zlg/study/compensated_run.hpp>

#include "test.hpp"

namespace zlg::unequal_light_test {

config::Config gyro_with(const std::vector<std::string>& settings) {
    config::Config c;
    c.motion.kind = config::MotionKind::rest;
    c.switching.interval_s = 2.0;
    for (const std::string& s : settings) config::apply_set(c, s);
    return c;
}

constexpr std::int64_t ticks_a_second = 200;
constexpr std::int64_t run_s = 400;
constexpr std::int64_t switches_due = run_s / 2 - 1;
constexpr std::int64_t learning_s = 60;

struct Made {
    std::size_t switches = 0;
    double rms_arcsec = 0.0;  // of those after the first minute
};

Made made_by(const config::Config& c) {
    const study::ErrorMeter meter = study::compensated_run(c, run_s * ticks_a_second, 1000);
    double sum = 0.0;
    int n = 0;
    for (const study::SwitchError& s : meter.switches()) {
        if (s.window.first_tick < learning_s * ticks_a_second) continue;
        sum += s.error_arcsec * s.error_arcsec;
        ++n;
    }
    return {meter.switches().size(), std::sqrt(sum / n)};
}

class EitherReadout : public testing::TestWithParam<std::vector<std::string>> {};

// The rms of n errors is known to 1/sqrt(2 n), the ratio of two to 1/sqrt(n): 0.077 of 169 switches. Three of that are
// the room.
TEST_P(EitherReadout, SwitchesAsOneOfEqualBeamsDoes) {
    const Made equal = made_by(gyro_with(GetParam()));
    EXPECT_EQ(equal.switches, std::size_t{switches_due});
    for (const auto& [gain_b, drift_per_h] : {std::pair{0.7, 0.05}, {1.02, 0.05}, {1.4, -0.05}}) {
        config::Config c = gyro_with(GetParam());
        c.light.gain_b = gain_b;
        c.light.gain_drift_per_h = drift_per_h;
        c.light.power_decay_per_h = 2.0 * std::log(2.0);  // to a half in half an hour
        const Made unequal = made_by(c);
        EXPECT_EQ(unequal.switches, equal.switches) << gain_b;
        EXPECT_LT(unequal.rms_arcsec, 1.1 * (1.0 + 3.0 * 0.077) * equal.rms_arcsec) << gain_b;
    }
}

INSTANTIATE_TEST_SUITE_P(UnequalLight, EitherReadout,
                         testing::Values(std::vector<std::string>{"perimeter.loop=analog", "gyro.readout=count"},
                                         std::vector<std::string>{"perimeter.loop=analog", "gyro.readout=phase"},
                                         std::vector<std::string>{"perimeter.loop=digital", "gyro.readout=count"},
                                         std::vector<std::string>{"perimeter.loop=digital", "gyro.readout=phase"}));

// What is said of its health, and its valid ticks of which the angle is not true.
struct Life {
    std::vector<std::uint32_t> health;  // by half
    std::uint32_t raised = 0;
    std::int64_t valid = 0;
    std::int64_t wrong = 0;
};

Life life_of(const config::Config& c, int seconds) {
    const twin::Motion motion = rig::motion(c);
    rig::ClosedLoop loop{c, motion};
    study::MeteredCompensation compensation{c, 1000};
    Life life;
    compensation.on_row = [&](const core::AngleRow& row, const study::TickTruth& truth) {
        if ((row.flags & (core::flag_invalid | core::flag_unrepaired)) != 0) return;
        ++life.valid;
        const double error_arcsec = std::abs(row.dtheta_final_arcsec - truth.rotation_arcsec + truth.taken_out_arcsec);
        const double drift_arcsec = 2.0 * c.gyro.tick_s;  // more than that of any mode
        life.wrong += !(error_arcsec <= 5.0 * row.sigma_arcsec + drift_arcsec);
    };
    for (std::int64_t h = 0; h < 2 * seconds * ticks_a_second; ++h) {
        const rig::LoopHalf half = loop.advance();
        life.health.push_back(half.control.health);
        life.raised |= half.control.health;
        compensation.take(half, loop.light());
    }
    (void)compensation.end();
    return life;
}

TEST(UnequalLight, ABeamThatFadesByATenthWithinASecondIsAFaultWithinHalfASecond) {
    for (const std::string loop : {"analog", "digital"}) {
        for (const std::string gain_b : {"1", "0.7", "1.4"}) {
            // Half of the fault's duration is the way to its full size.
            const config::Config c =
                gyro_with({"perimeter.loop=" + loop, "light.gain_b=" + gain_b, "switching.interval_s=100",
                           "faults.kind=beam_fades", "faults.at_s=20", "faults.duration_s=2", "faults.size=0.1"});
            const Life life = life_of(c, 24);
            const auto at = [&life](double time_s) { return life.health.begin() + std::lround(time_s * 400.0); };
            const auto is_unbalanced = [](std::uint32_t word) { return (word & core::health_light_unbalanced) != 0; };
            EXPECT_TRUE(std::none_of(at(2.0), at(20.0), is_unbalanced)) << loop << gain_b;
            EXPECT_TRUE(std::any_of(at(20.0), at(20.5), is_unbalanced)) << loop << gain_b;
            EXPECT_EQ(life.wrong, 0) << loop << gain_b;
        }
    }
}

TEST(UnequalLight, LightThatNoPhotodiodeCanHaveIsANamedFaultAndNoAngle) {
    for (const std::string fidelity : {"averaged", "laser"}) {
        const Life dark = life_of(gyro_with({"gyro.fidelity=" + fidelity, "light.offset_a=-1"}), 40);
        EXPECT_NE(dark.raised & core::health_light_lost, 0u);
        EXPECT_EQ(dark.valid, 0);
        const Life drifting = life_of(gyro_with({"gyro.fidelity=" + fidelity, "light.gain_drift_per_h=-1000"}), 40);
        EXPECT_NE(drifting.raised & core::health_light_lost, 0u);
        EXPECT_NE(drifting.raised & core::health_light_unbalanced, 0u);
        EXPECT_EQ(drifting.wrong, 0);
        for (const std::string gain_b : {"0.01", "100"}) {
            const Life lame = life_of(gyro_with({"gyro.fidelity=" + fidelity, "light.gain_b=" + gain_b}), 10);
            EXPECT_NE(lame.raised & core::health_light_lost, 0u) << gain_b;
            EXPECT_EQ(lame.wrong, 0) << gain_b;
        }
    }
}

TEST(UnequalLight, AGainThatIsNoneIsRefused) {
    for (const std::string gain_b : {"0", "-1", "1e6"}) {
        config::Config c;
        EXPECT_THROW(config::apply_set(c, "light.gain_b=" + gain_b), config::ConfigError) << gain_b;
    }
}

}  // namespace zlg::unequal_light_test
