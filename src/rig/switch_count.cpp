#include <zlg/rig/switch_count.hpp>

#include <fmt/format.h>

#include <zlg/rig/wiring.hpp>

namespace zlg::rig {

std::string sentence(const SwitchTally& tally) {
    if (tally.failed == 0) return {};
    if (tally.none_succeeded())
        return fmt::format("no switch of modes succeeded, {} failed: the gyro stayed in its mode or holds none",
                           tally.failed);
    return fmt::format("{} of {} switches of modes failed: the gyro went back or had to be searched for", tally.failed,
                       tally.failed + tally.succeeded);
}

SwitchCount::SwitchCount(const config::Config& config) {
    const core::ModeSwitchConfig made = control_config(config).mode_switch;
    patience_halves_ = 2 * (static_cast<std::int64_t>(made.gap_ticks) + made.lock_timeout_ticks);
}

void SwitchCount::take(const LoopHalf& half) {
    const core::HalfRecord& record = half.record;
    ++halves_since_opening_;
    if (!record.loop_closed && was_closed_ && !is_under_way_) {
        is_under_way_ = true;
        is_switching_ = mode_before_ != 0 && record.mode != mode_before_;
        halves_since_opening_ = 0;
    }
    was_closed_ = record.loop_closed;
    mode_before_ = record.mode;
    if (!half.control.has_event) return;
    if (half.control.event.outcome == core::SwitchOutcome::switched)
        ++ended_.succeeded;
    else if (is_switching_)
        ++ended_.failed;
    is_under_way_ = false;
    is_switching_ = false;
}

}  // namespace zlg::rig
