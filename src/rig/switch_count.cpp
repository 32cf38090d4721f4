#include <zlg/rig/switch_count.hpp>

#include <algorithm>

#include <fmt/format.h>

#include <zlg/rig/wiring.hpp>

namespace zlg::rig {

std::string sentence(const SwitchTally& tally) {
    std::string text;
    if (tally.failed > 0 && tally.succeeded + tally.withheld == 0)
        text = fmt::format("no switch of modes succeeded, {} failed: the gyro stayed in its mode or holds none",
                           tally.failed);
    else if (tally.failed > 0)
        text = fmt::format("{} of {} switches of modes failed: the gyro went back or had to be searched for",
                           tally.failed, tally.due());
    if (tally.withheld == 0) return text;
    return fmt::format(
        "{}{}{} of {} switches of modes that were due were withheld: the gyro was not ready, for its light was not "
        "to be trusted or it was out of its lock",
        text, text.empty() ? "" : "; ", tally.withheld, tally.due());
}

SwitchCount::SwitchCount(const config::Config& config) {
    const core::ModeSwitchConfig made = control_config(config).mode_switch;
    const config::Switching& sw = config.switching;
    const double interval_s = sw.schedule == config::Schedule::fixed ? sw.interval_s : sw.interval_max_s;
    interval_halves_ = static_cast<std::int64_t>(std::min(2.0 * interval_s / config.gyro.tick_s, 0x1p53));
    patience_halves_ = 2 * (static_cast<std::int64_t>(made.gap_ticks) + made.lock_timeout_ticks);
}

void SwitchCount::take(const LoopHalf& half) {
    const core::HalfRecord& record = half.record;
    waiting_halves_ = half.control.switch_waits ? waiting_halves_ + 1 : 0;
    if (waiting_halves_ > interval_halves_) {
        ++ended_.withheld;
        waiting_halves_ = 1;
    }
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
