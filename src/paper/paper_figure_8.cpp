// Figures 8a and 8b: error of a replaced gap against its length and the frequency of the oscillation.

#include <algorithm>
#include <cmath>

#include <zlg/design/taylor.hpp>

#include "paper_bridge_curves.hpp"
#include "paper_words.hpp"

namespace zlg::paper {
namespace {

using design::Fit;
using report::Figure;

constexpr double axis_end = 0.4;

// Replaced time times frequency, of three ticks.
Axis product_axis(const BridgePoints& points, Region region, std::vector<double> shown = evenly(0.0, axis_end, 161)) {
    const double tick_s = points.tick_s;
    const double time_s = design::figure_time_s(paper_gap_ticks, tick_s);
    return {.region = region,
            .case_at =
                [=](double product) {
                    return BridgeCase{.frequency_hz = product / time_s, .tick_s = tick_s, .region = region};
                },
            .shown = std::move(shown),
            .results = points.by_frequency,
            .measured = each(points.by_frequency, [=](const SubstitutionPoint& p) { return p.frequency_hz * time_s; })};
}

Axis length_axis(const BridgePoints& points) {
    const double tick_s = points.tick_s;
    std::vector<double> lengths = each(points.by_length, [](const SubstitutionPoint& p) { return p.n; });
    return {.region = Region::extremum,
            .case_at =
                [=](double n) {
                    return BridgeCase{.n = static_cast<int>(std::lround(n)),
                                      .frequency_hz = paper_frequency_hz(tick_s),
                                      .tick_s = tick_s};
                },
            .shown = lengths,
            .results = points.by_length,
            .measured = lengths};
}

// --- 8a --------------------------------------------------------------------------------------------------------------

// The same points on an axis of their own.
Figure crossing_points_figure(const Axis& axis) {
    Figure figure = worded({.id = "figure-8a-twin"}, {axis.results.front().interpolation[0].switches});
    figure.series.push_back(curve({theory_of_crossing, 0}, {0.0, axis_end}, [](double) { return 0.0; }));
    add_twin(axis, 3, figure.series);
    return figure;
}

// How many standard errors the point farthest from theory is away.
double farthest(const std::vector<SubstitutionResult>& results) {
    double most = 0.0;
    for (const SubstitutionResult& r : results)
        for (const int order : sum_orders) {
            const SubstitutionPoint& p = point_of(r, Fit::interpolation, order);
            most = std::max(most, std::abs(p.crossing.arcsec - p.crossing.theory) / p.crossing.error);
        }
    return most;
}

PaperItem figure_8a(const BridgePoints& points) {
    const Axis axis = product_axis(points, Region::crossing);
    const BridgeCase at = axis.case_at(0.2);
    return item_of("figure 8a",
                   {2 * points.by_frequency.size(), farthest(points.by_frequency),
                    series_error_as_printed_arcsec(at, 2), series_error_arcsec(at, 2)},
                   {},
                   {worded({.id = "figure-8a", .series = corrected(axis)}), crossing_points_figure(axis),
                    worded({.id = "figure-8a-delivered", .series = delivered(axis)})});
}

// --- 8b --------------------------------------------------------------------------------------------------------------

void add_theory_and_twin(const Axis& axis, Figure& figure) {
    add_exact(axis, figure.series);
    add_leading_laws(axis, figure.series);
    add_twin(axis, 0, figure.series);
}

Figure laws_figure(const BridgePoints& points) {
    const Axis axis = product_axis(points, Region::extremum, log_spaced(0.02, axis_end, 121));
    Figure figure = worded({.id = "figure-8b-laws", .log_x = true, .log_y = true});
    add_theory_and_twin(axis, figure);
    for (report::Series& s : figure.series)
        for (std::size_t i = 0; i < s.y_error.size(); ++i)
            if (!(s.y[i] > 3.0 * s.y_error[i])) s.y[i] = std::nan("");
    return figure;
}

Figure length_figure(const BridgePoints& points) {
    const Axis axis = length_axis(points);
    Figure figure = worded({.id = "figure-8b-length"}, {paper_frequency_hz(points.tick_s)});
    add_theory_and_twin(axis, figure);
    return figure;
}

PaperItem figure_8b(const BridgePoints& points) {
    const Axis axis = product_axis(points, Region::extremum);
    const auto exact = [&](double at, int order) {
        return exact_error_arcsec(axis.case_at(at), Fit::interpolation, order);
    };
    const auto series = [&](double at, int order) { return series_error_arcsec(axis.case_at(at), order); };
    const auto highest_hz = [&](int order) {
        return design::highest_frequency_hz({.order = order, .n = paper_gap_ticks, .tick_s = points.tick_s},
                                            paper_amplitude_arcsec_s, paper_switch_error_arcsec);
    };
    const double time_s = design::figure_time_s(paper_gap_ticks, points.tick_s);
    return item_of("figure 8b",
                   {exact(0.1, 0), exact(0.1, 2), exact(0.2, 0), exact(0.2, 2), series(0.2, 0), series(0.2, 2),
                    // does not:
                    exact(0.4, 2), exact(0.4, 0), series(0.4, 2), series(0.4, 0),
                    // reach:
                    highest_hz(0), highest_hz(2), highest_hz(0) * time_s, highest_hz(2) * time_s},
                   {},
                   {worded({.id = "figure-8b", .series = corrected(axis)}), laws_figure(points), length_figure(points),
                    worded({.id = "figure-8b-delivered", .series = delivered(axis)})});
}

}  // namespace

std::vector<PaperItem> paper_figure_8(const BridgePoints& points) { return {figure_8a(points), figure_8b(points)}; }

}  // namespace zlg::paper
