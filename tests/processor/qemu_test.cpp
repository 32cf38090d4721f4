#include <zlg/processor/qemu.hpp>

#include <atomic>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <thread>

#include <unistd.h>

#include <gtest/gtest.h>
#include <zlg/config/config.hpp>
#include <zlg/rig/closed_loop.hpp>
#include <zlg/rig/wiring.hpp>
#include <zlg/trials/compared.hpp>

#include "built_image.hpp"

namespace {

using namespace zlg;
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
    try {
        QemuProcessor{options};
    } catch (const QemuError& error) {
        return error.what();
    }
    return "";
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

// How often one of the threads in this folder of /proc is found at work, of 40 times within 200 ms.
int times_at_work(const std::string& tasks) {
    int n = 0;
    for (int k = 0; k < 40; ++k) {
        bool works = false;
        for (const auto& task : fs::directory_iterator{tasks}) {
            std::string line;
            std::getline(std::ifstream{task.path() / "stat"}, line);
            const std::size_t name_end = line.rfind(')');
            works = works || (name_end != std::string::npos && line.substr(name_end + 2, 1) == "R");
        }
        n += works ? 1 : 0;
        usleep(5000);
    }
    return n;
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

TEST(QemuProcessor, finds_no_image_where_there_is_none) {
    EXPECT_THROW((void)processor::image_beside("/proc"), QemuError);
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
    usleep(50'000);
    EXPECT_LE(times_at_work("/proc/" + std::to_string(emulator) + "/task"), 4);
    // The emulator stands still, and this program waits for its answer.
    ASSERT_EQ(kill(emulator, SIGSTOP), 0);
    std::atomic<pid_t> asks{0};
    std::thread host{[&] {
        asks = gettid();
        (void)processor.state();
    }};
    usleep(100'000);
    int n = 0;
    for (int k = 0; k < 40; ++k) {
        std::string line;
        std::getline(std::ifstream{"/proc/self/task/" + std::to_string(asks) + "/stat"}, line);
        n += line.substr(line.rfind(')') + 2, 1) == "R" ? 1 : 0;
        usleep(5000);
    }
    ASSERT_EQ(kill(emulator, SIGCONT), 0);
    host.join();
    // It looks up once a millisecond.
    EXPECT_LE(n, 12);
}

}  // namespace
