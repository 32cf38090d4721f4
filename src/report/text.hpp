#pragma once
// Text as SVG and HTML want it.

#include <string>
#include <string_view>

namespace zlg::report {

// Text safe between tags and inside quoted attributes: markup escaped; what XML forbids becomes U+FFFD.
[[nodiscard]] std::string escaped(std::string_view text);

// Numbers as in print: a minus for the hyphen before a digit, "2.6e+03" as 2.6 times a power of ten, "^2" raised, "+-"
// and "sqrt(" as their signs.
[[nodiscard]] std::string typeset(std::string_view text);

// A whole number, such as "-7" or "+07", in superscripts.
[[nodiscard]] std::string superscript(std::string_view number);

// Text that is nothing but a number, with signs, error and exponent, or stands for one that is not there.
[[nodiscard]] bool is_number(std::string_view text);

// Width of a line of text in units of the viewBox. The font is the reader's, so this is the width in a wide one.
[[nodiscard]] double text_width(std::string_view text, double font_size);

// A coordinate with at most two decimals, whatever the locale. `value` is finite.
[[nodiscard]] std::string coordinate(double value);

// An id made of letters, digits and dashes that starts with a letter; `otherwise` where nothing is left of it.
[[nodiscard]] std::string clean_id(std::string_view id, std::string_view otherwise);

}  // namespace zlg::report
