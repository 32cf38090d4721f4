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

// One line to standard error.
void complain(const std::string& line);

}  // namespace zlg::cli
