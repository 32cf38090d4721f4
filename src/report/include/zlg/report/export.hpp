#pragma once
// Figures as files of their own.

#include <string>

#include <zlg/report/diagram.hpp>
#include <zlg/report/figure.hpp>

namespace zlg::report {

// A complete SVG document.
[[nodiscard]] std::string svg_file(const Figure& figure);
[[nodiscard]] std::string svg_file(const Diagram& diagram);

// What the curves show, one point per row: series,x,y,y_error. Lines that begin with # name the figure, its axes and
// its bands. Reals in the shortest form that reads back; an error that a point does not have is an empty field.
[[nodiscard]] std::string csv(const Figure& figure);

// A field of a CSV row in quotes, with those within doubled.
[[nodiscard]] std::string csv_quoted(const std::string& text);

}  // namespace zlg::report
