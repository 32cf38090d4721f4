#pragma once
// The fringe counter, bit by bit: whether one of them is stuck, at 0 or at 1.
//
// A stuck bit k puts an error of 0 or 2^k into a reading, by what the bit should be. So the counter is followed as a
// steady rotation goes on, x for the readings of either bias sign and one rate v for both, and the error e that makes
// the reading fit best is taken off:
//
//   p = x_(h-2) + 2 v,   d = R_h - e_h - p,   e_h = 0, or the 2^k of the bit under suspicion, either way
//   x_h = p + d/4,       v <- v + d/32
//
// A first d near a power of two, larger than the tolerance, puts that bit under suspicion. The suspicion ends where the
// bit changes. It grows by one where the counter has moved on by 2^k while the error came or went, always one way and
// with every d within the tolerance: then the true counter has passed both values of the bit. A counter that stands
// still or swings to and fro over the same few readings proves nothing.
//
//   tolerance = 1 count + 2 a,   a: the mean size of d, which grows no faster than by 1/64 of a larger d

#include <array>
#include <cstdint>

namespace zlg::core {

// A bit under suspicion.
struct SuspectedBit {
    std::uint32_t value = 0;                // 2^k; 0: none
    std::uint32_t shown = 0;                // what it shows: 0 or its value
    std::array<std::int8_t, 2> error_of{};  // of the last two readings: e over 2^k
    bool has_from = false;
    bool has_toggled = false;   // the error has come or gone since then
    bool upwards = false;       // the way of the counter
    std::uint32_t from = 0;     // the counter without the error, where the suspicion grew last
    std::int32_t n_passed = 0;  // so many times it did
    std::int32_t n_calm = 0;    // halves since

    friend constexpr bool operator==(const SuspectedBit&, const SuspectedBit&) = default;
};

struct CounterMonitorState {
    std::int32_t n_known = 0;              // readings in a row, one a half, up to 4
    bool is_odd = false;                   // the half
    std::array<std::uint32_t, 2> place{};  // x at the last half and the one before, 1/256 count
    std::int32_t rate = 0;                 // v, 1/8192 count
    std::int32_t rough = 256;              // a, 1/256 count
    std::int32_t n_lost = 0;               // of the last halves, so many more with a d beyond the tolerance than within
    SuspectedBit suspect{};
    std::uint32_t cleared = 0;  // bits that were under suspicion and have changed
    bool stuck = false;         // the one under suspicion

    friend constexpr bool operator==(const CounterMonitorState&, const CounterMonitorState&) = default;
};

// Advance by one half-period; returns whether a bit is stuck: no later counts are to be trusted.
//
// counted  the reading is that of this half, the one before was that of the half before, and the gyro lased in both.
// latency  six times 2^k counts of rotation, and at least 20 halves. A bit that changes again is accepted at once, and
// so is
//          any after 400 halves in which the suspicion did not grow.
// errors   bit 0 is not judged (a count more or less is within every sigma), nor are those from 13 on, whose errors are
//          out of the bias's band. Bit k is judged where the tolerance is at most 2^k. Of two stuck bits the one is
//          found whose error comes and goes while that of the other stays.
[[nodiscard]] bool step(CounterMonitorState& state, bool counted, std::uint64_t reading) noexcept;

}  // namespace zlg::core
