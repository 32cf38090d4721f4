#include <zlg/core/control/bias_commutator.hpp>

namespace zlg::core {
namespace {

// Two wrong echoes in a row can be one disturbance that spans a latch; four cannot.
constexpr std::int32_t contradictions_debounce = 4;

// The sign of this half; returns whether the echo was at fault.
bool track_sign(BiasCommutatorState& s, const BiasCommutatorInput& in) noexcept {
    const std::int8_t predicted = s.sign == 0 ? std::int8_t{1} : static_cast<std::int8_t>(-s.sign);
    s.sign = predicted;
    if (!in.received) return false;

    const bool is_sign = in.bias_sign == 1 || in.bias_sign == -1;
    if (is_sign && !s.learnt) {
        s.learnt = true;
        s.sign = in.bias_sign;
        return false;
    }
    if (is_sign && in.bias_sign == predicted) {
        s.n_contradictions = 0;
        return false;
    }
    s.n_contradictions = is_sign ? s.n_contradictions + 1 : 0;
    if (s.n_contradictions >= contradictions_debounce) {
        s.n_contradictions = 0;
        s.sign = in.bias_sign;
    }
    return true;
}

// How far the stamp is out of step. Every stamp is brought back to the even reversal first.
std::uint64_t track_time(const BiasCommutatorConfig& c, BiasCommutatorState& s,
                         const BiasCommutatorInput& in) noexcept {
    s.expected_ticks += c.half_ticks;
    if (!in.received) return 0;

    // Unsigned differences wrap, so the smaller of the two is the size of the deviation.
    const std::uint64_t even_ticks = in.timer_ticks - static_cast<std::uint64_t>(s.dither.end_ticks);
    const std::uint64_t late = even_ticks - s.expected_ticks;
    const std::uint64_t early = std::uint64_t{0} - late;
    const std::uint64_t error_ticks = s.timer_known ? (late < early ? late : early) : 0;
    s.timer_known = true;
    s.expected_ticks = even_ticks;
    return error_ticks;
}

}  // namespace

bool is_on_time(const BiasCommutatorConfig& config, const BiasCommutatorState& state,
                std::uint64_t timer_ticks) noexcept {
    const std::uint64_t due =
        state.expected_ticks + config.half_ticks + static_cast<std::uint64_t>(state.dither.end_ticks);
    const std::uint64_t late = timer_ticks - due;
    const std::uint64_t early = std::uint64_t{0} - late;
    return state.timer_known && (late < early ? late : early) < config.half_ticks / 2;
}

BiasCommutatorOutput step(const BiasCommutatorConfig& config, BiasCommutatorState& state,
                          const BiasCommutatorInput& input) noexcept {
    BiasCommutatorOutput out;
    out.sign_error = track_sign(state, input);
    const std::uint64_t error_ticks = track_time(config, state, input);
    out.timer_error = error_ticks > config.tolerance_ticks;
    out.latch_error = error_ticks > config.latch_ticks;
    out.sign = state.sign;
    out.next_sign = static_cast<std::int8_t>(-state.sign);
    out.edge_offset_ticks = state.dither.end_ticks;
    return out;
}

std::int32_t next_edge(const BiasCommutatorConfig& config, BiasCommutatorState& state,
                       const RateReading& reading) noexcept {
    if (config.dither.method == DitherMethod::none) return 0;
    const auto next_sign = static_cast<std::int8_t>(-state.sign);
    return step(config.dither, state.dither, {next_sign, reading.helicity, reading.counted, reading.counts})
        .edge_offset_ticks;
}

}  // namespace zlg::core
