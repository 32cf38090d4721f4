#include <zlg/firmware/gyro.hpp>

#include "test.hpp"

namespace zlg::gyro_test {

using firmware::Gyro;

core::SensorFrame frame_of(std::uint32_t half, const core::ActuatorFrame& actuator) {
    core::SensorFrame frame;
    frame.sequence = half;
    frame.timer_ticks = 25'000u * (half + 1u);
    frame.counter = 20u * (half + 1u) + (half % 2 == 0 ? 150u : 0u);
    frame.bias_sign = half % 2 == 0 ? std::int8_t{1} : std::int8_t{-1};
    frame.polarity = actuator.polarity;
    frame.loop_closed = actuator.loop_closed;
    frame.n_light = 4;
    frame.has_light_b = true;
    for (std::size_t k = 0; k < 4; ++k) frame.light_a[k] = frame.light_b[k] = 1000.0f + static_cast<float>(k);
    frame.piezo_v = actuator.set_point_v[0];
    frame.temperature_c = 20.0;
    return frame;
}

TEST(Gyro, is_control_and_then_compensation_of_its_record) {
    const firmware::Settings settings;
    Gyro gyro;
    core::ActuatorFrame actuator = gyro.start(settings, 7);
    EXPECT_EQ(actuator, initial_actuator(settings.control));
    core::GyroControlState control = initial_state(settings.control, 7);
    core::GyroCompensationState compensation;
    for (std::uint32_t half = 0; half < 400; ++half) {
        const core::SensorFrame frame = frame_of(half, actuator);
        const core::GyroControlOutput expected = step(settings.control, control, frame);
        const std::span a{frame.light_a};
        const std::span b{frame.light_b};
        const core::CompensationOutput angle =
            step(settings.compensation, compensation, expected.record, {a.first(4), b.first(4)});
        const firmware::HalfOutput out = gyro.half(frame);
        ASSERT_EQ(out.control.record, expected.record);
        ASSERT_EQ(out.control.actuator, expected.actuator);
        ASSERT_EQ(out.compensation.angle_arcsec, angle.angle_arcsec);
        ASSERT_EQ(out.compensation.has_sample, half % 2 == 1);
        actuator = out.control.actuator;
    }
    EXPECT_EQ(gyro.state().control, control);
    EXPECT_EQ(gyro.state().compensation, compensation);
}

TEST(Gyro, counts_from_the_reading_it_is_started_with) {
    Gyro gyro;
    const core::ActuatorFrame actuator = gyro.start({}, 1000);
    core::SensorFrame frame = frame_of(0, actuator);
    frame.counter = 1170;
    EXPECT_EQ(gyro.half(frame).control.record.counts, 170);
}

TEST(Gyro, does_not_count_from_a_reading_that_nobody_knows) {
    Gyro gyro;
    core::ActuatorFrame actuator = gyro.start({});
    gyro.forget_counter();
    for (std::uint32_t half = 0; half < 2; ++half) {
        core::SensorFrame frame = frame_of(half, actuator);
        frame.counter = 1'000'000'000u + 170u * half;
        const core::GyroControlOutput out = gyro.half(frame).control;
        EXPECT_EQ(out.record.counts, half == 0 ? 0 : 170);
        EXPECT_EQ(out.health & core::health_counter_jump, 0u);
        actuator = out.actuator;
    }
}

TEST(Gyro, begins_anew_as_if_nothing_had_been) {
    Gyro used;
    core::ActuatorFrame actuator = used.start({});
    for (std::uint32_t half = 0; half < 50; ++half) actuator = used.half(frame_of(half, actuator)).control.actuator;
    Gyro fresh;
    EXPECT_EQ(used.start({}), fresh.start({}));
    EXPECT_EQ(used.state(), fresh.state());
}

TEST(Gyro, looks_at_no_light_beyond_the_samples_of_a_frame) {
    Gyro gyro;
    core::SensorFrame frame = frame_of(0, gyro.start({}));
    frame.n_light = 255;
    Gyro without;
    core::SensorFrame dark = frame_of(0, without.start({}));
    dark.n_light = 0;
    EXPECT_EQ(gyro.half(frame).control.record, without.half(dark).control.record);
    EXPECT_EQ(gyro.state(), without.state());
}

TEST(Gyro, owes_one_row_for_each_tick_it_was_given) {
    Gyro gyro;
    core::ActuatorFrame actuator = gyro.start({});
    int rows = 0;
    for (std::uint32_t half = 0; half < 40; ++half) {
        const firmware::HalfOutput out = gyro.half(frame_of(half, actuator));
        rows += out.compensation.sample.has_final ? 1 : 0;
        actuator = out.control.actuator;
    }
    for (core::DrainOutput due = gyro.drain(); due.has_row || due.has_gap; due = gyro.drain()) rows += due.has_row;
    EXPECT_EQ(rows, 20);
}

TEST(GyroSettings, are_refused_by_the_part_that_cannot_use_them) {
    firmware::Settings settings;
    EXPECT_EQ(firmware::check(settings), firmware::SettingsFault{});
    settings.control.presumed_temperature = core::Celsius{std::numeric_limits<double>::quiet_NaN()};
    settings.compensation.gyro.random_walk = core::ArcsecPerRootSecond{-1.0};
    EXPECT_EQ(firmware::check(settings).control, core::GyroControlFault::temperature);
    EXPECT_EQ(firmware::check(settings).compensation, core::GyroCompensationFault::random_walk);
}

}  // namespace zlg::gyro_test
