#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <zlg/core/gyro_control.hpp>
#include <zlg/wire/command_handler.hpp>

#include "test.hpp"

namespace zlg::wire::command_handler_test {

constexpr std::uint16_t interval_key = 0x0402;
constexpr std::uint16_t gap_key = 0x0501;
constexpr std::uint16_t settle_key = 0x0503;
constexpr std::uint16_t timeout_key = 0x0504;
constexpr std::uint16_t half_ticks_key = 0x0601;
constexpr std::uint16_t chi_key = 0x1006;

// A gyro with a host at the other end of a good line.
struct Bench {
    CommandState state{};
    Sender host{.session = 5, .sequence = 100};

    CommandOutput send(const Command& command) { return deliver(frame_of(host, command)); }
    CommandOutput deliver(const Frame& frame) {
        Receiver receiver;
        std::span<const std::uint8_t> left = frame.view();
        Message message;
        EXPECT_TRUE(receive(receiver, left, message));
        return handle(state, message);
    }
    CommandOutput set(std::initializer_list<Parameter> parameters) {
        return send(command_of(CommandCode::set_parameters, parameters));
    }
    [[nodiscard]] double value(std::uint16_t key) const { return parameter(state.settings, key); }

    static Command command_of(CommandCode code, std::initializer_list<Parameter> parameters) {
        Command command{.code = code};
        for (const Parameter& p : parameters) command.parameters.items[command.parameters.n++] = p;
        return command;
    }
};

TEST(CommandHandler, AnswersWithTheNumberOfTheCommand) {
    Bench bench;
    const CommandOutput out = bench.send({.code = CommandCode::read_state});
    EXPECT_TRUE(out.has_reply);
    EXPECT_EQ(out.reply.session, 5u);
    EXPECT_EQ(out.reply.sequence, 100u);
    EXPECT_EQ(out.reply.code, 1u);
    EXPECT_EQ(out.reply.result, CommandResult::done);
    EXPECT_EQ(out.effect, (CommandEffect{.send_status = true}));
}

TEST(CommandHandler, EachCommandHasItsEffect) {
    Bench bench;
    EXPECT_EQ(bench.send({.code = CommandCode::stop_switching}).effect, (CommandEffect{.stop_switching = true}));
    EXPECT_EQ(bench.send({.code = CommandCode::start_switching}).effect, (CommandEffect{.start_switching = true}));
    EXPECT_EQ(bench.send({.code = CommandCode::force_switch}).effect, (CommandEffect{.force_switch = true}));
}

TEST(CommandHandler, APieceOfSettingsIsLeftToTheCaller) {
    Bench bench;
    const std::array<std::uint8_t, 3> bytes{1, 2, 3};
    const Frame frame = frame_of(bench.host, SettingsPiece{.offset = 9, .bytes = bytes});
    EXPECT_EQ(bench.deliver(frame).effect, (CommandEffect{.load = true}));
    EXPECT_EQ(bench.deliver(frame).effect, CommandEffect{}) << "the same frame again";
}

TEST(CommandHandler, WhatIsNoCommandHasNoAnswer) {
    Bench bench;
    EXPECT_FALSE(bench.deliver(frame_of(bench.host, Reply{})).has_reply);
    EXPECT_FALSE(bench.state.has_last);
}

TEST(CommandHandler, AMalformedCommandIsAnsweredAsSuch) {
    Bench bench;
    const std::array<std::uint8_t, 2> body{99, 0};
    const CommandOutput out = bench.deliver(frame_of(bench.host, MessageType::command, body));
    EXPECT_EQ(out.reply.result, CommandResult::malformed);
    EXPECT_EQ(out.reply.code, 99u);
    EXPECT_EQ(out.effect, CommandEffect{});
}

TEST(CommandHandler, SetsAllAndTellsTheNewValues) {
    Bench bench;
    const CommandOutput out = bench.set({{interval_key, 4000.0}, {gap_key, 4.0}});
    EXPECT_EQ(out.reply.result, CommandResult::done);
    EXPECT_TRUE(out.effect.settings_changed);
    EXPECT_EQ(bench.value(interval_key), 4000.0);
    EXPECT_EQ(bench.value(gap_key), 4.0);
    EXPECT_EQ(out.reply.parameters.n, 2u);
    EXPECT_EQ(out.reply.parameters.items[0], (Parameter{interval_key, 4000.0}));
    EXPECT_EQ(out.reply.parameters.items[1], (Parameter{gap_key, 4.0}));
}

TEST(CommandHandler, StoresNothingWhereOneIsRefusedByTheCoreAndNamesIt) {
    Bench bench;
    const double before = bench.value(interval_key);
    const CommandOutput out = bench.set({{interval_key, 4000.0}, {gap_key, 0.0}});
    EXPECT_EQ(out.reply.result, CommandResult::not_allowed);
    EXPECT_EQ(out.reply.key, gap_key);
    EXPECT_EQ(out.reply.part, RefusingPart::control);
    EXPECT_EQ(out.reply.fault, static_cast<std::uint8_t>(core::GyroControlFault::mode_switch));
    EXPECT_EQ(out.effect, CommandEffect{});
    EXPECT_EQ(bench.value(interval_key), before);
    EXPECT_EQ(bench.value(gap_key), 3.0);
    EXPECT_EQ(out.reply.parameters.items[0], (Parameter{interval_key, before}));
}

TEST(CommandHandler, NamesThePartThatRefuses) {
    Bench bench;
    const CommandOutput out = bench.set({{chi_key, -2e6}});
    EXPECT_EQ(out.reply.part, RefusingPart::compensation);
    EXPECT_EQ(out.reply.fault, static_cast<std::uint8_t>(core::GyroCompensationFault::relock));
    EXPECT_EQ(out.reply.key, chi_key);
}

TEST(CommandHandler, TwoThatAreAllowedOnlyTogetherAreSetTogether) {
    Bench bench;
    // The time-out must be longer than the settling: 60 and 20 at the start.
    EXPECT_EQ(bench.set({{settle_key, 80.0}}).reply.result, CommandResult::not_allowed);
    EXPECT_EQ(bench.set({{settle_key, 80.0}, {timeout_key, 100.0}}).reply.result, CommandResult::done);
    EXPECT_EQ(bench.value(settle_key), 80.0);
}

TEST(CommandHandler, WhereNoneAloneIsAtFaultNoneIsNamed) {
    Bench bench;
    const CommandOutput out = bench.set({{gap_key, 0.0}, {chi_key, -2e6}});
    EXPECT_EQ(out.reply.result, CommandResult::not_allowed);
    EXPECT_EQ(out.reply.key, 0u);
    EXPECT_EQ(bench.value(chi_key), 3.6);
}

TEST(CommandHandler, UnknownReadOnlyAndImpossibleValuesAreNamed) {
    Bench bench;
    CommandOutput out = bench.set({{interval_key, 4000.0}, {0x7777, 1.0}});
    EXPECT_EQ(out.reply.result, CommandResult::unknown_key);
    EXPECT_EQ(out.reply.key, 0x7777u);
    out = bench.set({{interval_key, 4000.0}, {half_ticks_key, 1.0}});
    EXPECT_EQ(out.reply.result, CommandResult::read_only);
    EXPECT_EQ(out.reply.key, half_ticks_key);
    out = bench.set({{gap_key, 4.0}, {interval_key, 1.5}});
    EXPECT_EQ(out.reply.result, CommandResult::not_a_value);
    EXPECT_EQ(out.reply.key, interval_key);
    EXPECT_EQ(bench.value(interval_key), 18000.0);
    EXPECT_EQ(bench.value(gap_key), 3.0);
}

TEST(CommandHandler, AKeyThatIsGivenTwiceTakesTheLastValueOrTheFirstAgain) {
    Bench bench;
    EXPECT_EQ(bench.set({{gap_key, 4.0}, {gap_key, 5.0}}).reply.result, CommandResult::done);
    EXPECT_EQ(bench.value(gap_key), 5.0);
    EXPECT_EQ(bench.set({{gap_key, 4.0}, {gap_key, 0.0}}).reply.result, CommandResult::not_allowed);
    EXPECT_EQ(bench.value(gap_key), 5.0);
}

TEST(CommandHandler, ReadsParameters) {
    Bench bench;
    const CommandOutput out =
        bench.send(Bench::command_of(CommandCode::read_parameters, {{chi_key, 0.0}, {half_ticks_key, 0.0}}));
    EXPECT_EQ(out.reply.result, CommandResult::done);
    EXPECT_EQ(out.reply.parameters.items[0], (Parameter{chi_key, 3.6}));
    EXPECT_EQ(out.reply.parameters.items[1], (Parameter{half_ticks_key, 25000.0}));
    EXPECT_EQ(bench.send(Bench::command_of(CommandCode::read_parameters, {{0x7777, 0.0}})).reply.result,
              CommandResult::unknown_key);
}

TEST(CommandHandler, ARepeatedCommandIsAnsweredAlikeAndObeyedOnce) {
    Bench bench;
    const Frame frame = frame_of(bench.host, Command{.code = CommandCode::force_switch});
    const CommandOutput first = bench.deliver(frame);
    const CommandOutput second = bench.deliver(frame);
    EXPECT_TRUE(first.effect.force_switch);
    EXPECT_EQ(second.effect, CommandEffect{});
    EXPECT_EQ(second.reply, first.reply);
    EXPECT_TRUE(bench.send({.code = CommandCode::force_switch}).effect.force_switch);
}

TEST(CommandHandler, TheSameNumberOfAnotherHostIsAnotherCommand) {
    Bench bench;
    (void)bench.send({.code = CommandCode::force_switch});
    bench.host = {.session = 6, .sequence = 100};
    EXPECT_TRUE(bench.send({.code = CommandCode::force_switch}).effect.force_switch);
}

// A host that repeats until it has its answer, on a line that loses frames both ways.
TEST(CommandHandler, EveryCommandIsObeyedOnceHoweverMuchIsLost) {
    std::mt19937_64 random{3};
    Bench bench;
    int n_forced = 0;
    for (int k = 0; k < 500; ++k) {
        const Frame frame = frame_of(bench.host, Command{.code = CommandCode::force_switch});
        for (bool answered = false; !answered;) {
            if (random() % 2 == 0) continue;
            n_forced += bench.deliver(frame).effect.force_switch ? 1 : 0;
            answered = random() % 2 == 0;
        }
    }
    EXPECT_EQ(n_forced, 500);
}

RC_GTEST_PROP(CommandHandler, WhateverIsSetTheSettingsStayAllowed, ()) {
    Bench bench;
    const auto n = *rc::gen::inRange(1, 12);
    for (int k = 0; k < n; ++k) {
        Command command{.code = CommandCode::set_parameters};
        command.parameters.n = *rc::gen::inRange<std::uint8_t>(1, 5);
        for (std::size_t i = 0; i < command.parameters.n; ++i) {
            const auto all = parameters();
            const auto key = all[*rc::gen::inRange<std::size_t>(0, all.size())].key;
            const double present = bench.value(key);
            command.parameters.items[i] = {key, *rc::gen::oneOf(rc::gen::element(present, 2.0 * present, 0.5 * present,
                                                                                 present + 1.0, -present, 0.0),
                                                                rc::gen::arbitrary<double>())};
        }
        const GyroSettings before = bench.state.settings;
        const CommandOutput out = bench.send(command);
        RC_ASSERT(check(bench.state.settings.control) == core::GyroControlFault::none);
        RC_ASSERT(check(bench.state.settings.compensation) == core::GyroCompensationFault::none);
        RC_ASSERT(out.effect.settings_changed == (out.reply.result == CommandResult::done));
        if (out.reply.result != CommandResult::done)
            RC_ASSERT(settings_crc(bench.state.settings) == settings_crc(before));
    }
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
    void obey(const CommandOutput& out, const GyroSettings& settings) {
        if (out.effect.settings_changed) config = settings.control;
        if (out.effect.stop_switching) state.schedule.held = true;
        if (out.effect.start_switching) state.schedule.held = false;
        if (out.effect.force_switch) state.schedule.asked = true;
    }
};

TEST(CommandHandler, TheCoreStopsStartsAndSwitchesOnCommand) {
    Bench bench;
    bench.state.settings.control.schedule.interval_ticks = 100;
    Core gyro{bench.state.settings.control};
    EXPECT_EQ(gyro.openings(1000), 10);
    gyro.obey(bench.send({.code = CommandCode::stop_switching}), bench.state.settings);
    EXPECT_EQ(gyro.openings(1000), 0);
    gyro.obey(bench.send({.code = CommandCode::force_switch}), bench.state.settings);
    EXPECT_EQ(gyro.openings(1000), 1);
    gyro.obey(bench.send({.code = CommandCode::start_switching}), bench.state.settings);
    EXPECT_EQ(gyro.openings(1000), 10);
    gyro.obey(bench.set({{interval_key, 200.0}}), bench.state.settings);
    EXPECT_EQ(gyro.openings(1000), 5);
}

}  // namespace zlg::wire::command_handler_test
