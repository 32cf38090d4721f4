// An outer field in closed loop: when the control switches, and what stays of it in the angle.

#include <cmath>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>
#include <zlg/config/schema.hpp>
#include <zlg/rig/asked_compensation.hpp>
#include <zlg/rig/closed_loop.hpp>
#include <zlg/rig/replay.hpp>
#include <zlg/rig/wiring.hpp>

namespace {

using namespace zlg;

config::Config gyro(config::AfterStep after_step) {
    config::Config c;
    c.motion.kind = config::MotionKind::rest;
    c.switching.interval_s = 60.0;
    c.switching.first_segment = config::FirstSegment::half;
    c.switching.after_step = after_step;
    c.compensation.magnetic = core::MagneticMethod::estimate;
    return c;
}

config::Config with_field(config::Config c, double at_s, double duration_s, double hz) {
    c.faults.kind = {twin::FaultKind::field_pulse};
    c.faults.at_s = {at_s};
    c.faults.duration_s = {duration_s};
    c.faults.size = {hz};
    return c;
}

struct Life {
    std::vector<double> opened_s;
    std::vector<core::HalfRecord> records;
    double error_arcsec = 0.0;
};

double angle_of(const config::Config& c, const std::vector<core::HalfRecord>& records) {
    rig::Replay replay{rig::asked_compensation(c)};
    double angle = 0.0;
    const auto add = [&](const core::AngleRow& row) { angle += row.dtheta_final_arcsec; };
    for (const core::HalfRecord& record : records) (void)replay.take(record, {}, add);
    replay.end(add);
    return angle;
}

Life run(const config::Config& c, double length_s, const twin::Motion& motion = twin::Motion::rest()) {
    rig::ClosedLoop loop{c, motion};
    Life out;
    double turned = 0.0;
    bool was_closed = true;
    for (std::int64_t half = 0; half < std::llround(2.0 * length_s / c.gyro.tick_s); ++half) {
        const rig::LoopHalf now = loop.advance();
        turned += now.truth.dtheta_arcsec;
        if (was_closed && !now.record.loop_closed)
            out.opened_s.push_back(0.5 * static_cast<double>(half) * c.gyro.tick_s);
        was_closed = now.record.loop_closed;
        out.records.push_back(now.record);
    }
    out.error_arcsec = angle_of(c, out.records) - turned;
    return out;
}

TEST(FieldPulse, WithoutAStepTheScheduleIsThatOfAGyroThatWaits) {
    EXPECT_EQ(run(gyro(config::AfterStep::switch_early), 200.0).opened_s,
              run(gyro(config::AfterStep::wait), 200.0).opened_s);
}

TEST(FieldPulse, AfterAStepTheGyroSwitchesWithinTwoSeconds) {
    const Life got = run(with_field(gyro(config::AfterStep::switch_early), 120.0, 30.0, 30.0), 260.0);
    // Planned: 30, 90, 150, 210. The field begins at 120 and ends at 150.
    ASSERT_GE(got.opened_s.size(), 5U);
    EXPECT_DOUBLE_EQ(got.opened_s[1], 90.0);
    EXPECT_GT(got.opened_s[2], 120.5);
    EXPECT_LT(got.opened_s[2], 122.0);
    EXPECT_GT(got.opened_s[3], 150.5);
    EXPECT_LT(got.opened_s[3], 152.0);
}

TEST(FieldPulse, OfALastingFieldLittleStaysInTheAngle) {
    for (const double hz : {30.0, -10.0}) {
        const auto left = [&](config::AfterStep after_step, core::MagneticMethod method) {
            config::Config c = gyro(after_step);
            c.compensation.magnetic = method;
            return std::abs(run(with_field(c, 107.0, 38.0, hz), 300.0).error_arcsec - run(c, 300.0).error_arcsec);
        };
        const double waiting = left(config::AfterStep::wait, core::MagneticMethod::estimate);
        const double early = left(config::AfterStep::switch_early, core::MagneticMethod::estimate);
        const double without = left(config::AfterStep::wait, core::MagneticMethod::none);
        // All 38 s lie between two switches: without an early one the field is a rotation.
        EXPECT_NEAR(without, std::abs(hz) * 3.263 * 38.0, 20.0);
        EXPECT_NEAR(waiting, without, 20.0);
        EXPECT_LT(early, 25.0) << hz;
    }
}

// A table that turns for 40 s: the same step as that of a field.
TEST(FieldPulse, ARotationStaysInTheAngle) {
    std::vector<double> increments(3000, 0.0);
    for (std::size_t k = 1070; k < 1470; ++k) increments[k] = 9.8;
    const twin::Motion turn = twin::Motion::from_increments(increments, 10.0);
    for (const auto after_step : {config::AfterStep::wait, config::AfterStep::switch_early}) {
        config::Config without = gyro(after_step);
        without.compensation.magnetic = core::MagneticMethod::none;
        // The sawtooth of the drift, which the estimate makes no larger.
        const double sawtooth = 0.7 * 30.0;
        EXPECT_LT(std::abs(run(without, 300.0, turn).error_arcsec), sawtooth);
        EXPECT_LT(std::abs(run(gyro(after_step), 300.0, turn).error_arcsec), sawtooth);
    }
}

}  // namespace
