#pragma once
// A program that runs beside this one and never outlives it.

#include <string>
#include <vector>

#include <sys/types.h>

namespace zlg::processor {

class ChildProcess {
public:
    // words          name or path of the program, then its arguments.
    // inherited_fds  stay open in it, under the same numbers.
    //
    // errors  std::system_error where it cannot be started.
    ChildProcess(const std::vector<std::string>& words, const std::vector<int>& inherited_fds);
    ~ChildProcess();  // kills it and waits for its end
    ChildProcess(const ChildProcess&) = delete;
    ChildProcess& operator=(const ChildProcess&) = delete;

    [[nodiscard]] bool has_ended();

    // How it ended, and the first line of what it complained of.
    [[nodiscard]] std::string farewell();

private:
    pid_t pid_ = -1;
    int complaints_fd_ = -1;  // a file without a name
    bool ended_ = false;
    int status_ = 0;
};

}  // namespace zlg::processor
