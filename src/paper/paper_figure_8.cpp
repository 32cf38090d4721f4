// Figures 8a and 8b: error of a replaced gap against its length and the frequency of the oscillation.

#include <algorithm>
#include <cmath>

#include <zlg/design/taylor.hpp>

#include "paper_bridge_curves.hpp"
#include "paper_text.hpp"

namespace zlg::paper {
namespace {

using design::Fit;
using report::Figure;

constexpr double axis_end = 0.4;
const char* const error_label = "error (18) of the gap, arcsec";

// Replaced time times frequency, of three ticks.
Axis product_axis(const BridgePoints& points, Region region, std::vector<double> shown = evenly(0.0, axis_end, 161)) {
    const double tick_s = points.tick_s;
    const double time_s = design::figure_time_s(paper_gap_ticks, tick_s);
    return {.label = "replaced time \u00D7 frequency, \u0394t \u03BD",
            .region = region,
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
    return {.label = "replaced ticks n",
            .region = Region::extremum,
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

Figure delivered_figure(const Axis& axis, std::string id, std::string title) {
    return {.id = std::move(id),
            .title = std::move(title),
            .caption =
                "Sum of the three values that go out during the gap, extrapolated from the four ticks before it by "
                "(14), less the true angle. It is taken back by (16) and (17), so that nothing of it stays.",
            .x_label = axis.label,
            .y_label = "extrapolated minus true, arcsec",
            .series = delivered(axis)};
}

// --- 8a --------------------------------------------------------------------------------------------------------------

Figure crossing_figure(const Axis& axis) {
    return {.id = "figure-8a",
            .title = "Corrected gap, zero crossing of the rate in its middle",
            .caption =
                "Three ticks replaced, amplitude 12 000 deg/h, frequency varied; \u0394t is (n + 1)T/2. The series is "
                "what (20) has above the straight line or parabola, at the nearest measured tick, held over the gap. "
                "Error bars: one standard error.",
            .x_label = axis.label,
            .y_label = error_label,
            .series = corrected(axis)};
}

// The same points on an axis of their own.
Figure crossing_points_figure(const Axis& axis) {
    Figure figure{.id = "figure-8a-twin",
                  .title = "The points of the twin close up",
                  .caption = fmt::format("Error bars: one standard error, {} switches a point.",
                                         axis.results.front().interpolation[0].switches),
                  .x_label = axis.label,
                  .y_label = error_label};
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
    PaperItem item{
        .number = "figure 8a",
        .section = {.heading = "Figure 8a: error against the product of time and frequency, rate near zero"}};
    item.section.paragraphs = {
        "Name: print calls this the region of constant angular velocity. Where the rate passes zero it changes "
        "fastest; what is constant there is the angular acceleration. The region of nearly constant velocity is the "
        "other one.",
        sentence("Agrees: this is the harmless region. With two ticks on either side the fit is symmetric about the "
                 "gap, and all odd terms of the motion drop out of its sum: the error is 0 whatever the order, "
                 "frequency and length. The {} points of the twin lie within {:.1f} standard errors of it.",
                 2 * points.by_frequency.size(), farthest(points.by_frequency)),
        sentence("Does not: the error that print reads off its series is there only for a single tick, not for the "
                 "sum that stays in the angle. At \u0394t \u03BD = 0.2 it would be {:.1f} arcsec as printed, {:.1f} "
                 "arcsec with the cubic coefficient 4/3 that (20) lacks. An error of that size exists only in what is "
                 "delivered in real time, below.",
                 series_error_as_printed_arcsec(at, 2), series_error_arcsec(at, 2))};
    item.section.figures = {crossing_figure(axis), crossing_points_figure(axis),
                            delivered_figure(axis, "figure-8a-delivered",
                                             "Delivered in real time, zero crossing in the middle of the gap")};
    return item;
}

// --- 8b --------------------------------------------------------------------------------------------------------------

Figure extremum_figure(const Axis& axis) {
    return {.id = "figure-8b",
            .title = "Corrected gap, extremum of the rate in its middle",
            .caption =
                "As above, in the worst phase. Full lines: exact. Dashed: the terms of (20) above the straight line, "
                "and above the parabola.",
            .x_label = axis.label,
            .y_label = error_label,
            .series = corrected(axis)};
}

void add_theory_and_twin(const Axis& axis, Figure& figure) {
    add_exact(axis, figure.series);
    add_leading_laws(axis, figure.series);
    add_twin(axis, 0, figure.series);
}

Figure laws_figure(const BridgePoints& points) {
    const Axis axis = product_axis(points, Region::extremum, log_spaced(0.02, axis_end, 121));
    Figure figure{.id = "figure-8b-laws",
                  .title = "The same on logarithmic axes, with the laws for low frequency",
                  .caption =
                      "The constant's error grows with the square of the frequency, the parabola's with its fourth "
                      "power. A point below three standard errors is left out.",
                  .x_label = axis.label,
                  .y_label = error_label,
                  .log_x = true,
                  .log_y = true};
    add_theory_and_twin(axis, figure);
    for (report::Series& s : figure.series)
        for (std::size_t i = 0; i < s.y_error.size(); ++i)
            if (!(s.y[i] > 3.0 * s.y_error[i])) s.y[i] = std::nan("");
    return figure;
}

Figure length_figure(const BridgePoints& points) {
    const Axis axis = length_axis(points);
    Figure figure{.id = "figure-8b-length",
                  .title = "Against the number of replaced ticks, extremum in the middle of the gap",
                  .caption = sentence("Amplitude 12 000 deg/h at {} Hz, the upper end of the band, 0.1/T.",
                                      paper_frequency_hz(points.tick_s)),
                  .x_label = axis.label,
                  .y_label = error_label};
    add_theory_and_twin(axis, figure);
    return figure;
}

std::string reach(const BridgePoints& points) {
    const auto highest_hz = [&](int order) {
        return design::highest_frequency_hz({.order = order, .n = paper_gap_ticks, .tick_s = points.tick_s},
                                            paper_amplitude_arcsec_s, paper_switch_error_arcsec);
    };
    const double time_s = design::figure_time_s(paper_gap_ticks, points.tick_s);
    return sentence(
        "Reach: print lets the constant and the straight line go to \u0394t = 0.1/\u03BD, the parabola to 0.2/\u03BD. "
        "For 10 arcsec at three ticks the exact limits are {:.1f} Hz and {:.1f} Hz, \u0394t \u03BD = {:.3f} and "
        "{:.3f}.",
        highest_hz(0), highest_hz(2), highest_hz(0) * time_s, highest_hz(2) * time_s);
}

PaperItem figure_8b(const BridgePoints& points) {
    const Axis axis = product_axis(points, Region::extremum);
    const auto exact = [&](double at, int order) {
        return exact_error_arcsec(axis.case_at(at), Fit::interpolation, order);
    };
    const auto series = [&](double at, int order) { return series_error_arcsec(axis.case_at(at), order); };
    PaperItem item{
        .number = "figure 8b",
        .section = {.heading = "Figure 8b: error against the product of time and frequency, rate at an extremum"}};
    item.section.paragraphs = {
        "Name: print calls this the region of variable angular velocity. The rate is at its extremum and nearly "
        "constant; its acceleration is what varies.",
        sentence("Agrees: this is the dangerous region, and the parabola is the better the lower the frequency. At "
                 "\u0394t \u03BD = 0.1 the constant leaves {:.1f} arcsec, the parabola {:.1f} arcsec; at 0.2 {:.1f} "
                 "arcsec and {:.1f} arcsec. The series at the extremum is right as printed and gives the size: {:.1f} "
                 "arcsec and {:.1f} arcsec at 0.2.",
                 exact(0.1, 0), exact(0.1, 2), exact(0.2, 0), exact(0.2, 2), series(0.2, 0), series(0.2, 2)),
        sentence("Does not: a remainder of the rate at one time is not the error of a sum of angles over three ticks, "
                 "which moreover average the rate. At \u0394t \u03BD = 0.4, beyond the paper's band, the parabola has "
                 "lost all its advantage: {:.1f} arcsec against {:.1f} arcsec of the constant, while the series says "
                 "{:.1f} arcsec and {:.1f} arcsec.",
                 exact(0.4, 2), exact(0.4, 0), series(0.4, 2), series(0.4, 0)),
        reach(points),
        "Time axis: print gives one, two and three ticks as 0.1, 0.15 and 0.2 of a period of ten ticks. That is (n + "
        "1)T/2, the distance from the middle of the gap to the nearest measured tick, and not the length of the gap."};
    item.section.figures = {
        extremum_figure(axis), laws_figure(points), length_figure(points),
        delivered_figure(axis, "figure-8b-delivered", "Delivered in real time, extremum in the middle of the gap")};
    return item;
}

}  // namespace

std::vector<PaperItem> paper_figure_8(const BridgePoints& points) { return {figure_8a(points), figure_8b(points)}; }

}  // namespace zlg::paper
