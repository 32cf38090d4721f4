#include "output.hpp"

#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <string>

#include <fmt/format.h>

#include <zlg/logs/error.hpp>

#include "failure.hpp"

namespace zlg::cli {
namespace {

double now_s() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

constexpr double first_after_s = 1.0;
constexpr double every_s = 0.1;
constexpr int width = 40;

}  // namespace

void complain(const std::string& line) {
    // A standard error that takes nothing must not turn a complaint into a crash.
    (void)std::fputs(fmt::format("zlg: {}\n", line).c_str(), stderr);
}

void print(std::string_view text) {
    const bool written = std::fwrite(text.data(), 1, text.size(), stdout) == text.size() && std::fflush(stdout) == 0;
    if (!written) throw logs::IoError{fmt::format("standard output: {}", std::strerror(errno))};
}

Progress::Progress() : terminal_{isatty(STDERR_FILENO) != 0}, started_s_{now_s()} {}

Progress::~Progress() {
    if (drawn_) (void)std::fputs(fmt::format("\r{:{}}\r", "", width + 10).c_str(), stderr);
}

void Progress::show(double fraction) {
    if (!terminal_) return;
    const double t_s = now_s();
    if (t_s - started_s_ < first_after_s || t_s - last_s_ < every_s) return;
    last_s_ = t_s;
    drawn_ = true;
    const int done = static_cast<int>(fraction * width);
    (void)std::fputs(fmt::format("\r[{:=<{}}{:{}}] {:3.0f} %", "", done, "", width - done, 100.0 * fraction).c_str(),
                     stderr);
    (void)std::fflush(stderr);
}

}  // namespace zlg::cli
