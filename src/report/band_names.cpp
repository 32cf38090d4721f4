#include <algorithm>
#include <cmath>

#include "layout.hpp"
#include "text.hpp"

namespace zlg::report {

bool band_visible(const Band& band, const Scale& x) {
    if (std::isnan(band.x0) || std::isnan(band.x1)) return false;
    const double a = on_axis(std::max(band.x0, band.x1), x.log);
    const double b = on_axis(std::min(band.x0, band.x1), x.log);
    return a >= x.limits.lo && !(b > x.limits.hi);
}

std::vector<BandName> place_band_names(const std::vector<Band>& bands, const Scale& x, double left, double right,
                                       double baseline) {
    constexpr double gap_between = 12.0;
    std::vector<BandName> names;
    for (const Band& band : bands)
        if (!band.name.empty() && band_visible(band, x))
            names.push_back({{0.0, baseline, small_font_size, band.name}, 0.5 * (x.at(band.x0) + x.at(band.x1))});
    std::ranges::stable_sort(names, {}, &BandName::band_centre);
    const auto width = [](const BandName& name) { return text_width(name.line.text, small_font_size) + gap_between; };
    std::vector<BandName> placed;
    double from = left - 0.5 * gap_between, used = -gap_between;
    for (BandName& name : names) {
        const bool repeats = !placed.empty() && placed.back().line.text == name.line.text;
        if (repeats && name.band_centre - placed.back().band_centre < width(name)) continue;
        used += width(name);
        if (used > right - left) break;
        name.line.x = std::max(name.band_centre, from + 0.5 * width(name));
        from = name.line.x + 0.5 * width(name);
        placed.push_back(std::move(name));
    }
    double until = right + 0.5 * gap_between;
    for (std::size_t i = placed.size(); i-- > 0;) {
        placed[i].line.x = std::min(placed[i].line.x, until - 0.5 * width(placed[i]));
        until = placed[i].line.x - 0.5 * width(placed[i]);
    }
    return placed;
}

}  // namespace zlg::report
