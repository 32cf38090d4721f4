#pragma once
// The bias commutation as the processor sees it: which sign the field had, which comes next, when it is reversed,
// whether time keeps step.

#include <cstdint>

#include <zlg/core/control/edge_dither.hpp>

namespace zlg::core {

struct BiasCommutatorConfig {
    std::uint64_t half_ticks = 25000;                       // nominal half-period in ticks of the timer, 1..2^32
    std::uint64_t tolerance_ticks = 2;                      // of the time between two stamps; less than half_ticks
    std::uint64_t latch_ticks = 250;                        // an error beyond is a latch at another time
    EdgeDitherConfig dither{.method = DitherMethod::none};  // where it has a method: of the same half_ticks
};

enum class BiasCommutatorFault : unsigned char { none, half_ticks, tolerance, dither };

[[nodiscard]] constexpr BiasCommutatorFault check(const BiasCommutatorConfig& c) noexcept {
    if (!(c.half_ticks >= 1 && c.half_ticks <= (std::uint64_t{1} << 32))) return BiasCommutatorFault::half_ticks;
    if (!(c.tolerance_ticks < c.half_ticks)) return BiasCommutatorFault::tolerance;
    if (c.dither.method == DitherMethod::none) return BiasCommutatorFault::none;
    if (check(c.dither) != EdgeDitherFault::none || c.dither.half_ticks != c.half_ticks) {
        return BiasCommutatorFault::dither;
    }
    return BiasCommutatorFault::none;
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

struct BiasCommutatorInput {
    bool received = false;  // false: the half passed, but nothing is known of it
    std::int8_t bias_sign = 0;
    std::uint64_t timer_ticks = 0;
};

struct BiasCommutatorOutput {
    std::int8_t sign = 1;        // of the half just latched: the echo, or the prediction where the echo cannot be right
    std::int8_t next_sign = -1;  // of the half to come
    std::int32_t edge_offset_ticks = 0;  // of the reversal that ended the half just latched, as it was commanded
    bool sign_error = false;             // the echo was not +1 or -1, or did not alternate
    bool timer_error = false;            // the stamp did not advance by the time commanded, within the tolerance
    bool latch_error = false;            // by far: the counts are not those of a half
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
// config  passed `check`.
[[nodiscard]] BiasCommutatorOutput step(const BiasCommutatorConfig& config, BiasCommutatorState& state,
                                        const BiasCommutatorInput& input) noexcept;

// The rate in the half just latched, by which the law of the shifts is chosen.
struct RateReading {
    bool counted = false;  // the counts are those of this half, and are rotation and bias
    std::int64_t counts = 0;
    std::int8_t helicity = 1;  // that lased: +1 or -1
};

// The shift of the reversal that ends the half to come, in ticks of the timer; positive is later. To be called once
// after each `step`, from the first half on: the law keeps the books of the edges.
[[nodiscard]] std::int32_t next_edge(const BiasCommutatorConfig& config, BiasCommutatorState& state,
                                     const RateReading& reading) noexcept;

}  // namespace zlg::core
