#pragma once
// Exit codes, and the one line that explains each.

#include <stdexcept>
#include <string>

namespace zlg::cli {

enum Exit : int { good = 0, result_says_no = 1, wrong_usage = 2, bad_input_or_output = 3 };

// Wrong usage that the parser of the command line cannot see.
struct UsageError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

// Queue one line for standard error; queued lines are printed at the end, or dropped after an error. Lines that begin
// with `warning: ` may be printed earlier (print_warnings). Main thread only.
void complain(const std::string& line);

// The same of a line that explains the exit code: it is no note, --quiet or not.
void explain_exit(const std::string& line);

// From now on only warnings are queued.
void be_quiet();

// Print the queued warnings now.
void print_warnings();

// Print the rest of the queue, unless there was an error.
void print_notes();

// Of several processes only one speaks: from now on this one has no line for an error.
void leave_errors_to_another();

// With which the line of an error that ends the program ends; for the thread of `main` alone.
inline std::string after_error;

// The one line of an error, in place of what waits; from any thread. Only the first error has one.
void report_error(const std::string& line);

}  // namespace zlg::cli
