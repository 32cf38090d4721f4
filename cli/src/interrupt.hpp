#pragma once
// A signal to end becomes an error, so that a verb that writes ends as with any other one.

namespace zlg::cli {

// While it lives, the first SIGINT or SIGTERM is only noted; a second one ends the program at once.
class Interruptible {
public:
    Interruptible();
    ~Interruptible();
    Interruptible(const Interruptible&) = delete;
    Interruptible& operator=(const Interruptible&) = delete;

    // errors  logs::IoError where a signal has come.
    void check() const;

    // For a verb that has no other end than a signal.
    [[nodiscard]] bool is_noted() const;
};

}  // namespace zlg::cli
