// Figures 8a and 8b: error of a replaced gap against its length and the frequency of the oscillation.

#include <algorithm>

#include <zlg/design/taylor.hpp>

#include "paper_bridge_curves.hpp"

namespace zlg::paper {
namespace {

using design::Fit;
using report::Figure;
using report::Series;

constexpr double axis_end = 0.4;
const char* const product_label = "replaced time \u00D7 frequency, \u0394t \u03BD";
const char* const error_label = "error (18) of the gap, arcsec";

BridgeCase case_at(const BridgePoints& points, double product, Region region) {
    return {.n = paper_gap_ticks,
            .frequency_hz = product / design::figure_time_s(paper_gap_ticks, points.tick_s),
            .tick_s = points.tick_s,
            .region = region};
}

BridgeCase case_of_length(const BridgePoints& points, double n) {
    return {.n = static_cast<int>(std::lround(n)),
            .frequency_hz = paper_frequency_hz(points.tick_s),
            .tick_s = points.tick_s,
            .region = Region::extremum};
}

std::vector<double> products_of(const BridgePoints& points) {
    std::vector<double> x;
    for (const SubstitutionResult& r : points.by_frequency)
        x.push_back(r.interpolation[0].frequency_hz * design::figure_time_s(paper_gap_ticks, points.tick_s));
    return x;
}

std::vector<double> lengths_of(const BridgePoints& points) {
    std::vector<double> x;
    for (const SubstitutionResult& r : points.by_length) x.push_back(r.interpolation[0].n);
    return x;
}

void add_sum_points(Figure& figure, const std::vector<double>& x, const std::vector<SubstitutionResult>& results,
                    Region region, int first_colour) {
    for (const int order : sum_orders)
        figure.series.push_back(twin_points({fmt::format("twin, {}", sum_order_name(order)), first_colour + order / 2},
                                            x, results, Fit::interpolation, order, region));
}

Figure delivered_figure(const BridgePoints& points, Region region, std::string id, std::string title) {
    const auto theory = [&](int order, double product) {
        return exact_error_arcsec(case_at(points, product, region), Fit::extrapolation, order);
    };
    return {.id = std::move(id),
            .title = std::move(title),
            .caption =
                "Sum of the three values that go out during the gap, extrapolated from the four ticks before it by "
                "(14), less the true angle. It is taken back by (16) and (17), so that nothing of it stays.",
            .x_label = product_label,
            .y_label = "extrapolated minus true, arcsec",
            .series = delivered(evenly(0.0, axis_end, 161), theory, products_of(points), points.by_frequency, region),
            .bands = {}};
}

// --- 8a --------------------------------------------------------------------------------------------------------------

Figure crossing_figure(const BridgePoints& points) {
    const std::vector<double> x = evenly(0.0, axis_end, 161);
    Figure figure{.id = "figure-8a",
                  .title = "Corrected gap, zero crossing of the rate in its middle",
                  .caption =
                      "Three ticks replaced, amplitude 12 000 \"/s, frequency varied; \u0394t is (n + 1)T/2. The "
                      "series is what (20) has above the straight line or parabola, at the nearest measured tick, held "
                      "over the gap. Error bars: one standard error.",
                  .x_label = product_label,
                  .y_label = error_label,
                  .series = {},
                  .bands = {}};
    figure.series.push_back(curve({"theory, any order: 0", 0}, x, [](double) { return 0.0; }));
    figure.series.push_back(curve({"series as printed, cubic term 1", 1, true}, x, [&](double at) {
        return series_error_as_printed_arcsec(case_at(points, at, Region::crossing), 2);
    }));
    figure.series.push_back(curve({"series, cubic term 4/3", 2, true}, x, [&](double at) {
        return series_error_arcsec(case_at(points, at, Region::crossing), 2);
    }));
    add_sum_points(figure, products_of(points), points.by_frequency, Region::crossing, 3);
    return figure;
}

// The same points on an axis of their own.
Figure crossing_points_figure(const BridgePoints& points) {
    Figure figure{.id = "figure-8a-twin",
                  .title = "The points of the twin close up",
                  .caption = fmt::format("Error bars: one standard error, {} switches a point.",
                                         points.by_frequency.front().interpolation[0].switches),
                  .x_label = product_label,
                  .y_label = error_label,
                  .series = {},
                  .bands = {}};
    figure.series.push_back(curve({"theory, any order: 0", 0}, {0.0, axis_end}, [](double) { return 0.0; }));
    add_sum_points(figure, products_of(points), points.by_frequency, Region::crossing, 3);
    return figure;
}

// How many standard errors the point farthest from theory is away.
double farthest(const std::vector<SubstitutionResult>& results) {
    double most = 0.0;
    for (const SubstitutionResult& r : results)
        for (const int order : sum_orders) {
            const SubstitutionPoint& p = point_of(r, Fit::interpolation, order);
            most = std::max(most, std::abs(p.crossing_arcsec - p.crossing_theory) / p.crossing_error);
        }
    return most;
}

PaperItem figure_8a(const BridgePoints& points) {
    const BridgeCase at = case_at(points, 0.2, Region::crossing);
    PaperItem item{
        .number = "figure 8a",
        .section = {.heading = "Figure 8a: error against the product of time and frequency, rate near zero"}};
    item.section.paragraphs = {
        "Name: print calls this the region of constant angular velocity. Where the rate passes zero it changes "
        "fastest; what is constant there is the angular acceleration. The region of nearly constant velocity is the "
        "other one.",
        fmt::format("Agrees: this is the harmless region. With two ticks on either side the fit is symmetric about the "
                    "gap, and all odd terms of the motion drop out of its sum: the error is 0 whatever the order, "
                    "frequency and length. The {} points of the twin lie within {} standard errors of it.",
                    2 * points.by_frequency.size(), report::fixed_number(farthest(points.by_frequency), 1)),
        fmt::format("Does not: the error that print reads off its series is there only for a single tick, not for the "
                    "sum that stays in the angle. At \u0394t \u03BD = 0.2 it would be {} arcsec as printed, {} arcsec "
                    "with the cubic coefficient 4/3 that (20) lacks. An error of that size exists only in what is "
                    "delivered in real time, below.",
                    report::fixed_number(series_error_as_printed_arcsec(at, 2), 1),
                    report::fixed_number(series_error_arcsec(at, 2), 1))};
    item.section.figures = {crossing_figure(points), crossing_points_figure(points),
                            delivered_figure(points, Region::crossing, "figure-8a-delivered",
                                             "Delivered in real time, zero crossing in the middle of the gap")};
    return item;
}

// --- 8b --------------------------------------------------------------------------------------------------------------

void add_theory(Figure& figure, const std::vector<double>& x, const std::function<BridgeCase(double)>& case_of) {
    for (const int order : sum_orders)
        figure.series.push_back(curve({sum_order_name(order), order / 2}, x, [&](double at) {
            return exact_error_arcsec(case_of(at), Fit::interpolation, order);
        }));
}

Figure extremum_figure(const BridgePoints& points) {
    const std::vector<double> x = evenly(0.0, axis_end, 161);
    const auto case_of = [&](double at) { return case_at(points, at, Region::extremum); };
    Figure figure{.id = "figure-8b",
                  .title = "Corrected gap, extremum of the rate in its middle",
                  .caption =
                      "As above, in the worst phase. Full lines: exact. Dashed: the terms of (20) above the straight "
                      "line, and above the parabola.",
                  .x_label = product_label,
                  .y_label = error_label,
                  .series = {},
                  .bands = {}};
    add_theory(figure, x, case_of);
    for (const int order : sum_orders)
        figure.series.push_back(curve({fmt::format("series, {}", order == 2 ? "quadratic" : "linear"), order / 2, true},
                                      x, [&](double at) { return series_error_arcsec(case_of(at), order); }));
    add_sum_points(figure, products_of(points), points.by_frequency, Region::extremum, 0);
    return figure;
}

void add_leading_laws(Figure& figure, const std::vector<double>& x, const std::function<BridgeCase(double)>& case_of) {
    for (const int order : sum_orders)
        figure.series.push_back(
            curve({fmt::format("leading law, {}", sum_order_name(order)), order / 2, true}, x, [&](double at) {
                const BridgeCase c = case_of(at);
                const design::Tone tone{.amplitude_arcsec_s = c.amplitude_arcsec_s, .frequency_hz = c.frequency_hz};
                return -design::leading_error_arcsec(tone, order, c.n, c.tick_s);
            }));
}

Figure laws_figure(const BridgePoints& points) {
    std::vector<double> x;
    for (int i = 0; i <= 120; ++i) x.push_back(0.02 * std::pow(axis_end / 0.02, i / 120.0));
    const auto case_of = [&](double at) { return case_at(points, at, Region::extremum); };
    Figure figure{.id = "figure-8b-laws",
                  .title = "The same on logarithmic axes, with the laws for low frequency",
                  .caption =
                      "The constant's error grows with the square of the frequency, the parabola's with its fourth "
                      "power. A point below three standard errors is left out.",
                  .x_label = product_label,
                  .y_label = error_label,
                  .series = {},
                  .bands = {},
                  .log_x = true,
                  .log_y = true};
    add_theory(figure, x, case_of);
    add_leading_laws(figure, x, case_of);
    add_sum_points(figure, products_of(points), points.by_frequency, Region::extremum, 0);
    for (Series& s : figure.series)
        for (std::size_t i = 0; i < s.y_error.size(); ++i)
            if (!(s.y[i] > 3.0 * s.y_error[i])) s.y[i] = std::nan("");
    return figure;
}

Figure length_figure(const BridgePoints& points) {
    const std::vector<double> x = lengths_of(points);
    const auto case_of = [&](double n) { return case_of_length(points, n); };
    Figure figure{.id = "figure-8b-length",
                  .title = "Against the number of replaced ticks, extremum in the middle of the gap",
                  .caption = fmt::format("Amplitude 12 000 \"/s at {} Hz, the upper end of the band, 0.1/T.",
                                         report::short_number(paper_frequency_hz(points.tick_s))),
                  .x_label = "replaced ticks n",
                  .y_label = error_label,
                  .series = {},
                  .bands = {}};
    add_theory(figure, x, case_of);
    add_leading_laws(figure, x, case_of);
    add_sum_points(figure, x, points.by_length, Region::extremum, 0);
    return figure;
}

std::string reach(const BridgePoints& points) {
    constexpr double limit_arcsec = 10.0;
    const auto highest_hz = [&](int order) {
        return design::highest_frequency_hz(
            {.order = order, .n = paper_gap_ticks, .points = {}, .tick_s = points.tick_s}, paper_amplitude_arcsec_s,
            limit_arcsec);
    };
    const double time_s = design::figure_time_s(paper_gap_ticks, points.tick_s);
    return fmt::format(
        "Reach: print lets the constant and the straight line go to \u0394t = 0.1/\u03BD, the parabola to 0.2/\u03BD. "
        "For 10 arcsec at three ticks the exact limits are {} Hz and {} Hz, \u0394t \u03BD = {} and {}.",
        report::fixed_number(highest_hz(0), 1), report::fixed_number(highest_hz(2), 1),
        report::fixed_number(highest_hz(0) * time_s, 3), report::fixed_number(highest_hz(2) * time_s, 3));
}

PaperItem figure_8b(const BridgePoints& points) {
    const auto exact = [&](double at, int order) {
        return report::fixed_number(
            exact_error_arcsec(case_at(points, at, Region::extremum), Fit::interpolation, order), 1);
    };
    const auto series = [&](double at, int order) {
        return report::fixed_number(series_error_arcsec(case_at(points, at, Region::extremum), order), 1);
    };
    PaperItem item{
        .number = "figure 8b",
        .section = {.heading = "Figure 8b: error against the product of time and frequency, rate at an extremum"}};
    item.section.paragraphs = {
        "Name: print calls this the region of variable angular velocity. The rate is at its extremum and nearly "
        "constant; its acceleration is what varies.",
        fmt::format(
            "Agrees: this is the dangerous region, and the parabola is the better the lower the frequency. At \u0394t "
            "\u03BD = 0.1 the constant leaves {} arcsec, the parabola {} arcsec; at 0.2 {} arcsec and {} arcsec. The "
            "series at the extremum is right as printed and gives the size: {} arcsec and {} arcsec at 0.2.",
            exact(0.1, 0), exact(0.1, 2), exact(0.2, 0), exact(0.2, 2), series(0.2, 0), series(0.2, 2)),
        fmt::format("Does not: a remainder of the rate at one time is not the error of a sum of angles over three "
                    "ticks, which moreover average the rate. At \u0394t \u03BD = 0.4, beyond the paper's band, the "
                    "parabola has lost all its advantage: {} arcsec against {} arcsec of the constant, while the "
                    "series says {} arcsec and {} arcsec.",
                    exact(0.4, 2), exact(0.4, 0), series(0.4, 2), series(0.4, 0)),
        reach(points),
        "Time axis: print gives one, two and three ticks as 0.1, 0.15 and 0.2 of a period of ten ticks. That is (n + "
        "1)T/2, the distance from the middle of the gap to the nearest measured tick, and not the length of the gap."};
    item.section.figures = {extremum_figure(points), laws_figure(points), length_figure(points),
                            delivered_figure(points, Region::extremum, "figure-8b-delivered",
                                             "Delivered in real time, extremum in the middle of the gap")};
    return item;
}

}  // namespace

std::vector<PaperItem> paper_figure_8(const BridgePoints& points) { return {figure_8a(points), figure_8b(points)}; }

}  // namespace zlg::paper
