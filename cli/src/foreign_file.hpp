#pragma once
// A file that is no log: what it looks like, and what can be done with it.

#include <string>

namespace zlg::cli {

// One clause for a message.
[[nodiscard]] std::string foreign_file(const std::string& path);

}  // namespace zlg::cli
