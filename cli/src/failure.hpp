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

// One line to standard error, once the work is done: with an error there is no other line. What begins with `warning: ` comes
// after a second of work. For the thread of `main`.
void complain(const std::string& line);

// Prints the warnings of what waits.
void print_warnings();

// Prints what waits, unless there was an error.
void print_notes();

// The one line of an error, in place of what waits; from any thread. Only the first error has one.
void report_error(const std::string& line);

}  // namespace zlg::cli
