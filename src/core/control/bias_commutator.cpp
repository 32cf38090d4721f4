#include <zlg/core/control/bias_commutator.hpp>

namespace zlg::core {
namespace {

// Two wrong echoes in a row can be one disturbance that spans a latch; four cannot.
constexpr std::int32_t contradictions_debounce = 4;

// The sign of this half; returns whether the echo was at fault.
bool track_sign(BiasCommutatorState& s, bool received, std::int8_t echo) noexcept {
    const std::int8_t predicted = s.sign == 0 ? std::int8_t{1} : static_cast<std::int8_t>(-s.sign);
    s.sign = predicted;
    if (!received) return false;

    const bool is_sign = echo == 1 || echo == -1;
    if (is_sign && !s.learnt) {
        s.learnt = true;
        s.sign = echo;
        return false;
    }
    if (is_sign && echo == predicted) {
        s.n_contradictions = 0;
        return false;
    }
    s.n_contradictions = is_sign ? s.n_contradictions + 1 : 0;
    if (s.n_contradictions >= contradictions_debounce) {
        s.n_contradictions = 0;
        s.sign = echo;
    }
    return true;
}

// Unsigned differences wrap, so the smaller of the two is the size of the deviation.
std::uint64_t apart(std::uint64_t a, std::uint64_t b) noexcept { return a - b < b - a ? a - b : b - a; }

// How far the stamp is out of step. Every stamp is brought back to the even reversal first.
std::uint64_t track_time(const BiasCommutatorConfig& c, BiasCommutatorState& s, bool received,
                         std::uint64_t timer_ticks) noexcept {
    s.expected_ticks += c.half_ticks;
    if (!received) return 0;
    const std::uint64_t even_ticks = timer_ticks - static_cast<std::uint64_t>(s.dither.end_ticks);
    const std::uint64_t error_ticks = s.timer_known ? apart(even_ticks, s.expected_ticks) : 0;
    s.timer_known = true;
    s.expected_ticks = even_ticks;
    return error_ticks;
}

}  // namespace

bool is_on_time(const BiasCommutatorConfig& config, const BiasCommutatorState& state,
                std::uint64_t timer_ticks) noexcept {
    const std::uint64_t due =
        state.expected_ticks + config.half_ticks + static_cast<std::uint64_t>(state.dither.end_ticks);
    return state.timer_known && apart(timer_ticks, due) < config.half_ticks / 2;
}

BiasCommutatorOutput step(const BiasCommutatorConfig& config, BiasCommutatorState& state, bool received,
                          std::int8_t bias_sign, std::uint64_t timer_ticks) noexcept {
    const bool sign_error = track_sign(state, received, bias_sign);
    const std::uint64_t error_ticks = track_time(config, state, received, timer_ticks);
    return {.sign = state.sign,
            .sign_error = sign_error,
            .timer_error = error_ticks > config.tolerance_ticks,
            .latch_error = error_ticks > config.latch_ticks};
}

std::int32_t next_edge(const BiasCommutatorConfig& config, BiasCommutatorState& state,
                       const RateReading& reading) noexcept {
    return step(config.dither, state.dither, static_cast<std::int8_t>(-state.sign), reading);
}

}  // namespace zlg::core
