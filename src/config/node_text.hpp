#pragma once
// A value of a TOML document as text on one line, to be shown to whoever wrote it.

#include <string>

#include <toml++/toml.h>

namespace zlg::config {

// As TOML: reals in the shortest form that reads back, texts in the quotes that need no escapes. Cut after 60
// characters.
[[nodiscard]] std::string node_text(const toml::node& node);

}  // namespace zlg::config
