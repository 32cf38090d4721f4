#include <telemetry_queue.hpp>

#include <zlg/wire/angle_register.hpp>

#include "test.hpp"

namespace zlg::telemetry_queue_test {

using firmware::HalfOutput;
using firmware::TelemetryQueue;

constexpr double tick_s = 0.005;

// Both halves of a tick; each tick turns the gyro by 2 arcsec, and settles the tick ten before, at last 3 arcsec.
void put_tick(TelemetryQueue& queue, std::int64_t tick) {
    HalfOutput half;
    half.control.health = 1;
    queue.put(half, {}, tick_s);
    half.control.health = 4;
    half.control.record.mode = -1;
    half.control.record.temperature_c = 21.5;
    half.compensation.has_sample = true;
    half.compensation.sample.tick = tick;
    half.compensation.sample.dtheta_arcsec = 2.0;
    half.compensation.sample.has_final = true;
    half.compensation.sample.final_row.tick = tick - 10;
    half.compensation.sample.final_row.dtheta_arcsec = 2.0;
    half.compensation.sample.final_row.dtheta_final_arcsec = 3.0;
    queue.put(half, {.timer_ticks = 50'000u * static_cast<std::uint64_t>(tick + 1)}, tick_s);
}

double turned_arcsec(std::uint64_t reading) { return wire::turned_arcsec(0, reading); }

TEST(TelemetryQueue, tells_each_tick_once_and_in_order) {
    TelemetryQueue queue;
    wire::Telemetry message;
    EXPECT_FALSE(queue.take(message));
    for (std::int64_t tick = 0; tick < 9; tick += 3) {
        for (int k = 0; k < 3; ++k) put_tick(queue, tick + k);
        for (int k = 0; k < 3; ++k) {
            ASSERT_TRUE(queue.take(message));
            EXPECT_EQ(message.tick, tick + k);
            EXPECT_EQ(turned_arcsec(message.angle), 2.0 * static_cast<double>(tick + k + 1));
        }
        EXPECT_FALSE(queue.take(message));
    }
    EXPECT_EQ(message.mode, -1);
    EXPECT_EQ(message.health, 5u) << "of both halves";
    EXPECT_EQ(message.temperature_c, 21.5f);
    EXPECT_EQ(message.tick_s, tick_s);
    EXPECT_EQ(message.time.timer_ticks, 450'000u);
}

TEST(TelemetryQueue, a_listener_that_is_late_loses_messages_and_no_angle) {
    TelemetryQueue queue;
    for (std::int64_t tick = 0; tick < 100; ++tick) put_tick(queue, tick);
    wire::Telemetry message;
    std::uint32_t last = 0;
    for (; queue.take(message); last = message.tick)
        EXPECT_EQ(turned_arcsec(message.angle), 2.0 * (message.tick + 1.0));
    EXPECT_LT(last, 99u);
    put_tick(queue, 100);
    ASSERT_TRUE(queue.take(message));
    EXPECT_EQ(message.tick, 100u);
    EXPECT_EQ(turned_arcsec(message.angle), 202.0);
    EXPECT_EQ(turned_arcsec(message.settled_angle), 202.0);
    EXPECT_EQ(turned_arcsec(message.settled_final_angle), 303.0);
}

TEST(TelemetryQueue, begins_anew) {
    TelemetryQueue queue;
    for (std::int64_t tick = 0; tick < 7; ++tick) put_tick(queue, tick);
    queue.restart();
    wire::Telemetry message;
    EXPECT_FALSE(queue.take(message));
    put_tick(queue, 0);
    ASSERT_TRUE(queue.take(message));
    EXPECT_EQ(turned_arcsec(message.angle), 2.0);
}

}  // namespace zlg::telemetry_queue_test
