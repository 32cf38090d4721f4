#pragma once
// Text from outside, as it may stand on a terminal and in a log of messages.

#include <cstddef>
#include <string>
#include <string_view>

namespace zlg::text {

enum class Lines { one, many };  // whether a line feed is an end of line or one more control character

// Control characters (those of Unicode's C1 and its line separators too) and bytes that are no UTF-8 become \uXXXX, as
// JSON and TOML write them.
[[nodiscard]] std::string escaped(std::string_view text, Lines lines = Lines::one);

// Text that is no UTF-8 is taken for Latin-1, in which every byte is a letter: so German Excel writes its degree sign.
[[nodiscard]] std::string as_utf8(std::string_view text);

// A message that is far too long loses its middle.
[[nodiscard]] std::string shortened(std::string text, std::size_t max_bytes = 2000);

// The first letters of a text, with a replacement for each control character, and dots where there is more of it.
[[nodiscard]] std::string excerpt(std::string_view text, std::size_t max_bytes, char replacement);

}  // namespace zlg::text
