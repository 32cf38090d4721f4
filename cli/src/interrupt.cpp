#include "interrupt.hpp"

#include <pthread.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <chrono>
#include <csignal>
#include <ctime>
#include <string>
#include <system_error>

#include <fmt/format.h>

#include <zlg/logs/error.hpp>
#include <zlg/logs/unfinished.hpp>

#include "failure.hpp"

namespace zlg::cli {
namespace {

constexpr const char* complaint = "interrupted by a signal";

std::atomic<bool> is_signalled{false};
std::atomic<bool> finishes{false};
std::atomic<bool> has_ended{false};  // `main`

sigset_t handled_signals() {
    sigset_t signals{};
    ::sigemptyset(&signals);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
        struct sigaction before {};
        // Who starts a program with nohup wants it to outlive the terminal.
        if (signal == SIGHUP && ::sigaction(signal, nullptr, &before) == 0 && before.sa_handler == SIG_IGN) continue;
        ::sigaddset(&signals, signal);
    }
    return signals;
}

double cpu_s() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

// A file that is being renamed is given a second; not longer, for the file system may hang.
[[noreturn]] void end_now() {
    auto remains = logs::abandon_outputs();
    for (int ms = 0; !remains && ms < 1000; ms += 5) {
        std::this_thread::sleep_for(std::chrono::milliseconds{5});
        remains = logs::abandon_outputs();
    }
    std::string line = complaint;
    if (remains && !remains->parts.empty())
        line += fmt::format("; recorded until then: {}", fmt::join(remains->parts, ", "));
    if (remains && !remains->complete.empty())
        line += fmt::format("; complete: {}", fmt::join(remains->complete, ", "));
    report_error(line);
    ::_exit(bad_input_or_output);
}

void watch(const sigset_t signals) {
    using Clock = std::chrono::steady_clock;
    int signal = 0;
    (void)::sigwait(&signals, &signal);
    is_signalled = true;
    const auto noted = Clock::now();
    const double cpu_before_s = cpu_s();
    constexpr timespec step{.tv_sec = 0, .tv_nsec = 10'000'000};
    while (!has_ended) {
        const bool again = ::sigtimedwait(&signals, nullptr, &step) > 0;
        const double wall_s = std::chrono::duration<double>{Clock::now() - noted}.count();
        // What a verb is given to end by itself: processor time, and as a limit for one that waits (or a busy machine)
        // the time of the clock. What runs out first ends it.
        const double most_wall_s = finishes ? 5.0 : 0.3, most_cpu_s = finishes ? 1.0 : 0.15;
        if (has_ended || !(again || wall_s > most_wall_s || cpu_s() - cpu_before_s > most_cpu_s)) continue;
        // One more is left to the system.
        ::pthread_sigmask(SIG_UNBLOCK, &signals, nullptr);
        end_now();
    }
}

}  // namespace

InterruptGuard::InterruptGuard() {
    const sigset_t signals = handled_signals();
    // In this thread and all that it will start.
    ::pthread_sigmask(SIG_BLOCK, &signals, nullptr);
    try {
        thread_ = std::thread{watch, signals};
    } catch (const std::system_error&) {
        // Without the thread the signals end the program in their own way.
        ::pthread_sigmask(SIG_UNBLOCK, &signals, nullptr);
    }
}

InterruptGuard::~InterruptGuard() {
    if (!thread_.joinable()) return;
    has_ended = true;
    // A watcher that has its signal looks at `has_ended` by itself, and may have left the next one to the system.
    if (!is_signalled) ::pthread_kill(thread_.native_handle(), SIGTERM);
    thread_.join();
}

void check_interrupt() {
    if (is_interrupted()) throw logs::IoError{complaint};
}

bool is_interrupted() { return is_signalled.load(std::memory_order_relaxed); }

void will_finish() { finishes = true; }

}  // namespace zlg::cli
