#include "child_process.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <system_error>

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fmt/format.h>

namespace zlg::processor {
namespace {

[[noreturn]] void fail(int error, const std::string& what) {
    throw std::system_error{error, std::generic_category(), what};
}

// In the child, where only what a signal handler may do is allowed: never returns.
void become(pid_t parent, char* const* words, const std::vector<int>& inherited_fds, int complaints_fd,
            int failure_fd) {
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    // It may have been too late for that.
    if (getppid() != parent) _exit(127);
    const int nothing = open("/dev/null", O_RDWR);
    dup2(nothing, STDIN_FILENO);
    dup2(nothing, STDOUT_FILENO);
    dup2(complaints_fd, STDERR_FILENO);
    for (const int fd : inherited_fds) fcntl(fd, F_SETFD, 0);
    // What this program ignores, the other need not.
    for (const int signal : {SIGPIPE, SIGXFSZ, SIGINT, SIGTERM, SIGHUP}) std::signal(signal, SIG_DFL);
    // An interrupt from the keyboard is for this program: it ends the other one itself.
    setpgid(0, 0);
    execvp(words[0], words);
    const int error = errno;
    (void)!write(failure_fd, &error, sizeof error);
    _exit(127);
}

}  // namespace

ChildProcess::ChildProcess(const std::vector<std::string>& words, const std::vector<int>& inherited_fds) {
    std::vector<char*> raw;
    for (const std::string& word : words) raw.push_back(const_cast<char*>(word.c_str()));
    raw.push_back(nullptr);
    // The pipe closes when the other program begins; a word in it says why it did not.
    std::array<int, 2> failure{-1, -1};
    if (pipe2(failure.data(), O_CLOEXEC) != 0) fail(errno, "pipe");
    complaints_fd_ = memfd_create("complaints", MFD_CLOEXEC);
    const pid_t self = getpid();
    pid_ = fork();
    if (pid_ == 0) become(self, raw.data(), inherited_fds, complaints_fd_, failure[1]);
    const int fork_error = errno;
    close(failure[1]);
    int error = 0;
    const bool failed = pid_ > 0 && read(failure[0], &error, sizeof error) == sizeof error;
    close(failure[0]);
    if (pid_ > 0 && !failed) return;
    if (pid_ > 0) waitpid(pid_, &status_, 0);
    close(complaints_fd_);
    fail(failed ? error : fork_error, words[0]);
}

ChildProcess::~ChildProcess() {
    if (!ended_) {
        kill(pid_, SIGKILL);
        waitpid(pid_, &status_, 0);
    }
    close(complaints_fd_);
}

bool ChildProcess::has_ended() {
    if (!ended_) ended_ = waitpid(pid_, &status_, WNOHANG) == pid_;
    return ended_;
}

std::string ChildProcess::farewell() {
    std::string how = WIFSIGNALED(status_) ? fmt::format("was ended by signal {}", WTERMSIG(status_))
                                           : fmt::format("ended with exit status {}", WEXITSTATUS(status_));
    std::array<char, 4096> text{};
    const ssize_t size = pread(complaints_fd_, text.data(), text.size(), 0);
    std::string said{text.data(), static_cast<std::size_t>(size > 0 ? size : 0)};
    said.resize(std::min(said.size(), said.find('\n')));
    return said.empty() ? how : fmt::format("{}: {}", how, said);
}

}  // namespace zlg::processor
