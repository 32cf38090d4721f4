#pragma once
// The settings that stand above a log.

#include <string>
#include <utility>
#include <vector>

namespace zlg::logs {

// Pairs of key and value in their order: lines `# key = value` of a CSV log, /config of an HDF5 log.
using Settings = std::vector<std::pair<std::string, std::string>>;

}  // namespace zlg::logs
