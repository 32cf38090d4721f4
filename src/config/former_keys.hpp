#pragma once
// Keys, and values of keys, that logs of former versions hold and that are gone.

#include <optional>
#include <string>
#include <string_view>

namespace zlg::config {

// All since format_version 3 of logs.
struct FormerKey {
    std::string_view key;
    std::string_view value;  // that is gone; empty: the key is, with all its values
    std::string_view now;    // what to do in its place
};

// value  as TOML.
[[nodiscard]] std::optional<FormerKey> find_former(std::string_view key, std::string_view value);

// `section.key`, with the value where only that is gone.
[[nodiscard]] std::string shown(const FormerKey& former);

}  // namespace zlg::config
