#include "switch_reader.hpp"

#include <zlg/config/schema.hpp>

namespace zlg::acceptance {
namespace {

// After a switch so many halves are looked at.
constexpr std::int64_t followed_halves = 80;
constexpr std::uint32_t not_trusted = core::flag_unrepaired | core::flag_loop_unlocked | core::flag_invalid;

}  // namespace

SwitchReader::SwitchReader(const config::Config& config) : config_{config}, table_{config.compensation.relock_ticks} {}

void SwitchReader::take(const core::HalfRecord& half) {
    if (n_halves_ % 2 != 0) table_.take(n_halves_ / 2, first_, half);
    first_ = half;
    ++n_halves_;
    follow_lock(half);
}

// From the first half with the loop closed on, where the mode has changed.
void SwitchReader::follow_lock(const core::HalfRecord& half) {
    if (std::isfinite(half.detuning_lambda)) {
        if (!std::isfinite(detuning_)) detuning_ = half.detuning_lambda;
        detuning_varies_ = detuning_varies_ || half.detuning_lambda != detuning_;
    }
    if (!half.loop_closed) {
        closed_halves_ = -1;
    } else if (!was_closed_ && half.mode != mode_before_open_) {
        closed_halves_ = last_beyond_ = 0;
    }
    if (half.loop_closed && closed_halves_ >= 0) {
        ++closed_halves_;
        if (!(std::abs(half.detuning_lambda) <= settled_lambda)) last_beyond_ = closed_halves_;
        if (closed_halves_ == followed_halves) end_lock();
    }
    if (half.loop_closed) mode_before_open_ = half.mode;
    was_closed_ = half.loop_closed;
}

void SwitchReader::end_lock() {
    if (last_beyond_ < followed_halves)
        record_.relock_s.push_back(static_cast<double>(last_beyond_) * 0.5 * config_.gyro.tick_s);
    else
        ++record_.unsettled;
    closed_halves_ = -1;
}

void SwitchReader::take(const core::AngleRow& row) {
    table_.take(row);
    ++ticks_;
    const bool is_gap = (row.flags & not_trusted) != 0;
    if (is_gap && !in_gap_) gap_switches_ = false;
    gap_switches_ = gap_switches_ || (row.flags & core::flag_switching) != 0;
    if (in_gap_ && !is_gap && !gap_switches_) ++record_.alarms;
    in_gap_ = is_gap;
}

// Switches are due at whole intervals: a segment of two holds one that was withheld.
SwitchRecord SwitchReader::finish() {
    if (in_gap_ && !gap_switches_) ++record_.alarms;
    record_.lines = table_.lines();
    record_.detuning_is_dead = std::isfinite(detuning_) && !detuning_varies_;
    record_.half_s = 0.5 * config_.gyro.tick_s;
    record_.hours = static_cast<double>(ticks_) * config_.gyro.tick_s / 3600.0;
    const config::Switching& s = config_.switching;
    if (!config::is_given(config_, "switching.interval_s") || s.interval_optimal ||
        s.schedule != config::Schedule::fixed)
        return std::move(record_);
    record_.withheld = 0;
    const double interval = s.interval_s / config_.gyro.tick_s;
    double last = 0.0;
    const auto passed = [&](double tick) {
        record_.withheld = *record_.withheld + std::max<std::int64_t>(0, std::llround((tick - last) / interval) - 1);
        last = tick;
    };
    for (const study::SwitchLine& line : record_.lines) passed(static_cast<double>(line.tick));
    // The one at the very end is not due yet.
    record_.withheld =
        *record_.withheld + static_cast<std::int64_t>((static_cast<double>(ticks_ - 1) - last) / interval);
    return std::move(record_);
}

}  // namespace zlg::acceptance
