#pragma once
// The data of a figure as SVG elements.

#include <cstddef>
#include <string>

#include "layout.hpp"

namespace zlg::report {

// Colours that readers with a colour vision deficiency tell apart (Okabe and Ito's set without its yellow).
[[nodiscard]] const char* colour_of(std::size_t series);

// The index whose colour and marker a series has.
[[nodiscard]] std::size_t look_of(const Series& series, std::size_t index);

// The stroke's dash attribute, empty for a full line. Past the last colour the lines go on dotted.
[[nodiscard]] std::string dash_of(const Series& series, std::size_t index);

// A marker centred on the place; its shape goes with the series.
[[nodiscard]] std::string marker(std::size_t series, double x, double y, double radius);

// All marks of one series, as one group.
[[nodiscard]] std::string marks_of(const Series& series, std::size_t index, const Layout& layout);

}  // namespace zlg::report
