#pragma once
// The one door through which TOML comes in.

#include <string_view>

#include <toml++/toml.h>

#include <zlg/text/toml_depth.hpp>

namespace zlg::text {

// errors  toml::parse_error, also where it is nested too deep: before anything is built.
[[nodiscard]] inline toml::table parse_toml(std::string_view text) {
    static_assert(max_toml_levels == 64);
    if (const auto place = too_deep(text))
        throw toml::parse_error{"nested more than 64 deep; allowed is 64",
                                toml::source_position{place->line, place->column}};
    return toml::parse(text);
}

}  // namespace zlg::text
