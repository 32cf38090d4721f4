#pragma once
// The substitution of gaps written from its rules, with the whole log in view: no state, no delay, no streaming.
//
// A gap is the ticks first..last. Causal values come from the ticks before it, final ones from both sides, by least
// squares in long double; what a gap made uncertain is paid back in one tick.

#include <zlg/core/compensation/gap_bridge.hpp>

#include "test.hpp"

namespace gap_bridge_reference {

struct Tick {
    bool measured = true;
    long double value = 0.0L;  // as it enters
    long double amend = 0.0L;  // what is added to it one tick later
    long double dtheta = 0.0L;
    long double final_value = 0.0L;
    bool correction = false;
    bool extrapolated = false;
    bool interpolated = false;
    bool lower_order = false;  // of the final value
    bool unrepaired = false;
    bool settled = true;  // at its end nothing is outstanding
};

struct Gap {
    std::int64_t first = 0;
    std::int64_t last = 0;
    long double dp = 0.0L;
    long double lump = 0.0L;
};

class Reference {
public:
    Reference(const zlg::core::GapBridgeConfig& config, std::vector<Tick> log)
        : ticks{std::move(log)}, config_{config}, order_{zlg::core::order_of(config.method)} {
        for (Tick& t : ticks) {
            t.dtheta = t.value;
            t.final_value = t.value + t.amend;
        }
        find_gaps();
        for (Gap& gap : gaps) bridge(gap);
        for (Gap& gap : gaps) pay_back(gap);
    }

    std::vector<Tick> ticks;
    std::vector<Gap> gaps;

private:
    zlg::core::GapBridgeConfig config_;
    int order_;

    static constexpr std::int64_t longest = 16;

    std::int64_t size() const { return static_cast<std::int64_t>(ticks.size()); }
    Tick& at(std::int64_t k) { return ticks[static_cast<std::size_t>(k)]; }
    static std::int64_t length(const Gap& gap) { return gap.last - gap.first + 1; }

    void find_gaps() {
        for (std::int64_t k = 0; k < size(); ++k) {
            if (at(k).measured) continue;
            if (gaps.empty() || gaps.back().last != k - 1) gaps.push_back({.first = k});
            gaps.back().last = k;
        }
    }

    std::vector<std::int64_t> measured(std::int64_t from, std::int64_t to) {
        std::vector<std::int64_t> found;
        for (std::int64_t k = std::max<std::int64_t>(from, 0); k <= std::min(to, size() - 1); ++k)
            if (at(k).measured) found.push_back(k);
        return found;
    }

    // Least squares through the final values of some ticks, read at tick k: elimination on the normal equations.
    long double fit(const std::vector<std::int64_t>& points, int order, std::int64_t k) {
        const int n = std::min(order, static_cast<int>(points.size()) - 1) + 1;
        long double table[3][4] = {};
        for (const std::int64_t p : points) {
            const auto x = static_cast<long double>(p - points.front());
            for (int r = 0; r < n; ++r) {
                for (int c = 0; c < n; ++c) table[r][c] += std::pow(x, static_cast<long double>(r + c));
                table[r][n] += std::pow(x, static_cast<long double>(r)) * at(p).final_value;
            }
        }
        for (int pivot = 0; pivot < n; ++pivot)
            for (int r = 0; r < n; ++r) {
                if (r == pivot) continue;
                const long double factor = table[r][pivot] / table[pivot][pivot];
                for (int c = pivot; c <= n; ++c) table[r][c] -= factor * table[pivot][c];
            }
        long double value = 0.0L;
        for (int r = n - 1; r >= 0; --r)
            value = value * static_cast<long double>(k - points.front()) + table[r][n] / table[r][r];
        return value;
    }

    void bridge(Gap& gap) {
        if (config_.method == zlg::core::BridgeMethod::none) return;
        const auto history = measured(gap.first - config_.extrapolation_points, gap.first - 1);
        for (std::int64_t k = gap.first; k <= gap.last; ++k) {
            at(k).extrapolated = true;
            const int order = k - gap.first < longest ? order_ : 0;
            at(k).dtheta = history.empty() ? 0.0L : fit(history, order, k);
        }
        finish(gap, history);
        for (std::int64_t k = gap.first; k <= gap.last; ++k) gap.lump += at(k).final_value - at(k).dtheta;
        gap.dp = -gap.lump;
    }

    void finish(const Gap& gap, const std::vector<std::int64_t>& history) {
        auto points = measured(gap.first - config_.points_before, gap.first - 1);
        const bool before = !points.empty();
        const auto after =
            measured(gap.last + 1, gap.last + (before ? config_.points_after : config_.extrapolation_points));
        points.insert(points.end(), after.begin(), after.end());
        const bool hopeless = length(gap) > longest || points.empty();
        if (!hopeless && after.empty()) points = history;
        for (std::int64_t k = gap.first; k <= gap.last; ++k) {
            Tick& t = at(k);
            t.unrepaired = hopeless;
            t.interpolated = !hopeless && before && !after.empty();
            t.lower_order = !hopeless && order_ > static_cast<int>(points.size()) - 1;
            if (hopeless)
                t.final_value = history.empty() ? 0.0L : fit(history, 0, k);
            else
                t.final_value = fit(points, order_, k);
        }
    }

    // The lump and the late part of the first tick after the gap, in the first measured tick that may carry them.
    void pay_back(Gap& gap) {
        int wait = config_.points_after;
        if (gap.first == 0) wait = std::max(wait, config_.extrapolation_points);
        std::int64_t able = gap.last + 1 + wait;
        while (able < size() && !at(able).measured) ++able;
        if (gap.last + 1 < size()) gap.lump += at(gap.last + 1).amend;
        for (std::int64_t k = gap.first; k < std::min(able, size()); ++k) at(k).settled = false;
        if (able >= size()) return;
        at(able).dtheta += gap.lump;
        // Where nothing is bridged and nothing was amended, nothing is due.
        if (config_.method != zlg::core::BridgeMethod::none || gap.lump != 0.0L) at(able).correction = true;
    }
};

}  // namespace gap_bridge_reference
