#include <zlg/trials/magnetic_gate.hpp>

#include "test.hpp"

namespace zlg::trials::magnetic_gate_test {

using core::ScheduleKind;

// A short run of the campaign; enough switches for the estimator to act at rest.
MagneticGate gate(ScheduleKind schedule) {
    return {.interval_s = 20.0, .run_s = 1500.0, .schedule = schedule, .longest_s = 20.0};
}

bool knows_the_mode(const MovingBase& base) { return base.name.ends_with("times the mode"); }

TEST(MagneticGate, NowhereWorseThanWithout) {
    for (const ScheduleKind schedule : {ScheduleKind::fixed, ScheduleKind::measured})
        for (const MovingBase& base : moving_bases(gate(schedule))) {
            // What jumps whenever the gyro switches, by less than what was presumed, is a drift of the gyro.
            if (knows_the_mode(base) || base.name == "in step: square wave of 2 arcsec/s") continue;
            const GateResult r = gate_result(gate(schedule), base, 2);
            EXPECT_LE(r.with_arcsec, 1.2 * r.without_arcsec)
                << base.name << ": wrong by " << r.error_arcsec_s << ", trust " << r.trust;
        }
}

GateResult judged(const MagneticGate& g, const std::string& name) {
    const auto all = moving_bases(g);
    const auto found = std::find_if(all.begin(), all.end(), [&](const MovingBase& b) { return b.name == name; });
    EXPECT_NE(found, all.end()) << name;
    return gate_result(g, *found, 2);
}

TEST(MagneticGate, AtRestTheSawtoothIsTakenOut) {
    for (const ScheduleKind schedule : {ScheduleKind::fixed, ScheduleKind::measured}) {
        const GateResult r = judged(gate(schedule), "rest");
        // 0.7 to 1 arcsec/s for 10 s.
        EXPECT_NEAR(r.without_arcsec, 0.97 * 20.0 / std::sqrt(12.0), 1.0);
        EXPECT_LT(r.with_arcsec, 0.15 * r.without_arcsec);
    }
}

TEST(MagneticGate, ASteadyRotationInStepIsLeftInTheAngle) {
    const MagneticGate fixed = gate(ScheduleKind::fixed);
    for (const char* name : {"in step: sine of 25 arcsec/s", "in step: square wave of 30 arcsec/s",
                             "in step: square wave of 1000 arcsec/s", "10 arcsec/s times the mode"})
        EXPECT_EQ(judged(fixed, name).trust, 0.0) << name;
    // Only the times of the switches tell this one.
    EXPECT_GT(judged(fixed, "in step: square wave of 2 arcsec/s").with_arcsec, 1.1 * 5.6);
    const GateResult varied = judged(gate(ScheduleKind::measured), "in step: square wave of 2 arcsec/s");
    EXPECT_LE(varied.with_arcsec, 1.1 * varied.without_arcsec);
}

}  // namespace zlg::trials::magnetic_gate_test
