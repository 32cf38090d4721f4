#pragma once
// TOML from outside, looked through before a parser builds a tree of it: a dotted key of 30 000 sections is 60 KB of
// text, and a tree that a recursion cannot walk.

#include <cstdint>
#include <optional>
#include <string_view>

namespace zlg::text {

// Our own keys are 2 deep, and their values 1.
inline constexpr int max_toml_levels = 64;

struct Place {
    std::uint32_t line = 1;  // both from 1
    std::uint32_t column = 1;
};

// Where the text first nests deeper than max_toml_levels: dots of a key or a header, arrays and inline tables, all
// together. Of text that is no TOML the answer holds as far as it could be read as one.
//
// cost  one pass, no memory.
[[nodiscard]] std::optional<Place> too_deep(std::string_view toml);

}  // namespace zlg::text
