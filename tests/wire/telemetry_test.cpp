#include <zlg/wire/telemetry.hpp>

#include "carried.hpp"

namespace zlg::wire::telemetry_test {

constexpr double inf = std::numeric_limits<double>::infinity();
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

// A message in every field of which is another number.
Telemetry filled() {
    return {.tick = 0xFFFFFFF0,
            .has_tick = true,
            .has_settled = true,
            .settled_age_ticks = 0x24,
            .mode = -1,
            .flags = 0x1234,
            .dtheta_arcsec = -12.625,
            .angle = 0xFEDCBA9876543210,
            .settled_mode = 1,
            .settled_flags = 0x400,
            .settled_dtheta_arcsec = 3.263,
            .settled_final_arcsec = 3.2631,
            .settled_sigma_arcsec = inf,
            .settled_angle = 5,
            .settled_final_angle = 6,
            .health = 0x3FFFFFFF,
            .temperature_c = 36.5f,
            .tick_s = 0.005,
            .time = {.timer_ticks = 0x0102030405060708, .synchronised = true, .n_pulses = 9, .since_pulse_ticks = 10}};
}

std::optional<Telemetry> carried(const Telemetry& t) {
    const auto body = body_of(t);
    return telemetry_in({.type = MessageType::telemetry, .body = body});
}

TEST(Telemetry, ArrivesAsItWasSent) {
    EXPECT_EQ(carried(filled()), filled());
    Telemetry other = filled();
    other.has_tick = false;
    other.has_settled = false;
    other.time.synchronised = false;
    other.mode = 1;
    EXPECT_EQ(carried(other), other);
}

// The table of docs/wire.md, byte by byte.
TEST(Telemetry, HasTheLayoutOfTheDescription) {
    const auto body = body_of(filled());
    ASSERT_EQ(body.size(), 108u);
    const auto number = [&body](std::size_t at, std::size_t n) {
        std::uint64_t x = 0;
        for (std::size_t k = n; k-- > 0;) x = x << 8 | body[at + k];
        return x;
    };
    const auto real = [&number](std::size_t at) { return std::bit_cast<double>(number(at, 8)); };
    EXPECT_EQ(number(0, 4), 0xFFFFFFF0u);
    EXPECT_EQ(number(4, 2), 0x24u);
    EXPECT_EQ(body[6], 0x07);
    EXPECT_EQ(body[7], 0x00);
    EXPECT_EQ(number(8, 8), 0xFEDCBA9876543210u);
    EXPECT_EQ(real(16), -12.625);
    EXPECT_EQ(number(24, 4), 0x1234u);
    EXPECT_EQ(number(28, 4), 0x3FFFFFFFu);
    EXPECT_EQ(body[32], 0xFF);
    EXPECT_EQ(body[33], 0x01);
    EXPECT_EQ(number(34, 2), 0u);
    EXPECT_EQ(number(36, 4), std::bit_cast<std::uint32_t>(36.5f));
    EXPECT_EQ(real(40), 3.263);
    EXPECT_EQ(real(48), 3.2631);
    EXPECT_EQ(real(56), inf);
    EXPECT_EQ(number(64, 8), 5u);
    EXPECT_EQ(number(72, 8), 6u);
    EXPECT_EQ(number(80, 4), 0x400u);
    EXPECT_EQ(number(84, 4), 9u);
    EXPECT_EQ(number(88, 4), 10u);
    EXPECT_EQ(number(92, 8), 0x0102030405060708u);
    EXPECT_EQ(real(100), 0.005);
}

TEST(Telemetry, WhatNoGyroSendsIsRefused) {
    const auto refused = [](auto change) {
        Telemetry t = filled();
        change(t);
        return !carried(t).has_value();
    };
    EXPECT_TRUE(refused([](Telemetry& t) { t.dtheta_arcsec = nan; }));
    EXPECT_TRUE(refused([](Telemetry& t) { t.settled_dtheta_arcsec = inf; }));
    EXPECT_TRUE(refused([](Telemetry& t) { t.settled_final_arcsec = -inf; }));
    EXPECT_TRUE(refused([](Telemetry& t) { t.dtheta_arcsec = 0x1p35; }));
    EXPECT_FALSE(refused([](Telemetry& t) { t.dtheta_arcsec = -0x1p34; }));
    EXPECT_TRUE(refused([](Telemetry& t) { t.settled_sigma_arcsec = -1.0; }));
    EXPECT_TRUE(refused([](Telemetry& t) { t.settled_sigma_arcsec = nan; }));
    EXPECT_TRUE(refused([](Telemetry& t) { t.mode = 0; }));
    EXPECT_TRUE(refused([](Telemetry& t) { t.settled_mode = 2; }));
    EXPECT_TRUE(refused([](Telemetry& t) { t.flags = 0x10000; }));
    EXPECT_TRUE(refused([](Telemetry& t) { t.settled_flags = 0x20000; }));
    EXPECT_TRUE(refused([](Telemetry& t) { t.tick_s = 0.0; }));
    EXPECT_TRUE(refused([](Telemetry& t) { t.tick_s = inf; }));
    EXPECT_TRUE(refused([](Telemetry& t) { t.tick_s = nan; }));
    EXPECT_TRUE(refused([](Telemetry& t) { t.tick_s = 9e-7; }));
    EXPECT_FALSE(refused([](Telemetry& t) { t.tick_s = 1e-6; }));
    EXPECT_FALSE(refused([](Telemetry& t) { t.tick_s = 10.0; }));
    EXPECT_TRUE(refused([](Telemetry& t) { t.tick_s = 11.0; }));
    EXPECT_TRUE(refused([](Telemetry& t) { t.settled_sigma_arcsec = 1e300; }));
    EXPECT_TRUE(refused([](Telemetry& t) { t.settled_age_ticks = 129; }));
}

TEST(Telemetry, BitsAndBytesThatMustBeZeroAre) {
    for (const auto& [at, bits] : {std::pair{6u, 0xF8u}, {7u, 0xFFu}, {34u, 0xFFu}, {35u, 0xFFu}})
        for (unsigned bit = 1; bit < 256; bit <<= 1) {
            std::vector<std::uint8_t> body = body_of(filled());
            body[at] = static_cast<std::uint8_t>(body[at] ^ bit);
            EXPECT_EQ(telemetry_in({.type = MessageType::telemetry, .body = body}).has_value(), (bits & bit) == 0)
                << at << ' ' << bit;
        }
}

TEST(Telemetry, AnotherTypeOrLengthIsRefused) {
    std::vector<std::uint8_t> body = body_of(filled());
    EXPECT_TRUE(telemetry_in({.type = MessageType::telemetry, .body = body}).has_value());
    EXPECT_FALSE(telemetry_in({.type = MessageType::status, .body = body}).has_value());
    body.push_back(0);
    EXPECT_FALSE(telemetry_in({.type = MessageType::telemetry, .body = body}).has_value());
    body.resize(107);
    EXPECT_FALSE(telemetry_in({.type = MessageType::telemetry, .body = body}).has_value());
}

core::AngleSample sample(std::int64_t tick, double dtheta_arcsec) {
    return {.tick = tick, .dtheta_arcsec = dtheta_arcsec, .flags = core::flag_extrapolated};
}

TEST(TelemetryOfATick, SumsUpWhatIsDeliveredAndWhatIsSettled) {
    TelemetryState state;
    const TickReport report{
        .mode = -1, .health = 5, .temperature_c = 21.5, .tick_s = 0.004, .time = {.timer_ticks = 8}};
    Telemetry t = telemetry_of(state, sample(0, 1.5), report);
    EXPECT_FALSE(t.has_settled);
    EXPECT_EQ(t.angle, std::uint64_t{3} << 27);
    EXPECT_EQ(t.settled_angle, 0u);
    core::AngleSample second = sample(1, 2.0);
    second.has_final = true;
    second.final_row = {
        .tick = 0, .dtheta_arcsec = 1.5, .dtheta_final_arcsec = 1.25, .sigma_arcsec = 0.5, .mode = 1, .flags = 4};
    t = telemetry_of(state, second, report);
    EXPECT_TRUE(t.has_tick);
    EXPECT_EQ(t.tick, 1u);
    EXPECT_EQ(t.flags, core::flag_extrapolated);
    EXPECT_EQ(t.angle, std::uint64_t{7} << 27);
    EXPECT_TRUE(t.has_settled);
    EXPECT_EQ(t.settled_age_ticks, 1u);
    EXPECT_EQ(t.settled_angle, std::uint64_t{3} << 27);
    EXPECT_EQ(t.settled_final_angle, std::uint64_t{5} << 26);
    EXPECT_EQ(t.settled_mode, 1);
    EXPECT_EQ(t.settled_flags, 4u);
    EXPECT_EQ(t.settled_sigma_arcsec, 0.5);
    EXPECT_EQ(t.mode, -1);
    EXPECT_EQ(t.health, 5u);
    EXPECT_EQ(t.temperature_c, 21.5f);
    EXPECT_EQ(t.tick_s, 0.004);
    EXPECT_EQ(t.time.timer_ticks, 8u);
}

TEST(TelemetryOfATick, TicksThatAreNotToldStayInTheSums) {
    TelemetryState whole;
    TelemetryState sent;
    TelemetryState skipped;
    for (int tick = 0; tick < 3; ++tick) {
        core::AngleSample one = sample(tick, 0.1 * (tick + 1));
        one.has_final = true;
        one.final_row = {.tick = tick, .dtheta_arcsec = -0.3, .dtheta_final_arcsec = 0.7};
        (void)telemetry_of(whole, one, {});
        (void)telemetry_of(tick == 0 ? sent : skipped, one, {});
    }
    skip(sent, skipped);
    EXPECT_EQ(sent, whole);
}

TEST(TelemetryOfATick, AfterTheLastOneOnlyTheSettledRowGoesOn) {
    TelemetryState state;
    (void)telemetry_of(state, sample(0, 1.5), {});
    (void)telemetry_of(state, sample(1, 1.5), {});
    const core::AngleRow row{.tick = 1, .dtheta_arcsec = 1.5, .dtheta_final_arcsec = 1.0};
    const Telemetry t = telemetry_of(state, row, {});
    EXPECT_FALSE(t.has_tick);
    EXPECT_EQ(t.tick, 1u);
    EXPECT_EQ(t.settled_age_ticks, 0u);
    EXPECT_EQ(t.angle, std::uint64_t{3} << 28);
    EXPECT_EQ(t.settled_final_angle, std::uint64_t{1} << 28);
}

TEST(Telemetry, FitsTwentyTimesIntoATenthOfASecondOf921600Baud) {
    Sender sender;
    EXPECT_LE(20 * frame_of(sender, filled()).size, 9216u);
}

}  // namespace zlg::wire::telemetry_test
