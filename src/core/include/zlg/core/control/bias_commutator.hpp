#pragma once
// The bias commutation as the processor sees it: which sign the field had, which comes next, when it is reversed,
// whether time keeps step.

#include <cstdint>

#include <zlg/core/control/edge_dither.hpp>

namespace zlg::core {

struct BiasCommutatorConfig {
    std::uint64_t half_ticks = 25000;   // nominal half-period in ticks of the timer, 1..2^32
    std::uint64_t tolerance_ticks = 2;  // of the time between two stamps; less than half_ticks
    std::uint64_t latch_ticks = 250;    // an error beyond is a latch at another time
    EdgeDitherConfig dither{.method = DitherMethod::none};
};

// Of the shifted edges: at least a tick, and at most an eighth of a half.
[[nodiscard]] constexpr bool has_cycle(const BiasCommutatorConfig& c) noexcept {
    return c.dither.cycle_ticks >= 1.0 && c.dither.cycle_ticks <= static_cast<double>(c.half_ticks) / 8.0;
}

[[nodiscard]] constexpr bool is_allowed(const BiasCommutatorConfig& c) noexcept {
    const bool shifts = c.dither.method != DitherMethod::none;
    return c.half_ticks >= 1 && c.half_ticks <= std::uint64_t{1} << (shifts ? 30 : 32) &&
           c.tolerance_ticks < c.half_ticks && (!shifts || (is_allowed(c.dither) && has_cycle(c)));
}

struct BiasCommutatorState {
    std::int8_t sign = 0;               // of the last half; 0 before the first
    bool learnt = false;                // the sign rests on an echo
    std::int32_t n_contradictions = 0;  // echoes in a row that were of the other sign
    bool timer_known = false;
    std::uint64_t expected_ticks = 0;  // of the even reversal that ended the last half, by the last stamp
    EdgeDitherState dither{};

    friend constexpr bool operator==(const BiasCommutatorState&, const BiasCommutatorState&) = default;
};

struct BiasCommutatorOutput {
    std::int8_t sign = 1;      // of the half just latched: the echo, or the prediction where it cannot be right
    bool sign_error = false;   // the echo was not +1 or -1, or did not alternate
    bool timer_error = false;  // the stamp did not advance by the time commanded, within the tolerance
    bool latch_error = false;  // by far: the counts are not those of a half
};

// Whether a stamp is nearer to the end of the half to come than to that of any other.
[[nodiscard]] bool is_on_time(const BiasCommutatorConfig& config, const BiasCommutatorState& state,
                              std::uint64_t timer_ticks) noexcept;

// Advance by one half-period.
//
// Which sign comes first is learnt from the first echo. A single wrong echo is overruled by the alternation; four in a
// row that contradict it, alternating themselves, are accepted. Stamps are compared modulo 2^64; after an error, and
// across halves that were not received, counting goes on from the last stamp received.
//
// received  false: the half passed, but nothing is known of it.
// config    passed `is_allowed`.
[[nodiscard]] BiasCommutatorOutput step(const BiasCommutatorConfig& config, BiasCommutatorState& state, bool received,
                                        std::int8_t bias_sign, std::uint64_t timer_ticks) noexcept;

// The shift of the reversal that ends the half to come, in ticks of the timer; positive is later. To be called once
// after each `step`, from the first half on: the law keeps the books of the edges.
[[nodiscard]] std::int32_t next_edge(const BiasCommutatorConfig& config, BiasCommutatorState& state,
                                     const RateReading& reading) noexcept;

}  // namespace zlg::core
