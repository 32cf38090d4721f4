#pragma once
// A TOML value into its place in a Config.

#include <toml++/toml.h>

#include "key.hpp"

namespace zlg::config {

// errors  ConfigError `section.key = value: ...`: the wrong type, or out of range.
void assign(const Key& key, const toml::node& node, Config& config);

}  // namespace zlg::config
