#pragma once
// Text as SVG and HTML want it.

#include <string>
#include <string_view>

namespace zlg::report {

// Text safe between tags and inside quoted attributes: markup escaped; what XML forbids becomes U+FFFD.
[[nodiscard]] std::string escaped(std::string_view text);

// Width of a line of text in units of the viewBox. The font is the reader's, so this is the width in a wide one.
[[nodiscard]] double text_width(std::string_view text, double font_size);

// A coordinate with at most two decimals, whatever the locale. `value` is finite.
[[nodiscard]] std::string coordinate(double value);

// An id made of letters, digits and dashes that starts with a letter; `otherwise` where nothing is left of it.
[[nodiscard]] std::string clean_id(std::string_view id, std::string_view otherwise);

}  // namespace zlg::report
