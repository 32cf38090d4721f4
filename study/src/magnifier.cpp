#include "magnifier.hpp"

#include <algorithm>

namespace zlg::study {

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
