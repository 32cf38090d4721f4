#include "output.hpp"

#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <vector>

#include <fmt/format.h>

#include <zlg/logs/error.hpp>
#include <zlg/text/escape.hpp>

#include "cost.hpp"
#include "failure.hpp"

namespace zlg::cli {
namespace {

double now_s() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

// The bar of progress appears after a second of work and is drawn ten times a second.
constexpr double quiet_for_s = 1.0;
constexpr double redraw_every_s = 0.1;
constexpr int bar_width = 40;
constexpr int line_width = bar_width + 50;  // with its brackets, the percentage and the time that is left

std::vector<std::string> notes;  // wait to be printed; for the thread of `main` alone
bool is_quiet = false;

// Only the first error is printed, by whichever thread it comes.
std::atomic<bool> is_error_said{false};

void write_line(const std::string& line) {
    // A standard error that takes nothing must not turn a complaint into a crash.
    (void)std::fputs(fmt::format("zlg: {}\n", text::escaped(text::shortened(line))).c_str(), stderr);
}

}  // namespace

void be_quiet() { is_quiet = true; }

void complain(const std::string& line) {
    if (!is_quiet || line.starts_with("warning: ")) explain_exit(line);
}

void explain_exit(const std::string& line) { notes.push_back(line); }

void print_notes() {
    for (const std::string& line : notes)
        if (!is_error_said) write_line(line);
    notes.clear();
}

void print_warnings() {
    std::erase_if(notes, [](const std::string& line) {
        const bool is_warning = line.starts_with("warning: ");
        if (is_warning && !is_error_said) write_line(line);
        return is_warning;
    });
}

void leave_errors_to_another() { is_error_said = true; }

void report_error(const std::string& line) {
    if (!is_error_said.exchange(true)) write_line(line);
}

void print(std::string_view raw) {
    const std::string text = text::escaped(raw, text::Lines::many);
    const bool written = std::fwrite(text.data(), 1, text.size(), stdout) == text.size() && std::fflush(stdout) == 0;
    if (!written) throw logs::IoError{fmt::format("standard output: {}", std::strerror(errno))};
    print_notes();
}

std::string printable(const std::string& text) { return text::escaped(text); }

std::string name_of_file(const std::string& path) { return std::filesystem::path{path}.filename().string(); }

Progress::Progress() : is_drawn_{!is_quiet && isatty(STDERR_FILENO) != 0}, started_s_{now_s()} {}

Progress::~Progress() {
    if (drawn_) (void)std::fputs(fmt::format("\r{:{}}\r", "", line_width).c_str(), stderr);
}

void Progress::show(double fraction) {
    const double t_s = now_s();
    if (t_s - started_s_ < quiet_for_s || t_s - last_s_ < redraw_every_s) return;
    last_s_ = t_s;
    print_warnings();
    if (!is_drawn_) return;
    drawn_ = true;
    const int done = static_cast<int>(fraction * bar_width);
    const double left_s = (t_s - started_s_) * (1.0 - fraction) / fraction;
    const std::string bar = fmt::format("[{:=<{}}{:{}}] {:3.0f} %{}", "", done, "", bar_width - done, 100.0 * fraction,
                                        fraction > 0.0 ? fmt::format(", {} left", time_text(left_s)) : "");
    (void)std::fputs(fmt::format("\r{:<{}}", bar, line_width).c_str(), stderr);
    (void)std::fflush(stderr);
}

}  // namespace zlg::cli
