#include "magnifier.hpp"

#include <algorithm>

namespace zlg::study {

MagnifiedTick shown_tick(std::int64_t tick, double scale_arcsec, const rig::LoopHalf& first,
                         const rig::LoopHalf& second) {
    const auto counts = static_cast<double>(first.record.counts + second.record.counts);
    return {.tick = tick,
            .measured = is_measured(first.record, second.record),
            .read_arcsec = scale_arcsec * counts,
            .true_arcsec = first.truth.dtheta_arcsec + second.truth.dtheta_arcsec,
            .detuning_lambda = {first.record.detuning_lambda, second.record.detuning_lambda},
            .true_detuning_lambda = {first.truth.detuning_end_lambda, second.truth.detuning_end_lambda}};
}

void Magnifier::take(const MagnifiedTick& tick, const std::deque<SwitchWindow>& windows) {
    if (!kept_.empty()) return;
    recent_.push_back(tick);
    if (recent_.size() > 64) recent_.pop_front();
    for (const SwitchWindow& window : windows) {
        if (!window.gap_is_over()) continue;
        const std::int64_t last = std::min(window.last_tick, window.first_tick + window.n_ticks - 1 + ticks_after);
        if (tick.tick != last) continue;
        for (const MagnifiedTick& t : recent_)
            if (t.tick >= window.first_tick - ticks_before) kept_.push_back(t);
    }
}

}  // namespace zlg::study
