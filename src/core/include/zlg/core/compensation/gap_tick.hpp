#pragma once
// A tick as the gap bridge is given it, and as it remembers it.

#include <array>
#include <cstdint>

#include <zlg/core/common/maths.hpp>
#include <zlg/core/records.hpp>

namespace zlg::core {

// What a half-tick was read as, where its counts are an angle: after the loop is closed, or before it where both beams
// are lit.
struct HalfReading {
    bool read = false;
    bool lit = false;             // in a gap
    std::int8_t sign = 1;         // bias_sign * mode
    float false_arcsec2 = -1.0F;  // variance of `false_arcsec`, by the noise of the light; negative: not measured
    double angle_arcsec = 0.0;    // without the bias; its false angle is in it
    double false_arcsec = 0.0;    // -s D of the recorded mean square of the detuning: what is to be subtracted

    friend bool operator==(const HalfReading&, const HalfReading&) = default;
};

// One tick as measured, or the place of one in a gap.
struct TickInput {
    bool late = false;          // as it is recorded: the estimate of a gap that is due now was not ready
    bool measured = true;       // false: a tick of a gap
    double value_arcsec = 0.0;  // with the re-lock correction; in a gap what the counter read
    double variance_arcsec2 = 0.0;
    double relock_arcsec = 0.0;            // the correction in it
    double relock_variance_arcsec2 = 0.0;  // its variance, a part of the whole
    std::array<HalfReading, 2> half{};     // of `automatic`
    double common_arcsec2 = 0.0;           // part of the variance that all ticks at an even rate have in common
    bool settled = true;                   // re-lock is over: the tick shows the motion alone
    bool with_phase = false;               // the place within the count is known at both ends and in the middle
    bool known_is_rough = false;           // the known sum; the motion around the gap may tell more (gap_known.hpp)
    std::int8_t mode = 1;
    std::int8_t sign = 1;  // bias_sign * mode in its first half
    std::uint32_t flags = 0;
    bool amend_previous = false;          // the previous, measured tick becomes final now
    double amend_arcsec = 0.0;            // to be added to its final value
    double amend_variance_arcsec2 = 0.0;  // to be added to its variance
    std::uint32_t amend_flags = 0;
    std::int64_t known_ticks = 0;  // so many ticks of the gap, this one the last, have a known sum; 0: none
    double known_arcsec = 0.0;     // that sum
    double known_variance_arcsec2 = 0.0;
    double known_drift_arcsec2 = 0.0;  // the part of it that the detuning makes
};

struct HistoryTick {
    AngleRow row{};
    double variance_arcsec2 = 0.0;
    double relock_variance_arcsec2 = 0.0;  // of the re-lock correction, a part of the variance
    std::array<HalfReading, 2> half{};
    double share = 0.0;  // of a tick of a gap that is estimated: its part of what the angle of the gap is off by
    // As in TickInput.
    bool measured : 1 = false;
    bool settled : 1 = false;
    bool with_phase : 1 = false;
    bool known_is_rough : 1 = false;
    bool by_phase : 1 = false;     // the readings had the place within the count, by majority
    std::int32_t known_ticks = 0;  // that end with this one and have a known sum; 0: none
    double known_arcsec = 0.0;
    double known_variance_arcsec2 = 0.0;

    friend bool operator==(const HistoryTick&, const HistoryTick&) = default;
};

// Its halves show the motion alone.
[[nodiscard]] inline bool is_settled(const HistoryTick& entry) noexcept {
    return entry.measured && entry.settled && is_finite(entry.variance_arcsec2) && entry.half[0].read &&
           entry.half[1].read && (!entry.by_phase || entry.with_phase);
}

}  // namespace zlg::core
