#include <zlg/core/gyro_control.hpp>
#include <zlg/wire/command_handler.hpp>

#include "test.hpp"

namespace zlg::wire::command_handler_test {

// A gyro with a host at the other end of a good line.
struct Bench {
    CommandState state{};
    Sender host{.session = 5, .sequence = 100};

    CommandOutput send(CommandCode command) { return deliver(frame_of(host, command)); }
    CommandOutput deliver(const Frame& frame) {
        Receiver receiver;
        std::span<const std::uint8_t> left = frame.view();
        Message message;
        EXPECT_TRUE(receive(receiver, left, message));
        return handle(state, message);
    }
};

TEST(CommandHandler, AnswersWithTheNumberOfTheCommand) {
    Bench bench;
    const CommandOutput out = bench.send(CommandCode::read_state);
    EXPECT_TRUE(out.has_reply);
    EXPECT_EQ(out.reply.session, 5u);
    EXPECT_EQ(out.reply.sequence, 100u);
    EXPECT_EQ(out.reply.code, 1u);
    EXPECT_EQ(out.reply.result, CommandResult::done);
    EXPECT_EQ(out.due, CommandCode::read_state);
}

TEST(CommandHandler, EachCommandHasItsEffect) {
    Bench bench;
    EXPECT_EQ(bench.send(CommandCode::stop_switching).due, CommandCode::stop_switching);
    EXPECT_EQ(bench.send(CommandCode::start_switching).due, CommandCode::start_switching);
    EXPECT_EQ(bench.send(CommandCode::force_switch).due, CommandCode::force_switch);
}

TEST(CommandHandler, APieceOfSettingsIsLeftToTheCaller) {
    Bench bench;
    const std::array<std::uint8_t, 3> bytes{1, 2, 3};
    const Frame frame = frame_of(bench.host, SettingsPiece{.offset = 9, .bytes = bytes});
    EXPECT_EQ(bench.deliver(frame).due, CommandCode::load);
    EXPECT_EQ(bench.deliver(frame).due, std::nullopt) << "the same frame again";
}

TEST(CommandHandler, WhatIsNoCommandHasNoAnswer) {
    Bench bench;
    EXPECT_FALSE(bench.deliver(frame_of(bench.host, Reply{})).has_reply);
    EXPECT_FALSE(bench.state.last);
}

TEST(CommandHandler, AMalformedCommandIsAnsweredAsSuch) {
    Bench bench;
    const std::array<std::uint8_t, 2> body{99, 0};
    const CommandOutput out = bench.deliver(frame_of(bench.host, MessageType::command, body));
    EXPECT_EQ(out.reply.result, CommandResult::malformed);
    EXPECT_EQ(out.reply.code, 99u);
    EXPECT_EQ(out.due, std::nullopt);
}

TEST(CommandHandler, ARepeatedCommandIsAnsweredAlikeAndObeyedOnce) {
    Bench bench;
    const Frame frame = frame_of(bench.host, CommandCode::force_switch);
    const CommandOutput first = bench.deliver(frame);
    const CommandOutput second = bench.deliver(frame);
    EXPECT_EQ(first.due, CommandCode::force_switch);
    EXPECT_EQ(second.due, std::nullopt);
    EXPECT_EQ(second.reply, first.reply);
    EXPECT_EQ(bench.send(CommandCode::force_switch).due, CommandCode::force_switch);
}

TEST(CommandHandler, TheSameNumberOfAnotherHostIsAnotherCommand) {
    Bench bench;
    (void)bench.send(CommandCode::force_switch);
    bench.host = {.session = 6, .sequence = 100};
    EXPECT_EQ(bench.send(CommandCode::force_switch).due, CommandCode::force_switch);
}

// A host that repeats until it has its answer, on a line that loses frames both ways.
TEST(CommandHandler, EveryCommandIsObeyedOnceHoweverMuchIsLost) {
    std::mt19937_64 random{3};
    Bench bench;
    int n_forced = 0;
    for (int k = 0; k < 500; ++k) {
        const Frame frame = frame_of(bench.host, CommandCode::force_switch);
        for (bool answered = false; !answered;) {
            if (random() % 2 == 0) continue;
            n_forced += bench.deliver(frame).due == CommandCode::force_switch ? 1 : 0;
            answered = random() % 2 == 0;
        }
    }
    EXPECT_EQ(n_forced, 500);
}

// The interrupt's part of it: the core obeys what the effect says.
struct Core {
    core::GyroControlConfig config{};
    core::GyroControlState state{};
    core::SensorFrame frame{.n_light = 4, .has_light_b = true};
    core::ActuatorFrame command{};

    explicit Core(const core::GyroControlConfig& c) : config{c}, state{initial_state(c)}, command{initial_actuator(c)} {
        frame.light_a.fill(1.0f);
        frame.light_b.fill(1.0f);
        frame.piezo_v = command.set_point_v[0];
        frame.temperature_c = 20.0;
    }
    // A gyro that obeys at once and always holds the mode; how often its loop was opened in so many ticks.
    int openings(int ticks) {
        int n = 0;
        for (int half = 0; half < 2 * ticks; ++half) {
            frame.loop_closed = command.loop_closed;
            frame.polarity = command.polarity;
            frame.piezo_v = command.set_point_v[0];
            frame.counter += static_cast<std::uint64_t>(frame.bias_sign * frame.polarity * 150);
            const bool was_closed = command.loop_closed;
            command = step(config, state, frame).actuator;
            n += was_closed && !command.loop_closed ? 1 : 0;
            ++frame.sequence;
            frame.timer_ticks += 25000;
            frame.bias_sign = static_cast<std::int8_t>(-frame.bias_sign);
        }
        return n;
    }
    void obey(const CommandOutput& out) {
        if (out.due == CommandCode::stop_switching) state.schedule.held = true;
        if (out.due == CommandCode::start_switching) state.schedule.held = false;
        if (out.due == CommandCode::force_switch) state.schedule.asked = true;
    }
};

TEST(CommandHandler, TheCoreStopsStartsAndSwitchesOnCommand) {
    Bench bench;
    core::GyroControlConfig config;
    config.schedule.interval_ticks = 100;
    Core gyro{config};
    EXPECT_EQ(gyro.openings(1000), 10);
    gyro.obey(bench.send(CommandCode::stop_switching));
    EXPECT_EQ(gyro.openings(1000), 0);
    gyro.obey(bench.send(CommandCode::force_switch));
    EXPECT_EQ(gyro.openings(1000), 1);
    gyro.obey(bench.send(CommandCode::start_switching));
    EXPECT_EQ(gyro.openings(1000), 10);
}

}  // namespace zlg::wire::command_handler_test
