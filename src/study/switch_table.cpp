#include <zlg/study/switch_table.hpp>

#include <zlg/core/common/maths.hpp>

namespace zlg::study {
namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

template <class Value> const Value* found(const std::map<std::int64_t, Value>& all, std::int64_t tick) {
    const auto at = all.find(tick);
    return at != all.end() ? &at->second : nullptr;
}

}  // namespace

void SwitchTable::take(std::int64_t tick, const core::HalfRecord& first, const core::HalfRecord& second) {
    finder_.take(tick, first, second);
    const auto& windows = finder_.windows();
    if (!windows.empty() && windows.back().gap_is_over()) switches_[windows.back().first_tick] = windows.back();
}

void SwitchTable::take(const core::AngleRow& row) {
    for (const SwitchWindow& window : finder_.windows()) {
        if (row.tick < window.first_tick || (window.gap_is_over() && row.tick > window.last_tick)) continue;
        if (row.tick == window.first_tick) relock_so_far_arcsec_ = 0.0;
        relock_so_far_arcsec_ += row.relock_arcsec;
        if (window.gap_is_over() && row.tick == window.last_tick)
            relock_arcsec_[window.first_tick] = relock_so_far_arcsec_;
    }
}

std::vector<SwitchLine> SwitchTable::lines() const {
    std::vector<SwitchLine> lines;
    for (const auto& [tick, window] : switches_) {
        const double* relock = found(relock_arcsec_, tick);
        const core::GapReport* gap = found(gaps_, tick);
        lines.push_back({.tick = tick,
                         .mode = window.mode_after,
                         .miss_lambda = window.miss_lambda,
                         .gap_ticks = window.n_ticks,
                         .dp_arcsec = gap != nullptr ? gap->dp_arcsec : unknown,
                         .relock_arcsec = relock != nullptr ? *relock : unknown,
                         .sigma_arcsec = gap != nullptr ? gap->sigma_sum_arcsec : core::infinity});
    }
    return lines;
}

}  // namespace zlg::study
