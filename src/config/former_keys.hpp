#pragma once
// Keys, and values of keys, that logs of former versions hold and that are gone.

#include <optional>
#include <string>
#include <string_view>

namespace zlg::config {

struct FormerKey {
    std::string_view section;
    std::string_view name;
    std::string_view value;  // that is gone; empty: the key is, with all its values
    int since = 0;           // the format_version of logs that first was without it
    std::string_view now;    // what to do in its place
};

// value  as TOML.
[[nodiscard]] const FormerKey* find_former(std::string_view section, std::string_view name, std::string_view value);

// `section.key`, with the value where only that is gone.
[[nodiscard]] std::string shown(const FormerKey& former);

}  // namespace zlg::config
