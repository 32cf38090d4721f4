#include <zlg/processor/qemu.hpp>

#include <ctime>

#include <pthread.h>
#include <sys/wait.h>
#include <unistd.h>

#include <zlg/config/config.hpp>
#include <zlg/rig/closed_loop.hpp>
#include <zlg/rig/wiring.hpp>
#include <zlg/trials/compared.hpp>

#include "built_image.hpp"

namespace zlg::qemu_test {

using processor::QemuError;
using processor::QemuProcessor;
namespace fs = std::filesystem;

// A program that stands in for the emulator.
std::string script(const std::string& name, const std::string& text) {
    const std::string path = fs::temp_directory_path() / (name + std::to_string(getpid()));
    std::ofstream{path} << "#!/bin/sh\n" << text << "\n";
    fs::permissions(path, fs::perms::owner_all);
    return path;
}

std::string complaint(const processor::QemuOptions& options) {
    return test::refusal_by<QemuError>([&] { QemuProcessor{options}; });
}

int children() {
    int n = 0;
    std::ifstream list{"/proc/self/task/" + std::to_string(gettid()) + "/children"};
    for (int pid = 0; list >> pid;) ++n;
    return n;
}

pid_t child() {
    std::ifstream list{"/proc/self/task/" + std::to_string(gettid()) + "/children"};
    pid_t pid = 0;
    list >> pid;
    return pid;
}

// The time that a thread or a process has had a processor, whatever else wanted one.
double worked_s(clockid_t clock) {
    timespec time{};
    EXPECT_EQ(clock_gettime(clock, &time), 0);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

// Of the next waits_us.
double share_at_work(clockid_t clock, useconds_t waits_us) {
    const double worked_before_s = worked_s(clock);
    const double before_s = worked_s(CLOCK_MONOTONIC);
    usleep(waits_us);
    return (worked_s(clock) - worked_before_s) / (worked_s(CLOCK_MONOTONIC) - before_s);
}

TEST(QemuProcessor, says_which_program_is_not_there) {
    const std::string said = complaint({.image = "/proc/self/exe", .program = "no-such-emulator"});
    EXPECT_NE(said.find("no-such-emulator"), std::string::npos) << said;
    EXPECT_NE(said.find("qemu-system-arm"), std::string::npos) << "it must name the package: " << said;
}

TEST(QemuProcessor, says_which_image_is_not_there) {
    EXPECT_NE(complaint({.image = "/no/such.elf"}).find("/no/such.elf"), std::string::npos);
}

TEST(QemuProcessor, tells_how_an_emulator_that_ends_has_ended) {
    const std::string program = script("ends", "echo 'no such machine' >&2; exit 5");
    const std::string said = complaint({.image = "/proc/self/exe", .program = program});
    EXPECT_NE(said.find("exit status 5"), std::string::npos) << said;
    EXPECT_NE(said.find("no such machine"), std::string::npos) << said;
    EXPECT_EQ(children(), 0);
    fs::remove(program);
}

TEST(QemuProcessor, gives_up_an_emulator_that_hangs_and_ends_it) {
    const std::string program = script("hangs", "exec sleep 1000");
    const std::string said = complaint({.image = "/proc/self/exe", .program = program, .timeout_ms = 100});
    EXPECT_NE(said.find("100 ms"), std::string::npos) << said;
    EXPECT_EQ(children(), 0) << "it is still there";
    fs::remove(program);
}

// Of the image that provokes faults, with the number of a case of tests/firmware/test_faults.py; empty where it runs to
// its end.
std::string complaint_of_case(const std::string& image, int number) {
    const std::string program =
        script("provokes", "exec qemu-system-arm \"$@\" -device loader,addr=0x60800000,data=" + std::to_string(number) +
                               ",data-len=4");
    const config::Config c;
    const std::string said = test::refusal_by<QemuError>([&] {
        QemuProcessor processor{{.image = image, .program = program}};
        rig::ClosedLoop loop{c, rig::motion(c), &processor};
        for (int k = 0; k < 400; ++k) (void)loop.advance();
    });
    fs::remove(program);
    return said;
}

TEST(QemuProcessor, says_why_an_image_has_begun_anew) {
    const std::optional<std::string> image = test::built_image("zlg_gyro_faults.elf");
    if (!image) GTEST_SKIP() << "no image that provokes faults, or no emulator";
    EXPECT_EQ(complaint_of_case(*image, 0), "");
    EXPECT_NE(complaint_of_case(*image, 4).find("begun anew: divide_by_zero pc="), std::string::npos);
    const std::string said = complaint_of_case(*image, 19);
    EXPECT_NE(said.find("begun anew: stack_overflow pc="), std::string::npos) << said;
}

TEST(QemuProcessor, ends_with_a_program_that_is_killed) {
    const std::string program = script("outlives", "echo $$ >$0.new; mv $0.new $0.pid; exec sleep 1000");
    const pid_t owner = fork();
    if (owner == 0) {
        (void)complaint({.image = "/proc/self/exe", .program = program});
        _exit(0);
    }
    const auto waited_for = [](const auto& is_so) {
        for (int k = 0; k < 1000 && !is_so(); ++k) usleep(10'000);
        return is_so();
    };
    ASSERT_TRUE(waited_for([&] { return fs::exists(program + ".pid"); }));
    std::string pid;
    std::ifstream{program + ".pid"} >> pid;
    kill(owner, SIGKILL);
    waitpid(owner, nullptr, 0);
    // One that has ended and that nobody has asked for has no words.
    EXPECT_TRUE(waited_for([&] {
        std::string words;
        std::ifstream{"/proc/" + pid + "/cmdline"} >> words;
        return words.empty();
    }));
    fs::remove(program);
    fs::remove(program + ".pid");
}

TEST(QemuProcessor, gives_the_bits_of_this_program_switch_by_switch) {
    const auto image = test::built_image();
    if (!image) GTEST_SKIP() << "no image of the processor, or no emulator";
    QemuProcessor qemu{{.image = *image}};
    for (const auto relock : {core::RelockMethod::mean_square, core::RelockMethod::joint}) {
        trials::ComparedProcessor both{qemu};
        config::Config c;
        c.switching.interval_s = 1.0;
        c.compensation.relock = relock;
        rig::ClosedLoop loop{c, rig::motion(c), &both};
        int events = 0;
        for (int k = 0; k < 4000; ++k) events += loop.advance().control.has_event ? 1 : 0;
        for (auto due = both.drain(); due.has_row || due.has_gap;) due = both.drain();
        EXPECT_GE(events, 8);
        EXPECT_EQ(both.first_difference(), "");
        EXPECT_EQ(qemu.state(), both.state());
    }
}

TEST(QemuProcessor, refuses_settings_that_the_core_refuses) {
    const auto image = test::built_image();
    if (!image) GTEST_SKIP() << "no image of the processor, or no emulator";
    QemuProcessor qemu{{.image = *image}};
    rig::ProcessorSettings settings;
    settings.control.presumed_temperature = core::Celsius{1e9};
    EXPECT_THROW((void)qemu.start(settings), QemuError);
    EXPECT_NO_THROW((void)qemu.start({})) << "and takes good ones afterwards";
}

TEST(QemuProcessor, ends_with_its_object) {
    const auto image = test::built_image();
    if (!image) GTEST_SKIP() << "no image of the processor, or no emulator";
    {
        const QemuProcessor qemu{{.image = *image}};
        EXPECT_EQ(children(), 1);
    }
    EXPECT_EQ(children(), 0);
}

// Who looks for the other all the time takes the processor from it where others want it too.
TEST(QemuProcessor, whoever_waits_sleeps) {
    const auto image = test::built_image();
    if (!image) GTEST_SKIP() << "no image or no emulator";
    QemuProcessor processor{{.image = *image}};
    (void)processor.state();
    const pid_t emulator = child();
    ASSERT_GT(emulator, 0);
    clockid_t emulators_clock{};
    ASSERT_EQ(clock_getcpuclockid(emulator, &emulators_clock), 0);
    // On a busy machine it has something to finish at first.
    bool slept = false;
    for (int k = 0; k < 50 && !slept; ++k) slept = share_at_work(emulators_clock, 200'000) < 0.1;
    EXPECT_TRUE(slept);
    // The emulator stands still, and this program waits for its answer.
    ASSERT_EQ(kill(emulator, SIGSTOP), 0);
    std::thread host{[&] { (void)processor.state(); }};
    clockid_t hosts_clock{};
    ASSERT_EQ(pthread_getcpuclockid(host.native_handle(), &hosts_clock), 0);
    usleep(100'000);
    // It looks up once a millisecond.
    EXPECT_LT(share_at_work(hosts_clock, 200'000), 0.1);
    ASSERT_EQ(kill(emulator, SIGCONT), 0);
    host.join();
}

}  // namespace zlg::qemu_test
