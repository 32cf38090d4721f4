#pragma once
// A line of bytes between this program and the emulator, over which each wakes the other.

namespace zlg::processor {

class Bell {
public:
    // errors  std::system_error.
    Bell();
    ~Bell();
    Bell(const Bell&) = delete;
    Bell& operator=(const Bell&) = delete;

    // The other program's end, until it has it.
    [[nodiscard]] int other_fd() const { return other_fd_; }
    void give_away();

    void ring() const;

    // Until the other side rings, it is gone, or `ms` are over: false then.
    [[nodiscard]] bool wait(int ms) const;

private:
    int fd_ = -1;
    int other_fd_ = -1;
};

}  // namespace zlg::processor
