#include "interrupt.hpp"

#include <fcntl.h>
#include <poll.h>
#include <pthread.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
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

constexpr std::array<int, 3> handled_signals{SIGINT, SIGTERM, SIGHUP};
constexpr const char* complaint = "interrupted by a signal";

std::atomic<int> n_noted{0};
std::atomic<bool> finishes{false};

// Pipe to the thread: 's' from the handler, 'e' from the end of `main`.
std::array<int, 2> news{-1, -1};

static_assert(std::atomic<int>::is_always_lock_free, "a handler may use nothing else");

void note(int signal) {
    const int error = errno;
    if (++n_noted > 1) std::signal(signal, SIG_DFL);
    const char byte = 's';
    (void)!::write(news[1], &byte, 1);
    errno = error;
}

void install() {
    for (const int signal : handled_signals) {
        struct sigaction before {};
        // Who starts a program with nohup wants it to outlive the terminal.
        if (signal == SIGHUP && ::sigaction(signal, nullptr, &before) == 0 && before.sa_handler == SIG_IGN) continue;
        std::signal(signal, note);
    }
}

double cpu_s() {
    timespec t{};
    (void)::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

struct Patience {
    double wall_s;
    double cpu_s;
};

// What a verb is given to end by itself: processor time, and as a limit for one that waits (or a busy machine) the time
// of the clock. What runs out first ends it.
Patience patience() {
    return finishes ? Patience{.wall_s = 5.0, .cpu_s = 1.0} : Patience{.wall_s = 0.3, .cpu_s = 0.15};
}

enum class News { none, signal, end };

News wait_for_news(int ms) {
    pollfd ready{.fd = news[0], .events = POLLIN, .revents = 0};
    char byte = 0;
    if (::poll(&ready, 1, ms) <= 0 || ::read(news[0], &byte, 1) != 1) return News::none;
    return byte == 's' ? News::signal : News::end;
}

// A file that is being renamed is given a second; not longer, for the file system may hang.
[[noreturn]] void end_now() {
    auto remains = logs::abandon_outputs();
    for (int ms = 0; !remains && ms < 1000; ms += 5) {
        (void)::poll(nullptr, 0, 5);
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

void watch() {
    using Clock = std::chrono::steady_clock;
    News what = News::none;
    while (what == News::none) what = wait_for_news(-1);
    if (what == News::end) return;
    const auto noted = Clock::now();
    const double cpu_before_s = cpu_s();
    for (;;) {
        what = wait_for_news(10);
        if (what == News::end) return;
        const double wall_s = std::chrono::duration<double>{Clock::now() - noted}.count();
        const Patience most = patience();
        if (what == News::signal || wall_s > most.wall_s || cpu_s() - cpu_before_s > most.cpu_s) end_now();
    }
}

}  // namespace

InterruptGuard::InterruptGuard() {
    if (::pipe2(news.data(), O_CLOEXEC | O_NONBLOCK) != 0) return;
    // Blocked in this thread's child, so that the handler runs in another thread and ends its poll().
    sigset_t ours{};
    sigset_t before{};
    ::sigemptyset(&ours);
    for (const int signal : handled_signals) ::sigaddset(&ours, signal);
    ::pthread_sigmask(SIG_BLOCK, &ours, &before);
    try {
        thread_ = std::thread{watch};
    } catch (const std::system_error&) {
        // Without the thread the signals end the program in their own way.
    }
    ::pthread_sigmask(SIG_SETMASK, &before, nullptr);
    if (thread_.joinable()) install();
}

InterruptGuard::~InterruptGuard() {
    if (!thread_.joinable()) return;
    const char byte = 'e';
    (void)!::write(news[1], &byte, 1);
    thread_.join();
}

void Interruptible::check() const {
    if (is_noted()) throw logs::IoError{complaint};
}

bool Interruptible::is_noted() const { return n_noted.load(std::memory_order_relaxed) != 0; }

void Interruptible::will_finish() const { finishes = true; }

}  // namespace zlg::cli
