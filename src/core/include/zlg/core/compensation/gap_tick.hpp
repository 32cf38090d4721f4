#pragma once
// A tick as the gap bridge is given it, and as it remembers it.

#include <cstdint>

#include <zlg/core/records.hpp>

namespace zlg::core {

// One tick as measured, or the place of one in a gap.
struct TickInput {
    bool measured = true;       // false: a tick of a gap
    double value_arcsec = 0.0;  // with the re-lock correction; in a gap what the counter read
    double variance_arcsec2 = 0.0;
    double relock_arcsec = 0.0;            // the correction in it
    double relock_variance_arcsec2 = 0.0;  // its variance, a part of the whole
    double half_excess_arcsec = 0.0;       // first half over the second, without the bias
    double bias_arcsec = 0.0;              // what a positive bias adds to a half, as far as half-ticks are used
    double relock_to_come_arcsec2 = 0.0;   // variance of the corrections after this one, as far as this one tells
    double walk_of_switch_arcsec2 =
        0.0;                      // of a tick of a gap: variance of the random walk in the re-lock ticks after it
    double common_arcsec2 = 0.0;  // part of the variance that all ticks at an even rate have in common
    std::int64_t settled_tick =
        0;                // of a tick of a gap: the first one whose re-lock was over before this gap; its halves and
                          // those of later ones hold the same bias
    bool settled = true;  // re-lock is over: the tick shows the motion alone
    bool with_phase = false;      // the place within the count is known at both ends and in the middle
    bool known_is_rough = false;  // the known sum; the motion around the gap may tell more (gap_known.hpp)
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
    double half_excess_arcsec = 0.0;       // first half over the second, without the bias
    std::int8_t sign = 1;                  // of the bias in its first half
    bool measured = false;
    bool with_phase = false;       // as in TickInput
    bool known_is_rough = false;   // as in TickInput
    std::int64_t known_ticks = 0;  // that end with this one and have a known sum; 0: none
    double known_arcsec = 0.0;
    double known_variance_arcsec2 = 0.0;

    friend bool operator==(const HistoryTick&, const HistoryTick&) = default;
};

}  // namespace zlg::core
