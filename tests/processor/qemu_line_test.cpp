// The image's serial line while the twin drives the image: a gyro that switches tells of it, and obeys.

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <zlg/config/config.hpp>
#include <zlg/firmware/stored.hpp>
#include <zlg/processor/qemu.hpp>
#include <zlg/rig/closed_loop.hpp>
#include <zlg/rig/wire_stream.hpp>
#include <zlg/rig/wiring.hpp>
#include <zlg/wire/command.hpp>
#include <zlg/wire/telemetry.hpp>

#include "built_image.hpp"
#include "temporary_folder.hpp"

namespace zlg::qemu_line_test {

using processor::QemuProcessor;
namespace fs = std::filesystem;

struct Heard {
    std::vector<wire::Telemetry> ticks;
    std::vector<wire::Reply> replies;
};

void take(Heard& heard, wire::Receiver& receiver, std::span<const std::uint8_t> bytes) {
    wire::Message message;
    while (receive(receiver, bytes, message)) {
        if (const auto tick = wire::telemetry_in(message)) heard.ticks.push_back(*tick);
        if (const auto reply = wire::reply_in(message)) heard.replies.push_back(*reply);
    }
}

// Two pipes, as the emulator wants them: what it sends waits in one of them.
class Line {
public:
    Line() {
        for (const char* end : {".in", ".out"}) EXPECT_EQ(mkfifo((path_ + end).c_str(), 0600), 0);
        tells_ = open((path_ + ".in").c_str(), O_RDWR);
        hears_ = open((path_ + ".out").c_str(), O_RDONLY | O_NONBLOCK);
    }
    ~Line() {
        close(tells_);
        close(hears_);
    }
    Line(const Line&) = delete;
    Line& operator=(const Line&) = delete;

    [[nodiscard]] std::string name() const { return "pipe:" + path_; }

    void send(const wire::Frame& frame) const {
        EXPECT_EQ(write(tells_, frame.bytes.data(), frame.size), static_cast<ssize_t>(frame.size));
    }

    const Heard& hear() {
        std::uint8_t bytes[4096];
        for (ssize_t n = 0; (n = read(hears_, bytes, sizeof bytes)) > 0;)
            take(heard_, receiver_, std::span{bytes}.first(static_cast<std::size_t>(n)));
        return heard_;
    }

