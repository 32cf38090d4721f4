// Figure 6: readings replaced through one switch of the twin.

#include <algorithm>

#include "paper_parts.hpp"
#include "paper_text.hpp"

namespace zlg::paper {
namespace {

using namespace report;

// The ticks that the figure shows, by the paper's count: the gap is 1..n.
constexpr int first_shown = -5;
constexpr int shown_after = 7;

struct Numbered {
    int j = 0;
    study::MagnifiedTick tick;
};

struct Gap {
    std::vector<Numbered> ticks;
    int n = 0;
};

Gap gap_of(const study::RunResult& run) {
    Gap gap;
    const auto first = std::find_if(run.magnified.begin(), run.magnified.end(),
                                    [](const study::MagnifiedTick& t) { return !t.measured; });
    if (first == run.magnified.end()) return gap;
    auto last = first;
    for (; last != run.magnified.end() && !last->measured; ++last) ++gap.n;
    for (const study::MagnifiedTick& t : run.magnified) {
        const auto j = static_cast<int>(t.tick - first->tick) + 1;
        if (j >= first_shown && j <= gap.n + shown_after) gap.ticks.push_back({j, t});
    }
    return gap;
}

bool in_gap(const Gap& gap, const Numbered& at) { return at.j >= 1 && at.j <= gap.n; }

Figure figure_of(const Gap& gap) {
    Series truth{.name = "true"};
    Series read{.name = "as read", .mark = Mark::points};
    Series live{.name = "delivered in real time, (14) and (17)", .mark = Mark::steps};
    Series final_value{.name = "final, (15)", .mark = Mark::points};
    for (const Numbered& at : gap.ticks) {
        add_point(truth, at.j, at.tick.true_arcsec);
        if (!in_gap(gap, at)) add_point(read, at.j, at.tick.read_arcsec);
        add_point(live, at.j - 0.5, at.tick.dtheta_arcsec);
        add_point(final_value, at.j, at.tick.final_arcsec);
    }
    if (!live.x.empty()) add_point(live, live.x.back() + 1.0, live.y.back());
    return {.id = "figure-6",
            .title = "Readings replaced through one switch",
            .caption =
                "Angle of each tick. Tick 1 is the first without light in both directions. What the counter reads "
                "there means nothing and is not drawn.",
            .x_label = "tick j",
            .y_label = "angle of the tick, arcsec",
            .series = {std::move(truth), std::move(read), std::move(final_value), std::move(live)},
            .bands = {{0.5, gap.n + 0.5, "gap"}}};
}

report::Table table_of(const Gap& gap) {
    report::Table table{.caption = "The ticks of the gap and the one that takes the difference, arcsec.",
                        .header = {"tick j", "extrapolated (14)", "final (15)", "true", "final minus true"}};
    const auto add = [&table](std::string name, double extrapolated, double final_arcsec, double true_arcsec) {
        table.rows.push_back({std::move(name), sentence("{:.2f}", extrapolated), sentence("{:.2f}", final_arcsec),
                              sentence("{:.2f}", true_arcsec), sentence("{:.2f}", final_arcsec - true_arcsec)});
    };
    study::MagnifiedTick sum;
    for (const Numbered& at : gap.ticks) {
        if (!in_gap(gap, at)) continue;
        add(fmt::format("{}", at.j), at.tick.dtheta_arcsec, at.tick.final_arcsec, at.tick.true_arcsec);
        sum.dtheta_arcsec += at.tick.dtheta_arcsec;
        sum.final_arcsec += at.tick.final_arcsec;
        sum.true_arcsec += at.tick.true_arcsec;
    }
    add("sum", sum.dtheta_arcsec, sum.final_arcsec, sum.true_arcsec);
    table.rows.push_back(
        {"\u0394P (16), sum of (14) less (15)", sentence("{:.2f}", sum.dtheta_arcsec - sum.final_arcsec), "", "", ""});
    return table;
}

// Sum of (14) less (15) over the gap, and the tick that holds the correction (17): the one outside the gap whose
// delivered angle differs most from the final one.
std::string correction(const Gap& gap) {
    double dp_arcsec = 0.0;
    const Numbered* carrier = nullptr;
    const auto delivered_less_final = [](const Numbered& at) { return at.tick.dtheta_arcsec - at.tick.final_arcsec; };
    for (const Numbered& at : gap.ticks) {
        if (in_gap(gap, at)) {
            dp_arcsec += delivered_less_final(at);
        } else if (!carrier || std::abs(delivered_less_final(at)) > std::abs(delivered_less_final(*carrier))) {
            carrier = &at;
        }
    }
    if (!carrier) return "";
    return fmt::format("\u0394P is {:+.2f} arcsec, and tick {} carries {:+.2f} arcsec beside its own angle.", dp_arcsec,
                       carrier->j, delivered_less_final(*carrier));
}

}  // namespace

PaperItem paper_figure_6(const study::RunResult& run) {
    PaperItem item{.number = "figure 6", .section = {.heading = "Figure 6: replacing the readings of a switch"}};
    const Gap gap = gap_of(run);
    if (gap.n == 0) {
        item.section.paragraphs = {"The run holds no whole switch that could be shown."};
        return item;
    }
    item.section.paragraphs = {
        "The first switch of the same run of the twin as figure 3, compensated as configured. In print the figure is a "
        "sketch without numbers.",
        fmt::format("Agrees: the four steps are as described. {} The final values depend on the ticks on either side "
                    "alone, so that the error (18) does not depend on what was extrapolated.",
                    correction(gap)),
        "Beyond the print: the first ticks after the gap are read falsely until the perimeter has settled, by much "
        "more than the interpolation errs. They are points of (15), so their correction has to come first."};
    item.section.tables = {table_of(gap)};
    item.section.figures = {figure_of(gap)};
    return item;
}

}  // namespace zlg::paper
