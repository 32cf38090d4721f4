#pragma once
// The signals that end the program: SIGINT, SIGTERM and SIGHUP.
//
// The first one is noted. A verb that looks for it ends by an error, as of a failed write, and what it has recorded is
// whole. Whatever has not ended soon is ended here, from a thread of its own: what is not complete is removed, logs
// that hold rows stay and are named, and the exit code is that of the error. So no computation need know of signals. A
// second signal does that at once; another one is left to the system.

#include <thread>

namespace zlg::cli {

// In `main`, around all that can last or starts a thread.
class InterruptGuard {
public:
    InterruptGuard();
    ~InterruptGuard();
    InterruptGuard(const InterruptGuard&) = delete;
    InterruptGuard& operator=(const InterruptGuard&) = delete;

private:
    std::thread thread_;
};

// What a verb sees of it.
//
// errors  logs::IoError where a signal has come.
void check_interrupt();

// For a verb that has no other end than a signal.
[[nodiscard]] bool is_interrupted();

// After a signal this verb completes its file, which may last some seconds.
void will_finish();

}  // namespace zlg::cli
