#include <zlg/study/half_wave_replay.hpp>

#include <cmath>

#include <zlg/config/schema.hpp>
#include <zlg/rig/wiring.hpp>

namespace zlg::study {
namespace {

// Gaps end where those of the log do, and no lock fails.
constexpr std::int32_t never_ticks = 1 << 24;

core::ModeSwitchConfig led(core::ModeSwitchConfig sequence) {
    sequence.gap_ticks = sequence.lock_timeout_ticks = never_ticks;
    sequence.gap_min_ticks = 1;
    return sequence;
}

}  // namespace

HalfWaveReplay::HalfWaveReplay(const config::Config& config) : half_wave_{rig::measured_half_wave(config)} {
    try {
        sequence_ = led(rig::control_config(config).mode_switch);
    } catch (const config::ConfigError&) {
        possible_ = false;
    }
    state_ = core::initial_state(sequence_);
}

void HalfWaveReplay::take(const core::HalfRecord& half) {
    if (possible_ && n_halves_ > 0) step(last_, half);
    last_ = half;
    ++n_halves_;
}

void HalfWaveReplay::step(const core::HalfRecord& half, const core::HalfRecord& next) {
    // A loop that opens for another reason than a switch, or before the last lock: begin anew with the next closed
    // half.
    if (state_.loop_closed != half.loop_closed) {
        state_ = core::initial_state(sequence_);
        return;
    }
    // The control records 0 where the light tells no detuning, and uses one that it tells also where the counts are not
    // valid.
    const bool usable = std::isfinite(half.detuning_lambda) && half.detuning_lambda != 0.0;
    const bool lit = half.valid || usable;
    const bool opens = half.loop_closed && !next.loop_closed;
    const bool closes = !half.loop_closed && next.loop_closed;
    core::ModeSwitchInput in{.due = opens && next.mode != half.mode,
                             .tick_border = opens || closes,
                             .next_tick = n_halves_ / 2,
                             .light_known = lit,
                             .two_way = lit,
                             .usable = usable,
                             .detuning = core::Wavelengths{half.detuning_lambda},
                             .piezo = core::Volts{half.piezo_v},
                             .set_point = core::Volts{half.piezo_v},
                             .half_wave = core::Volts{half_wave_.estimate_v}};
    // Led back from an end of its range, the piezo teaches nothing.
    in.recentre = in.due && core::near_end(sequence_.range, in.piezo) &&
                  !core::choose_direction(sequence_.range, in.piezo, in.half_wave).out_of_range;
    if (!half.loop_closed) {
        in.light_known = in.two_way = in.usable = in.at_rest = closes;
        in.detuning = core::Wavelengths{0.0};
    }
    const std::optional<core::SwitchEvent> event = core::step(sequence_, state_, in);
    if (!event) return;
    half_wave_.take(*event);
    measured_ = measured_ || event->has_half_wave;
    if (measured_) after_[event->tick_opened] = half_wave_;
}

void HalfWaveReplay::fill(std::vector<SwitchLine>& lines) const {
    for (SwitchLine& line : lines) {
        const auto known = after_.find(line.tick);
        if (known == after_.end()) continue;
        line.half_wave_v = known->second.estimate_v;
        line.half_wave_sigma_v = known->second.sigma_v();
    }
}

}  // namespace zlg::study