    [[nodiscard]] std::uint32_t n_damaged() const { return receiver_.n_damaged; }

private:
    test::TemporaryFolder folder_;
    std::string path_ = folder_.file("line");
    int tells_ = -1;
    int hears_ = -1;
    wire::Receiver receiver_{};
    Heard heard_{};
};

config::Config gyro() {
    config::Config c;
    c.switching.interval_s = 1.0;
    return c;
}

std::vector<wire::Telemetry> told_by_this_program(int halves) {
    rig::ClosedLoop loop{gyro(), rig::motion(gyro())};
    rig::WireStream stream{gyro()};
    std::vector<std::uint8_t> bytes;
    for (int k = 0; k < halves; ++k) stream.take(loop, loop.advance(), bytes);
    Heard heard;
    wire::Receiver receiver;
    take(heard, receiver, bytes);
    return heard.ticks;
}

TEST(QemuLine, tells_bit_by_bit_what_this_program_tells) {
    const auto image = test::built_image();
    if (!image) GTEST_SKIP() << "no image of the processor, or no emulator";
    constexpr int halves = 4000;
    Line line;
    QemuProcessor qemu{{.image = *image, .line = line.name()}};
    rig::ClosedLoop loop{gyro(), rig::motion(gyro()), &qemu};
    for (int k = 0; k < halves; ++k) {
        (void)loop.advance();
        (void)line.hear();
    }
    // The last tick is on its way.
    for (int patience = 1000; patience > 0 && line.hear().ticks.size() < halves / 2; --patience) usleep(10'000);
    const std::vector<wire::Telemetry> expected = told_by_this_program(halves);
    EXPECT_EQ(expected.back().time.n_pulses, 10u);
    ASSERT_EQ(line.hear().ticks.size(), expected.size());
    for (std::size_t k = 0; k < expected.size(); ++k) ASSERT_EQ(line.hear().ticks[k], expected[k]) << "tick " << k;
    EXPECT_EQ(line.n_damaged(), 0u);
    EXPECT_NE(expected.front().mode, expected[200].mode) << "the gyro has switched";
}

constexpr int second = 400;  // halves

// A host that sends one command after the other while the gyro runs.
class Driven {
public:
    explicit Driven(const std::string& image) : qemu_{{.image = image, .line = line_.name()}} {}

    // The switches that end while this command is answered, and in `halves` after it.
    int switches_after(wire::CommandCode command, int halves) {
        int n = switches_during(command);
        for (int k = 0; k < halves; ++k) n += advance();
        return n;
    }

    int advance() {
        const rig::LoopHalf half = loop_.advance();
        (void)line_.hear();
        is_closed_ = half.control.actuator.loop_closed;
        return half.control.has_event && half.control.event.outcome == core::SwitchOutcome::switched ? 1 : 0;
    }

    // To a piece of settings, without a half meanwhile.
    wire::CommandResult answer(const wire::SettingsPiece& piece) {
        const std::size_t n_replies = line_.hear().replies.size();
        line_.send(frame_of(sender_, piece));
        for (int most = 20'000; most > 0 && line_.hear().replies.size() == n_replies; --most) usleep(1000);
        if (line_.hear().replies.size() == n_replies) throw std::runtime_error{"the gyro does not answer"};
        return line_.hear().replies.back().result;
    }

    [[nodiscard]] bool is_closed() const { return is_closed_; }

    int last_mode() {
        for (int k = 0; k < 8; ++k) (void)advance();
        return line_.hear().ticks.back().mode;
    }

private:
    // Until it is answered.
    int switches_during(wire::CommandCode command) {
        const std::size_t n_replies = line_.hear().replies.size();
        line_.send(frame_of(sender_, command));
        int n = 0;
        for (int most = 200'000; most > 0 && line_.hear().replies.size() == n_replies; --most) n += advance();
        if (line_.hear().replies.size() != n_replies + 1) throw std::runtime_error{"the gyro does not answer"};
        EXPECT_EQ(line_.hear().replies.back().result, wire::CommandResult::done);
        return n;
    }

    Line line_;
    QemuProcessor qemu_;
    rig::ClosedLoop loop_{gyro(), rig::motion(gyro()), &qemu_};
    wire::Sender sender_{.session = 5};
    bool is_closed_ = true;
};

// The host sets the pace: while it waits for the answer the gap goes on.
TEST(QemuLine, nothing_is_loaded_while_a_switch_is_under_way) {
    const auto image = test::built_image();
    if (!image) GTEST_SKIP() << "no image of the processor, or no emulator";
    Driven gyro{*image};
    const rig::ProcessorSettings made = rig::processor_settings(config::Config{});
    alignas(firmware::Settings) std::array<std::uint8_t, firmware::stored_bytes> bytes{};
    firmware::put_stored({made.control, made.compensation}, bytes);
    for (std::size_t at = 0; at < bytes.size(); at += wire::max_piece_bytes)
        EXPECT_EQ(
            gyro.answer({.offset = static_cast<std::uint16_t>(at),
                         .bytes = std::span{bytes}.subspan(at, std::min(wire::max_piece_bytes, bytes.size() - at))}),
            wire::CommandResult::done);
    while (gyro.is_closed()) (void)gyro.advance();
    EXPECT_EQ(gyro.answer({.offset = firmware::stored_bytes}), wire::CommandResult::switch_under_way);
    EXPECT_EQ(gyro.switches_after(wire::CommandCode::read_state, second), 1) << "the gyro goes on";
}

TEST(QemuLine, switching_stops_is_forced_and_starts_again) {
    const auto image = test::built_image();
    if (!image) GTEST_SKIP() << "no image of the processor, or no emulator";
    Driven gyro{*image};
    (void)gyro.switches_after(wire::CommandCode::stop_switching, second);
    const int mode = gyro.last_mode();
    EXPECT_EQ(gyro.switches_after(wire::CommandCode::read_state, 5 * second), 0) << "stopped";
    EXPECT_EQ(gyro.last_mode(), mode);
    EXPECT_EQ(gyro.switches_after(wire::CommandCode::force_switch, 5 * second), 1) << "forced, once";
    EXPECT_EQ(gyro.last_mode(), -mode);
    EXPECT_GE(gyro.switches_after(wire::CommandCode::start_switching, 5 * second), 4) << "one a second";
}

}  // namespace zlg::qemu_line_test
