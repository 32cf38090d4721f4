// Figure 7, the oscillation with the two places of a gap in it, and figures 8 to 10, the error of a replaced gap
// against its length, the frequency and the amplitude of the oscillation.

#include <algorithm>
#include <cmath>
#include <numbers>

#include <zlg/design/taylor.hpp>
#include <zlg/report/number_text.hpp>

#include "paper_bridge_curves.hpp"
#include "paper_words.hpp"

namespace zlg::paper {
namespace {

using design::Fit;
using report::Figure;
using report::Mark;
using report::Series;

// The gap about a moment, as a stretch of the axis in ms.
report::Band gap_at(double middle_s, double tick_s, const char* name) {
    const double half_s = 0.5 * paper_gap_ticks * tick_s;
    return {1e3 * (middle_s - half_s), 1e3 * (middle_s + half_s), name};
}

Figure oscillation_figure(double tick_s) {
    const double frequency_hz = paper_frequency_hz(tick_s);
    const double period_s = 1.0 / frequency_hz;
    constexpr double end_periods = 1.0;
    Series rate{.name = "rate A sin 2\u03C0\u03BDt"};
    for (const double periods : evenly(-0.25, end_periods, 251)) {
        report::add_point(rate, 1e3 * periods * period_s,
                          paper_amplitude_arcsec_s * std::sin(2.0 * std::numbers::pi * periods));
    }
    Series ticks{.name = "mean over each tick, P/T", .mark = Mark::points};
    const double w = 2.0 * std::numbers::pi * frequency_hz;
    // A tick lies in the middle of the zero crossing.
    for (double t0_s = -2.5 * tick_s; t0_s + tick_s <= end_periods * period_s + 1e-9; t0_s += tick_s) {
        const double angle = paper_amplitude_arcsec_s / w * (std::cos(w * t0_s) - std::cos(w * (t0_s + tick_s)));
        report::add_point(ticks, 1e3 * (t0_s + 0.5 * tick_s), angle / tick_s);
    }
    return worded({.id = "figure-7",
                   .series = {std::move(rate), std::move(ticks)},
                   .bands = {gap_at(0.0, tick_s, "1"), gap_at(0.75 * period_s, tick_s, "2")}},
                  {frequency_hz, 1e3 * tick_s});
}

constexpr double axis_end = 0.4;

// Replaced time times frequency, of three ticks.
Axis product_axis(const BridgePoints& points, Region region) {
    const double tick_s = points.tick_s;
    const double time_s = design::figure_time_s(paper_gap_ticks, tick_s);
    return {.case_at =
                [=](double product) {
                    return BridgeCase{.frequency_hz = product / time_s, .tick_s = tick_s, .region = region};
                },
            .shown = evenly(0.0, axis_end, 161),
            .results = points.by_frequency,
            .measured = each(points.by_frequency, [=](const SubstitutionPoint& p) { return p.frequency_hz * time_s; })};
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
                   {worded({.id = "figure-8a", .series = drawn(axis, corrected(Region::crossing))}),
                    worded({.id = "figure-8a-delivered", .series = drawn(axis, delivered())})});
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
                   {worded({.id = "figure-8b", .series = drawn(axis, corrected(Region::extremum))}),
                    worded({.id = "figure-8b-delivered", .series = drawn(axis, delivered())})});
}

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
        return {.case_at = [panel = *this](double amplitude_arcsec_s) { return panel.at(amplitude_arcsec_s); },
                .shown = {0.0, amplitudes.back()},
                .results = results(),
                .measured = amplitudes};
    }
    [[nodiscard]] std::string number() const {
        return fmt::format("{}{}", region == Region::crossing ? 9 : 10, "abc"[n - 1]);
    }
    [[nodiscard]] std::string words_of(const char* part) const {
        return fmt::format("figure {}{}", region == Region::crossing ? 9 : 10, part);
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

report::Table errors_table(const Panel& panel) {
    std::vector<std::vector<std::string>> rows;
    const BridgeCase c = panel.at(paper_amplitude_arcsec_s);
    for (int order = 0; order < 3; ++order) {
        const double exact = exact_error_arcsec(c, Fit::interpolation, order);
        const auto twin = [&](Fit fit) {
            const Measured m = measured(point_of(panel.of_the_paper(), fit, order), panel.region);
            return filled("{:.2f} \u00B1 {:.2f}", {m.arcsec, m.error});
        };
        rows.push_back({order_names[static_cast<std::size_t>(order)],
                        // A zero of theory is not to show the rounding of its sines.
                        report::fixed_number(std::abs(exact) < 1e-9 ? 0.0 : exact, 2), twin(Fit::interpolation),
                        report::fixed_number(series_error_as_printed_arcsec(c, order), 2),
                        report::fixed_number(exact_error_arcsec(c, Fit::extrapolation, order), 2),
                        twin(Fit::extrapolation)});
    }
    return table_of("panel.table", std::move(rows), {paper_frequency_hz(panel.points.tick_s), panel.ticks()});
}

Values numbers_of(const Panel& panel) {
    const BridgeCase c = panel.at(paper_amplitude_arcsec_s);
    const auto live = [&](int order) { return std::abs(exact_error_arcsec(c, Fit::extrapolation, order)); };
    Values numbers{panel.number(),
                   design::figure_time_s(panel.n, panel.points.tick_s) * paper_frequency_hz(panel.points.tick_s)};
    if (panel.region == Region::crossing) {
        const char* alike = panel.n == 1 ? ", where with one tick the first two happen to agree as well" : "";
        numbers.insert(numbers.end(), {live(0), live(1), live(2), alike});
    } else {
        const double flat = exact_error_arcsec(c, Fit::interpolation, 0);
        const double bent = exact_error_arcsec(c, Fit::interpolation, 2);
        numbers.insert(numbers.end(), {flat, bent, flat / bent, series_error_arcsec(c, 0), series_error_arcsec(c, 2)});
    }
    return numbers;
}

PaperItem panel_item(const Panel& panel) {
    const Axis axis = panel.axis();
    const std::string id = "figure-" + panel.number();
    const char* alike = panel.n == 1 ? " With one tick two of the three curves coincide." : "";
    PaperItem item =
        item_of("figure " + panel.number(), numbers_of(panel), {errors_table(panel)},
                {worded({.id = id, .series = drawn(axis, corrected(panel.region))},
                        {panel.n == 1 ? "One tick" : panel.ticks()}, panel.words_of(".corrected")),
                 worded({.id = id + "-delivered", .series = drawn(axis, delivered())}, {alike}, "panel.delivered")},
                panel.words_of(""));
    std::vector<std::string>& text = item.section.paragraphs;
    if (panel.n == 1) text.insert(text.begin(), words(panel.words_of(".first")).front());
    if (panel.n == 3 && panel.region == Region::extremum) text.push_back(words("figure 10.last").front());
    return item;
}

}  // namespace

PaperItem paper_figure_7(const PaperTask& task) {
    return item_of("figure 7", {}, {}, {oscillation_figure(task.config.gyro.tick_s)});
}

std::vector<PaperItem> paper_figure_8(const BridgePoints& points) { return {figure_8a(points), figure_8b(points)}; }

std::vector<PaperItem> paper_figures_9_and_10(const BridgePoints& points) {
    std::vector<PaperItem> items;
    for (const Region region : {Region::crossing, Region::extremum})
        for (int n = 1; n <= 3; ++n) items.push_back(panel_item({points, n, region}));
    return items;
}

}  // namespace zlg::paper
