#pragma once
// What can go wrong with a file, as one line that names the place and what is allowed there.

#include <stdexcept>

namespace zlg::logs {

// The content is not what it must be: file, row, column, value, what is allowed.
struct FormatError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

// The file cannot be opened, read, written or renamed.
struct IoError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

}  // namespace zlg::logs
