// Figure 6: readings replaced through one switch of the twin.

#include <algorithm>

#include <zlg/report/number_text.hpp>

#include "paper_parts.hpp"
#include "paper_words.hpp"

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
    return worded({.id = "figure-6",
                   .series = {std::move(truth), std::move(read), std::move(final_value), std::move(live)},
                   .bands = {{0.5, gap.n + 0.5, "gap"}}});
}

report::Table ticks_table(const Gap& gap) {
    std::vector<std::vector<std::string>> rows;
    const auto add = [&rows](std::string name, const study::MagnifiedTick& tick) {
        rows.push_back({std::move(name), fixed_number(tick.dtheta_arcsec, 2), fixed_number(tick.final_arcsec, 2),
                        fixed_number(tick.true_arcsec, 2), fixed_number(tick.final_arcsec - tick.true_arcsec, 2)});
    };
    study::MagnifiedTick sum;
    for (const Numbered& at : gap.ticks) {
        if (!in_gap(gap, at)) continue;
        add(fmt::format("{}", at.j), at.tick);
        sum.dtheta_arcsec += at.tick.dtheta_arcsec;
        sum.final_arcsec += at.tick.final_arcsec;
        sum.true_arcsec += at.tick.true_arcsec;
    }
    add("sum", sum);
    rows.push_back(
        {"\u0394P (16), sum of (14) less (15)", fixed_number(sum.dtheta_arcsec - sum.final_arcsec, 2), "", "", ""});
    return table_of("figure 6.table", std::move(rows));
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
    const Gap gap = gap_of(run);
    if (gap.n == 0) return item_of("figure 6", {}, {}, {}, "figure 6.none");
    return item_of("figure 6", {correction(gap)}, {ticks_table(gap)}, {figure_of(gap)});
}

}  // namespace zlg::paper
