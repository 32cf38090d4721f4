#pragma once
// Where the parts of a figure stand, in units of the viewBox.

#include <cstddef>
#include <string>
#include <vector>

#include <zlg/report/figure.hpp>

#include "scale.hpp"
#include "ticks.hpp"

namespace zlg::report {

// At 390 px of screen a unit is about half a pixel, at full width a little more than one: text of 16 units stays
// legible.
inline constexpr double figure_width = 680.0;
inline constexpr double label_font_size = 17.0;
inline constexpr double small_font_size = 16.0;
inline constexpr double swatch_width = 30.0;

// One line of text that has room for `font_size` or was made smaller to fit.
struct Line {
    double x = 0.0;
    double y = 0.0;
    double font_size = 0.0;
    std::string text;
};

struct LegendEntry {
    Line line;
    std::size_t series = 0;
};

// The name of a band, with the line that ties it to a band it could not stand over.
struct BandName {
    Line line;  // centred on line.x
    double band_centre = 0.0;
};

struct Layout {
    double left = 0.0;  // of the plot area
    double right = 0.0;
    double top = 0.0;
    double bottom = 0.0;
    double height = 0.0;  // of the whole figure
    Scale x;
    Scale y;
    Ticks x_ticks;
    Ticks y_ticks;
    Line x_label;
    Line y_label;
    std::vector<LegendEntry> legend;
    std::vector<BandName> band_names;
};

[[nodiscard]] Layout layout_of(const Figure& figure);

// Is there a point of the series that the figure can show?
[[nodiscard]] bool has_data(const Figure& figure, const Series& series);

// Does any of the band lie on the axis? Infinite ends reach over all of it.
[[nodiscard]] bool band_visible(const Band& band, const Scale& x);

// Names of bands side by side above the plot: each over its band, or moved aside as little as it takes.
// A name that has no room is left out, first of all one that repeats the name before it.
[[nodiscard]] std::vector<BandName> place_band_names(const std::vector<Band>& bands, const Scale& x, double left,
                                                     double right, double baseline);

}  // namespace zlg::report
