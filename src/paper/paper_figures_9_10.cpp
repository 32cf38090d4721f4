// Figures 9a-c and 10a-c: error of a replaced gap against the amplitude of the oscillation.

#include <algorithm>
#include <cmath>

#include <zlg/design/taylor.hpp>

#include "paper_bridge_curves.hpp"
#include "paper_text.hpp"

namespace zlg::paper {
namespace {

using design::Fit;
using report::Figure;

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
    [[nodiscard]] Axis axis() const {
        std::vector<double> amplitudes =
            each(results(), [](const SubstitutionPoint& p) { return p.amplitude_arcsec_s; });
        return {.label = "amplitude of the rate, deg/h",
                .region = region,
                .case_at = [panel = *this](double amplitude_arcsec_s) { return panel.at(amplitude_arcsec_s); },
                .shown = {0.0, amplitudes.back()},
                .results = results(),
                .measured = amplitudes};
    }
    [[nodiscard]] std::string number() const {
        return fmt::format("{}{}", region == Region::crossing ? 9 : 10, "abc"[n - 1]);
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
    const bool crossing = panel.region == Region::crossing;
    const Axis axis = panel.axis();
    return {.id = "figure-" + panel.number(),
            .title = fmt::format("{} replaced, corrected, {} in the middle of the gap",
                                 panel.n == 1 ? "One tick" : panel.ticks(), crossing ? "zero crossing" : "extremum"),
            .caption = crossing ? "Full line: exact. Dashed: what (20) has above the polynomial. Error bars: one "
                                  "standard error."
                                : "Full lines: exact. Dashed: what (20) has above the polynomial. The error bars of "
                                  "one standard error are smaller than the points.",
            .x_label = axis.label,
            .y_label = "error (18) of the gap, arcsec",
            .series = corrected(axis)};
}

Figure delivered_figure(const Panel& panel) {
    const Axis axis = panel.axis();
    return {.id = fmt::format("figure-{}-delivered", panel.number()),
            .title = "The same, delivered in real time",
            .caption = fmt::format(
                "Extrapolated by (14) from the four ticks before the gap; taken back after it by (16) and (17).{}",
                panel.n == 1 ? " With one tick two of the three curves coincide." : ""),
            .x_label = axis.label,
            .y_label = "extrapolated minus true, arcsec",
            .series = delivered(axis)};
}

report::Table table_of(const Panel& panel) {
    report::Table table{
        .caption = sentence("Error of the gap in arcsec at 12 000 deg/h and {} Hz, {} replaced.",
                            paper_frequency_hz(panel.points.tick_s), panel.ticks()),
        .header = {"polynomial", "corrected, exact", "twin", "series as printed", "in real time, exact", "twin"}};
    const BridgeCase c = panel.at(paper_amplitude_arcsec_s);
    for (int order = 0; order < 3; ++order) {
        const double exact = exact_error_arcsec(c, Fit::interpolation, order);
        const auto twin = [&](Fit fit) {
            const Measured m = measured(point_of(panel.of_the_paper(), fit, order), panel.region);
            return sentence("{:.2f} \u00B1 {:.2f}", m.arcsec, m.error);
        };
        table.rows.push_back({order_names[static_cast<std::size_t>(order)],
                              // A zero of theory is not to show the rounding of its sines.
                              report::fixed_number(std::abs(exact) < 1e-9 ? 0.0 : exact, 2), twin(Fit::interpolation),
                              report::fixed_number(series_error_as_printed_arcsec(c, order), 2),
                              report::fixed_number(exact_error_arcsec(c, Fit::extrapolation, order), 2),
                              twin(Fit::extrapolation)});
    }
    return table;
}

std::vector<std::string> crossing_text(const Panel& panel) {
    const BridgeCase c = panel.at(paper_amplitude_arcsec_s);
    const auto live = [&](int order) { return std::abs(exact_error_arcsec(c, Fit::extrapolation, order)); };
    std::vector<std::string> text;
    if (panel.n == 1)
        text.emplace_back(
            "Name: the caption says constant angular velocity; at a zero crossing of the rate it is the acceleration "
            "that is constant. Print calls the stretch of variable acceleration the most dangerous, which it is, and "
            "shows this figure for it; the figure of that stretch is 10.");
    text.push_back(sentence(
        "Agrees: errors are proportional to the amplitude, and constant and linear cannot be distinguished. Does not: "
        "nothing of the error drawn here stays in the angle. All orders give exactly 0, and so does the twin. Three "
        "different curves exist only in real time: {:.0f} arcsec, {:.0f} arcsec and {:.0f} arcsec at 12 000 deg/h for "
        "constant, linear and quadratic{}.",
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
    text.push_back(sentence(
        "Agrees: constant and linear are one, not nearly but sample by sample: with symmetric points the straight "
        "line's slope drops out of the sum. They leave {:.1f} arcsec at 12 000 deg/h, the parabola {:.1f} arcsec, "
        "{:.1f} times less. Does not: the series understates both, {:.1f} arcsec and {:.1f} arcsec.",
        flat, bent, flat / bent, series_error_arcsec(c, 0), series_error_arcsec(c, 2)));
    if (panel.n == 3)
        text.emplace_back(
            "Print finds the constant good to 0.1/\u03BD and the parabola to 0.2/\u03BD, that is, to one and to three "
            "ticks at this frequency. The errors there are those of figures 10a and 10c, about equal in size, which "
            "supports the pair; neither is within 10 arcsec.");
    return text;
}

PaperItem item_of(const Panel& panel) {
    const bool crossing = panel.region == Region::crossing;
    const double tick_s = panel.points.tick_s;
    return {
        .number = "figure " + panel.number(),
        .section = {.heading = sentence("Figure {}: error against amplitude, \u0394t = {}/\u03BD, {}", panel.number(),
                                        design::figure_time_s(panel.n, tick_s) * paper_frequency_hz(tick_s),
                                        crossing ? "rate near zero" : "rate at an extremum"),
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
