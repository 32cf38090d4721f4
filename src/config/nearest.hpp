#pragma once
// The known word that a misspelt one was meant to be.

#include <string>
#include <string_view>

namespace zlg::config {

// The section whose name is nearest.
[[nodiscard]] std::string nearest_section(std::string_view section);

// The key that is nearest to [section] name: its name alone where it is of the same section, else `[other] name`.
[[nodiscard]] std::string nearest_key(std::string_view section, std::string_view name);

}  // namespace zlg::config
