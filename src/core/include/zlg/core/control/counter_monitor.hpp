#pragma once
// The fringe counter, bit by bit: whether one of them is stuck, at 0 or at 1.
//
// Each reading y is predicted from three neighbours on either side, which may turn and swing as they like: a cubic and
// an even alternation, as the bias makes it, are predicted exactly.
//
//   p = ((y_-1 + y_+1) + 2 (y_-2 + y_+2) - (y_-3 + y_+3))/4,   R = 4 (y - p)
//
// A bit is accused by a reading in which it shows another value than in p, taken nearer to the reading by the usual
// size of R, if it may have made that R: its errors, 0 or 2^k in each of the seven readings, make multiples of 2^k up
// to 6 of them. It is stuck where enough readings have accused it, no two alike, and acquitted by the first half in
// which it changes. A motion that returns to the same few readings proves nothing.

#include <array>
#include <cstddef>
#include <cstdint>

namespace zlg::core {

inline constexpr std::size_t judged_bits = 13;

struct CounterMonitorState {
    std::int32_t n_known = 0;                           // readings in a row, one a half, up to 7
    std::array<std::uint32_t, 7> last{};                // the last ones
    std::uint32_t rough = 128;                          // 64 times the usual |R|: the mean of those that accuse none
    std::uint32_t suspected = 0;                        // bits that were accused since they changed last
    std::uint32_t stuck = 0;                            // of these, those with enough readings
    std::int32_t n_calm = 0;                            // halves since the last that was new
    std::array<std::uint64_t, judged_bits> readings{};  // that accuse each bit, hashed to 64 places

    friend constexpr bool operator==(const CounterMonitorState&, const CounterMonitorState&) = default;
};

// Advance by one half-period; returns whether a bit is stuck: no later counts are to be trusted.
//
// counted  the reading is that of this half, the one before was that of the half before, and the gyro lased in both.
// latency  26 accusing readings for bit 1, 12 from bit 8 on: some 90 halves where a half turns by 2^k and more, else
//          ten times 2^k counts of rotation. A bit that changes again is accepted at once, and so is any after 400
//          halves without a new accusation.
// errors   bit 0 is not judged (a count more or less is within every sigma; by phase the reading is in half counts),
// nor
//          are those from 13 on, whose errors are out of the bias's band.
[[nodiscard]] bool step(CounterMonitorState& state, bool counted, std::uint64_t reading) noexcept;

}  // namespace zlg::core
