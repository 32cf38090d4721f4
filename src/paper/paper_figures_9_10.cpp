// Figures 9a-c and 10a-c: error of a replaced gap against the amplitude of the oscillation.

#include <algorithm>

#include <zlg/design/taylor.hpp>

#include "paper_bridge_curves.hpp"

namespace zlg::paper {
namespace {

using design::Fit;
using report::Figure;

const char* const amplitude_label = "amplitude of the rate, arcsec/s";

// One panel: a number of ticks and a region.
struct Panel {
    const BridgePoints& points;
    int n = 1;
    Region region = Region::extremum;

    [[nodiscard]] const std::vector<SubstitutionResult>& results() const {
        return points.by_amplitude[static_cast<std::size_t>(n - 1)];
    }
    [[nodiscard]] BridgeCase at(double amplitude_arcsec_s) const {
        return {.n = n,
                .frequency_hz = paper_frequency_hz(points.tick_s),
                .amplitude_arcsec_s = amplitude_arcsec_s,
                .tick_s = points.tick_s,
                .region = region};
    }
    [[nodiscard]] std::vector<double> amplitudes() const {
        std::vector<double> x;
        for (const SubstitutionResult& r : results()) x.push_back(r.interpolation[0].amplitude_arcsec_s);
        return x;
    }
    [[nodiscard]] std::string number() const {
        return fmt::format("{}{}", region == Region::crossing ? 9 : 10, "abc"[n - 1]);
    }
    [[nodiscard]] std::string product() const {
        return report::short_number(design::figure_time_s(n, points.tick_s) * paper_frequency_hz(points.tick_s));
    }
    [[nodiscard]] std::string ticks() const { return n == 1 ? "one tick" : fmt::format("{} ticks", n); }
    // The experiment at the paper's own amplitude.
    [[nodiscard]] const SubstitutionResult& of_the_paper() const {
        const auto found = std::find_if(results().begin(), results().end(), [](const SubstitutionResult& r) {
            return r.interpolation[0].amplitude_arcsec_s == paper_amplitude_arcsec_s;
        });
        return found == results().end() ? results().back() : *found;
    }
};

Figure corrected_figure(const Panel& panel) {
    const std::vector<double> x = evenly(0.0, panel.amplitudes().back(), 2);
    const bool crossing = panel.region == Region::crossing;
    Figure figure{
        .id = "figure-" + panel.number(),
        .title = fmt::format("{} replaced, corrected, {} in the middle of the gap",
                             panel.n == 1 ? "One tick" : panel.ticks(), crossing ? "zero crossing" : "extremum"),
        .caption = crossing
                       ? "Full line: exact. Dashed: what (20) has above the polynomial. Error bars: one standard error."
                       : "Full lines: exact. Dashed: what (20) has above the polynomial. The error bars of one "
                         "standard error are smaller than the points.",
        .x_label = amplitude_label,
        .y_label = "error (18) of the gap, arcsec",
        .series = {},
        .bands = {}};
    if (crossing) {
        figure.series.push_back(curve({"theory, any order: 0", 0}, x, [](double) { return 0.0; }));
        figure.series.push_back(curve({"series as printed, cubic term 1", 1, true}, x,
                                      [&](double a) { return series_error_as_printed_arcsec(panel.at(a), 2); }));
        figure.series.push_back(curve({"series, cubic term 4/3", 2, true}, x,
                                      [&](double a) { return series_error_arcsec(panel.at(a), 2); }));
    } else {
        for (const int order : sum_orders)
            figure.series.push_back(curve({sum_order_name(order), order / 2}, x, [&](double a) {
                return exact_error_arcsec(panel.at(a), Fit::interpolation, order);
            }));
        for (const int order : sum_orders)
            figure.series.push_back(
                curve({fmt::format("series, {}", order == 2 ? "quadratic" : "linear"), order / 2, true}, x,
                      [&](double a) { return series_error_arcsec(panel.at(a), order); }));
    }
    for (const int order : sum_orders)
        figure.series.push_back(
            twin_points({fmt::format("twin, {}", sum_order_name(order)), (crossing ? 3 : 0) + order / 2},
                        panel.amplitudes(), panel.results(), Fit::interpolation, order, panel.region));
    return figure;
}

Figure delivered_figure(const Panel& panel) {
    const auto theory = [&](int order, double amplitude) {
        return exact_error_arcsec(panel.at(amplitude), Fit::extrapolation, order);
    };
    return {.id = fmt::format("figure-{}-delivered", panel.number()),
            .title = "The same, delivered in real time",
            .caption = fmt::format(
                "Extrapolated by (14) from the four ticks before the gap; taken back after it by (16) and (17).{}",
                panel.n == 1 ? " With one tick two of the three curves coincide." : ""),
            .x_label = amplitude_label,
            .y_label = "extrapolated minus true, arcsec",
            .series = delivered(evenly(0.0, panel.amplitudes().back(), 2), theory, panel.amplitudes(), panel.results(),
                                panel.region),
            .bands = {}};
}

report::Table table_of(const Panel& panel) {
    report::Table table{
        .caption = fmt::format("Error of the gap in arcsec at 12 000 \"/s and {} Hz, {} replaced.",
                               report::short_number(paper_frequency_hz(panel.points.tick_s)), panel.ticks()),
        .header = {"polynomial", "corrected, exact", "twin", "series as printed", "in real time, exact", "twin"},
        .rows = {}};
    const BridgeCase c = panel.at(paper_amplitude_arcsec_s);
    const SubstitutionResult& result = panel.of_the_paper();
    for (int order = 0; order < 3; ++order) {
        const double corrected = exact_error_arcsec(c, Fit::interpolation, order);
        table.rows.push_back({order_names[static_cast<std::size_t>(order)],
                              // A zero of theory is not to show the rounding of its sines.
                              report::fixed_number(std::abs(corrected) < 1e-9 ? 0.0 : corrected, 2),
                              with_error(measured(point_of(result, Fit::interpolation, order), panel.region), 2),
                              report::fixed_number(series_error_as_printed_arcsec(c, order), 2),
                              report::fixed_number(exact_error_arcsec(c, Fit::extrapolation, order), 2),
                              with_error(measured(point_of(result, Fit::extrapolation, order), panel.region), 2)});
    }
    return table;
}

std::vector<std::string> crossing_text(const Panel& panel) {
    const BridgeCase c = panel.at(paper_amplitude_arcsec_s);
    const auto live = [&](int order) {
        return report::fixed_number(std::abs(exact_error_arcsec(c, Fit::extrapolation, order)), 0);
    };
    std::vector<std::string> text;
    if (panel.n == 1)
        text.emplace_back(
            "Name: the caption says constant angular velocity; at a zero crossing of the rate it is the acceleration "
            "that is constant. Print calls the stretch of variable acceleration the most dangerous, which it is, and "
            "shows this figure for it; the figure of that stretch is 10.");
    text.push_back(fmt::format(
        "Agrees: errors are proportional to the amplitude, and constant and linear cannot be told apart. Does not: "
        "nothing of the error drawn here stays in the angle. All orders give exactly 0, and so does the twin. Three "
        "different curves exist only in real time: {} arcsec, {} arcsec and {} arcsec at 12 000 \"/s for constant, "
        "linear and quadratic{}.",
        live(0), live(1), live(2), panel.n == 1 ? ", where with one tick the first two happen to agree as well" : ""));
    return text;
}

std::vector<std::string> extremum_text(const Panel& panel) {
    const BridgeCase c = panel.at(paper_amplitude_arcsec_s);
    const double flat = exact_error_arcsec(c, Fit::interpolation, 0);
    const double bent = exact_error_arcsec(c, Fit::interpolation, 2);
    std::vector<std::string> text;
    if (panel.n == 1)
        text.emplace_back(
            "Name: the caption says variable angular velocity; at an extremum the rate is nearly constant and its "
            "acceleration varies. This is the worst phase, and the one that print calls the most dangerous.");
    text.push_back(fmt::format(
        "Agrees: constant and linear are one, not nearly but sample by sample: with symmetric points the "
        "straight line's slope drops out of the sum. They leave {} arcsec at 12 000 \"/s, the parabola {} "
        "arcsec, {} times less. Does not: the series understates both, {} arcsec and {} arcsec.",
        report::fixed_number(flat, 1), report::fixed_number(bent, 1), report::fixed_number(flat / bent, 1),
        report::fixed_number(series_error_arcsec(c, 0), 1), report::fixed_number(series_error_arcsec(c, 2), 1)));
    if (panel.n == 3)
        text.emplace_back(
            "Print finds the constant good to 0.1/\u03BD and the parabola to 0.2/\u03BD, that is, to one and to three "
            "ticks at this frequency. The errors there are those of figures 10a and 10c, about equal in size, which "
            "supports the pair; neither is within 10 arcsec.");
    return text;
}

PaperItem item_of(const Panel& panel) {
    const bool crossing = panel.region == Region::crossing;
    return {.number = "figure " + panel.number(),
            .section = {
                .heading = fmt::format("Figure {}: error against amplitude, \u0394t = {}/\u03BD, {}", panel.number(),
                                       panel.product(), crossing ? "rate near zero" : "rate at an extremum"),
                .paragraphs = crossing ? crossing_text(panel) : extremum_text(panel),
                .tables = {table_of(panel)},
                .figures = {corrected_figure(panel), delivered_figure(panel)}}};
}

}  // namespace

std::vector<PaperItem> paper_figures_9_and_10(const BridgePoints& points) {
    std::vector<PaperItem> items;
    for (const Region region : {Region::crossing, Region::extremum})
        for (int n = 1; n <= 3; ++n) items.push_back(item_of({points, n, region}));
    return items;
}

}  // namespace zlg::paper
