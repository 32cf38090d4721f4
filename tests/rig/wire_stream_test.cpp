#include <fmt/format.h>
#include <zlg/config/schema.hpp>
#include <zlg/logs/wire_rows.hpp>
#include <zlg/rig/asked_compensation.hpp>
#include <zlg/rig/wire_stream.hpp>
#include <zlg/rig/wiring.hpp>

#include "test.hpp"

namespace zlg::rig::wire_stream_test {

config::Config gyro() {
    config::Config c;
    c.run.duration_s = 30.0;
    c.switching.interval_s = 10.0;
    return c;
}

struct Made {
    std::vector<std::uint8_t> bytes;
    std::vector<core::AngleRow> rows;  // of a compensation beside it
    std::vector<std::uint64_t> stamps_ticks;
};

Made made(const config::Config& config) {
    Made all;
    ClosedLoop loop{config, motion(config)};
    WireStream stream{config, 9};
    Replay beside{asked_compensation(config)};
    const auto add = [&](const core::AngleRow& row) { all.rows.push_back(row); };
    for (int half = 0; half < 12000; ++half) {
        const LoopHalf now = loop.advance();
        stream.take(loop, now, all.bytes);
        const auto out = beside.take(now.record, loop.light(), add);
        if (out.has_sample) all.stamps_ticks.push_back(loop.sensor().timer_ticks);
    }
    stream.end(all.bytes);
    beside.end(add);
    for (core::AngleRow& row : all.rows) row.relock_arcsec = 0.0;
    return all;
}

TEST(WireStream, TellsTheRowsOfTheCompensationBitByBit) {
    const Made all = made(gyro());
    logs::WireRows rows;
    rows.take(all.bytes);
    rows.end();
    std::vector<core::AngleRow> got;
    core::AngleRow row;
    while (rows.next(row)) got.push_back(row);
    ASSERT_EQ(got.size(), 6000u);
    EXPECT_EQ(got, all.rows);
    EXPECT_EQ(rows.summary().n_lost_messages, 0u);
    // One a second, the first with the first tick.
    EXPECT_EQ(rows.summary().n_status, 30u);
    ASSERT_TRUE(rows.status().has_value());
    EXPECT_EQ(rows.status()->n_switches, 2u);
    EXPECT_EQ(rows.status()->scale_arcsec, 3.263);
    EXPECT_EQ(rows.status()->timer_hz, timer_hz);
}

TEST(WireStream, TheTickIsTimedByTheTimerAndThePulse) {
    const Made all = made(gyro());
    wire::Receiver receiver;
    wire::Message message;
    std::span<const std::uint8_t> left{all.bytes};
    std::size_t tick = 0;
    while (receive(receiver, left, message)) {
        EXPECT_EQ(message.session, 9u);
        const auto t = wire::telemetry_in(message);
        if (!t || !t->has_tick) continue;
        ASSERT_EQ(t->tick, tick);
        EXPECT_EQ(t->time.timer_ticks, all.stamps_ticks[tick]);
        ASSERT_TRUE(t->time.synchronised);
        EXPECT_LT(t->time.since_pulse_ticks, pulse_ticks);
        // Pulses and what is left make the stamp again.
        EXPECT_EQ((t->time.n_pulses - 1) * pulse_ticks + t->time.since_pulse_ticks,
                  all.stamps_ticks[tick] - (all.stamps_ticks[0] - 25000));
        ++tick;
    }
    EXPECT_EQ(tick, 6000u);
}

TEST(WireStream, HealthAndModeAreThoseOfTheTick) {
    const Made all = made(gyro());
    wire::Receiver receiver;
    wire::Message message;
    std::span<const std::uint8_t> left{all.bytes};
    int n_switching = 0;
    int n_minus = 0;
    while (receive(receiver, left, message)) {
        const auto t = wire::telemetry_in(message);
        if (!t || !t->has_tick) continue;
        n_switching += (t->health & core::health_switching) != 0 ? 1 : 0;
        n_minus += t->mode < 0 ? 1 : 0;
    }
    // Two switches, each a gap of 3 ticks and a lock of 20 and more; the second segment lasts 10 s of 30.
    EXPECT_GE(n_switching, 46);
    EXPECT_LE(n_switching, 200);
    EXPECT_NEAR(n_minus, 2000, 20);
}

// The line refuses what no configuration allows, and nothing else.
TEST(WireStream, ATickMayHaveOnTheLineTheLengthsOfTheConfiguration) {
    config::Config c;
    const auto set = [&c](double tick_s) { config::apply_pair(c, "gyro.tick_s", fmt::format("{}", tick_s), "test"); };
    EXPECT_NO_THROW(set(wire::min_tick_s));
    EXPECT_NO_THROW(set(wire::max_tick_s));
    EXPECT_THROW(set(0.999 * wire::min_tick_s), config::ConfigError);
    EXPECT_THROW(set(1.001 * wire::max_tick_s), config::ConfigError);
}

}  // namespace zlg::rig::wire_stream_test
