#include <algorithm>
#include <cmath>
#include <cstddef>

#include <zlg/report/figure.hpp>

namespace zlg::report {
namespace {

// The points to keep of the stretch [from, to): its extremes and, so that a break stays a break, its first gap.
void keep_extremes(const Series& series, std::size_t from, std::size_t to, std::vector<std::size_t>& kept) {
    std::vector<std::size_t> chosen;
    std::size_t lowest = to;
    std::size_t highest = to;
    std::size_t gap = to;
    for (std::size_t i = from; i < to; ++i) {
        if (!std::isfinite(series.y[i])) {
            gap = std::min(gap, i);
            continue;
        }
        if (lowest == to || series.y[i] < series.y[lowest]) lowest = i;
        if (highest == to || series.y[i] > series.y[highest]) highest = i;
    }
    for (const std::size_t i : {lowest, highest, gap}) {
        if (i != to && std::find(chosen.begin(), chosen.end(), i) == chosen.end()) chosen.push_back(i);
    }
    std::sort(chosen.begin(), chosen.end());
    kept.insert(kept.end(), chosen.begin(), chosen.end());
}

Series picked(const Series& series, const std::vector<std::size_t>& indices) {
    Series out{series.name, {}, {}, {}, series.mark, series.dashed, series.colour};
    for (const std::size_t i : indices) {
        out.x.push_back(series.x[i]);
        out.y.push_back(series.y[i]);
        if (i < series.y_error.size()) out.y_error.push_back(series.y_error[i]);
        if (i < series.y_error_down.size()) out.y_error_down.push_back(series.y_error_down[i]);
    }
    return out;
}

}  // namespace

Series thin(const Series& series, int n_points) {
    const std::size_t n = std::min(series.x.size(), series.y.size());
    const auto room = static_cast<std::size_t>(std::max(n_points, 0));
    if (n <= room) return series;
    std::vector<std::size_t> kept;
    if (room > 0) kept.push_back(0);
    const bool broken = std::any_of(series.y.begin(), series.y.end(), [](double y) { return !std::isfinite(y); });
    const std::size_t per_stretch = broken ? 3 : 2;
    const std::size_t n_stretches = room < 2 ? 0 : (room - 2) / per_stretch;
    for (std::size_t k = 0; k < n_stretches; ++k) {
        const double share = static_cast<double>(n - 2) / static_cast<double>(n_stretches);
        const auto from = 1 + static_cast<std::size_t>(share * static_cast<double>(k));
        const auto to = 1 + static_cast<std::size_t>(share * static_cast<double>(k + 1));
        keep_extremes(series, from, k + 1 == n_stretches ? n - 1 : to, kept);
    }
    if (room > 1) kept.push_back(n - 1);
    return picked(series, kept);
}

}  // namespace zlg::report
