#pragma once
// The settings that stand above a log.

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace zlg::logs {

// Pairs of key and value in their order: lines `# key = value` of a CSV log, /config of an HDF5 log.
using Settings = std::vector<std::pair<std::string, std::string>>;

// Length of a tick by the setting `tick_s`; empty where none says a number above 0.
[[nodiscard]] std::optional<double> said_tick_s(const Settings& settings);

}  // namespace zlg::logs
