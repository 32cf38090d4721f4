#pragma once
// The lines `# key = value` above a table.

#include <string>
#include <utility>
#include <vector>
#include <zlg/logs/table_file.hpp>

namespace zlg::logs {

// errors  FormatError: a key or a value that does not stay on its line; IoError.
void write_settings(TableFile& file, const std::vector<std::pair<std::string, std::string>>& settings);

}  // namespace zlg::logs
