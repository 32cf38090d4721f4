#include <algorithm>
#include <cmath>

#include "layout.hpp"
#include "text.hpp"

namespace zlg::report {
namespace {

constexpr double gap_between = 12.0;

struct Candidate {
    double centre = 0.0;
    double half_width = 0.0;
    std::string name;
};

// Bands that the axis shows, in the order of their centres.
std::vector<Candidate> candidates_of(const std::vector<Band>& bands, const Scale& x) {
    std::vector<Candidate> out;
    for (const Band& band : bands) {
        if (band.name.empty() || !band_visible(band, x)) continue;
        const double centre = 0.5 * (x.at(band.x0) + x.at(band.x1));
        out.push_back({centre, 0.5 * text_width(band.name, small_font_size), band.name});
    }
    std::stable_sort(out.begin(), out.end(),
                     [](const Candidate& a, const Candidate& b) { return a.centre < b.centre; });
    return out;
}

// Drop a name that repeats the one kept before it and would touch it.
void drop_crowded_repeats(std::vector<Candidate>& names) {
    std::vector<Candidate> kept;
    for (Candidate& next : names) {
        const bool repeats = !kept.empty() && kept.back().name == next.name &&
                             next.centre - kept.back().centre < next.half_width + kept.back().half_width + gap_between;
        if (!repeats) kept.push_back(std::move(next));
    }
    names = std::move(kept);
}

// Drop from the end what the whole row cannot hold.
void drop_beyond(std::vector<Candidate>& names, double room) {
    double used = -gap_between;
    const auto first_out = std::find_if(names.begin(), names.end(), [&](const Candidate& c) {
        used += 2.0 * c.half_width + gap_between;
        return used > room;
    });
    names.erase(first_out, names.end());
}

}  // namespace

bool band_visible(const Band& band, const Scale& x) {
    if (std::isnan(band.x0) || std::isnan(band.x1)) return false;
    const double a = on_axis(std::max(band.x0, band.x1), x.log);
    const double b = on_axis(std::min(band.x0, band.x1), x.log);
    return a >= x.limits.lo && !(b > x.limits.hi);
}

std::vector<BandName> place_band_names(const std::vector<Band>& bands, const Scale& x, double left, double right,
                                       double baseline) {
    std::vector<Candidate> names = candidates_of(bands, x);
    drop_crowded_repeats(names);
    drop_beyond(names, right - left);
    std::vector<BandName> out;
    double from = left;
    for (const Candidate& c : names) {
        const double at = std::max(c.centre, from + c.half_width);
        out.push_back({{at, baseline, small_font_size, c.name}, c.centre});
        from = at + c.half_width + gap_between;
    }
    double until = right;
    for (std::size_t i = names.size(); i-- > 0;) {
        out[i].line.x = std::min(out[i].line.x, until - names[i].half_width);
        until = out[i].line.x - names[i].half_width - gap_between;
    }
    return out;
}

}  // namespace zlg::report
