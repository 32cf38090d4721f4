// Figures 9a-c and 10a-c: error of a replaced gap against the amplitude of the oscillation.

#include <algorithm>
#include <cmath>

#include <zlg/design/taylor.hpp>
#include <zlg/report/number_text.hpp>

#include "paper_bridge_curves.hpp"
#include "paper_words.hpp"

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
        return {.region = region,
                .case_at = [panel = *this](double amplitude_arcsec_s) { return panel.at(amplitude_arcsec_s); },
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
    PaperItem item = item_of("figure " + panel.number(), numbers_of(panel), {errors_table(panel)},
                             {worded({.id = id, .series = corrected(axis)}, {panel.n == 1 ? "One tick" : panel.ticks()},
                                     panel.words_of(".corrected")),
                              worded({.id = id + "-delivered", .series = delivered(axis)}, {alike}, "panel.delivered")},
                             panel.words_of(""));
    std::vector<std::string>& text = item.section.paragraphs;
    if (panel.n == 1) text.insert(text.begin(), words(panel.words_of(".first")).front());
    if (panel.n == 3 && panel.region == Region::extremum) text.push_back(words("figure 10.last").front());
    return item;
}

}  // namespace

std::vector<PaperItem> paper_figures_9_and_10(const BridgePoints& points) {
    std::vector<PaperItem> items;
    for (const Region region : {Region::crossing, Region::extremum})
        for (int n = 1; n <= 3; ++n) items.push_back(panel_item({points, n, region}));
    return items;
}

}  // namespace zlg::paper
