#include <zlg/core/gyro_compensation.hpp>
#include <zlg/core/gyro_control.hpp>
#include <zlg/wire/status.hpp>

#include "carried.hpp"

namespace zlg::wire::status_test {

Status filled() {
    return {.tick = 0x01020304,
            .tick_s = 0.005,
            .scale_arcsec = 3.263,
            .timer_hz = 1e7,
            .phase = core::SwitchPhase::returning,
            .loop_closed = true,
            .polarity = -1,
            .held = true,
            .asked = true,
            .health = 1,
            .n_switches = 2,
            .n_failed = 3,
            .half_wave_v = 40.5f,
            .half_wave_sigma_v = 0.25f,
            .piezo_v = 150.5f,
            .temperature_c = -3.5f,
            .detuning_lambda = 0.125f,
            .magnetic_arcsec_s = 0.75f,
            .switch_error_arcsec = 2.5f,
            .settings_crc = 4,
            .n_received = 5,
            .n_damaged = 6,
            .n_overruns = 7,
            .stack_used_bytes = 8,
            .last_fault = 9};
}

std::optional<Status> carried(const Status& s) {
    const auto body = body_of(s);
    return status_in({.type = MessageType::status, .body = body});
}

TEST(Status, ArrivesAsItWasSent) {
    EXPECT_EQ(carried(filled()), filled());
    Status other = filled();
    other.loop_closed = false;
    other.held = false;
    other.asked = false;
    EXPECT_EQ(carried(other), other);
}

TEST(Status, HasTheLayoutOfTheDescription) {
    const auto body = body_of(filled());
    ASSERT_EQ(body.size(), 96u);
    const auto number = [&body](std::size_t at, std::size_t n) {
        std::uint64_t x = 0;
        for (std::size_t k = n; k-- > 0;) x = x << 8 | body[at + k];
        return x;
    };
    EXPECT_EQ(number(0, 4), 0x01020304u);
    EXPECT_EQ(body[4], 3);
    EXPECT_EQ(body[5], 0xFF);
    EXPECT_EQ(body[6], 7);
    EXPECT_EQ(std::bit_cast<double>(number(8, 8)), 0.005);
    EXPECT_EQ(std::bit_cast<double>(number(16, 8)), 3.263);
    EXPECT_EQ(std::bit_cast<double>(number(24, 8)), 1e7);
    for (std::size_t k = 0; k < 3; ++k) EXPECT_EQ(number(32 + 4 * k, 4), k + 1);
    EXPECT_EQ(number(44, 4), std::bit_cast<std::uint32_t>(40.5f));
    EXPECT_EQ(number(68, 4), std::bit_cast<std::uint32_t>(2.5f));
    for (std::size_t k = 0; k < 6; ++k) EXPECT_EQ(number(72 + 4 * k, 4), k + 4);
}

TEST(Status, WhatNoGyroSendsIsRefused) {
    Status s = filled();
    s.polarity = 0;
    EXPECT_FALSE(carried(s).has_value());
    s = filled();
    s.phase = static_cast<core::SwitchPhase>(5);
    EXPECT_FALSE(carried(s).has_value());
    s = filled();
    for (const double tick_s : {0.0, 9e-7, 11.0, 1e308, std::numeric_limits<double>::quiet_NaN()}) {
        s.tick_s = tick_s;
        EXPECT_FALSE(carried(s).has_value()) << tick_s;
    }
    const auto body = body_of(filled());
    EXPECT_FALSE(status_in({.type = MessageType::reply, .body = body}).has_value());
    EXPECT_FALSE(status_in({.type = MessageType::status, .body = std::span{body}.first(95)}).has_value());
}

TEST(Status, BitsAndBytesThatMustBeZeroAre) {
    for (const auto& [at, bits] : {std::pair{6u, 0xF8u}, {7u, 0x00u}})
        for (unsigned bit = 1; bit < 256; bit <<= 1) {
            auto body = body_of(filled());
            body[at] = static_cast<std::uint8_t>(body[at] ^ bit);
            EXPECT_EQ(status_in({.type = MessageType::status, .body = body}).has_value(), (bits & bit) == 0)
                << at << ' ' << bit;
        }
}

TEST(Status, OfTheCoreIsWhatTheCoreKnows) {
    core::GyroControlConfig control;
    core::GyroControlState state = initial_state(control);
    for (int half = 0; half < 10; ++half) (void)step(control, state, {.sequence = static_cast<std::uint32_t>(half)});
    state.schedule.held = true;
    state.temperature_c = 31.5;
    core::GyroCompensationConfig compensation;
    compensation.gyro.scale = core::Arcsec{1.5};
    compensation.gyro.timer = core::Hertz{2e6};
    const Status s = status_of(state, {}, compensation);
    EXPECT_EQ(s.tick, 4u);
    EXPECT_EQ(s.scale_arcsec, 1.5);
    EXPECT_EQ(s.timer_hz, 2e6);
    EXPECT_EQ(s.tick_s, 0.005);
    EXPECT_TRUE(s.held);
    EXPECT_FALSE(s.asked);
    EXPECT_EQ(s.temperature_c, 31.5f);
    EXPECT_EQ(s.half_wave_v, 40.0f);
    EXPECT_EQ(s.half_wave_sigma_v, 4.0f);
    EXPECT_EQ(s.phase, state.mode_switch.phase);
    EXPECT_EQ(s.magnetic_arcsec_s, 0.0f);
}

}  // namespace zlg::wire::status_test
